#include "fixtures/PlanWorldSteps.hpp"

#include <chrono>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using ACS::Testing::BeginPlan;
using ACS::Testing::MakeControlPlan;
using ACS::Testing::MakeLogisticsPlan;
using ACS::Testing::MakeTestOptions;
using ACS::Testing::MakeTestSite;
using ACS::Testing::PlanWorld;
using ACS::Testing::TryRunFor;

namespace
{

using Nodes = std::vector<std::string>;

RobotWorkChanged MakeWork(const std::string& robotID, Nodes nodeIDs)
{
    RobotWorkChanged work;
    work.robotID = robotID;
    work.nodeIDs = std::move(nodeIDs);
    return work;
}

void RestartAlone(PlanWorld& world)
{
    EngineOptions options = MakeTestOptions(true);
    options.robots.back().rejectedActions["TrayLoad"] = "so that the plan is CR01's";
    world.Restart(std::move(options), MakeTestSite());
    for (const char* robotID : {"CR01", "CR02"})
    {
        world.Raise(robotID, LinkChanged{true});
        world.PublishState(robotID);
    }
}

/// Starts the engine again on these rows, with a plan for CR01, whose route begins on L02. CR01 and CR02 report.
void Restart(PlanWorld& world, const std::vector<RobotWorkChanged>& works)
{
    for (const RobotWorkChanged& work : works)
    {
        REQUIRE(world.store.Append({{work}}).has_value());
    }
    RestartAlone(world);
    world.Submit(MakeControlPlan("P1"));
}

/// LR01 is at or after L01 (x = 0), LR02 at or after L15 (x = 14). In manual mode until it is on its node.
void PublishPlace(PlanWorld& world, const std::string& robotID, double x, bool bDriving, Nodes heldNodeIDs = {})
{
    StateChanged state;
    state.lastNodeID = robotID == "LR01" ? "L01" : "L15";
    state.bAutomatic = x == (robotID == "LR01" ? 0 : 14);
    state.bPoseKnown = true;
    state.x = x;
    state.bDriving = bDriving;
    state.heldNodeIDs = std::move(heldNodeIDs);
    world.Raise(robotID, state);
}

void PublishFirstPlace(PlanWorld& world, const std::string& robotID, double x, bool bDriving, Nodes heldNodeIDs = {})
{
    world.Raise(robotID, LinkChanged{true});
    PublishPlace(world, robotID, x, bDriving, std::move(heldNodeIDs));
}

void PublishParked(PlanWorld& world, const std::string& robotID)
{
    world.Raise(robotID, LinkChanged{true});
    world.PublishState(robotID);
}

/// The nodes that would be kept free for LR01 after another restart.
Nodes GetKept(const PlanWorld& world)
{
    const std::vector<RobotWorkChanged>& works = world.store.GetState().robotWorks;
    return std::ranges::find(works, "LR01", &RobotWorkChanged::robotID)->nodeIDs;
}

bool IsBegun(PlanWorld& world)
{
    static_cast<void>(TryRunFor(world, std::chrono::milliseconds(1)));
    return !world.GetTraceOf("command CR01 ").empty();
}

bool HasAlarm(const PlanWorld& world, const std::string& robotID, const std::string& errorCode)
{
    const std::vector<Alarm>& alarms = world.engine->GetActiveAlarms();
    return std::ranges::any_of(alarms, [&robotID, &errorCode](const Alarm& alarm) {
        return alarm.robotID == robotID && alarm.errorCode == errorCode;
    });
}

/// LR01 may be on L01 to L03, and stops: between two nodes, then on one.
void CheckKeptWhereItStands(PlanWorld& world)
{
    CHECK(GetKept(world) == Nodes{"L01", "L02", "L03"});
    PublishPlace(world, "LR01", 0.9, false);
    CHECK(GetKept(world) == Nodes{"L01", "L02"});
    CHECK_FALSE(IsBegun(world));
    PublishPlace(world, "LR01", 0, false);
    CHECK(IsBegun(world));
}

} // namespace

TEST_CASE("After a restart a driving robot keeps its remaining route, and two nodes when it stops between them")
{
    PlanWorld world(1, true);
    Restart(world, {MakeWork("LR01", {"L01", "L02", "L03"})});
    PublishParked(world, "LR02");
    PublishFirstPlace(world, "LR01", 0.1, true);
    CheckKeptWhereItStands(world);
}

TEST_CASE("A robot that loses an order from before the restart between two nodes keeps the one ahead")
{
    PlanWorld world(1, true);
    Restart(world, {MakeWork("LR01", {"L01"})});
    PublishParked(world, "LR02");
    PublishFirstPlace(world, "LR01", 0.1, true, {"L02", "L03"});
    CheckKeptWhereItStands(world);
}

TEST_CASE("After a restart the reported position of a robot counts more than the assumed position of another one")
{
    const bool bThere = GENERATE(false, true); // whether the other one has reported that it is on the way there
    PlanWorld world(1, true);
    Restart(world, {MakeWork("LR01", {"L01", "L15", "L02"})});
    if (bThere)
    {
        PublishFirstPlace(world, "LR01", 0.1, true);
    }
    static_cast<void>(TryRunFor(world, MakeTestOptions(true).restartWait));
    PublishFirstPlace(world, "LR02", 14, false);
    CHECK_FALSE(HasAlarm(world, "LR02", "ACS-1003"));
    CHECK_FALSE(IsBegun(world));
    PublishPlace(world, "LR01", 0, false);
    CHECK(IsBegun(world) == bThere);
}

TEST_CASE("After a restart a node where two robots may be is free once both have reported other nodes")
{
    PlanWorld world(1, true);
    Restart(world, {MakeWork("LR01", {"L01", "L02"}), MakeWork("LR02", {"L15", "L01", "L02"})});
    PublishFirstPlace(world, "LR02", 14.1, true);
    static_cast<void>(TryRunFor(world, MakeTestOptions(true).restartWait));
    CHECK(HasAlarm(world, "LR01", "ACS-1002"));
    CHECK_FALSE(IsBegun(world));
    PublishPlace(world, "LR02", 14, false);
    CHECK_FALSE(IsBegun(world));
    PublishFirstPlace(world, "LR01", 0, false);
    CHECK_FALSE(HasAlarm(world, "LR01", "ACS-1003"));
    CHECK(IsBegun(world));
}

TEST_CASE("The nodes where a robot may be are kept over several restarts")
{
    PlanWorld world(1, true);
    Restart(world, {MakeWork("LR01", {"L01", "L02"})});
    PublishParked(world, "LR02");
    static_cast<void>(TryRunFor(world, MakeTestOptions(true).restartWait));
    RestartAlone(world);
    CHECK_FALSE(IsBegun(world));
    CHECK(GetKept(world) == Nodes{"L01", "L02"});
}

TEST_CASE("A robot that was switched off in a drive and has no pose after it keeps its nodes until it has one")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Step 1 InProgress");
    REQUIRE(world.TryRun([&world] { return world.GetRobot("LR01").GetOccupied() == Nodes{"L02", "L03"}; }));
    const auto listReserved = [&world] {
        return world.engine->GetRobotRoutes().front().reservedNodeIDs;
    };
    const Nodes reserved = listReserved();
    REQUIRE(reserved.size() > 1);
    StateChanged state;
    state.lastNodeID = "L02";
    state.bAutomatic = false;
    world.Raise("LR01", LinkChanged{false});
    world.Raise("LR01", LinkChanged{true});
    world.Raise("LR01", state);
    world.Raise("LR01", DriveRejected{world.driveIDs.at("LR01"), "it was switched off"});
    CHECK(listReserved() == reserved);
    world.Raise("LR01", state);
    CHECK(listReserved() == reserved);
    const SiteMap site = MakeTestSite();
    const SiteNode& node = site.GetNodes()[*site.FindNodeIndexOrNull("L02")];
    state.bPoseKnown = true;
    state.x = node.x;
    state.y = node.y;
    world.Raise("LR01", state);
    CHECK(listReserved() == Nodes{"L02"});
}

TEST_CASE("A robot that was switched off in a drive and carried to another node gets no drive from where it was")
{
    const bool bOnRoute = GENERATE(false, true);
    const std::string nodeID = bOnRoute ? "L01" : "D-A01.CP03";
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Step 1 InProgress");
    REQUIRE(world.TryRun([&world] { return world.GetRobot("LR01").GetOccupied() == Nodes{"L02", "L03"}; }));
    const std::string driveID = world.driveIDs.at("LR01");
    world.Raise("LR01", LinkChanged{false});
    world.Raise("LR01", LinkChanged{true});
    StateChanged state;
    state.lastNodeID = nodeID;
    state.batteryPercent = 80;
    world.Raise("LR01", state);
    world.Raise("LR01", DriveRejected{driveID, "it was switched off"});
    CHECK(world.engine->GetRobotRoutes().front().reservedNodeIDs == Nodes{nodeID});
    CHECK(world.engine->GetRobotDetails().front().nodeID == nodeID);
    CHECK_FALSE(HasAlarm(world, "LR01", "ACS-1003"));
}
