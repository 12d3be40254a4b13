#pragma once

#include "Catch.hpp"
#include "judge/McsJudge.hpp"
#include "ManualClock.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Testing
{

/// A judge in virtual time, and texts of both sides. Ids are short numbers that become UUIDs.
class JudgeFixture
{
public:
    static constexpr std::string_view PLAN =
        R"({"planId":"P","lotId":"L","steps":[{"stepNo":1,"action":"CassetteLoad","position":"A01.CP01","carrierIds":["C"],)"
        R"("jobs":[{"jobId":"J","from":"A01.CP01","to":"AMR.CP01"}]}]})";
    static constexpr std::string_view REPORT = R"({"planId":"P","status":"InProgress","message":""})";
    static constexpr std::string_view STATE = R"({"state":"Auto"})";

    ManualClock clock;
    AcsSim::McsJudge judge;

    [[nodiscard]] static std::string MakeID(int number)
    {
        return fmt::format("00000000-0000-4000-8000-{:012}", number);
    }

    [[nodiscard]] static std::string MakeRequest(std::string_view command, int id, std::string_view payload)
    {
        return fmt::format(
            R"({{"command":"{}","transactionId":"{}","timestamp":"2025-07-02T21:00:00.123+09:00","payload":{}}})",
            command,
            MakeID(id),
            payload);
    }

    [[nodiscard]] static std::string MakeAck(std::string_view command, int id, std::string_view result = "Success")
    {
        return fmt::format(
            R"({{"command":"{}Ack","transactionId":"{}","timestamp":"2025-07-02T21:00:00.123+09:00","result":"{}",)"
            R"("message":"","payload":{{}}}})",
            command,
            MakeID(id),
            result);
    }

    void Sent(const std::string& text)
    {
        judge.OnSent(text, clock.GetNow().steady);
    }

    void Received(const std::string& text)
    {
        judge.OnReceived(text, clock.GetNow().steady);
    }

    void Ask(std::string_view command, int id, std::string_view payload, std::string_view result = "Success")
    {
        Sent(MakeRequest(command, id, payload));
        Received(MakeAck(command, id, result));
    }

    void Register(int id = 1)
    {
        Ask("Registration", id, "{}");
    }

    /// Registered, with the plan P, which is accepted.
    void Begin()
    {
        Register();
        Received(MakeRequest("ExecutionPlan", 2, PLAN));
        Sent(MakeAck("ExecutionPlan", 2));
    }

    void Wait(std::chrono::milliseconds time)
    {
        clock.Advance(time);
        judge.OnTick(clock.GetNow().steady);
    }

    [[nodiscard]] std::vector<AcsSim::ERule> GetViolated()
    {
        std::vector<AcsSim::ERule> rules;
        for (std::size_t i = 0; i < AcsSim::RULE_COUNT; ++i)
        {
            if (judge.GetBook().GetRow(static_cast<AcsSim::ERule>(i)).violated > 0)
            {
                rules.push_back(static_cast<AcsSim::ERule>(i));
            }
        }
        return rules;
    }

    [[nodiscard]] bool WasKept(AcsSim::ERule rule)
    {
        return judge.GetBook().GetRow(rule).kept > 0;
    }
};

} // namespace ACS::Testing
