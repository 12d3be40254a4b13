#include "RunJudge.hpp"

#include "Catch.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace
{

namespace Protocol = ACS::Protocol;

using ACS::McsSim::RunJudge;

struct RunJudgeFixture
{
    ACS::McsSim::PlanTracker::Lines lines;
    RunJudge judge{ACS::McsSim::SimulatorOptions{}, {}, lines};

    [[nodiscard]] std::size_t Finish()
    {
        judge.Finish();
        return judge.GetTracker().CountViolations();
    }

    void LeaveUnanswered()
    {
        judge.OnUnanswered({Protocol::EAcsCommand::CancelPlan, "T1", Protocol::EUnansweredReason::Timeout, 1});
    }

    void Acknowledge(bool bLate)
    {
        Protocol::AcsAck ack;
        ack.command = Protocol::EAcsCommand::CancelPlan;
        ack.transactionID = "T1";
        ack.payload = Protocol::PlanAck{"P1"};
        judge.OnAck({ack, bLate});
    }

    void NoteStrayAck()
    {
        judge.OnNoted({Protocol::EProtocolNote::AckUnexpected, 1, "CancelPlan"});
    }
};

} // namespace

TEST_CASE("An Ack that fits nothing is excused once where a request was not answered")
{
    RunJudgeFixture fixture;
    fixture.LeaveUnanswered();
    fixture.Acknowledge(false); // of another request
    fixture.NoteStrayAck();
    CHECK(fixture.judge.GetTracker().CountViolations() == 0);
    fixture.NoteStrayAck();
    CHECK(fixture.judge.GetTracker().CountViolations() == 1);
}

TEST_CASE("Nothing is excused by a request whose connection was lost or replaced")
{
    RunJudgeFixture fixture;
    for (const auto reason : {Protocol::EUnansweredReason::LinkLost, Protocol::EUnansweredReason::Replaced})
    {
        fixture.judge.OnUnanswered({Protocol::EAcsCommand::CancelPlan, "T1", reason, 1});
    }
    fixture.NoteStrayAck();
    CHECK(fixture.judge.GetTracker().CountViolations() == 1);
}

TEST_CASE("An Ack that fits nothing is not excused by a request whose Ack came late")
{
    RunJudgeFixture fixture;
    fixture.LeaveUnanswered();
    fixture.Acknowledge(true);
    CHECK(fixture.lines.back() == "P1 CancelPlanAck Success");
    fixture.NoteStrayAck();
    CHECK(fixture.judge.GetTracker().CountViolations() == 1);
}

TEST_CASE("6.1, R1 A request without an Ack is a violation at the end of the run")
{
    RunJudgeFixture fixture;
    fixture.LeaveUnanswered();
    CHECK(fixture.judge.GetTracker().CountViolations() == 0);
    CHECK(fixture.Finish() == 1);
    CHECK(fixture.lines.back() == "VIOLATION ACS CancelPlan was not answered");
}

TEST_CASE("R1 A request is answered by a late Ack")
{
    RunJudgeFixture fixture;
    fixture.LeaveUnanswered();
    fixture.Acknowledge(true);
    CHECK(fixture.Finish() == 0);
}

TEST_CASE("R1 It is unknown whether a request was answered where the connection was lost after its time limit")
{
    RunJudgeFixture fixture;
    fixture.LeaveUnanswered();
    fixture.judge.OnLinkLost();
    CHECK(fixture.Finish() == 0);
}

TEST_CASE("R1 A request is answered by an Ack that the simulator has lost, before its time limit or after it")
{
    const bool bBefore = GENERATE(false, true);
    CAPTURE(bBefore);
    RunJudgeFixture fixture;
    if (!bBefore)
    {
        fixture.LeaveUnanswered();
    }
    fixture.judge.OnTextLost(
        R"({"command":"CancelPlanAck","transactionId":"T1","timestamp":"2025-07-02T21:00:00.123+09:00",)"
        R"("result":"Success","message":"","payload":{"planId":"P1"}})");
    if (bBefore)
    {
        fixture.LeaveUnanswered();
    }
    CHECK(fixture.Finish() == 0);
}
