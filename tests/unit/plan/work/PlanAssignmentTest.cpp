#include "Catch.hpp"
#include "fixtures/EngineParts.hpp"
#include "fixtures/PlanWorld.hpp"

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS::Testing;  // NOLINT(google-build-using-namespace): its fixtures
using namespace std::chrono_literals;

TEST_CASE(
    "PlanAssignment: a plan leaves the queue when it is offered, and starts once its robot accepts the first command")
{
    EngineParts parts;
    parts.PutOn(parts.lr, "D-CHG01");
    ActivePlan& plan = parts.AddLoad();
    parts.Discard();
    parts.assignment.Offer(plan, parts.lr);
    CHECK(parts.engine.plans.GetQueue().empty());
    CHECK(parts.lr.planOrNull == &plan);
    CHECK(parts.lr.activity == EActivity::Waits);
    CHECK(parts.engine.plans.IsAnyRunning());
    CHECK(plan.record.progress.robotID.empty());
    CHECK(plan.record.progress.state == EPlanState::Pending);
    CHECK(parts.Collect().ListReports<PlanReport>().empty());
    parts.assignment.Start(plan);
    parts.assignment.Start(plan);
    CHECK(plan.record.progress.robotID == "LR01");
    CHECK(plan.record.progress.state == EPlanState::InProgress);
    CHECK(plan.record.progress.steps[0].state == EStepState::Dispatched);
    CHECK(plan.record.progress.steps[1].state == EStepState::Pending);
    CHECK(parts.engine.call.begunPlanIDs == std::vector<std::string>{"P1"});
    CHECK(parts.engine.transaction.IsDispatchNeeded());
    const CallOutcome outcome = parts.Collect();
    CHECK(outcome.ListReports<PlanReport>().size() == 1);
    CHECK(outcome.ListReports<StepReport>().size() == 1);
}

TEST_CASE("PlanAssignment: a plan whose offer is withdrawn is in the queue at its former place, without a report")
{
    EngineParts parts;
    parts.PutOn(parts.lr, "D-CHG01");
    ActivePlan& plan = parts.AddLoad();
    parts.assignment.Offer(plan, parts.lr);
    parts.Discard();
    parts.assignment.Withdraw(plan);
    CHECK(parts.engine.plans.GetQueue().begin()->second == &plan);
    CHECK_FALSE(plan.robot.has_value());
    CHECK(parts.lr.IsFree());
    CHECK_FALSE(parts.engine.plans.IsAnyRunning());
    CHECK(parts.Collect().ListReports<PlanReport>().empty());
}

TEST_CASE("PlanAssignment: a plan is handed over before its first job only, and not if the robot may have done it")
{
    EngineParts parts(MakeTestOptions(true));
    ActivePlan& plan = parts.BeginDriveToLoad();
    REQUIRE(parts.assignment.CanHandOver(plan));
    SECTION("the robot may have done jobs that could not be stored")
    {
        parts.lr.work.MarkUnresolved();
        CHECK_FALSE(parts.assignment.CanHandOver(plan));
    }
    SECTION("after a restart the robot has not shown what it did")
    {
        const RobotWorkChanged stored = parts.lr.work.Make("LR01");
        parts.lr.work.Restore(stored);
        CHECK_FALSE(parts.assignment.CanHandOver(plan));
        StateChanged state;
        state.restartEvidence.commandID = stored.commandID;
        CHECK(parts.lr.work.TryCheckEvidence(state, true));
        CHECK(parts.assignment.CanHandOver(plan));
    }
    SECTION("a job was commanded")
    {
        plan.bJobBegun = true;
        CHECK_FALSE(parts.assignment.CanHandOver(plan));
    }
    SECTION("a control is open")
    {
        parts.controls.Control(ControlPlan{EPlanControl::Pause, "P1", {}, 7, {}});
        CHECK_FALSE(parts.assignment.CanHandOver(plan));
    }
    SECTION("handed over")
    {
        Robot& other = *parts.engine.fleet.FindOrNull("LR02");
        parts.coordinator.EndDrive(parts.lr);
        parts.PutOn(other, "D-CHG03");
        plan.record.progress.bArrived = true;
        parts.Discard();
        parts.assignment.HandOver(plan, other);
        CHECK(parts.lr.planOrNull == nullptr);
        CHECK(other.planOrNull == &plan);
        CHECK_FALSE(plan.record.progress.bArrived);
        const CallOutcome outcome = parts.Collect();
        CHECK(outcome.ListReports<PlanReport>().empty());
        const auto steps = outcome.ListReports<StepReport>();
        REQUIRE(steps.size() == 1);
        CHECK(steps.front().robotID == "LR02");
        CHECK(steps.front().state == EStepState::Dispatched);
    }
}
