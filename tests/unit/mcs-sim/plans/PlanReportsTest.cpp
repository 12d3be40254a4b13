#include "Catch.hpp"
#include "plans/PlanTrackerFixture.hpp"

#include <string>
#include <utility>
#include <vector>

using ACS::McsSim::EOutcome;
using ACS::McsSim::PlanTracker;
using ACS::Protocol::AcsPayload;
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

TEST_CASE("6 A plan whose reports come in causal order is completed, without a violation")
{
    PlanTrackerFixture fixture;
    fixture.RunFirstJob();
    fixture.Report({MakeStepReport("P1", 1, EStepStatus::Completed)});
    fixture.RunSecondStep();
    CHECK_FALSE(fixture.tracker.IsFinished());
    fixture.Report({MakePlanReport("P1", EPlanStatus::Completed)});
    CHECK(fixture.tracker.IsFinished());
    CHECK(fixture.tracker.IsSuccess());
    CHECK(fixture.tracker.CountOutcome(EOutcome::Completed) == 1);
    CHECK(fixture.tracker.CountSteps().done == 2);
    CHECK(fixture.tracker.CountJobs().done == 3);
    CHECK(fixture.tracker.CountViolations() == 0);
    CHECK(fixture.GetFirst().robotID == "LR01");
    CHECK(fixture.lines.front() == "P1 ExecutionPlan sent");
    CHECK(fixture.lines.back() == "P1 PlanReport Completed (LR01)");
}

TEST_CASE("A printed line names step, job, status and robot")
{
    PlanTrackerFixture fixture;
    fixture.RunFirstJob();
    CHECK(fixture.lines[1] == "P1 ExecutionPlanAck Success");
    CHECK(fixture.lines[3] == "P1 StepReport step 1 CassetteLoad at A01.CP01 Dispatched (LR01)");
    CHECK(fixture.lines.back() == "P1 JobReport step 1 job 1/1 Completed (LR01)");
}

TEST_CASE("6.14 A failed job fails its step and its plan, in this order")
{
    PlanTrackerFixture fixture;
    fixture.RunFirstJob();
    fixture.Report(
        {MakeStepReport("P1", 1, EStepStatus::Completed),
         MakeStepReport("P1", 2, EStepStatus::Dispatched),
         MakeStepReport("P1", 2, EStepStatus::InProgress),
         MakeJobReport("P1", 2, "J2", EJobStatus::Instructed),
         MakeJobReport("P1", 2, "J2", EJobStatus::Failed)});
    SECTION("as it must be")
    {
        fixture.Report(
            {MakeStepReport("P1", 2, EStepStatus::Failed), MakePlanReport("P1", EPlanStatus::Failed, "gripper open")});
        CHECK(fixture.tracker.CountViolations() == 0);
        CHECK(fixture.tracker.CountOutcome(EOutcome::Failed) == 1);
        CHECK(fixture.GetFirst().reason == "gripper open");
    }
    SECTION("the plan before its step")
    {
        fixture.Report({MakePlanReport("P1", EPlanStatus::Failed)});
        CHECK(fixture.GetViolation() == "P1 PlanReport Failed before the step of its failed job");
    }
}

TEST_CASE("Cancelled and aborted plans count as failed")
{
    PlanTrackerFixture fixture(2);
    fixture.tracker.OnRegistered();
    fixture.Send();
    fixture.Report(
        {MakePlanReport("P1", EPlanStatus::Cancelled),
         MakePlanReport("P2", EPlanStatus::InProgress),
         MakePlanReport("P2", EPlanStatus::Aborted)});
    CHECK(fixture.tracker.CountViolations() == 0);
    CHECK(fixture.tracker.CountFailed() == 2);
    CHECK(fixture.tracker.IsFinished());
}

TEST_CASE("6.5 A plan is not Cancelled once a job was begun; it may be Aborted")
{
    PlanTrackerFixture fixture;
    fixture.RunFirstJob();
    SECTION("cancelled")
    {
        fixture.Report({MakePlanReport("P1", EPlanStatus::Cancelled)});
        CHECK(fixture.GetViolation() == "P1 PlanReport Cancelled after a job was begun");
        CHECK(fixture.tracker.CountOutcome(EOutcome::Cancelled) == 1);
    }
    SECTION("aborted")
    {
        fixture.Report({MakePlanReport("P1", EPlanStatus::Aborted)});
        CHECK(fixture.tracker.CountViolations() == 0);
    }
}

TEST_CASE("6.14 After a failed job no other job of its plan is begun")
{
    PlanTrackerFixture fixture;
    fixture.RunFirstJob();
    fixture.Report(
        {MakeStepReport("P1", 1, EStepStatus::Completed),
         MakeStepReport("P1", 2, EStepStatus::Dispatched),
         MakeStepReport("P1", 2, EStepStatus::InProgress),
         MakeJobReport("P1", 2, "J2", EJobStatus::Instructed),
         MakeJobReport("P1", 2, "J2", EJobStatus::Failed)});
    CHECK(fixture.tracker.CountViolations() == 0);
    fixture.Report({MakeJobReport("P1", 2, "J3", EJobStatus::Instructed)});
    CHECK(fixture.GetViolation() == "P1 JobReport step 2 job 2 Instructed after a failed job");
}

TEST_CASE("A report out of causal order is a violation, and followed nevertheless")
{
    PlanTrackerFixture fixture;
    fixture.RunFirstJob();
    using Row = std::pair<AcsPayload, std::string>;
    const Row row = GENERATE(
        Row{MakePlanReport("P1", EPlanStatus::Completed), "P1 PlanReport Completed before all its steps"},
        Row{MakePlanReport("P1", EPlanStatus::InProgress), "P1 PlanReport InProgress after InProgress"},
        Row{MakeStepReport("P1", 2, EStepStatus::Dispatched),
            "P1 StepReport step 2 Dispatched before the steps in front of it are done"},
        Row{MakeStepReport("P1", 1, EStepStatus::Dispatched), "P1 StepReport step 1 Dispatched after InProgress"},
        Row{MakeStepReport("P1", 2, EStepStatus::Completed), "P1 StepReport step 2 Completed after Pending"},
        Row{MakeJobReport("P1", 2, "J2", EJobStatus::Instructed),
            "P1 JobReport step 2 job 1 Instructed while its step is Pending"},
        Row{MakeJobReport("P1", 1, "J1", EJobStatus::Completed), "P1 JobReport step 1 job 1 Completed after Completed"},
        Row{MakeJobReport("P1", 1, "J2", EJobStatus::Completed), "P1 JobReport step 1 for an unknown job J2"},
        Row{MakeStepReport("P1", 3, EStepStatus::Dispatched), "P1 StepReport for an unknown step 3"},
        Row{MakePlanReport("P9", EPlanStatus::InProgress), "P9 PlanReport for an unknown plan"});
    fixture.Report({row.first});
    CHECK(fixture.GetViolation() == row.second);
    CHECK_FALSE(fixture.tracker.IsSuccess());
}

TEST_CASE("6.7 While its plan is Paused no step is Dispatched and no job is Instructed")
{
    PlanTrackerFixture fixture;
    fixture.Begin();
    fixture.Report({MakePlanReport("P1", EPlanStatus::InProgress)});
    SECTION("a step")
    {
        fixture.Report({MakePlanReport("P1", EPlanStatus::Paused), MakeStepReport("P1", 1, EStepStatus::Dispatched)});
        CHECK(fixture.GetViolation() == "P1 StepReport step 1 Dispatched while the plan is Paused");
    }
    SECTION("a job")
    {
        fixture.Report(
            {MakeStepReport("P1", 1, EStepStatus::Dispatched),
             MakeStepReport("P1", 1, EStepStatus::InProgress),
             MakePlanReport("P1", EPlanStatus::Paused),
             MakeJobReport("P1", 1, "J1", EJobStatus::Instructed)});
        CHECK(fixture.GetViolation() == "P1 JobReport step 1 job 1 Instructed while the plan is Paused");
    }
}

TEST_CASE("6.7 What was begun before the pause may be reported while the plan is Paused")
{
    PlanTrackerFixture fixture;
    fixture.Begin();
    fixture.Report(
        {MakePlanReport("P1", EPlanStatus::InProgress),
         MakeStepReport("P1", 1, EStepStatus::Dispatched),
         MakePlanReport("P1", EPlanStatus::Paused),
         MakeStepReport("P1", 1, EStepStatus::InProgress), // a cancel that came too late: the robot has arrived
         MakePlanReport("P1", EPlanStatus::InProgress),
         MakeJobReport("P1", 1, "J1", EJobStatus::Instructed),
         MakePlanReport("P1", EPlanStatus::Paused),
         MakeJobReport("P1", 1, "J1", EJobStatus::InProgress), // an operator answers done for a job of unknown outcome
         MakeJobReport("P1", 1, "J1", EJobStatus::Completed),
         MakeStepReport("P1", 1, EStepStatus::Completed),
         MakeStepReport("P1", 2, EStepStatus::Skipped),
         MakePlanReport("P1", EPlanStatus::InProgress),
         MakePlanReport("P1", EPlanStatus::Completed)});
    CHECK(fixture.tracker.IsSuccess());
}

TEST_CASE("6.15, 6.16 A robot status or an error of an unknown plan, step or job is a violation")
{
    PlanTrackerFixture fixture;
    fixture.Begin();
    ACS::Protocol::RobotStatusUpdate status;
    status.robotID = "LR01";
    ACS::Protocol::ErrorReport error;
    error.robotID = "LR01";
    error.errorCode = "E1";
    SECTION("none, or of the plan")
    {
        fixture.Report({status, error});
        status.planID = error.planID = "P1";
        status.stepNo = error.stepNo = 2;
        status.jobID = error.jobID = "J3";
        fixture.Report({status, error});
        CHECK(fixture.tracker.CountViolations() == 0);
    }
    SECTION("an unknown plan")
    {
        status.planID = error.planID = "P9";
        fixture.Report({status});
        CHECK(fixture.GetViolation() == "P9 RobotStatusUpdate for an unknown plan");
        fixture.Report({error});
        CHECK(fixture.tracker.GetViolations().back() == "P9 ErrorReport for an unknown plan");
        error.bSet = false; // of a plan of an earlier MCS: a clear has the identity of its set
        fixture.Report({error});
        CHECK(fixture.tracker.CountViolations() == 2);
    }
    SECTION("an unknown step")
    {
        status.planID = "P1";
        status.stepNo = 3;
        fixture.Report({status});
        CHECK(fixture.GetViolation() == "P1 RobotStatusUpdate for an unknown step 3");
    }
    SECTION("a job of another step")
    {
        status.planID = "P1";
        status.stepNo = 1;
        status.jobID = "J2";
        fixture.Report({status});
        CHECK(fixture.GetViolation() == "P1 RobotStatusUpdate step 1 for an unknown job J2");
    }
}

TEST_CASE("A step is not Completed before all its jobs")
{
    PlanTrackerFixture fixture;
    fixture.RunFirstJob();
    fixture.Report(
        {MakeStepReport("P1", 1, EStepStatus::Completed),
         MakeStepReport("P1", 2, EStepStatus::Dispatched),
         MakeStepReport("P1", 2, EStepStatus::InProgress),
         MakeStepReport("P1", 2, EStepStatus::Completed)});
    CHECK(fixture.GetViolation() == "P1 StepReport step 2 Completed before all its jobs");
}

TEST_CASE("6.13 A step is skipped before it is begun, or while its job is unresolved; a step that failed is not")
{
    PlanTrackerFixture fixture;
    fixture.RunFirstJob();
    fixture.Report(
        {MakeStepReport("P1", 1, EStepStatus::Completed),
         MakeStepReport("P1", 2, EStepStatus::Dispatched),
         MakeStepReport("P1", 2, EStepStatus::InProgress),
         MakeJobReport("P1", 2, "J2", EJobStatus::Instructed)});
    SECTION("unresolved")
    {
        fixture.Report({MakeStepReport("P1", 2, EStepStatus::Skipped), MakePlanReport("P1", EPlanStatus::Completed)});
        CHECK(fixture.tracker.CountViolations() == 0);
        CHECK(fixture.tracker.CountOutcome(EOutcome::Completed) == 1);
    }
    SECTION("failed")
    {
        fixture.Report(
            {MakeJobReport("P1", 2, "J2", EJobStatus::Failed),
             MakeStepReport("P1", 2, EStepStatus::Failed),
             MakeStepReport("P1", 2, EStepStatus::Skipped)});
        CHECK(fixture.GetViolation() == "P1 StepReport step 2 Skipped after Failed");
    }
    SECTION("6.14 its job failed: the plan fails too")
    {
        fixture.Report(
            {MakeJobReport("P1", 2, "J2", EJobStatus::Failed),
             MakeStepReport("P1", 2, EStepStatus::Skipped),
             MakePlanReport("P1", EPlanStatus::Completed)});
        REQUIRE(fixture.tracker.CountViolations() == 2);
        CHECK(fixture.tracker.GetViolations()[0] == "P1 StepReport step 2 Skipped after its failed job");
        CHECK(fixture.tracker.GetViolations()[1] == "P1 PlanReport Completed with a failed job");
    }
}

TEST_CASE("A violation makes the run fail even where every plan is completed")
{
    PlanTrackerFixture fixture;
    fixture.RunFirstJob();
    fixture.Report({MakePlanReport("P1", EPlanStatus::Completed)});
    CHECK(fixture.tracker.CountOutcome(EOutcome::Completed) == 1);
    CHECK(fixture.tracker.IsFinished());
    CHECK_FALSE(fixture.tracker.IsSuccess());
}

TEST_CASE("7 A report after the final one is a violation, and changes nothing")
{
    PlanTrackerFixture fixture;
    fixture.tracker.OnRegistered();
    fixture.Send();
    fixture.Ack(0);
    fixture.Report({MakePlanReport("P1", EPlanStatus::Cancelled), MakePlanReport("P1", EPlanStatus::InProgress)});
    CHECK(fixture.GetViolation() == "P1 PlanReport after it was cancelled");
    CHECK(fixture.tracker.CountOutcome(EOutcome::Cancelled) == 1);
}

TEST_CASE("A report about a plan that was not sent yet is a violation")
{
    PlanTrackerFixture fixture;
    fixture.tracker.OnRegistered();
    fixture.Report({MakePlanReport("P1", EPlanStatus::InProgress)});
    CHECK(fixture.GetViolation() == "P1 PlanReport before it was sent");
}

TEST_CASE("A plan that moves to another robot is a violation")
{
    PlanTrackerFixture fixture;
    fixture.RunFirstJob();
    ACS::Protocol::StepReport report = MakeStepReport("P1", 1, EStepStatus::Completed);
    report.robotID = "LR02";
    fixture.Report({report});
    CHECK(fixture.GetViolation() == "P1 moved from LR01 to LR02");
}

TEST_CASE("Another robot may take over a plan with StepReport(Dispatched) before the first job, and not after it")
{
    PlanTrackerFixture fixture;
    ACS::Protocol::StepReport other = MakeStepReport("P1", 1, EStepStatus::Dispatched);
    other.robotID = "LR02";
    SECTION("before")
    {
        fixture.Begin();
        fixture.Report(
            {MakePlanReport("P1", EPlanStatus::InProgress),
             MakeStepReport("P1", 1, EStepStatus::Dispatched),
             MakeStepReport("P1", 1, EStepStatus::InProgress),
             other});
        CHECK(fixture.tracker.CountViolations() == 0);
        fixture.Report({MakeStepReport("P1", 1, EStepStatus::InProgress)}); // of the first robot
        CHECK(fixture.GetViolation() == "P1 moved from LR02 to LR01");
    }
    SECTION("to the same robot")
    {
        fixture.Begin();
        fixture.Report(
            {MakePlanReport("P1", EPlanStatus::InProgress),
             MakeStepReport("P1", 1, EStepStatus::Dispatched),
             MakeStepReport("P1", 1, EStepStatus::Dispatched)});
        CHECK(fixture.GetViolation() == "P1 StepReport step 1 Dispatched after Dispatched");
    }
    SECTION("after")
    {
        fixture.RunFirstJob();
        fixture.Report({other});
        CHECK(fixture.tracker.CountViolations() > 0);
    }
}

TEST_CASE("D-24 A first report of Pending is no violation")
{
    PlanTrackerFixture fixture;
    fixture.tracker.OnRegistered();
    fixture.Send();
    fixture.Report(
        {MakePlanReport("P1", EPlanStatus::Pending),
         MakeStepReport("P1", 1, EStepStatus::Pending),
         MakeJobReport("P1", 1, "J1", EJobStatus::Pending),
         MakePlanReport("P1", EPlanStatus::InProgress)});
    CHECK(fixture.tracker.CountViolations() == 0);
}

TEST_CASE("Of two plans with one planId the reports belong to the one that was not refused")
{
    PlanTracker tracker({MakeSamplePlan("P", "T1"), MakeSamplePlan("P", "T2")});
    PlanTracker::Lines lines;
    const ManualClock clock;
    tracker.OnRegistered();
    tracker.OnSent(0, clock.GetNow(), lines);
    tracker.OnSent(1, clock.GetNow(), lines);
    tracker.OnAck(MakeAck(tracker.GetPlans()[0].planned, EAckResult::Success), lines);
    tracker.OnAck(MakeAck(tracker.GetPlans()[1].planned, EAckResult::Fail, "Duplicated Plan"), lines);
    tracker.OnRequest(MakePlanReport("P", EPlanStatus::Cancelled), {}, lines);
    CHECK(tracker.CountViolations() == 0);
    CHECK(tracker.CountOutcome(EOutcome::Cancelled) == 1);
    CHECK(tracker.CountOutcome(EOutcome::Refused) == 1);
}

TEST_CASE("What a peer sends cannot forge a line or a terminal's sequence")
{
    PlanTrackerFixture fixture;
    fixture.tracker.OnRegistered();
    fixture.Send();
    fixture.Ack(0, EAckResult::Fail, "bad\n0.1 P1 PlanReport Completed\x1b[2J");
    CHECK(fixture.lines.back() == "P1 ExecutionPlanAck Fail: bad?0.1 P1 PlanReport Completed?[2J");
}
