#pragma once

#include "Catch.hpp"
#include "Fixture.hpp"
#include "ManualClock.hpp"
#include "SeededRandom.hpp"
#include "SessionProbe.hpp"
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

/// A session with its clock, and shorthands for what happens to it.
class AcsSessionBench
{
public:
    ManualClock clock;
    SeededRandom random;
    Protocol::AcsSession session;
    SessionProbe probe;

    explicit AcsSessionBench(const Protocol::SessionOptions& options = MakeOptions())
        : session(options, random)
    {
    }

    void Text(const std::string& text)
    {
        probe.Clear();
        session.OnText(text, clock.GetNow(), probe.out);
    }

    void Timer(Protocol::ESessionTimer timer, std::chrono::milliseconds after)
    {
        probe.Clear();
        clock.Advance(after);
        session.OnTimer(timer, clock.GetNow(), probe.out);
    }

    void Closed()
    {
        probe.Clear();
        session.OnClosed("gone", clock.GetNow(), probe.out);
    }

    /// The plan of the fixture ExecutionPlanLR is taken.
    void AnswerPlan()
    {
        session.Answer(
            Protocol::EAcsCommand::ExecutionPlan,
            "e2a97f63-4ed2-4d85-a2b3-11a51c188111",
            Protocol::EAckResult::Success,
            "registered",
            Protocol::PlanAck{"PLAN-20250702-001"},
            clock.GetNow(),
            probe.out);
    }

    [[nodiscard]] bool TrySend(const std::string& transactionID)
    {
        return session.TrySendDurable(MakeReport(transactionID), clock.GetNow(), probe.out);
    }

    /// From Connecting to Registered.
    void Register()
    {
        probe.Clear();
        session.OnConnected(clock.GetNow(), probe.out);
        const std::vector<Protocol::AcsRequest> requests = probe.GetRequests();
        REQUIRE(requests.size() == 1);
        Text(MakeAckText("Registration", requests[0].transactionID));
        REQUIRE(probe.GetEvents<Protocol::Registered>().size() == 1);
    }

    void StartAndRegister()
    {
        session.Start(clock.GetNow(), probe.out);
        Register();
    }

    void StartAndReplay()
    {
        StartAndRegister();
        probe.Clear();
        session.ReplayDone(clock.GetNow(), probe.out);
    }

    void AckAllRequests()
    {
        for (const Protocol::AcsRequest& request : probe.GetRequests())
        {
            session.OnText(
                MakeAckText(std::string(GetText(GetCommand(request))), request.transactionID),
                clock.GetNow(),
                probe.out);
        }
    }
};

} // namespace ACS::Testing
