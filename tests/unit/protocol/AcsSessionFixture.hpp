#pragma once

#include "ActionRecorder.hpp"
#include "Catch.hpp"
#include "Fixture.hpp"
#include "ManualClock.hpp"
#include "SeededRandom.hpp"
#include <acs/protocol/AcsSession.hpp>

#include <chrono>
#include <string>
#include <vector>

namespace ACS::Testing
{

inline Protocol::AcsRequest MakeReport(const std::string& transactionID)
{
    return {
        transactionID,
        {Core::WallTime(std::chrono::seconds(1'751'457'600)), std::chrono::hours(9)},
        Protocol::PlanReport{"P", Protocol::EPlanStatus::InProgress, "fine"}};
}

inline Protocol::AcsPayload MakeStatus(const std::string& robotID, Protocol::ERobotStatus status)
{
    Protocol::RobotStatusUpdate update;
    update.robotID = robotID;
    update.robotStatus = status;
    return update;
}

inline Protocol::SessionOptions MakeOptions()
{
    Protocol::SessionOptions options;
    options.positionInterval = std::chrono::milliseconds(0);
    return options;
}

/// A session with its clock, and shorthands for its inputs.
class AcsSessionFixture
{
public:
    ManualClock clock;
    SeededRandom random;
    Protocol::AcsSession session;
    ActionRecorder recorder;

    explicit AcsSessionFixture(const Protocol::SessionOptions& options = MakeOptions())
        : session(options, random)
    {
    }

    void Text(const std::string& text)
    {
        recorder.Clear();
        session.OnText(text, clock.GetNow(), recorder.out);
    }

    void Timer(Protocol::ESessionTimer timer, std::chrono::milliseconds after)
    {
        recorder.Clear();
        clock.Advance(after);
        session.OnTimer(timer, clock.GetNow(), recorder.out);
    }

    void Closed()
    {
        recorder.Clear();
        session.OnClosed("gone", clock.GetNow(), recorder.out);
    }

    /// The plan of the fixture ExecutionPlanLR is accepted.
    void AnswerPlan()
    {
        session.Answer(
            Protocol::EAcsCommand::ExecutionPlan,
            "e2a97f63-4ed2-4d85-a2b3-11a51c188111",
            Protocol::EAckResult::Success,
            "registered",
            Protocol::PlanAck{"PLAN-20250702-001"},
            clock.GetNow(),
            recorder.out);
    }

    [[nodiscard]] bool TrySend(const std::string& transactionID)
    {
        return session.TrySendDurable(MakeReport(transactionID), clock.GetNow(), recorder.out);
    }

    /// From Connecting to Registered.
    void Register()
    {
        recorder.Clear();
        session.OnConnected(clock.GetNow(), recorder.out);
        const std::vector<Protocol::AcsRequest> requests = recorder.GetRequests();
        REQUIRE(requests.size() == 1);
        Text(MakeAckText("Registration", requests[0].transactionID));
        REQUIRE(recorder.GetEvents<Protocol::Registered>().size() == 1);
    }

    void StartAndRegister()
    {
        session.Start(clock.GetNow(), recorder.out);
        Register();
    }

    void StartAndReplay()
    {
        StartAndRegister();
        recorder.Clear();
        session.ReplayDone(clock.GetNow(), recorder.out);
    }

    void AckAllRequests()
    {
        for (const Protocol::AcsRequest& request : recorder.GetRequests())
        {
            session.OnText(
                MakeAckText(std::string(GetText(GetCommand(request))), request.transactionID),
                clock.GetNow(),
                recorder.out);
        }
    }
};

} // namespace ACS::Testing
