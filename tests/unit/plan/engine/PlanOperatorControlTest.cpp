#include "fixtures/PlanWorldSteps.hpp"

#include <algorithm>
#include <optional>
#include <string>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using ACS::Testing::BeginPlan;
using ACS::Testing::GetReportsAfter;
using ACS::Testing::Lines;
using ACS::Testing::MakeLogisticsPlan;
using ACS::Testing::MakeWorld;
using ACS::Testing::PausePlan;
using ACS::Testing::PlanWorld;
using ACS::Testing::RestartEngine;
using ACS::Testing::TryRunUntil;

namespace
{

ControlPlan MakeOperatorControl(EPlanControl control, const std::string& planID = "P1")
{
    return {control, planID, {}, 9, {}, EControlOrigin::Operator};
}

std::string ControlByOperator(PlanWorld& world, EPlanControl control, const std::string& planID = "P1")
{
    const ControlPlan command = MakeOperatorControl(control, planID);
    const std::optional<std::string> reason = world.engine->GetRejectionReasonOrNull(command);
    world.replies.clear();
    world.Ask(command);
    REQUIRE(world.replies.size() == 1);
    const ReplyCommand& reply = world.replies.begin()->second;
    CHECK(reply.bAccepted != reason.has_value());
    CHECK((reply.bAccepted || reply.message == *reason));
    return (reply.bAccepted ? "yes: " : "no: ") + reply.message;
}

std::string GetMessage(const PlanWorld& world)
{
    return world.engine->GetPlanRecordOrNull("P1")->progress.message;
}

} // namespace

TEST_CASE("Operator: a plan in the queue is paused, resumed and cancelled with its reports and without a result report")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P2"), "Plan InProgress");
    world.Submit(MakeLogisticsPlan("P1"));
    CHECK(ControlByOperator(world, EPlanControl::Pause) == "yes: Plan P1 is Paused.");
    CHECK(GetMessage(world) == "Held in the queue by the operator.");
    CHECK(world.engine->GetWaitReasonOrNull("P1")->message == "The plan is held in the queue by the operator.");
    CHECK(ControlByOperator(world, EPlanControl::Pause) == "yes: Plan P1 is Paused.");
    CHECK(ControlByOperator(world, EPlanControl::Resume) == "yes: Plan P1 is Pending.");
    CHECK(ControlByOperator(world, EPlanControl::Cancel) == "yes: Plan P1 is Cancelled.");
    CHECK(GetMessage(world) == "Ended by the operator.");
    CHECK(world.GetReportsOf("P1") == Lines{"Plan Paused", "Plan Pending", "Plan Cancelled"});
}

TEST_CASE("Operator: a plan is paused while its robot drives, and continues after the operator has resumed it")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Step 1 InProgress");
    const std::size_t before = world.GetReportsOf("P1").size();
    CHECK(ControlByOperator(world, EPlanControl::Pause) == "yes: PausePlan of P1 is in progress.");
    CHECK(ControlByOperator(world, EPlanControl::Pause) == "yes: PausePlan of P1 is in progress.");
    REQUIRE(world.TryRun());
    CHECK(GetReportsAfter(world, "P1", before) == Lines{"Plan Paused"});
    CHECK(GetMessage(world) == "Paused by the operator.");
    CHECK(world.engine->GetWaitReasonOrNull("P1")->message == "The plan is paused by the operator.");
    CHECK(ControlByOperator(world, EPlanControl::Resume) == "yes: ResumePlan of P1 is in progress.");
    REQUIRE(world.TryRun());
    const Lines after = GetReportsAfter(world, "P1", before + 1);
    CHECK(after.front() == "Plan InProgress");
    CHECK(after.back() == "Plan Completed");
    CHECK(std::ranges::none_of(after, [](const std::string& line) { return line.find("Result") != line.npos; }));
}

TEST_CASE("Operator: an abort ends the plan when the robot has stopped, also over a restart, without a result report")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Step 1 InProgress");
    const std::size_t before = world.GetReportsOf("P1").size();
    CHECK(ControlByOperator(world, EPlanControl::Abort) == "yes: AbortPlan of P1 is in progress.");
    CHECK(GetReportsAfter(world, "P1", before).empty());
    SECTION("at once")
    {
    }
    SECTION("after a restart")
    {
        RestartEngine(world);
        CHECK(world.engine->GetPlanRecordOrNull("P1")->progress.controlOrigin == EControlOrigin::Operator);
    }
    REQUIRE(world.TryRun());
    CHECK(GetReportsAfter(world, "P1", before) == Lines{"Plan Aborted"});
    CHECK(GetMessage(world) == "Ended by the operator.");
}

TEST_CASE("Operator: while a control of the MCS has no result, the operator's is refused with the reason")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Step 1 InProgress");
    world.Control(EPlanControl::Pause, "P1", 3);
    CHECK(
        ControlByOperator(world, EPlanControl::Abort)
        == "no: The MCS has PausePlan in progress for this plan. Wait for its result.");
    REQUIRE(TryRunUntil(world, "P1", "PauseResult Success"));
    CHECK(ControlByOperator(world, EPlanControl::Abort) == "yes: AbortPlan of P1 is in progress.");
    REQUIRE(TryRunUntil(world, "P1", "Plan Aborted"));
}

TEST_CASE("Operator: a control of the MCS replaces the operator's, and the same one shares its outcome")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Step 1 InProgress");
    const std::size_t before = world.GetReportsOf("P1").size();
    ControlByOperator(world, EPlanControl::Pause);
    SECTION("the same control")
    {
        world.Control(EPlanControl::Pause, "P1");
        REQUIRE(world.TryRun());
        CHECK(GetReportsAfter(world, "P1", before) == Lines{"Plan Paused", "PauseResult Success"});
    }
    SECTION("another control")
    {
        world.Control(EPlanControl::Abort, "P1");
        REQUIRE(world.TryRun());
        CHECK(GetReportsAfter(world, "P1", before) == Lines{"Plan Aborted", "AbortResult Success"});
    }
}

TEST_CASE("Operator: a control that the MCS's result would refuse is refused with the same reason")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Job 1 P1-a4 InProgress");
    CHECK(ControlByOperator(world, EPlanControl::Cancel, "P9") == "no: There is no plan P9.");
    CHECK(ControlByOperator(world, EPlanControl::Cancel) == "no: The first job has started.");
    CHECK(ControlByOperator(world, EPlanControl::Resume) == "no: The plan is not paused.");
    CHECK(ControlByOperator(world, EPlanControl::Abort) == "yes: AbortPlan of P1 is in progress.");
    CHECK(ControlByOperator(world, EPlanControl::Pause) == "no: AbortPlan is already in progress for this plan.");
    REQUIRE(TryRunUntil(world, "P1", "Plan Aborted"));
    CHECK(ControlByOperator(world, EPlanControl::Abort) == "no: The plan is already Aborted.");
}

TEST_CASE("Operator: while the store fails, plans are not controlled")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Step 1 InProgress");
    world.store.bFails = true;
    world.Submit(MakeLogisticsPlan("P2"));
    CHECK(
        ControlByOperator(world, EPlanControl::Pause)
        == "no: The request cannot be stored because the store is failing. Send it again.");
}

TEST_CASE("Operator: while the TSC is not Auto, a plan with a robot is not resumed")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Step 1 InProgress");
    PausePlan(world);
    world.SwitchTSC(true);
    CHECK(ControlByOperator(world, EPlanControl::Resume) == "no: The TSC is Paused. Resume the plan when it is Auto.");
}

TEST_CASE("Operator: the TSC is not Paused before a plan that is being resumed has ended")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Step 1 InProgress");
    PausePlan(world);
    world.GetRobot("LR01").bIgnoresPause = true;
    world.Control(EPlanControl::Resume, "P1");
    world.SwitchTSC(true);
    CHECK(world.engine->GetTscState() == ETscState::Pausing);
    world.GetRobot("LR01").bIgnoresPause = false;
    REQUIRE(world.TryRun());
    CHECK(world.engine->GetTscState() == ETscState::Paused);
}

TEST_CASE("Operator: a full outbox leaves room for the end of a plan, not for a pause")
{
    PlanWorld world = MakeWorld([](EngineOptions& options) { options.maximumReports = 40; });
    BeginPlan(world, MakeLogisticsPlan("P1"), "Job 1 P1-a4 InProgress");
    world.bAcknowledges = false;
    for (ReplyToken token = 0; token < 40; ++token)
    {
        world.Control(EPlanControl::Abort, "unknown", token);
    }
    CHECK(ControlByOperator(world, EPlanControl::Pause).starts_with("no: Outbox Full"));
    CHECK(ControlByOperator(world, EPlanControl::Abort) == "yes: AbortPlan of P1 is in progress.");
}
