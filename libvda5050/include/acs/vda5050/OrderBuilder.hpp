#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/Result.hpp>
#include <acs/vda5050/OrderMessage.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace ACS::VDA5050
{

/// Creates an order and its updates from a route: sets sequence ids, released flags and the start and end nodes of edges; an
/// update begins at the decision point (the last released node). The caller sets ids, positions, actions and limits.
class ACS_API OrderBuilder
{
public:
    /// As horizonNodes: the rest of the route.
    static constexpr std::size_t WHOLE_ROUTE = std::numeric_limits<std::size_t>::max();

private:
    std::string _orderID;
    std::uint32_t _orderUpdateID = 0;
    std::vector<OrderNode> _nodes;
    std::vector<OrderEdge> _edges;
    std::size_t _releasedNodes = 0;
    std::vector<std::size_t> _releasedBefore; ///< Before each of the last updates.

    OrderBuilder(std::string orderID, std::vector<OrderNode> nodes, std::vector<OrderEdge> edges);

public:
    /// Requires at least one node, and one edge less than nodes: edge n leads from node n to node n + 1. Fails with
    /// InvalidOrder.
    [[nodiscard]] static Core::Result<OrderBuilder> Create(
        std::string orderID,
        std::vector<OrderNode> nodes,
        std::vector<OrderEdge> edges);

    /// The first message: the first releasedNodes nodes (1 to all) are the base, at most horizonNodes more the horizon.
    /// Fails with InvalidOrder if it was created already.
    [[nodiscard]] Core::Result<OrderMessage> MakeOrder(
        std::size_t releasedNodes,
        std::size_t horizonNodes = WHOLE_ROUTE);

    /// The next update: releases the first releasedNodes nodes of the route, at least as many as before. Increments
    /// orderUpdateID.
    [[nodiscard]] Core::Result<OrderMessage> MakeUpdate(
        std::size_t releasedNodes,
        std::size_t horizonNodes = WHOLE_ROUTE);

    /// The vehicle has rejected the last update: the next one begins where that one did. Once for each update that was rejected, at
    /// most 2: a MasterSession has one update in flight and one that waits, and reports both as rejected.
    void WithdrawUpdate() noexcept;

    /// Extends the route by the same number of edges and nodes, which are not released yet; the first edge starts at the last
    /// node.
    [[nodiscard]] Core::Result<void> Append(std::vector<OrderNode> nodes, std::vector<OrderEdge> edges);

    /// As it was passed to Create.
    [[nodiscard]] const std::string& GetOrderID() const noexcept;
    /// All nodes of the route, with their sequence ids.
    [[nodiscard]] const std::vector<OrderNode>& GetNodes() const noexcept;
    /// Number of nodes that the messages so far have released, from the first one; 0 before MakeOrder.
    [[nodiscard]] std::size_t GetReleasedNodes() const noexcept;
    /// Whether no further update is needed.
    [[nodiscard]] bool IsWholeRouteReleased() const noexcept;

private:
    [[nodiscard]] OrderMessage Cut(std::size_t firstNode, std::size_t horizonNodes) const;
};

} // namespace ACS::VDA5050
