#include "Catch.hpp"
#include "Vda5050Sample.hpp"
#include <acs/vda5050/OrderValidator.hpp>

namespace ACS::VDA5050::Test
{

TEST_CASE("4.1 A built order is valid: sequence ids, base and horizon, neighbours")
{
    OrderBuilder builder = MakeBuilder(5);
    const auto order = builder.MakeOrder(2, 2);
    REQUIRE(order.has_value());
    CHECK(ValidateOrder(*order).empty());
    CHECK(order->nodes.size() == 4);
    CHECK(order->edges.size() == 3);
    CHECK(order->nodes[3].sequenceID == 6);
    CHECK(order->edges[0].bReleased);
    CHECK_FALSE(order->edges[1].bReleased);
    CHECK(order->edges[1].startNodeID == "N1");
    CHECK(order->edges[1].endNodeID == "N2");
}

TEST_CASE("4.3 A built update begins at the decision point and releases more")
{
    OrderBuilder builder = MakeBuilder(5);
    REQUIRE(builder.MakeOrder(2).has_value());
    const auto update = builder.MakeUpdate(4);
    REQUIRE(update.has_value());
    CHECK(ValidateOrder(*update).empty());
    CHECK(update->orderUpdateID == 1);
    CHECK(update->nodes.front().nodeID == "N1");
    CHECK(update->nodes.front().sequenceID == 2);
    CHECK(update->nodes.size() == 4);
    CHECK(update->nodes[2].bReleased);
    CHECK_FALSE(update->nodes[3].bReleased);
    CHECK_FALSE(builder.IsWholeRouteReleased());
    CHECK(builder.MakeUpdate(5)->nodes.size() == 2);
    CHECK(builder.IsWholeRouteReleased());
}

TEST_CASE("4.3 After a rejected update the next one begins at the same decision point, with a new number")
{
    OrderBuilder builder = MakeBuilder(5);
    REQUIRE(builder.MakeOrder(2).has_value());
    REQUIRE(builder.MakeUpdate(4).has_value());
    builder.WithdrawUpdate();
    const auto update = builder.MakeUpdate(3);
    REQUIRE(update.has_value());
    CHECK(ValidateOrder(*update).empty());
    CHECK(update->orderUpdateID == 2);
    CHECK(update->nodes.front().nodeID == "N1");
}

TEST_CASE("4.3 Two updates that were rejected are withdrawn one after the other")
{
    OrderBuilder builder = MakeBuilder(5);
    REQUIRE(builder.MakeOrder(2).has_value());
    REQUIRE(builder.MakeUpdate(3).has_value());
    REQUIRE(builder.MakeUpdate(4).has_value());
    builder.WithdrawUpdate();
    builder.WithdrawUpdate();
    CHECK_FALSE(builder.MakeOrder(2).has_value());
    const auto update = builder.MakeUpdate(3);
    REQUIRE(update.has_value());
    CHECK(update->orderUpdateID == 3);
    CHECK(update->nodes.front().nodeID == "N1");
}

TEST_CASE("4.3 A base is never taken back, and there is one first message")
{
    OrderBuilder builder = MakeBuilder(3);
    CHECK_FALSE(builder.MakeUpdate(1).has_value());
    CHECK_FALSE(builder.MakeOrder(0).has_value());
    CHECK_FALSE(builder.MakeOrder(4).has_value());
    REQUIRE(builder.MakeOrder(3).has_value());
    CHECK_FALSE(builder.MakeOrder(3).has_value());
    CHECK_FALSE(builder.MakeUpdate(2).has_value());
    CHECK_FALSE(OrderBuilder::Create("o", MakeNodes(2), MakeEdges(2)).has_value());
    CHECK_FALSE(OrderBuilder::Create("", MakeNodes(1), {}).has_value());
}

TEST_CASE("4.3 A route grows at its end")
{
    OrderBuilder builder = MakeBuilder(2);
    REQUIRE(builder.MakeOrder(2).has_value());
    CHECK_FALSE(builder.Append(MakeNodes(1), {}).has_value());
    REQUIRE(builder.Append(MakeNodes(1), MakeEdges(1)).has_value());
    const auto update = builder.MakeUpdate(3);
    REQUIRE(update.has_value());
    CHECK(ValidateOrder(*update).empty());
    CHECK(update->nodes[1].sequenceID == 4);
}

} // namespace ACS::VDA5050::Test
