#include "fixtures/PlanWorldSteps.hpp"

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using ACS::Testing::BeginPlan;
using ACS::Testing::Contains;
using ACS::Testing::FinishPlan;
using ACS::Testing::Lines;
using ACS::Testing::MakeLogisticsPlan;
using ACS::Testing::PlanWorld;
using ACS::Testing::TryRunFor;
using ACS::Testing::TryRunUntil;

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
    SECTION("before it has confirmed the drive")
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
    BeginForMinute(world);
    CHECK(world.GetTraceOf("command LR01 Drive").size() == 3);
    CHECK(HasAlarm(world));
    CHECK(GetWaitReason(world) == "LR01: rejects its commands: simulated by the test.");
    CHECK(world.GetReportsOf("P1").back() == "Step 1 Dispatched");
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

TEST_CASE("A plan whose robot rejects all its drives is taken over by another robot, unless it names the robot")
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
    CHECK(HasAlarm(world));
    CHECK(world.GetTraceOf("command LR01 Drive").size() == 3);
    if (bPinned)
    {
        CHECK(GetWaitReason(world) == "LR01: rejects its commands: simulated by the test.");
        return;
    }
    const Lines reports = world.GetReportsOf("P1");
    CHECK(std::ranges::count(reports, "Plan InProgress") == 1);
    CHECK(std::ranges::count(reports, "Step 1 Dispatched") == 2);
    CHECK(reports.back() == "Plan Completed");
    CHECK(world.GetRobot("LR02").doneJobs == Lines{"P1-a4", "P1-b2"});
    CHECK(world.violations == Lines{});
}

TEST_CASE(
    "A plan whose robot rejects its drives is handed over when another robot is free, and to no other robot before")
{
    PlanWorld world(1, true);
    world.GetRobot("LR01").bRejectDrives = true;
    world.GetRobot("LR02").bRejectDrives = true;
    BeginForMinute(world);
    CHECK(world.engine->GetPlanOrNull("P1")->robotID == "LR02");
    const auto count = [&world] {
        return std::ranges::count(world.GetReportsOf("P1"), "Step 1 Dispatched");
    };
    CHECK(count() == 2);
    SECTION("the same robot may try again")
    {
        world.GetRobot("LR02").bRejectDrives = false;
        world.Ask(ClearAlarms{"LR02", "ACS-1012", {}, {}, 0});
        FinishPlan(world);
        CHECK(count() == 2);
    }
    SECTION("the other robot may try again")
    {
        world.GetRobot("LR01").bRejectDrives = false;
        world.Ask(ClearAlarms{"LR01", "ACS-1012", {}, {}, 0});
        FinishPlan(world);
        CHECK(count() == 3);
        CHECK(world.GetRobot("LR01").doneJobs == Lines{"P1-a4", "P1-b2"});
    }
    SECTION("it is paused meanwhile")
    {
        world.Control(EPlanControl::Pause, "P1");
        world.GetRobot("LR01").bRejectDrives = false;
        world.Ask(ClearAlarms{"LR01", "ACS-1012", {}, {}, 0});
        static_cast<void>(TryRunFor(world, 1min));
        CHECK(count() == 2);
        world.Control(EPlanControl::Resume, "P1");
        FinishPlan(world);
        CHECK(count() == 3);
    }
    CHECK(world.violations == Lines{});
}
