#include "floor/FloorPlan.hpp"

#include "Catch.hpp"
#include "floor/FloorPlans.hpp"

#include <string>
#include <vector>

using namespace ACS::Sim; // NOLINT(google-build-using-namespace)
using ACS::McsSim::Describe;
using ACS::McsSim::FloorMove;
using ACS::McsSim::FloorPlan;
using ACS::McsSim::IsMove;
using ACS::McsSim::IsSameMove;
using ACS::McsSim::MakeFloorPlan;
using ACS::McsSim::WithRobot;
using ACS::Protocol::ExecutionPlan;
using ACS::Testing::MakeTrayPlan;

namespace
{

ExecutionPlan MakePlan(std::vector<ACS::Protocol::PlanStep> steps)
{
    ExecutionPlan plan;
    plan.planID = "P";
    plan.steps = std::move(steps);
    return plan;
}

} // namespace

TEST_CASE("The plan of the document moves two trays and two memories, in the order of the steps")
{
    ExecutionPlan plan = MakeTrayPlan("P").plan;
    std::swap(plan.steps[0], plan.steps[2]);
    const FloorPlan floor = MakeFloorPlan(plan);
    CHECK(
        floor.moves
        == std::vector<FloorMove>{
            {1, "P-1", CarrierMoved{"", "TRAY_01", "A01.CP02.TP01", "AMR.TP01"}},
            {1, "P-2", CarrierMoved{"", "TRAY_02", "A01.CP02.TP02", "AMR.TP02"}},
            {2, "P-3", MemoryMoved{"", "AMR.TP01.MP01", "A01.SET01.MP01"}},
            {2, "P-4", MemoryMoved{"", "AMR.TP02.MP01", "A01.SET01.MP02"}},
            {3, "P-5", CarrierMoved{"", "TRAY_01", "AMR.TP01", "A01.CP02.TP03"}},
            {3, "P-6", CarrierMoved{"", "TRAY_02", "AMR.TP02", "A01.CP02.TP04"}}});
}

TEST_CASE("Each fixed place must hold what its first use needs, memories in a tray included")
{
    const FloorPlan floor = MakeFloorPlan(MakeTrayPlan("P").plan);
    CHECK(
        floor.carriers
        == std::vector<CarrierPlaced>{
            {"TRAY_01", "A01.CP02.TP01"},
            {"TRAY_02", "A01.CP02.TP02"},
            {"", "A01.CP02.TP03"},
            {"", "A01.CP02.TP04"}});
    CHECK(
        floor.memories
        == std::vector<MemoryPlaced>{
            {"A01.CP02.TP01.MP01", EMemory::Occupied},
            {"A01.SET01.MP01", EMemory::Empty},
            {"A01.CP02.TP02.MP01", EMemory::Occupied},
            {"A01.SET01.MP02", EMemory::Empty}});
    CHECK(floor.claims == std::vector<std::string>{"A01.CP02", "A01.SET01", "TRAY_01", "TRAY_02"});
}

TEST_CASE("A place that is used twice counts by its first use")
{
    const FloorPlan floor = MakeFloorPlan(MakePlan(
        {{1, "CassetteLoad", "A01.CP01", {"C"}, {{"a", "A01.CP01", "AMR.CP01"}}},
         {2, "CassetteUnload", "A02.CP03", {"C"}, {{"b", "AMR.CP01", "A02.CP03"}}},
         {3, "CassetteLoad", "A02.CP03", {"C"}, {{"c", "A02.CP03", "AMR.CP01"}}},
         {4, "CassetteUnload", "A01.CP01", {"C"}, {{"d", "AMR.CP01", "A01.CP01"}}}}));
    CHECK(floor.carriers == std::vector<CarrierPlaced>{{"C", "A01.CP01"}, {"", "A02.CP03"}});
}

TEST_CASE("Ports of a robot are never stocked, and a carrier that is loaded unnamed gets a name by hand only")
{
    const FloorPlan floor = MakeFloorPlan(MakePlan(
        {{1, "CassetteUnload", "A02.CP03", {"C"}, {{"a", "LR01.CP01", "A02.CP03"}}},
         {2, "CassetteLoad", "A01.CP01", {}, {{"b", "a01.cp1", "AMR.CP02"}}},
         {3, "MemoryPickAndPlace", "A01.SET01", {}, {{"c", "AMR.TP01.MP01", "SET01.MP01"}}}}));
    CHECK(floor.carriers == std::vector<CarrierPlaced>{{"", "A02.CP03"}, {"UNNAMED-A01.CP01", "A01.CP01"}});
    CHECK(floor.memories == std::vector<MemoryPlaced>{{"A01.SET01.MP01", EMemory::Empty}});
    CHECK(floor.moves[1].event == WorldEvent(CarrierMoved{"", "", "A01.CP01", "AMR.CP02"}));
}

TEST_CASE("Covers and buttons are those of the step's position, also of a step without jobs")
{
    const FloorPlan floor = MakeFloorPlan(MakePlan(
        {{1, "OpenSetCover", "A01.SET01", {}, {{"a", "", ""}}},
         {2, "CloseSetCover", "A01.SET01", {}, {}},
         {3, "Start", "A01.SET01", {}, {{"b", "", ""}}}}));
    CHECK(
        floor.moves
        == std::vector<FloorMove>{
            {1, "a", CoverMoved{"", "A01.SET01", false}},
            {2, "", CoverMoved{"", "A01.SET01", true}},
            {3, "b", ButtonPushed{"", "A01.SET01"}}});
    CHECK(floor.carriers.empty());
}

TEST_CASE("Invalid places make no move: the ACS refuses the plan")
{
    const FloorPlan floor = MakeFloorPlan(MakePlan(
        {{1, "CassetteLoad", "nowhere", {"C"}, {{"a", "A01.CP01", "AMR.CP01"}}},
         {2, "CassetteLoad", "A01.CP01", {"C"}, {{"b", "here", "AMR.CP01"}, {"c", "A01.CP01", ""}}}}));
    CHECK(floor.moves.empty());
    CHECK(floor.carriers.empty());
}

TEST_CASE("A move is compared with the robot that reports it; an unnamed carrier matches any")
{
    const WorldEvent named = WithRobot(CarrierMoved{"", "C", "A01.CP01", "AMR.CP01"}, "LR01");
    CHECK(named == WorldEvent(CarrierMoved{"LR01", "C", "A01.CP01", "LR01.CP01"}));
    CHECK_FALSE(IsSameMove(named, CarrierMoved{"LR01", "D", "A01.CP01", "LR01.CP01"}));
    CHECK_FALSE(IsSameMove(named, CarrierMoved{"LR01", "C", "A01.CP01", "LR01.CP02"}));
    CHECK_FALSE(IsSameMove(named, CarrierMoved{"LR02", "C", "A01.CP01", "LR01.CP01"}));
    const WorldEvent open = WithRobot(CarrierMoved{"", "", "A01.CP01", "AMR.CP01"}, "LR01");
    CHECK(IsSameMove(open, CarrierMoved{"LR01", "D", "A01.CP01", "LR01.CP01"}));
    CHECK_FALSE(IsSameMove(open, CarrierMoved{"LR01", "D", "A01.CP02", "LR01.CP01"}));
    CHECK(
        WithRobot(MemoryMoved{"", "AMR.TP01.MP01", "A01.SET01.MP01"}, "CR01")
        == WorldEvent(MemoryMoved{"CR01", "CR01.TP01.MP01", "A01.SET01.MP01"}));
    CHECK(WithRobot(CoverMoved{"", "A01.SET01", true}, "CR01") == WorldEvent(CoverMoved{"CR01", "A01.SET01", true}));
}

TEST_CASE("Docking and changes by hand are not moves; the others are described with the robot")
{
    CHECK_FALSE(IsMove(RobotDocked{"LR01", {"A01.CP01"}}));
    CHECK_FALSE(IsMove(CarrierPlaced{"C", "A01.CP01"}));
    CHECK_FALSE(IsMove(MemoryPlaced{"A01.SET01.MP01", EMemory::Empty}));
    CHECK(IsMove(ButtonPushed{"CR01", "A01.SET01"}));
    CHECK(Describe(CarrierMoved{"LR01", "C", "A01.CP01", "LR01.CP01"}) == "LR01: C from A01.CP01 to LR01.CP01");
    CHECK(Describe(CarrierMoved{"LR01", "", "A01.CP01", "LR01.CP01"}) == "LR01: a carrier from A01.CP01 to LR01.CP01");
    CHECK(
        Describe(MemoryMoved{"CR01", "CR01.TP01.MP01", "A01.SET01.MP01"})
        == "CR01: a memory from CR01.TP01.MP01 to A01.SET01.MP01");
    CHECK(Describe(CoverMoved{"CR01", "A01.SET01", false}) == "CR01: cover of A01.SET01 opened");
    CHECK(Describe(ButtonPushed{"CR01", "A01.SET01"}) == "CR01: start button of A01.SET01 pushed");
}
