#include "fixtures/PlanWorldSteps.hpp"

#include <chrono>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using ACS::Testing::MakeControlPlan;
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
        world.TellState(robotID);
    }
}

/// Starts the engine again on these rows, with a plan for CR01, whose way begins on L02. CR01 and CR02 are there.
void Restart(PlanWorld& world, const std::vector<RobotWorkChanged>& works)
{
    for (const RobotWorkChanged& work : works)
    {
        REQUIRE(world.store.Append({{work}}).has_value());
    }
    RestartAlone(world);
    world.Submit(MakeControlPlan("P1"));
}

/// LR01 is at or behind L01 (x = 0), LR02 at or behind L15 (x = 14). In manual mode until it stands on its node.
void Tell(PlanWorld& world, const std::string& robotID, double x, bool bDriving, Nodes heldNodeIDs = {})
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

void TellFirst(PlanWorld& world, const std::string& robotID, double x, bool bDriving, Nodes heldNodeIDs = {})
{
    world.Raise(robotID, LinkChanged{true});
    Tell(world, robotID, x, bDriving, std::move(heldNodeIDs));
}

void TellAtHome(PlanWorld& world, const std::string& robotID)
{
    world.Raise(robotID, LinkChanged{true});
    world.TellState(robotID);
}

/// What would be kept free for LR01 after another restart.
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

/// LR01 may be on L01 to L03, and comes to a stand: between two nodes, then on one.
void CheckKeptWhereItStands(PlanWorld& world)
{
    CHECK(GetKept(world) == Nodes{"L01", "L02", "L03"});
    Tell(world, "LR01", 0.9, false);
    CHECK(GetKept(world) == Nodes{"L01", "L02"});
    CHECK_FALSE(IsBegun(world));
    Tell(world, "LR01", 0, false);
    CHECK(IsBegun(world));
}

} // namespace

TEST_CASE(
    "After a restart a robot that drives keeps all that was left of its way, and two nodes when it stands between")
{
    PlanWorld world(1, true);
    Restart(world, {MakeWork("LR01", {"L01", "L02", "L03"})});
    TellAtHome(world, "LR02");
    TellFirst(world, "LR01", 0.1, true);
    CheckKeptWhereItStands(world);
}

TEST_CASE("A robot that loses an order of before the restart between two nodes keeps the one ahead")
{
    PlanWorld world(1, true);
    Restart(world, {MakeWork("LR01", {"L01"})});
    TellAtHome(world, "LR02");
    TellFirst(world, "LR01", 0.1, true, {"L02", "L03"});
    CheckKeptWhereItStands(world);
}

TEST_CASE("After a restart a robot that stands where another one is only supposed to be is believed")
{
    const bool bThere = GENERATE(false, true); // whether the other one has told that it is on the way there
    PlanWorld world(1, true);
    Restart(world, {MakeWork("LR01", {"L01", "L15", "L02"})});
    if (bThere)
    {
        TellFirst(world, "LR01", 0.1, true);
    }
    static_cast<void>(TryRunFor(world, MakeTestOptions(true).restartWait));
    TellFirst(world, "LR02", 14, false);
    CHECK_FALSE(HasAlarm(world, "LR02", "ACS-1003"));
    CHECK_FALSE(IsBegun(world));
    Tell(world, "LR01", 0, false);
    CHECK(IsBegun(world) == bThere);
}

TEST_CASE("After a restart a node where two robots may be is free when neither is there")
{
    PlanWorld world(1, true);
    Restart(world, {MakeWork("LR01", {"L01", "L02"}), MakeWork("LR02", {"L15", "L01", "L02"})});
    TellFirst(world, "LR02", 14.1, true);
    static_cast<void>(TryRunFor(world, MakeTestOptions(true).restartWait));
    CHECK(HasAlarm(world, "LR01", "ACS-1002"));
    CHECK_FALSE(IsBegun(world));
    Tell(world, "LR02", 14, false);
    CHECK_FALSE(IsBegun(world));
    TellFirst(world, "LR01", 0, false);
    CHECK_FALSE(HasAlarm(world, "LR01", "ACS-1003"));
    CHECK(IsBegun(world));
}

TEST_CASE("Where a robot may be is kept over one restart after the other")
{
    PlanWorld world(1, true);
    Restart(world, {MakeWork("LR01", {"L01", "L02"})});
    TellAtHome(world, "LR02");
    static_cast<void>(TryRunFor(world, MakeTestOptions(true).restartWait));
    RestartAlone(world);
    CHECK_FALSE(IsBegun(world));
    CHECK(GetKept(world) == Nodes{"L01", "L02"});
}
