#include "fixtures/PlanWorldSteps.hpp"

#include <algorithm>
#include <chrono>
#include <optional>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using ACS::Testing::BeginPlan;
using ACS::Testing::FinishPlan;
using ACS::Testing::Lines;
using ACS::Testing::MakeLogisticsPlan;
using ACS::Testing::MakeTestOptions;
using ACS::Testing::MakeTestSite;
using ACS::Testing::PausePlan;
using ACS::Testing::PlanWorld;
using ACS::Testing::RestartEngine;
using ACS::Testing::TryRunUntil;

namespace
{

/// One load at the place.
Plan MakeLoadPlan(const std::string& place = "A01.CP01")
{
    return {"P1", "", 1, {{1, "CassetteLoad", place, {"C"}, {{"J1", place, "AMR.CP01"}}}}};
}

/// The test site with one more edge, which is the shortest way.
SiteMap MakeSiteWith(const std::string& from, const std::string& to)
{
    const SiteMap site = MakeTestSite();
    std::vector<SiteEdge> edges = site.GetEdges();
    SiteEdge edge = edges.front();
    edge.edgeID = from + ">" + to;
    edge.startNodeID = from;
    edge.endNodeID = to;
    edges.push_back(edge);
    return *SiteMap::Create(site.GetNodes(), edges, site.GetStations());
}

/// LR01's statuses up to its first job, without the position that it comes from.
Lines GetStatuses(PlanWorld& world)
{
    REQUIRE(TryRunUntil(world, "P1", "Job 1 J1 InProgress"));
    Lines statuses = world.GetTraceOf("status LR01 ");
    std::erase_if(statuses, [](const std::string& line) {
        return line.starts_with("Init") || line.starts_with("Idle");
    });
    return statuses;
}

RobotStatus GetStatus(const PlanWorld& world, const std::string& robotID)
{
    const std::vector<RobotStatus> statuses = world.engine->GetRobotStatuses();
    return *std::ranges::find(statuses, robotID, &RobotStatus::robotID);
}

/// The message of the latest PlanReport with this state.
std::string GetMessage(const PlanWorld& world, const std::string& planID, EPlanState state)
{
    std::string message = "no such report";
    for (const OutboxEntry& entry : world.reports)
    {
        const auto* reportOrNull = std::get_if<PlanReport>(&entry.report);
        if (reportOrNull != nullptr && reportOrNull->planID == planID && reportOrNull->state == state)
        {
            message = reportOrNull->message;
        }
    }
    return message;
}

} // namespace

TEST_CASE("5.9 A robot that starts on the last node before the dock arrives when it accepts its drive")
{
    EngineOptions options = MakeTestOptions(false);
    options.robots[0].startNodeID = "L03";
    PlanWorld world(1, options, MakeTestSite());
    world.Submit(MakeLoadPlan());
    world.Connect();
    CHECK(GetStatuses(world) == Lines{"Moving ", "Arrival A01.CP01", "Docking A01.CP01", "Working A01.CP01"});
}

TEST_CASE("5.9 A robot whose drive is to be cancelled is Moving; when the cancel has failed it arrives, then docks")
{
    EngineOptions options = MakeTestOptions(false);
    options.robots[0].startNodeID = "L03";
    options.controls.cancelTimeout = std::chrono::milliseconds(900);
    PlanWorld world(1, options, MakeTestSite());
    world.GetRobot("LR01").bIgnoresDriveCancel = true;
    world.Submit(MakeLoadPlan());
    world.Connect();
    REQUIRE(TryRunUntil(world, "P1", "Step 1 Dispatched"));
    world.Control(EPlanControl::Cancel, "P1");
    REQUIRE(TryRunUntil(world, "P1", "CancelResult Failed"));
    CHECK(GetStatuses(world) == Lines{"Moving ", "Arrival A01.CP01", "Docking A01.CP01", "Working A01.CP01"});
}

TEST_CASE("5.9 From dock to dock over one edge: the robot docks, and its arrival is reported once")
{
    PlanWorld world(1, MakeTestOptions(false), MakeSiteWith("D-CHG01", "D-A01.CP01"));
    world.Connect();
    world.Submit(MakeLoadPlan());
    CHECK(GetStatuses(world) == Lines{"UnDocking CHG01", "Arrival A01.CP01", "Docking A01.CP01", "Working A01.CP01"});
}

TEST_CASE("5.9 A dock on the route is not left with UnDocking: the robot arrives there and docks at the next one")
{
    PlanWorld world(1, MakeTestOptions(false), MakeSiteWith("D-A01.CP01", "D-A01.CP06"));
    world.Connect();
    world.Submit(MakeLoadPlan("A01.CP06"));
    CHECK(
        GetStatuses(world)
        == Lines{"UnDocking CHG01", "Moving CHG01", "Arrival A01.CP06", "Docking A01.CP06", "Working A01.CP06"});
}

TEST_CASE("5.9 A robot that is at its place already arrives there without a drive")
{
    PlanWorld world;
    world.Connect();
    Plan plan = MakeLoadPlan();
    plan.steps.push_back({2, "CassetteUnload", "A01.CP01", {"C"}, {{"J2", "AMR.CP01", "A01.CP01"}}});
    world.Submit(plan);
    FinishPlan(world);
    CHECK(world.GetTraceOf("status LR01 Arrival") == Lines{" A01.CP01", " A01.CP01"});
    CHECK(world.GetRobot("LR01").drives == 2); // To the place and to the parking position.
}

TEST_CASE("5.9 A robot that waits for its route is Moving, and its message names the robot in the way")
{
    PlanWorld world;
    ACS::Testing::BeginRouteWait(world);
    REQUIRE(world.TryRun([&world] { return GetStatus(world, "CR01").planID == "P2"; }));
    const RobotStatus waiting = GetStatus(world, "CR01");
    CHECK(waiting.status == ERobotStatus::Moving);
    CHECK(waiting.message == "CR01 waits for LR01 to clear its route.");
    CHECK(waiting.message == world.engine->GetWaitReasonOrNull("P2")->message);
    world.GetRobot("LR01").bStuck = false;
    world.Operate("LR01", Pause{});
    world.Operate("LR01", Resume{});
    REQUIRE(TryRunUntil(world, "P2", "Step 1 InProgress"));
    CHECK(GetStatus(world, "CR01").message.empty());
}

TEST_CASE("5.9 The message of a robot has the reason why it makes no progress")
{
    PlanWorld world;
    CHECK(GetStatus(world, "LR01").message == "LR01: no connection.");
    world.Connect();
    CHECK(GetStatus(world, "LR01").message.empty());
    StateChanged state;
    state.lastNodeID = "D-CHG01";
    state.bPoseKnown = true;
    state.batteryPercent = 80;
    state.bAutomatic = false;
    world.Raise("LR01", state);
    CHECK(GetStatus(world, "LR01").message == "LR01: not in automatic mode.");
    state.bAutomatic = true;
    state.errors.push_back({"AGV-motor", EAlarmLevel::Heavy, "hot"});
    world.Raise("LR01", state);
    CHECK(GetStatus(world, "LR01").message == "LR01: error AGV-motor.");
    state.errors.clear();
    world.Raise("LR01", state);
    CHECK(GetStatus(world, "LR01").message.empty());
    world.Submit(MakeLoadPlan());
    REQUIRE(TryRunUntil(world, "P1", "Step 1 InProgress"));
    world.GetRobot("LR01").bStuck = true;
    REQUIRE(world.TryRun([&world] { return GetStatus(world, "LR01").message.starts_with("Robot stalled"); }));
    CHECK(GetStatus(world, "LR01").message.ends_with(" not reached."));
}

TEST_CASE("5.9 The message of a robot reports its unresolved job")
{
    PlanWorld world;
    BeginPlan(world, MakeLoadPlan(), "Job 1 J1 InProgress");
    world.GetRobot("LR01").unresolvedReason = "it was switched off";
    RestartEngine(world);
    CHECK(GetStatus(world, "LR01").status == ERobotStatus::Working);
    CHECK(GetStatus(world, "LR01").message == "Outcome of job J1 unknown. Check LR01, then resolve the job.");
}

TEST_CASE("5.4 The message of a PlanReport names the robot of the plan, and the control that changed it")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Step 1 InProgress");
    CHECK(GetMessage(world, "P1", EPlanState::InProgress) == "Assigned to LR01.");
    PausePlan(world);
    CHECK(GetMessage(world, "P1", EPlanState::Paused) == "Paused by PausePlan.");
    world.Control(EPlanControl::Resume, "P1");
    REQUIRE(TryRunUntil(world, "P1", "ResumeResult Success"));
    CHECK(GetMessage(world, "P1", EPlanState::InProgress) == "Resumed by ResumePlan.");
    world.Control(EPlanControl::Abort, "P1");
    REQUIRE(TryRunUntil(world, "P1", "Plan Aborted"));
    CHECK(GetMessage(world, "P1", EPlanState::Aborted) == "Ended by AbortPlan.");
    world.Submit(MakeLogisticsPlan("P2"));
    world.Control(EPlanControl::Pause, "P2");
    CHECK(GetMessage(world, "P2", EPlanState::Paused) == "Held in the queue by PausePlan.");
    world.Control(EPlanControl::Cancel, "P2");
    CHECK(GetMessage(world, "P2", EPlanState::Cancelled) == "Ended by CancelPlan.");
    CHECK(std::get<ControlResultReport>(world.reports.back().report).message == "The plan is Cancelled.");
}

TEST_CASE("5.4, D-24 The message of a plan that is reported as Pending has its wait reason")
{
    EngineOptions options = MakeTestOptions(false);
    options.bInitialPendingReported = true;
    PlanWorld world(1, options, MakeTestSite());
    world.Submit(MakeLoadPlan());
    REQUIRE(world.TryRun());
    CHECK(GetMessage(world, "P1", EPlanState::Pending) == "No suitable robot is free.");
}

TEST_CASE("5.6 The message of a JobReport has the cause of the failure, or that the operator reported it as done")
{
    PlanWorld world;
    const bool bFails = GENERATE(false, true);
    BeginPlan(world, MakeLoadPlan(), "Job 1 J1 InProgress");
    world.GetRobot("LR01").unresolvedReason = "it was switched off";
    RestartEngine(world);
    world.ResolveJob("P1", "J1", bFails ? EJobResolution::Failed : EJobResolution::Done);
    const auto last = std::find_if(world.reports.rbegin(), world.reports.rend(), [](const OutboxEntry& entry) {
        return std::holds_alternative<JobReport>(entry.report);
    });
    REQUIRE(last != world.reports.rend());
    CHECK(
        std::get<JobReport>(last->report).message
        == (bFails ? "Reported as not done by the operator." : "Reported as done by the operator."));
}
