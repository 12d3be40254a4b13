#include "fixtures/PlanWorldSteps.hpp"

#include <optional>
#include <string>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
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
