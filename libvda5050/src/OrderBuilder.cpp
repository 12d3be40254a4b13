#include <acs/vda5050/EVda5050Error.hpp>
#include <acs/vda5050/OrderBuilder.hpp>

#include <algorithm>
#include <cassert>
#include <iterator>
#include <utility>

namespace ACS::VDA5050
{

namespace
{

constexpr std::uint32_t SEQUENCE_INCREMENT = 2; // nodes even, edges odd
constexpr std::size_t MOST_WITHDRAWN = 2;       // updates, one after the other

void NumberElements(std::vector<OrderNode>& nodes, std::vector<OrderEdge>& edges)
{
    std::uint32_t sequenceID = 0;
    for (std::size_t index = 0; index < nodes.size(); ++index)
    {
        nodes[index].sequenceID = sequenceID;
        if (index < edges.size())
        {
            edges[index].sequenceID = sequenceID + 1;
            edges[index].startNodeID = nodes[index].nodeID;
            edges[index].endNodeID = nodes[index + 1].nodeID;
        }
        sequenceID += SEQUENCE_INCREMENT;
    }
}

} // namespace

OrderBuilder::OrderBuilder(std::string orderID, std::vector<OrderNode> nodes, std::vector<OrderEdge> edges)
    : _orderID(std::move(orderID)),
      _nodes(std::move(nodes)),
      _edges(std::move(edges))
{
    NumberElements(_nodes, _edges);
}

Core::Result<OrderBuilder> OrderBuilder::Create(
    std::string orderID,
    std::vector<OrderNode> nodes,
    std::vector<OrderEdge> edges)
{
    if (orderID.empty())
    {
        return Core::Fail(EVda5050Error::InvalidOrder, "orderId", "an id", "nothing");
    }
    if (nodes.empty() || edges.size() + 1 != nodes.size())
    {
        return Core::Fail(
            EVda5050Error::InvalidOrder,
            "edges",
            "at least one node, and one edge less than nodes",
            std::to_string(nodes.size()) + " nodes, " + std::to_string(edges.size()) + " edges");
    }
    return OrderBuilder(std::move(orderID), std::move(nodes), std::move(edges));
}

OrderMessage OrderBuilder::Cut(std::size_t firstNode, std::size_t horizonNodes) const
{
    OrderMessage order;
    order.orderID = _orderID;
    order.orderUpdateID = _orderUpdateID;
    const std::size_t horizon = std::min(horizonNodes, _nodes.size() - _releasedNodes);
    const std::size_t end = _releasedNodes + horizon;
    for (std::size_t index = firstNode; index < end; ++index)
    {
        OrderNode& node = order.nodes.emplace_back(_nodes[index]);
        node.bReleased = index < _releasedNodes;
        if (index + 1 < end)
        {
            OrderEdge& edge = order.edges.emplace_back(_edges[index]);
            edge.bReleased = index + 1 < _releasedNodes;
        }
    }
    return order;
}

Core::Result<OrderMessage> OrderBuilder::MakeOrder(std::size_t releasedNodes, std::size_t horizonNodes)
{
    if (_releasedNodes != 0 || releasedNodes == 0 || releasedNodes > _nodes.size())
    {
        return Core::Fail(
            EVda5050Error::InvalidOrder,
            {},
            "one first message, with 1 to " + std::to_string(_nodes.size()) + " released nodes",
            std::to_string(releasedNodes));
    }
    _releasedNodes = releasedNodes;
    return Cut(0, horizonNodes);
}

Core::Result<OrderMessage> OrderBuilder::MakeUpdate(std::size_t releasedNodes, std::size_t horizonNodes)
{
    if (_releasedNodes == 0 || releasedNodes < _releasedNodes || releasedNodes > _nodes.size())
    {
        return Core::Fail(
            EVda5050Error::InvalidOrder,
            {},
            "after the first message, " + std::to_string(_releasedNodes) + " to " + std::to_string(_nodes.size())
                + " released nodes",
            std::to_string(releasedNodes));
    }
    const std::size_t decisionPoint = _releasedNodes - 1;
    _releasedBefore.push_back(std::exchange(_releasedNodes, releasedNodes));
    if (_releasedBefore.size() > MOST_WITHDRAWN)
    {
        _releasedBefore.erase(_releasedBefore.begin());
    }
    ++_orderUpdateID;
    return Cut(decisionPoint, horizonNodes);
}

void OrderBuilder::WithdrawUpdate() noexcept
{
    assert(!_releasedBefore.empty());
    if (!_releasedBefore.empty())
    {
        _releasedNodes = _releasedBefore.back();
        _releasedBefore.pop_back();
    }
}

Core::Result<void> OrderBuilder::Append(std::vector<OrderNode> nodes, std::vector<OrderEdge> edges)
{
    if (nodes.size() != edges.size())
    {
        return Core::Fail(
            EVda5050Error::InvalidOrder,
            "edges",
            "as many edges as nodes",
            std::to_string(nodes.size()) + " nodes, " + std::to_string(edges.size()) + " edges");
    }
    std::ranges::move(nodes, std::back_inserter(_nodes));
    std::ranges::move(edges, std::back_inserter(_edges));
    NumberElements(_nodes, _edges);
    return {};
}

const std::string& OrderBuilder::GetOrderID() const noexcept
{
    return _orderID;
}

const std::vector<OrderNode>& OrderBuilder::GetNodes() const noexcept
{
    return _nodes;
}

std::size_t OrderBuilder::GetReleasedNodes() const noexcept
{
    return _releasedNodes;
}

bool OrderBuilder::IsWholeRouteReleased() const noexcept
{
    return _releasedNodes == _nodes.size();
}

} // namespace ACS::VDA5050
