#include "fixtures/PlanWorldSteps.hpp"

#include <algorithm>
#include <optional>
#include <string>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using ACS::Testing::BeginPlan;
using ACS::Testing::FinishPlan;
using ACS::Testing::Lines;
using ACS::Testing::MakeControlPlan;
using ACS::Testing::MakeLogisticsPlan;
using ACS::Testing::MakeRestrictedSite;
using ACS::Testing::MakeTestOptions;
using ACS::Testing::MakeTestSite;
using ACS::Testing::PlanWorld;
using ACS::Testing::RestartEngine;

namespace
{

template <typename TCommand>
std::string Ask(PlanWorld& world, const TCommand& command)
{
    const std::optional<std::string> reason = world.engine->GetRejectionReasonOrNull(command);
    world.replies.clear();
    world.Ask(command);
    REQUIRE(world.replies.size() == 1);
    const ReplyCommand& reply = world.replies.begin()->second;
    CHECK(reply.bAccepted != reason.has_value());
    CHECK((reply.bAccepted || reply.message == *reason));
    return (reply.bAccepted ? "yes: " : "no: ") + reply.message;
}

std::string AskToBlock(PlanWorld& world, EBlockKind kind, const std::string& id, const std::string& reason = {})
{
    return Ask(world, BlockPlace{kind, id, reason, 0});
}

std::string AskToUnblock(PlanWorld& world, EBlockKind kind, const std::string& id)
{
    return Ask(world, UnblockPlace{kind, id, 0});
}

/// One load at the station.
Plan MakeLoadPlan(const std::string& stationID)
{
    return {"P1", "", 1, {{1, "CassetteLoad", stationID, {"C"}, {{"J1", stationID, "AMR.CP01"}}}}};
}

WaitReason GetWaitReason(const PlanWorld& world)
{
    const std::optional<WaitReason> reason = world.engine->GetWaitReasonOrNull("P1");
    REQUIRE(reason.has_value());
    return *reason;
}

/// The node of the robot, or that which it has passed last.
std::string GetNode(const PlanWorld& world, const std::string& robotID)
{
    const std::vector<RobotDetail> details = world.engine->GetRobotDetails();
    return std::ranges::find(details, robotID, &RobotDetail::robotID)->nodeID;
}

bool TryRunToNode(PlanWorld& world, const std::string& robotID, const std::string& nodeID)
{
    return world.TryRun([&world, robotID, nodeID] { return GetNode(world, robotID) == nodeID; });
}

} // namespace

TEST_CASE("Block: nodes, edges and stations are blocked and opened, also over a restart")
{
    PlanWorld world;
    CHECK(AskToBlock(world, EBlockKind::Node, "L03", "oil") == "yes: The node L03 is blocked.");
    CHECK(AskToBlock(world, EBlockKind::Edge, "L03>L04") == "yes: The edge L03>L04 is blocked.");
    CHECK(AskToBlock(world, EBlockKind::Station, "A01.CP02") == "yes: The station A01.CP02 is blocked.");
    const ACS::Core::WallTime now = world.GetNow().wall;
    const std::vector<Block> blocks{
        {EBlockKind::Node, "L03", "oil", now},
        {EBlockKind::Edge, "L03>L04", "", now},
        {EBlockKind::Station, "A01.CP02", "", now}};
    CHECK(world.engine->GetBlocks() == blocks);
    CHECK(world.store.GetState().blocks == blocks);
    RestartEngine(world);
    CHECK(world.engine->GetBlocks() == blocks);
    CHECK(AskToUnblock(world, EBlockKind::Node, "L03") == "yes: The node L03 is open.");
    CHECK(AskToUnblock(world, EBlockKind::Node, "L03") == "no: The node L03 is not blocked.");
    CHECK(world.engine->GetBlocks() == std::vector<Block>(blocks.begin() + 1, blocks.end()));
    CHECK(world.store.GetState().blocks.size() == 2);
}

TEST_CASE("Block: unknown ids, a second block, a bad reason and too many blocks are refused")
{
    PlanWorld world;
    CHECK(AskToBlock(world, EBlockKind::Node, "L99") == "no: There is no node L99.");
    CHECK(AskToBlock(world, EBlockKind::Edge, "L03") == "no: There is no edge L03.");
    CHECK(AskToBlock(world, EBlockKind::Station, "L03") == "no: There is no station L03.");
    CHECK(AskToBlock(world, EBlockKind::Node, "L03", "a\nb").starts_with("no: Invalid reason"));
    CHECK(AskToBlock(world, EBlockKind::Node, "L03", std::string(201, 'x')).starts_with("no: Invalid reason"));
    CHECK(AskToBlock(world, EBlockKind::Node, "L03", std::string(200, 'x')).starts_with("yes"));
    CHECK(AskToBlock(world, EBlockKind::Node, "L03") == "no: The node L03 is blocked already.");
    std::vector<Block> many(MAXIMUM_BLOCKS, world.engine->GetBlocks().front());
    for (std::size_t i = 0; i < many.size(); ++i)
    {
        many[i].id = std::to_string(i); // of an earlier map
    }
    REQUIRE(world.store.Append({{BlockRemoved{EBlockKind::Node, "L03"}}}).has_value());
    for (const Block& block : many)
    {
        REQUIRE(world.store.Append({{BlockAdded{block}}}).has_value());
    }
    RestartEngine(world);
    CHECK(world.engine->GetBlocks() == many);
    CHECK(AskToBlock(world, EBlockKind::Node, "L03").starts_with("no: There are 1000 blocks already."));
    CHECK(AskToUnblock(world, EBlockKind::Node, "17") == "yes: The node 17 is open.");
    CHECK(AskToBlock(world, EBlockKind::Node, "L03").starts_with("yes"));
}

TEST_CASE("Block: a plan to a blocked station waits with the reason, also after a restart, until it is open")
{
    PlanWorld world;
    world.Connect();
    AskToBlock(world, EBlockKind::Station, "A02.CP03", "cleaning"); // of the second step
    world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1").empty());
    CHECK(GetWaitReason(world).message == "The station A02.CP03 is blocked: cleaning.");
    CHECK(
        GetWaitReason(world).robots
        == std::vector<RobotUnavailability>{{"LR01", "station A02.CP03 is blocked: cleaning"}});
    RestartEngine(world);
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1").empty());
    AskToUnblock(world, EBlockKind::Station, "A02.CP03");
    FinishPlan(world);
}

TEST_CASE("Block: a plan waits while a node or an edge of its only route is blocked, and names it")
{
    PlanWorld world;
    world.Connect();
    const EBlockKind kind = GENERATE(EBlockKind::Node, EBlockKind::Edge);
    const std::string id = kind == EBlockKind::Node ? "L02" : "L01>L02";
    AskToBlock(world, kind, id);
    world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1").empty());
    CHECK(GetWaitReason(world).robots.front().reason == std::string(GetText(kind)) + " " + id + " is blocked");
    AskToUnblock(world, kind, id);
    FinishPlan(world);
}

TEST_CASE("Block: a station that is blocked during a plan stops the robot at its former station")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Job 1 P1-a4 InProgress");
    AskToBlock(world, EBlockKind::Station, "A02.CP03", "cleaning");
    REQUIRE(TryRunUntil(world, "P1", "Step 2 Dispatched"));
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1").back() == "Error ACS-1015 set");
    CHECK(GetWaitReason(world).message == "LR01 waits: station A02.CP03 is blocked: cleaning.");
    CHECK(world.engine->GetRobotStatuses().front().message == GetWaitReason(world).message);
    CHECK(GetNode(world, "LR01") == "D-A01.CP01");
    AskToUnblock(world, EBlockKind::Station, "A02.CP03");
    FinishPlan(world);
}

TEST_CASE(
    "Block: a robot stops before a blocked node of its route, waits with the reason, and continues when it is open")
{
    EngineOptions options = MakeTestOptions(false);
    options.baseLength = 1;
    PlanWorld world(1, options, MakeTestSite());
    BeginPlan(world, MakeLoadPlan("A01.CP06"), "Step 1 InProgress");
    AskToBlock(world, EBlockKind::Node, "L05", "oil");
    REQUIRE(world.TryRun());
    CHECK(GetNode(world, "LR01") == "D-CHG01"); // its parking position: it does not wait on the lane
    CHECK(GetWaitReason(world).message == "LR01 waits: node L05 is blocked: oil.");
    AskToUnblock(world, EBlockKind::Node, "L05");
    FinishPlan(world);
    CHECK(world.violations == Lines{});
}

TEST_CASE("Block: a robot whose plan has ended waits for no block")
{
    EngineOptions options = MakeTestOptions(false);
    options.baseLength = 1;
    PlanWorld world(1, options, MakeTestSite());
    BeginPlan(world, MakeLoadPlan("A01.CP06"), "Step 1 InProgress");
    AskToBlock(world, EBlockKind::Node, "L05", "oil");
    REQUIRE(world.TryRun());
    CHECK(world.engine->GetRobotStatuses()[0].message == "LR01 waits: node L05 is blocked: oil.");
    world.Control(EPlanControl::Abort, "P1");
    REQUIRE(world.TryRun());
    CHECK(world.engine->GetRobotStatuses()[0].message.empty());
}

TEST_CASE("Block: a robot is rerouted around a blocked edge of its route")
{
    EngineOptions options = MakeTestOptions(false);
    options.baseLength = 1;
    PlanWorld world(1, options, MakeRestrictedSite({true, true}));
    BeginPlan(world, MakeLoadPlan("A01.CP06"), "Step 1 InProgress");
    AskToBlock(world, EBlockKind::Edge, "L05>L06", "oil");
    REQUIRE(TryRunToNode(world, "LR01", "AROUND"));
    FinishPlan(world);
    CHECK(world.violations == Lines{});
}

TEST_CASE("Block: a robot whose parking position is blocked leaves it, parks elsewhere, and makes way for others there")
{
    PlanWorld world;
    world.Connect();
    const EBlockKind kind = GENERATE(EBlockKind::Node, EBlockKind::Station);
    AskToBlock(world, kind, kind == EBlockKind::Node ? "D-CHG01" : "CHG01");
    REQUIRE(world.TryRun());
    CHECK(GetNode(world, "LR01") == "D-A01.CP01");
    world.Submit(MakeControlPlan("P1")); // CR01 works at A01.CP01
    FinishPlan(world);
    world.Submit(MakeLogisticsPlan("P2"));
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P2").back() == "Plan Completed");
    CHECK(GetNode(world, "LR01") != "D-CHG01");
    AskToUnblock(world, kind, kind == EBlockKind::Node ? "D-CHG01" : "CHG01");
    REQUIRE(world.TryRun());
    CHECK(GetNode(world, "LR01") == "D-CHG01");
    CHECK(world.violations == Lines{});
}

TEST_CASE("Block: granted nodes are driven, and a robot on a blocked node leaves it")
{
    PlanWorld world;
    BeginPlan(world, MakeLoadPlan("A01.CP06"), "Step 1 InProgress");
    REQUIRE(TryRunToNode(world, "LR01", "L02"));
    AskToBlock(world, EBlockKind::Node, "L02");
    AskToBlock(world, EBlockKind::Node, "L03");
    FinishPlan(world);
}
