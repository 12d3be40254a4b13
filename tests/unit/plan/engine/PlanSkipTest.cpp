#include "fixtures/PlanWorldSteps.hpp"

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using ACS::Testing::BeginPlan;
using ACS::Testing::Contains;
using ACS::Testing::FinishPlan;
using ACS::Testing::GetReportsAfter;
using ACS::Testing::Lines;
using ACS::Testing::MakeControlPlan;
using ACS::Testing::MakeLogisticsPlan;
using ACS::Testing::MakeWorld;
using ACS::Testing::PausePlan;
using ACS::Testing::PlanWorld;
using ACS::Testing::RestartEngine;
using ACS::Testing::TryRunUntil;

namespace
{

std::string Skip(PlanWorld& world, std::int32_t stepNo, const std::string& planID = "P1")
{
    const SkipStep command{planID, stepNo, 7};
    const std::optional<std::string> objection = world.engine->GetRejectionReasonOrNull(command);
    world.Ask(command);
    const ReplyCommand& reply = world.replies.at(7);
    CHECK(reply.bAccepted == !objection.has_value());
    CHECK((reply.bAccepted || reply.message == objection));
    return (reply.bAccepted ? "yes: " : "no: ") + reply.message;
}

/// Four steps at four places, without jobs.
Plan MakeCoverPlan()
{
    return {
        "P1",
        "",
        1,
        {{1, "OpenSetCover", "A01.SET01", {}, {}},
         {2, "OpenSetCover", "A01.SET02", {}, {}},
         {3, "OpenSetCover", "A01.SET03", {}, {}},
         {4, "OpenSetCover", "A01.SET04", {}, {}}}};
}

Lines GetStepReports(const PlanWorld& world)
{
    Lines steps = world.GetReportsOf("P1");
    std::erase_if(steps, [](const std::string& line) {
        return !line.starts_with("Step ") && !line.starts_with("Plan ");
    });
    return steps;
}

/// P1, whose first job runs, after a restart. The outcome of the job is unknown.
void BeginUnresolved(PlanWorld& world, const Plan& plan)
{
    BeginPlan(world, plan, "Job 1 P1-a4 InProgress");
    world.GetRobot("LR01").unresolvedReason = "it was switched off";
    RestartEngine(world);
    REQUIRE(world.engine->GetActiveAlarms().size() == 1);
}

} // namespace

TEST_CASE("6.13 Pending steps that an operator skips are left out, and the plan completes without them")
{
    PlanWorld world;
    BeginPlan(world, MakeCoverPlan(), "Step 1 InProgress");
    CHECK(Skip(world, 2) == "yes: Step 2 is skipped.");
    CHECK(Skip(world, 4) == "yes: Step 4 is skipped.");
    const auto& report = std::get<StepReport>(world.reports.back().report);
    CHECK(report == StepReport{"P1", "CR01", 4, EStepState::Skipped, "Skipped by the operator."});
    const bool bRestarts = GENERATE(false, true);
    if (bRestarts)
    {
        RestartEngine(world);
    }
    FinishPlan(world);
    CHECK(
        GetStepReports(world)
        == Lines{
            "Plan InProgress",
            "Step 1 Dispatched",
            "Step 1 InProgress",
            "Step 2 Skipped",
            "Step 4 Skipped",
            "Step 1 Completed",
            "Step 3 Dispatched",
            "Step 3 InProgress",
            "Step 3 Completed",
            "Plan Completed"});
    CHECK(world.GetTraceOf("command CR01 StartJob").size() == 2);
}

TEST_CASE("6.13 A step with an unresolved job is skipped: the job is not reported, ports are kept, the plan continues")
{
    PlanWorld world;
    Plan plan = MakeLogisticsPlan("P1");
    plan.steps[1] = plan.steps[0];
    plan.steps[1].stepNo = 2;
    plan.steps[1].jobs.front().jobID = "P1-b2";
    plan.steps[1].action = "CassetteUnload";
    std::swap(plan.steps[1].jobs.front().from, plan.steps[1].jobs.front().to);
    BeginUnresolved(world, plan);
    const std::size_t told = world.GetReportsOf("P1").size();
    CHECK(Skip(world, 1) == "yes: Step 1 is skipped.");
    CHECK(
        GetReportsAfter(world, "P1", told)
        == Lines{
            "Step 1 Skipped",
            "Error ACS-1008 cleared",
            "Step 2 Dispatched",
            "Step 2 InProgress",
            "Job 2 P1-b2 Instructed"});
    CHECK(world.engine->GetRobotStatuses().front().carrierIDs.front() == std::nullopt);
    world.Raise("LR01", JobFinished{"P1-a4"}); // A late report.
    CHECK(world.engine->GetRobotStatuses().front().carrierIDs.front() == std::nullopt);
    FinishPlan(world);
    CHECK_FALSE(Contains(world.GetReportsOf("P1"), "Job 1 P1-a4 Completed"));
    CHECK_FALSE(Contains(world.GetReportsOf("P1"), "Job 1 P1-a4 Failed"));
}

TEST_CASE("6.13 A plan whose last step is skipped is Completed at once, also after one more restart")
{
    PlanWorld world;
    Plan plan = MakeLogisticsPlan("P1");
    plan.steps.pop_back();
    BeginUnresolved(world, plan);
    static_cast<void>(Skip(world, 1));
    CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
    RestartEngine(world);
    REQUIRE(world.TryRun());
    CHECK(world.engine->GetPlanOrNull("P1")->state == EPlanState::Completed);
    CHECK(world.engine->GetActiveAlarms().empty());
}

TEST_CASE("6.13 In a paused plan the next step is skipped, and the one after it waits for Resume")
{
    PlanWorld world = MakeWorld([](EngineOptions& options) { options.controls.bPausesAfterJob = true; });
    BeginPlan(world, MakeLogisticsPlan("P1"), "Job 1 P1-a4 InProgress");
    PausePlan(world);
    CHECK(world.GetReportsOf("P1").back() == "PauseResult Success");
    CHECK(Skip(world, 2) == "yes: Step 2 is skipped.");
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1").back() == "Step 2 Skipped");
    const bool bRestarts = GENERATE(false, true);
    if (bRestarts)
    {
        RestartEngine(world);
        REQUIRE(world.TryRun());
    }
    CHECK(world.engine->GetPlanOrNull("P1")->state == EPlanState::Paused);
    world.Control(EPlanControl::Resume, "P1");
    REQUIRE(world.TryRun());
    CHECK(world.engine->GetPlanOrNull("P1")->state == EPlanState::Completed);
    CHECK(world.GetRobot("LR01").doneJobs == Lines{"P1-a4"});
}

TEST_CASE("6.13 A pause that waits for the end of an unresolved job is confirmed when its step is skipped")
{
    const auto change = [](EngineOptions& options) {
        options.controls.bPausesAfterJob = true;
    };
    PlanWorld world = MakeWorld(change);
    BeginPlan(world, MakeLogisticsPlan("P1"), "Job 1 P1-a4 InProgress");
    world.GetRobot("LR01").unresolvedReason = "it was switched off";
    RestartEngine(world, change);
    world.Control(EPlanControl::Pause, "P1");
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1").back() == "Error ACS-1008 set");
    static_cast<void>(Skip(world, 1));
    CHECK(world.GetReportsOf("P1").back() == "PauseResult Success");
    CHECK(world.engine->GetPlanOrNull("P1")->state == EPlanState::Paused);
    world.Control(EPlanControl::Resume, "P1");
    FinishPlan(world);
    CHECK(world.GetRobot("LR01").doneJobs == Lines{"P1-a4", "P1-b2"}); // It did the first one nevertheless.
}

TEST_CASE("6.13 A step that runs, has ended, is unknown or whose plan has not begun cannot be skipped")
{
    PlanWorld world;
    CHECK(Skip(world, 1) == "no: There is no plan P1.");
    world.Submit(MakeLogisticsPlan("P1"));
    CHECK(Skip(world, 1) == "no: Plan P1 has no robot yet. Skip the step once the plan is InProgress.");
    CHECK(Skip(world, 3) == "no: Plan P1 has no step 3.");
    world.Connect();
    const std::string rule = ". Only a Pending step or a step with an unresolved job can be skipped.";
    REQUIRE(TryRunUntil(world, "P1", "Job 1 P1-a4 InProgress"));
    CHECK(Skip(world, 1) == "no: Step 1 is InProgress" + rule);
    REQUIRE(TryRunUntil(world, "P1", "Step 1 Completed"));
    CHECK(Skip(world, 1) == "no: Step 1 is Completed" + rule);
    REQUIRE(TryRunUntil(world, "P1", "Step 2 Dispatched"));
    CHECK(Skip(world, 2) == "no: Step 2 is Dispatched" + rule);
    FinishPlan(world);
    CHECK(Skip(world, 2) == "no: Plan P1 is already Completed.");
}

TEST_CASE("6.13 After a skipped load of a tray the memory step waits until the tray is on record")
{
    PlanWorld world;
    Plan plan = MakeControlPlan("P1");
    plan.steps.insert(plan.steps.begin(), Step{1, "OpenSetCover", "A01.SET02", {}, {}});
    for (std::int32_t stepNo = 1; Step & step : plan.steps)
    {
        step.stepNo = stepNo;
        ++stepNo;
    }
    BeginPlan(world, plan, "Step 1 InProgress");
    static_cast<void>(Skip(world, 2));
    REQUIRE(TryRunUntil(world, "P1", "Step 3 InProgress"));
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1").back() == "Error ACS-1015 set");
    CHECK(world.engine->GetWaitReasonOrNull("P1")->message.starts_with("CR01.TP01 has no tray for CR01.TP01.MP01"));
    CHECK(Skip(world, 3).starts_with("no: Step 3 is InProgress"));
    world.Ask(SetCarriers{"CR01", {"TRAY_01", "TRAY_02", {}}, 8});
    CHECK(world.replies.at(8).bAccepted);
    FinishPlan(world);
}
