#include "RunJudge.hpp"

#include "Catch.hpp"

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
