#include "fixtures/PlanWorldSteps.hpp"

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using ACS::Testing::BeginPlan;
using ACS::Testing::Lines;
using ACS::Testing::MakeLogisticsPlan;
using ACS::Testing::MakeTestOptions;
using ACS::Testing::MakeTestSite;
using ACS::Testing::PlanWorld;
using ACS::Testing::RestartEngine;
using ACS::Testing::TryRunUntil;

namespace
{

Lines GetPlanIDs(const std::vector<std::reference_wrapper<const PlanRecord>>& records)
{
    Lines planIDs;
    for (const PlanRecord& record : records)
    {
        planIDs.push_back(record.plan.planID);
    }
    return planIDs;
}

RobotRoute GetRoute(const PlanWorld& world, const std::string& robotID)
{
    const std::vector<RobotRoute> routes = world.engine->GetRobotRoutes();
    return *std::ranges::find(routes, robotID, &RobotRoute::robotID);
}

} // namespace

TEST_CASE("The record of a plan has its steps, jobs, states and times, also after its end and a restart")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Job 1 P1-a4 InProgress");
    const PlanRecord* recordOrNull = world.engine->GetPlanRecordOrNull("P1");
    REQUIRE(recordOrNull != nullptr);
    CHECK(recordOrNull->plan.steps[1].jobs[0].jobID == "P1-b2");
    CHECK(recordOrNull->progress.robotID == "LR01");
    CHECK(recordOrNull->progress.steps[0] == StepProgress{EStepState::InProgress, {EJobState::InProgress}});
    CHECK(recordOrNull->progress.steps[1] == StepProgress{EStepState::Pending, {EJobState::Pending}});
    CHECK(recordOrNull->progress.startedAt.has_value());
    CHECK(world.engine->GetPlanRecordOrNull("P2") == nullptr);
    REQUIRE(TryRunUntil(world, "P1", "Plan Completed"));
    const PlanRecord finished = *world.engine->GetPlanRecordOrNull("P1");
    CHECK(finished.progress.state == EPlanState::Completed);
    CHECK(finished.progress.endedAt.has_value());
    RestartEngine(world);
    CHECK(*world.engine->GetPlanRecordOrNull("P1") == finished);
}

TEST_CASE("The records of unfinished plans are in the order of GetActivePlans")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Plan InProgress");
    world.Submit(MakeLogisticsPlan("P2"));
    Plan urgent = MakeLogisticsPlan("P3");
    urgent.priority = 99;
    world.Submit(urgent);
    CHECK(GetPlanIDs(world.engine->GetActivePlanRecords()) == Lines{"P1", "P3", "P2"});
    CHECK(world.engine->GetFinishedPlanRecords(100).empty());
}

TEST_CASE("Finished plans are listed in the order of their ends, latest first, also after a restart")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Job 1 P1-a4 InProgress");
    world.Submit(MakeLogisticsPlan("P2"));
    world.Submit(MakeLogisticsPlan("P3"));
    world.Control(EPlanControl::Cancel, "P3");
    REQUIRE(TryRunUntil(world, "P2", "Plan Completed"));
    const Lines expected{"P2", "P1", "P3"};
    CHECK(GetPlanIDs(world.engine->GetFinishedPlanRecords(100)) == expected);
    CHECK(GetPlanIDs(world.engine->GetFinishedPlanRecords(2)) == Lines{"P2", "P1"});
    CHECK(world.engine->GetFinishedPlanRecords(0).empty());
    RestartEngine(world);
    CHECK(GetPlanIDs(world.engine->GetFinishedPlanRecords(100)) == expected);
}

TEST_CASE("The route of a robot has the nodes ahead in driving order, with those that it may drive to now first")
{
    EngineOptions options = MakeTestOptions(false);
    options.baseLength = 2;
    PlanWorld world(1, options, MakeTestSite());
    BeginPlan(world, MakeLogisticsPlan("P1"), "Plan InProgress"); // LR01 drives from CHG01
    const RobotRoute route = GetRoute(world, "LR01");
    CHECK(
        route.nodes
        == std::vector<RouteNodeAhead>{{"L01", true}, {"L02", true}, {"L03", false}, {"D-A01.CP01", false}});
    CHECK(route.reservedNodeIDs == Lines{"D-CHG01", "L01", "L02"});
    CHECK(GetRoute(world, "CR01") == RobotRoute{"CR01", {}, {"D-CHG02"}});
    REQUIRE(TryRunUntil(world, "P1", "Job 1 P1-a4 InProgress"));
    CHECK(GetRoute(world, "LR01") == RobotRoute{"LR01", {}, {"D-A01.CP01"}});
}

TEST_CASE("The engine has its options and its site, with the ports of each robot")
{
    const PlanWorld world;
    CHECK(world.engine->GetOptions().robots[1].ports.size() == 3);
    CHECK(world.engine->GetSite().FindNodeIndexOrNull("L01").has_value());
}
