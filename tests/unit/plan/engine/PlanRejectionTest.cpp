#include "fixtures/PlanWorldSteps.hpp"

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using ACS::Testing::BeginPlan;
using ACS::Testing::Contains;
using ACS::Testing::FinishPlan;
using ACS::Testing::Lines;
using ACS::Testing::MakeControlPlan;
using ACS::Testing::MakeLogisticsPlan;
using ACS::Testing::PlanWorld;
using ACS::Testing::RestartEngine;
using ACS::Testing::TryRunFor;

namespace
{

using namespace std::chrono_literals;

bool HasAlarm(const PlanWorld& world)
{
    return std::ranges::count(world.engine->GetActiveAlarms(), "ACS-1012", &Alarm::errorCode) > 0;
}

std::string GetWaitReason(const PlanWorld& world)
{
    const std::optional<WaitReason> reason = world.engine->GetWaitReasonOrNull("P1");
    return reason.has_value() ? reason->message : std::string();
}

/// Why the first robot cannot take the plan, which is in the queue.
std::string GetRobotReason(const PlanWorld& world)
{
    const std::optional<WaitReason> reason = world.engine->GetWaitReasonOrNull("P1");
    return reason.has_value() && !reason->robots.empty() ? reason->robots.front().reason : std::string();
}

/// A robot was given the plan a minute ago.
void BeginForMinute(PlanWorld& world)
{
    BeginPlan(world, MakeLogisticsPlan("P1"), "Step 1 Dispatched");
    static_cast<void>(TryRunFor(world, 1min));
}

} // namespace

TEST_CASE("A plan whose robot loses its drive in manual mode waits, and continues from where the robot is")
{
    PlanWorld world;
    SECTION("on a node")
    {
        BeginPlan(world, MakeLogisticsPlan("P1"), "Step 1 InProgress");
        world.GetRobot("LR01").bStuck = true; // after the next node
        REQUIRE(world.TryRun([&world] { return world.GetRobot("LR01").GetOccupied().size() == 1; }));
    }
    SECTION("between two nodes")
    {
        BeginPlan(world, MakeLogisticsPlan("P1"), "Step 1 InProgress");
        REQUIRE(world.TryRun([&world] { return world.GetRobot("LR01").GetOccupied() == Lines{"L02", "L03"}; }));
    }
    SECTION("on its first node")
    {
        BeginPlan(world, MakeLogisticsPlan("P1"), "Step 1 Dispatched");
    }
    const std::size_t reports = world.GetReportsOf("P1").size();
    world.SwitchMode("LR01", true);
    static_cast<void>(TryRunFor(world, 1min));
    CHECK(GetWaitReason(world) == "LR01: not in automatic mode.");
    CHECK(world.GetReportsOf("P1").size() == reports);
    world.GetRobot("LR01").bStuck = false;
    world.SwitchMode("LR01", false);
    FinishPlan(world);
    CHECK(world.GetRobot("LR01").doneJobs == Lines{"P1-a4", "P1-b2"});
    CHECK_FALSE(HasAlarm(world));
    CHECK(world.violations == Lines{});
}

TEST_CASE("A robot that rejects three drives in a row is unavailable until something about it changes")
{
    PlanWorld world;
    world.GetRobot("LR01").bRejectDrives = true;
    world.Connect();
    world.Submit(MakeLogisticsPlan("P1"));
    static_cast<void>(TryRunFor(world, 1min));
    CHECK(world.GetTraceOf("command LR01 Drive").size() == 3);
    CHECK(HasAlarm(world));
    CHECK(GetRobotReason(world) == "rejects its commands: simulated by the test");
    CHECK_FALSE(Contains(world.GetReportsOf("P1"), "Plan InProgress"));
    SECTION("its mode")
    {
        world.SwitchMode("LR01", true);
        world.SwitchMode("LR01", false);
        static_cast<void>(TryRunFor(world, 1min));
        CHECK(world.GetTraceOf("command LR01 Drive").size() == 4);
        CHECK(HasAlarm(world));
        world.GetRobot("LR01").bRejectDrives = false;
        world.SwitchMode("LR01", true);
        world.SwitchMode("LR01", false);
    }
    SECTION("its connection")
    {
        world.GetRobot("LR01").bRejectDrives = false;
        world.Raise("LR01", LinkChanged{false});
        world.Connect();
    }
    SECTION("its factsheet")
    {
        world.GetRobot("LR01").bRejectDrives = false;
        world.Raise("LR01", JobCheckChanged{});
    }
    SECTION("the operator clears the alarm")
    {
        world.GetRobot("LR01").bRejectDrives = false;
        world.Ask(ClearAlarms{"LR01", "ACS-1012", {}, {}, 7});
        CHECK(world.replies.at(7).bAccepted);
    }
    FinishPlan(world);
    CHECK_FALSE(HasAlarm(world));
    CHECK(world.violations == Lines{});
}

TEST_CASE("A robot that accepts each drive and drops it without progress is unavailable too")
{
    PlanWorld world;
    world.GetRobot("LR01").bDropsDrives = true;
    BeginForMinute(world);
    CHECK(world.GetRobot("LR01").drives == 3);
    CHECK(HasAlarm(world));
}

TEST_CASE("Until a robot has accepted its first drive, the plan is Pending, also when it is cancelled or paused")
{
    PlanWorld world;
    world.GetRobot("LR01").bDeaf = true;
    world.Connect();
    world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(world.TryRun([&world] { return world.GetTraceOf("command LR01 Drive").size() == 1; }));
    CHECK(world.engine->GetPlanOrNull("P1")->state == EPlanState::Pending);
    const std::string driveID = world.driveIDs.at("LR01");
    SECTION("it accepts it")
    {
        world.Raise("LR01", NodePassed{driveID, "D-CHG01"});
        CHECK(world.GetReportsOf("P1") == Lines{"Plan InProgress", "Step 1 Dispatched"});
    }
    SECTION("it is cancelled")
    {
        world.Control(EPlanControl::Cancel, "P1");
        CHECK(world.GetReportsOf("P1").empty());
        world.Raise("LR01", DriveRejected{driveID, "cancelled before it was sent"});
        CHECK(world.GetReportsOf("P1") == Lines{"Plan Cancelled", "CancelResult Success"});
    }
    SECTION("it is cancelled, and the ACS is restarted before the robot has answered")
    {
        world.Control(EPlanControl::Cancel, "P1");
        world.Crash();
        RestartEngine(world);
        REQUIRE(world.TryRun());
        CHECK(world.GetReportsOf("P1") == Lines{"Plan Cancelled", "CancelResult Success"});
    }
    SECTION("it is paused: the robot may have accepted it already")
    {
        world.Control(EPlanControl::Pause, "P1");
        CHECK(
            world.GetReportsOf("P1")
            == Lines{"Plan InProgress", "Step 1 Dispatched", "Plan Paused", "PauseResult Success"});
    }
    SECTION("the TSC is paused: it waits for the plan, as for one in progress")
    {
        world.SwitchTSC(true);
        CHECK(world.engine->GetTscState() == ETscState::Pausing);
        world.Raise("LR01", DriveRejected{driveID, "rejected"});
        CHECK(world.engine->GetTscState() == ETscState::Paused);
        CHECK(world.GetReportsOf("P1").empty());
    }
    SECTION("the ACS is restarted")
    {
        world.GetRobot("LR01").bDeaf = false;
        world.Crash();
        RestartEngine(world);
        FinishPlan(world);
        CHECK(std::ranges::count(world.GetReportsOf("P1"), "Plan InProgress") == 1);
    }
    CHECK(world.violations == Lines{});
}

TEST_CASE("A plan whose robot becomes unavailable before it has a drive is given to another robot")
{
    PlanWorld world(1, true);
    Plan control = MakeControlPlan("P2");
    control.priority = 20;
    BeginPlan(world, control, "Job 1 P2-cd InProgress");
    world.Submit(MakeLogisticsPlan("P1")); // waits for the dock where CR01 works
    REQUIRE(world.TryRun([&world] { return world.engine->GetRobotStatuses()[0].planID == "P1"; }));
    CHECK(world.GetRobot("LR01").drives == 0);
    world.SwitchMode("LR01", true);
    CHECK_FALSE(world.engine->GetRobotStatuses()[0].planID.has_value());
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
    CHECK(world.GetRobot("LR02").doneJobs == Lines{"P1-a4", "P1-b2"});
    CHECK(std::ranges::count(world.GetReportsOf("P1"), "Step 1 Dispatched") == 1);
    CHECK(world.violations == Lines{});
}

TEST_CASE("While the TSC is not Auto, a plan whose robot waits for its first drive is in the queue again")
{
    PlanWorld world(1, true);
    Plan control = MakeControlPlan("P2");
    control.priority = 20;
    BeginPlan(world, control, "Job 1 P2-cd InProgress");
    world.Submit(MakeLogisticsPlan("P1")); // waits for the dock where CR01 works
    REQUIRE(world.TryRun([&world] { return world.engine->GetRobotStatuses()[0].planID == "P1"; }));
    world.SwitchTSC(true);
    CHECK(world.engine->GetTscState() == ETscState::Pausing);
    CHECK_FALSE(world.engine->GetRobotStatuses()[0].planID.has_value());
    static_cast<void>(TryRunFor(world, 10min));
    CHECK(world.engine->GetTscState() == ETscState::Paused);
    CHECK(world.GetReportsOf("P1").empty());
    world.SwitchTSC(false);
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
    CHECK(std::ranges::count(world.GetReportsOf("P1"), "Plan InProgress") == 1);
    CHECK(world.violations == Lines{});
}

TEST_CASE("A plan whose robot rejects its first drive is given to another robot, unless it names the robot")
{
    PlanWorld world(1, true);
    world.GetRobot("LR01").bRejectDrives = true;
    world.Connect();
    Plan plan = MakeLogisticsPlan("P1");
    const bool bPinned = GENERATE(false, true);
    if (bPinned)
    {
        plan.steps[0].jobs[0].to = "LR01.CP01";
        plan.steps[1].jobs[0].from = "LR01.CP01";
    }
    world.Submit(plan);
    static_cast<void>(TryRunFor(world, 10min));
    CHECK(HasAlarm(world) == bPinned);
    CHECK(world.GetTraceOf("command LR01 Drive").size() == (bPinned ? 3 : 1));
    const Lines reports = world.GetReportsOf("P1");
    if (bPinned)
    {
        CHECK_FALSE(Contains(reports, "Plan InProgress"));
        CHECK(GetRobotReason(world) == "rejects its commands: simulated by the test");
        return;
    }
    CHECK(std::ranges::count(reports, "Plan InProgress") == 1);
    CHECK(std::ranges::count(reports, "Step 1 Dispatched") == 1);
    CHECK(reports.back() == "Plan Completed");
    CHECK(world.GetRobot("LR02").doneJobs == Lines{"P1-a4", "P1-b2"});
    CHECK(world.violations == Lines{});
}

TEST_CASE("A plan whose robot drops its drives is handed over when another robot is free, and to no other robot before")
{
    PlanWorld world(1, true);
    world.GetRobot("LR01").bDropsDrives = true;
    world.GetRobot("LR02").bDropsDrives = true;
    BeginForMinute(world);
    CHECK(world.engine->GetPlanOrNull("P1")->robotID == "LR02");
    const auto count = [&world] {
        return std::ranges::count(world.GetReportsOf("P1"), "Step 1 Dispatched");
    };
    CHECK(count() == 2);
    SECTION("the same robot may try again")
    {
        world.GetRobot("LR02").bDropsDrives = false;
        world.Ask(ClearAlarms{"LR02", "ACS-1012", {}, {}, 0});
        FinishPlan(world);
        CHECK(count() == 2);
    }
    SECTION("the other robot may try again")
    {
        world.GetRobot("LR01").bDropsDrives = false;
        world.Ask(ClearAlarms{"LR01", "ACS-1012", {}, {}, 0});
        FinishPlan(world);
        CHECK(count() == 3);
        CHECK(world.GetRobot("LR01").doneJobs == Lines{"P1-a4", "P1-b2"});
    }
    SECTION("it is paused meanwhile")
    {
        world.Control(EPlanControl::Pause, "P1");
        world.GetRobot("LR01").bDropsDrives = false;
        world.Ask(ClearAlarms{"LR01", "ACS-1012", {}, {}, 0});
        static_cast<void>(TryRunFor(world, 1min));
        CHECK(count() == 2);
        world.Control(EPlanControl::Resume, "P1");
        FinishPlan(world);
        CHECK(count() == 3);
    }
    CHECK(world.violations == Lines{});
}

TEST_CASE("An incompatible robot is given no plan until it is compatible")
{
    PlanWorld world;
    world.Connect();
    world.Raise("LR01", CompatibilityChanged{"its factsheet does not list order.edges.maxSpeed."});
    world.Submit(MakeLogisticsPlan("P1"));
    static_cast<void>(TryRunFor(world, 1min));
    CHECK(world.GetTraceOf("command LR01").empty());
    const auto countAlarms = [&world] {
        return std::ranges::count(world.engine->GetActiveAlarms(), "ACS-1013", &Alarm::errorCode);
    };
    CHECK(countAlarms() == 1);
    world.Ask(ClearAlarms{"LR01", "ACS-1013", {}, {}, 3});
    CHECK(countAlarms() == 1); // its cause remains
    world.Raise("LR01", CompatibilityChanged{});
    CHECK(countAlarms() == 0);
    FinishPlan(world);
    CHECK(world.GetRobot("LR01").doneJobs == Lines{"P1-a4", "P1-b2"});
}

TEST_CASE("A plan whose robot becomes incompatible before its first job is handed over")
{
    PlanWorld world(1, true);
    world.GetRobot("LR01").bRejectDrives = true;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Step 1 Dispatched");
    world.Raise("LR01", CompatibilityChanged{"its factsheet does not list order.edges.maxSpeed."});
    FinishPlan(world);
    CHECK(world.GetTraceOf("command LR01 Drive").size() == 1);
    CHECK(world.GetRobot("LR02").doneJobs == Lines{"P1-a4", "P1-b2"});
    CHECK(world.violations == Lines{});
}
