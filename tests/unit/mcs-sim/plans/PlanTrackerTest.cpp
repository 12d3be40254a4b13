#include "plans/PlanTracker.hpp"

#include "Catch.hpp"
#include "plans/PlanTrackerFixture.hpp"

#include <chrono>
#include <string>
#include <vector>

using ACS::McsSim::EDelivery;
using ACS::McsSim::EOutcome;
using ACS::McsSim::PlanTracker;
using ACS::Protocol::EAckResult;
using ACS::Protocol::EJobStatus;
using ACS::Protocol::EPlanStatus;
using ACS::Protocol::EStepStatus;
using ACS::Testing::MakeAck;
using ACS::Testing::MakeJobReport;
using ACS::Testing::MakePlanReport;
using ACS::Testing::MakeSamplePlan;
using ACS::Testing::MakeStepReport;
using ACS::Testing::ManualClock;
using ACS::Testing::PlanTrackerFixture;

TEST_CASE("Nothing is sent before an ACS has registered")
{
    PlanTrackerFixture fixture(2);
    CHECK(fixture.Send().empty());
    fixture.tracker.OnRegistered();
    CHECK(fixture.Send() == "P1 P2");
    CHECK(fixture.Send().empty());
}

TEST_CASE("6.21 No plan is sent while the ACS reports that it accepts no work")
{
    PlanTrackerFixture fixture;
    fixture.tracker.OnRegistered();
    fixture.Report({ACS::Protocol::AcsCommStateUpdate{false}});
    CHECK(fixture.Send().empty());
    fixture.Report({ACS::Protocol::AcsCommStateUpdate{true}});
    CHECK(fixture.Send() == "P1");
}

TEST_CASE("A plan that is not acknowledged within five seconds is sent again")
{
    PlanTrackerFixture fixture(2);
    fixture.tracker.OnRegistered();
    fixture.Send();
    fixture.Ack(0);
    fixture.clock.Advance(std::chrono::milliseconds(4'999));
    CHECK(fixture.Send().empty());
    fixture.clock.Advance(std::chrono::milliseconds(1));
    CHECK(fixture.Send() == "P2");
    CHECK(fixture.lines.back() == "P2 ExecutionPlan sent again");
    CHECK(fixture.tracker.CountResends() == 1);
    fixture.Ack(1);
    fixture.clock.Advance(std::chrono::milliseconds(60'000));
    CHECK(fixture.Send().empty());
}

TEST_CASE("After a reconnect only what was not acknowledged is sent again")
{
    PlanTrackerFixture fixture(3);
    fixture.tracker.OnRegistered();
    fixture.Send();
    fixture.Ack(1);
    fixture.tracker.OnLinkLost();
    CHECK(fixture.Send().empty());
    fixture.tracker.OnRegistered();
    CHECK(fixture.Send() == "P1 P3");
}

TEST_CASE("The number of plans that wait for their Ack is limited")
{
    PlanTrackerFixture fixture(PlanTracker::SEND_WINDOW + 2);
    fixture.tracker.OnRegistered();
    fixture.Send();
    CHECK(fixture.lines.size() == PlanTracker::SEND_WINDOW);
    fixture.Ack(7);
    CHECK(fixture.Send() == "P" + std::to_string(PlanTracker::SEND_WINDOW + 1));
}

TEST_CASE("A plan that is blocked lets later ones go, and is due when it is unblocked")
{
    PlanTrackerFixture fixture(3);
    fixture.tracker.Block(0);
    fixture.tracker.OnRegistered();
    CHECK(fixture.Send() == "P2 P3");
    fixture.Ack(1);
    fixture.Ack(2);
    CHECK(fixture.Send().empty());
    fixture.tracker.Unblock(0);
    CHECK(fixture.Send() == "P1");
}

TEST_CASE(
    "6.13 A step is Skipped before it begins or while it is InProgress, and the plan continues without a JobReport")
{
    PlanTrackerFixture fixture;
    fixture.tracker.OnRegistered();
    fixture.Send();
    fixture.Report({MakePlanReport("P1", EPlanStatus::InProgress)});
    SECTION("from InProgress")
    {
        fixture.Report(
            {MakeStepReport("P1", 1, EStepStatus::Dispatched),
             MakeStepReport("P1", 1, EStepStatus::InProgress),
             MakeJobReport("P1", 1, "J1", EJobStatus::Instructed)});
    }
    SECTION("from Pending")
    {
    }
    fixture.Report({MakeStepReport("P1", 1, EStepStatus::Skipped)});
    fixture.RunSecondStep();
    fixture.Report({MakePlanReport("P1", EPlanStatus::Completed)});
    CHECK(fixture.tracker.CountViolations() == 0);
    CHECK(fixture.tracker.IsSuccess());
    fixture.Report({MakeStepReport("P1", 1, EStepStatus::Skipped)});
    CHECK(fixture.tracker.CountViolations() == 1);
}

TEST_CASE("6.4 A refused plan has failed, for the reason that the ACS gave")
{
    PlanTrackerFixture fixture;
    fixture.tracker.OnRegistered();
    fixture.Send();
    fixture.Ack(0, EAckResult::Fail, "no such place as A09.CP01");
    CHECK(fixture.tracker.IsFinished());
    CHECK_FALSE(fixture.tracker.IsSuccess());
    CHECK(fixture.tracker.CountOutcome(EOutcome::Refused) == 1);
    CHECK(fixture.tracker.CountFailed() == 1);
    CHECK(fixture.GetFirst().reason == "no such place as A09.CP01");
    CHECK(fixture.lines.back() == "P1 ExecutionPlanAck Fail: no such place as A09.CP01");
    fixture.Report({MakePlanReport("P1", EPlanStatus::InProgress)});
    CHECK(fixture.GetViolation() == "P1 PlanReport after it was refused");
}

TEST_CASE("A late Ack that was taken for another transaction counts for the plan that it names")
{
    PlanTrackerFixture fixture(2);
    fixture.tracker.OnRegistered();
    fixture.Send();
    ACS::Protocol::AcsAck late = MakeAck(fixture.tracker.GetPlans()[0].planned, EAckResult::Success);
    late.transactionID = "T2";
    fixture.tracker.OnAck(late, fixture.lines);
    CHECK(fixture.tracker.GetPlans()[0].delivery == EDelivery::Accepted);
    CHECK(fixture.tracker.GetPlans()[1].delivery == EDelivery::Sent);
}

TEST_CASE("A plan that is being reported is not refused by the answer to its repetition")
{
    PlanTrackerFixture fixture;
    fixture.tracker.OnRegistered();
    fixture.Send();
    fixture.Report({MakePlanReport("P1", EPlanStatus::InProgress)});
    fixture.Ack(0, EAckResult::Fail, "Duplicated Plan");
    CHECK(fixture.GetFirst().delivery == EDelivery::Accepted);
    CHECK(fixture.tracker.CountOutcome(EOutcome::Open) == 1);
}

TEST_CASE("6.3 A plan that is reported has an Ack before the end of the run, unless a lost link took it")
{
    PlanTrackerFixture fixture;
    fixture.tracker.OnRegistered();
    fixture.Send();
    std::size_t violations = 1;
    SECTION("without an Ack")
    {
    }
    SECTION("with an Ack")
    {
        fixture.Ack(0);
        violations = 0;
    }
    SECTION("with a lost link, and no Ack of the repetition yet")
    {
        fixture.tracker.OnLinkLost();
        fixture.tracker.OnRegistered();
        CHECK(fixture.Send() == "P1");
        violations = 0;
    }
    SECTION("with an Ack that was lost by the simulator")
    {
        fixture.tracker.OnAckLost("T1");
        violations = 0;
    }
    fixture.Report({MakePlanReport("P1", EPlanStatus::InProgress)});
    fixture.RunFirstStep();
    fixture.RunSecondStep();
    fixture.Report({MakePlanReport("P1", EPlanStatus::Completed)});
    CHECK(fixture.tracker.CountViolations() == 0);
    fixture.tracker.Finish(fixture.lines);
    CHECK(fixture.tracker.CountViolations() == violations);
    CHECK((violations == 0 || fixture.GetViolation() == "P1 reported without ExecutionPlanAck"));
}

TEST_CASE("A plan that is neither acknowledged nor reported is no violation")
{
    PlanTrackerFixture fixture;
    fixture.tracker.OnRegistered();
    fixture.Send();
    fixture.tracker.Finish(fixture.lines);
    CHECK(fixture.tracker.CountViolations() == 0);
}

TEST_CASE("12.6 Without resending a plan goes once, however long its Ack takes, and on a new connection too")
{
    ACS::Testing::ManualClock clock;
    PlanTracker tracker({MakeSamplePlan("P1", "T1")}, false);
    PlanTracker::Lines lines;
    tracker.OnRegistered();
    REQUIRE(tracker.GetNextToSendOrNull(clock.GetNow()) == std::size_t{0});
    tracker.OnSent(0, clock.GetNow(), lines);
    clock.Advance(PlanTracker::RESEND_AFTER);
    CHECK_FALSE(tracker.GetNextToSendOrNull(clock.GetNow()).has_value());
    tracker.OnRegistered();
    CHECK_FALSE(tracker.GetNextToSendOrNull(clock.GetNow()).has_value());
}

TEST_CASE("A plan can be added to the run; the same message again is the same plan, and stays answered")
{
    PlanTrackerFixture fixture;
    fixture.RunFirstJob();
    CHECK(fixture.tracker.AddPlan(MakeSamplePlan("P1", "T1")) == 0);
    fixture.tracker.OnSent(0, fixture.clock.GetNow(), fixture.lines);
    CHECK(fixture.GetFirst().delivery == EDelivery::Accepted);
    CHECK(fixture.tracker.AddPlan(MakeSamplePlan("P2", "T2")) == 1);
    CHECK(fixture.tracker.CountOutcome(EOutcome::Open) == 2);
}
