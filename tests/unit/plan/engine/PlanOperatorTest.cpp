#include "fixtures/PlanWorldSteps.hpp"

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using ACS::Testing::MakeLogisticsPlan;
using ACS::Testing::MakeTestOptions;
using ACS::Testing::MakeTestSite;
using ACS::Testing::PlanWorld;
using ACS::Testing::TryRunUntil;

namespace
{

std::string Ask(PlanWorld& world, const PlanCommand& command)
{
    world.replies.clear();
    world.Ask(command);
    REQUIRE(world.replies.size() == 1);
    return (world.replies.begin()->second.bAccepted ? "yes: " : "no: ") + world.replies.begin()->second.message;
}

ERobotStatus GetStatus(const PlanWorld& world)
{
    return world.engine->GetRobotStatuses().front().status;
}

void Fail(PlanWorld& world, bool bFails)
{
    StateChanged state;
    state.bPoseKnown = true;
    state.batteryPercent = 80;
    state.lastNodeID = "D-CHG01";
    if (bFails)
    {
        state.errors.push_back({"AGV-motor", EAlarmLevel::Heavy, "hot"});
    }
    world.Raise("LR01", state);
}

} // namespace

TEST_CASE("Maintenance: the robot completes its plan, then stays where it is, is Stopped, and accepts no other plan")
{
    PlanWorld world;
    world.Connect();
    world.Submit(MakeLogisticsPlan("P1"));
    world.Submit(MakeLogisticsPlan("P2"));
    REQUIRE(TryRunUntil(world, "P1", "Job 1 P1-a4 InProgress"));
    CHECK(Ask(world, SetMaintenance{"LR01", true, 0}) == "yes: LR01 is in maintenance after plan P1.");
    CHECK(GetStatus(world) == ERobotStatus::Working);
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
    CHECK(world.GetReportsOf("P2").empty());
    CHECK(GetStatus(world) == ERobotStatus::Stopped);
    CHECK(world.engine->GetRobotStatuses().front().message == "In maintenance.");
    CHECK(world.GetRobot("LR01").GetOccupied() == std::vector<std::string>{"D-A02.CP03"});
    CHECK(world.engine->GetWaitReasonOrNull("P2")->robots.front().reason == "in maintenance");
    CHECK(Ask(world, SetMaintenance{"LR01", false, 0}) == "yes: LR01 is in service.");
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P2").back() == "Plan Completed");
    CHECK(GetStatus(world) == ERobotStatus::Idle);
    CHECK(Ask(world, SetMaintenance{"LR09", true, 0}) == "no: There is no robot LR09.");
}

TEST_CASE("Maintenance: waiting plans are assigned to other robots")
{
    PlanWorld world(1, true);
    world.Connect();
    world.Ask(SetMaintenance{"LR01", true, 0});
    world.Submit(MakeLogisticsPlan("P1"));
    world.Submit(MakeLogisticsPlan("P2"));
    REQUIRE(world.TryRun());
    for (const std::string planID : {"P1", "P2"})
    {
        CHECK(world.engine->GetPlanOrNull(planID)->robotID == "LR02");
        CHECK(world.GetReportsOf(planID).back() == "Plan Completed");
    }
}

TEST_CASE("Maintenance is kept over a restart")
{
    PlanWorld world;
    world.Connect();
    world.Ask(SetMaintenance{"LR01", true, 0});
    world.Restart(MakeTestOptions(false), MakeTestSite());
    CHECK(world.engine->GetRobotStatuses().front().bInMaintenance);
    world.Connect();
    world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1").empty());
    CHECK(GetStatus(world) == ERobotStatus::Stopped);
    world.Ask(SetMaintenance{"LR01", false, 0});
    world.Restart(MakeTestOptions(false), MakeTestSite());
    CHECK_FALSE(world.engine->GetRobotStatuses().front().bInMaintenance);
}

TEST_CASE("An alarm that the operator clears is reported as cleared, and set again while its cause remains")
{
    PlanWorld world;
    world.Connect();
    Fail(world, true);
    CHECK(
        Ask(world, ClearAlarms{"LR01", "AGV-motor", {}, {}, 0})
        == "yes: 1 cleared; 1 set again because the cause remains.");
    CHECK(
        world.GetReportsOf("-")
        == std::vector<std::string>{"Error AGV-motor set", "Error AGV-motor cleared", "Error AGV-motor set"});
    Fail(world, false);
    CHECK(world.engine->GetActiveAlarms().empty());
    CHECK(Ask(world, ClearAlarms{"LR01", "AGV-motor", {}, {}, 0}) == "no: LR01 has no alarm AGV-motor.");
    world.Raise("LR01", LinkChanged{false});
    world.Ask(ClearAlarms{"LR01", "ACS-1002", {}, {}, 0});
    CHECK(world.engine->GetActiveAlarms().size() == 1);
    world.Connect();
    CHECK(world.engine->GetActiveAlarms().empty());
}

TEST_CASE("An alarm is kept over a restart until it is cleared, and stays cleared after another one")
{
    PlanWorld world;
    world.Connect();
    Plan plan = MakeLogisticsPlan("P1");
    plan.steps.pop_back();
    world.Submit(plan);
    REQUIRE(TryRunUntil(world, "P1", "Job 1 P1-a4 InProgress"));
    // As if the robot had another carrier on the port than the plan's.
    world.Ask(SetCarriers{"LR01", {"CASSETTE_99"}, 0});
    REQUIRE(TryRunUntil(world, "P1", "Plan Completed"));
    REQUIRE(world.engine->GetActiveAlarms().size() == 1);
    CHECK(world.engine->GetActiveAlarms().front().errorCode == "ACS-1004");
    world.Restart(MakeTestOptions(false), MakeTestSite());
    CHECK(world.engine->GetActiveAlarms().size() == 1);
    CHECK(
        Ask(world, ClearAlarms{"LR01", "ACS-1004", {}, {}, 0})
        == "yes: 1 cleared; 0 set again because the cause remains.");
    world.Restart(MakeTestOptions(false), MakeTestSite());
    CHECK(world.engine->GetActiveAlarms().empty());
    CHECK(world.GetReportsOf("-").back() == "Error ACS-1004 cleared");
}

TEST_CASE("5.9, R12 Ports that an operator corrects are published at once and stored; an invalid correction is refused")
{
    PlanWorld world(1, true);
    world.Connect();
    CHECK(Ask(world, SetCarriers{"CR01", {"TRAY_01", {}, "TRAY_03"}, 0}) == "yes: The ports of CR01 are corrected.");
    const std::vector<std::optional<std::string>> carriers{"TRAY_01", std::nullopt, "TRAY_03"};
    CHECK(world.engine->GetRobotStatuses()[1].carrierIDs == carriers);
    world.Restart(MakeTestOptions(true), MakeTestSite());
    CHECK(world.engine->GetRobotStatuses()[1].carrierIDs == carriers);
    CHECK(
        Ask(world, SetCarriers{"CR01", {"TRAY_01"}, 0})
        == "no: CR01 has 3 carrier ports, but the command gives carriers for 1. Give one entry per port; null (acsctl: -) is no carrier.");
    CHECK(Ask(world, SetCarriers{"CR01", {"A", "A", {}}, 0}) == "no: Carrier A is given for two ports.");
    CHECK(Ask(world, SetCarriers{"CR01", {"", {}, {}}, 0}) == "no: Invalid carrierId: expected 1 to 128 bytes.");
    CHECK(
        Ask(world, SetCarriers{"CR01", {"A\n", {}, {}}, 0})
        == "no: Invalid carrierId: control characters are not allowed.");
    CHECK(
        Ask(world, SetCarriers{"CR02", {{}, "TRAY_03", {}}, 0})
        == "no: Carrier TRAY_03 is on CR01. Correct the ports of that robot first.");
    CHECK(Ask(world, SetCarriers{"LR09", {}, 0}) == "no: There is no robot LR09.");
}
