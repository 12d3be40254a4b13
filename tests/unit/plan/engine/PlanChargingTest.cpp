#include "fixtures/PlanWorldSteps.hpp"

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using ACS::Testing::Contains;
using ACS::Testing::FindLine;
using ACS::Testing::MakeLogisticsPlan;
using ACS::Testing::MakeTestOptions;
using ACS::Testing::MakeTestSite;
using ACS::Testing::MakeWorld;
using ACS::Testing::PlanWorld;
using ACS::Testing::RestartEngine;
using ACS::Testing::TryRunFor;
using ACS::Testing::TryRunUntil;

namespace
{

using namespace std::chrono_literals;

/// LR01 charges on CHG03, not its parking position.
PlanWorld MakeChargingWorld(const std::string& station = "CHG03")
{
    return MakeWorld([&station](EngineOptions& options) { options.robots.front().chargingStationID = station; });
}

void SetBattery(PlanWorld& world, double percent)
{
    world.GetRobot("LR01").battery = percent;
    world.PublishState("LR01");
}

ERobotStatus GetStatus(const PlanWorld& world)
{
    return world.engine->GetRobotStatuses().front().status;
}

} // namespace

TEST_CASE("robot.battery_floor: below it a robot accepts no plan, charges and is used again at the resume level")
{
    PlanWorld world = MakeChargingWorld();
    world.Connect();
    SetBattery(world, 12);
    world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1").empty());
    CHECK(world.GetRobot("LR01").GetOccupied() == std::vector<std::string>{"D-CHG03"});
    CHECK(GetStatus(world) == ERobotStatus::Charging);
    CHECK(world.GetRobot("LR01").chargesAsked == 1);
    const WaitReason waiting = *world.engine->GetWaitReasonOrNull("P1");
    REQUIRE(waiting.robots.size() == 1);
    CHECK(waiting.robots.front().reason == "battery 12 % is below 20 %");
    SetBattery(world, 79);
    CHECK(world.engine->GetWaitReasonOrNull("P1")->robots.front().reason == "charging, battery 79 % of 80 %");
    SetBattery(world, 80);
    REQUIRE(world.TryRun());
    CHECK(Contains(world.trace, "command LR01 StopCharging"));
    CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
    CHECK(world.GetRobot("LR01").GetOccupied() == std::vector<std::string>{"D-CHG01"});
}

TEST_CASE("robot.battery_floor: a plan in progress is completed before the robot charges")
{
    PlanWorld world = MakeChargingWorld();
    world.Connect();
    world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(TryRunUntil(world, "P1", "Step 1 InProgress"));
    SetBattery(world, 3);
    REQUIRE(TryRunUntil(world, "P1", "Plan Completed"));
    REQUIRE(world.TryRun());
    CHECK(GetStatus(world) == ERobotStatus::Charging);
}

TEST_CASE("A robot whose parking position is its charger charges there below the resume level, and leaves for a plan")
{
    PlanWorld world = MakeChargingWorld("CHG01");
    world.Connect();
    CHECK(world.GetRobot("LR01").chargesAsked == 0);
    SetBattery(world, 60);
    CHECK(world.GetRobot("LR01").chargesAsked == 1);
    CHECK(GetStatus(world) == ERobotStatus::Charging);
    world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(TryRunUntil(world, "P1", "Plan Completed"));
    CHECK(FindLine(world, "command LR01 StopCharging", 0) < FindLine(world, "command LR01 Drive to D-A01.CP01", 0));
}

TEST_CASE("A restart does not end the charging of a robot with a low battery")
{
    const bool bOwnCharger = GENERATE(true, false);
    const std::string charger =
        bOwnCharger ? "CHG03" : "CHG01"; // or its parking position, too: it may charge for the next plan
    PlanWorld world = MakeChargingWorld(charger);
    world.Connect();
    SetBattery(world, 12);
    REQUIRE(world.TryRun());
    SetBattery(world, 50);
    REQUIRE(GetStatus(world) == ERobotStatus::Charging);
    RestartEngine(world, [&charger](EngineOptions& options) { options.robots.front().chargingStationID = charger; });
    world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1").empty() == bOwnCharger);
    SetBattery(world, 80);
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
}

TEST_CASE("A robot that does not charge at its charger is commanded again; the alarm is cleared when it charges")
{
    PlanWorld world = MakeChargingWorld();
    world.GetRobot("LR01").bIgnoresCharging = true;
    world.Connect();
    SetBattery(world, 12);
    REQUIRE(TryRunFor(world, 5min));
    CHECK(world.GetRobot("LR01").chargesAsked > 2);
    CHECK(world.GetReportsOf("-") == std::vector<std::string>{"Error ACS-1010 set"});
    world.GetRobot("LR01").bIgnoresCharging = false;
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("-").back() == "Error ACS-1010 cleared");
    CHECK(GetStatus(world) == ERobotStatus::Charging);
}

TEST_CASE("A robot without a charging station is used at any battery level")
{
    PlanWorld world;
    world.Connect();
    SetBattery(world, 1);
    world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
    CHECK(world.GetRobot("LR01").chargesAsked == 0);
}

TEST_CASE("Options with a shared charging station or with battery levels out of order are rejected")
{
    EngineOptions options = MakeTestOptions(true);
    options.robots[0].chargingStationID = "CHG01";
    options.robots[2].chargingStationID = "CHG01";
    options.robots[1].chargingStationID = "NOWHERE";
    options.dispatch.batteryFloor = 90;
    const std::vector<ACS::Core::Error> errors = FindErrors(options, MakeTestSite());
    REQUIRE(errors.size() == 3);
    CHECK(errors[0].path == "robots.CR01.charge");
    CHECK(errors[1].path == "robots.LR02.charge");
    CHECK(errors[2].path == "robot.battery_floor");
}
