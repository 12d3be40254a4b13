#include "Vda5050Sample.hpp"

#include "Catch.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace ACS::VDA5050::Test
{

namespace
{

constexpr double NODE_DISTANCE = 10.0;

} // namespace

VehicleAddress MakeAddress()
{
    return VehicleAddress{"uagv", "ACS", "LR01"};
}

Action MakeAction(std::string actionID, EBlockingType blockingType, std::string actionType)
{
    Action action;
    action.actionType = std::move(actionType);
    action.actionID = std::move(actionID);
    action.blockingType = blockingType;
    return action;
}

std::vector<OrderNode> MakeNodes(std::size_t count)
{
    std::vector<OrderNode> nodes(count);
    for (std::size_t index = 0; index < count; ++index)
    {
        nodes[index].nodeID = "N" + std::to_string(index);
        NodePosition position;
        position.x = NODE_DISTANCE * static_cast<double>(index);
        position.mapID = "floor";
        nodes[index].nodePosition = position;
    }
    return nodes;
}

std::vector<OrderEdge> MakeEdges(std::size_t count)
{
    std::vector<OrderEdge> edges(count);
    for (std::size_t index = 0; index < count; ++index)
    {
        edges[index].edgeID = "E" + std::to_string(index);
    }
    return edges;
}

OrderBuilder MakeBuilder(std::size_t nodeCount, std::string orderID)
{
    Core::Result<OrderBuilder> builder =
        OrderBuilder::Create(std::move(orderID), MakeNodes(nodeCount), MakeEdges(nodeCount - 1));
    REQUIRE(builder.has_value());
    return std::move(*builder);
}

OrderMessage MakeOrder(std::size_t nodeCount, std::size_t releasedNodes, std::string orderID)
{
    OrderBuilder builder = MakeBuilder(nodeCount, std::move(orderID));
    Core::Result<OrderMessage> order = builder.MakeOrder(releasedNodes);
    REQUIRE(order.has_value());
    return std::move(*order);
}

OrderMessage MakeUpdate(std::size_t nodeCount, std::size_t releasedBefore, std::size_t releasedNow)
{
    OrderBuilder builder = MakeBuilder(nodeCount);
    REQUIRE(builder.MakeOrder(releasedBefore).has_value());
    return *builder.MakeUpdate(releasedNow);
}

std::vector<std::string> ListNodes(const StateMessage& state)
{
    std::vector<std::string> ids;
    std::ranges::transform(state.nodeStates, std::back_inserter(ids), &NodeState::nodeID);
    return ids;
}

} // namespace ACS::VDA5050::Test
