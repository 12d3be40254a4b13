#include "vda-sim/ProfileRules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <utility>

namespace ACS::VdaSim
{
namespace
{

using VDA5050::OrderViolation;

OrderViolation MakeViolation(
    const VDA5050::OrderMessage& order,
    std::string rule,
    std::initializer_list<VDA5050::ErrorReference> references)
{
    OrderViolation violation = VDA5050::MakeOrderViolation(order, VDA5050::ErrorTypes::ORDER_ERROR, std::move(rule));
    violation.error.errorReferences.insert(violation.error.errorReferences.end(), references);
    return violation;
}

/// The first edge that is not released, and its end node, are the beginning of the horizon.
void CheckHorizon(const VDA5050::OrderMessage& order, std::vector<OrderViolation>& violations)
{
    const auto edge = std::ranges::find(order.edges, false, &VDA5050::OrderEdge::bReleased);
    if (edge != order.edges.end())
    {
        violations.push_back(MakeViolation(
            order,
            fmt::format("the vehicle accepts no horizon: the edge {} is not released", edge->edgeID),
            {{"edgeId", edge->edgeID}, {"nodeId", edge->endNodeID}}));
    }
}

/// To the further nodes of an order the vehicle drives before it handles a load there.
void CheckPlace(
    const VDA5050::OrderMessage& order,
    const VDA5050::OrderContext& context,
    const LoadHandling& handling,
    std::vector<OrderViolation>& violations)
{
    const VDA5050::OrderNode& node = order.nodes.front();
    if (order.orderID == context.heldOrderID || !node.nodePosition.has_value() || !context.position.has_value())
    {
        return;
    }
    const double distance =
        std::hypot(node.nodePosition->x - context.position->x, node.nodePosition->y - context.position->y);
    const auto action = std::ranges::find_if(node.actions, [&handling](const VDA5050::Action& candidate) {
        return candidate.actionType == handling.pickType || candidate.actionType == handling.dropType;
    });
    if (action != node.actions.end() && distance > PLACE_TOLERANCE)
    {
        violations.push_back(MakeViolation(
            order,
            fmt::format("{} at a node that is {:.2f} m from the vehicle", action->actionType, distance),
            {{"nodeId", node.nodeID}, {"actionId", action->actionID}, {"parameter", "order.nodes.nodePosition"}}));
    }
}

} // namespace

std::vector<OrderViolation> FindRejected(
    const VDA5050::OrderMessage& order,
    const VDA5050::OrderContext& context,
    const VehicleTraits& traits,
    const LoadHandling& handling)
{
    std::vector<OrderViolation> violations;
    if (traits.bRejectsHorizon)
    {
        CheckHorizon(order, violations);
    }
    if (traits.bHandlesLoadsInPlaceOnly)
    {
        CheckPlace(order, context, handling, violations);
    }
    return violations;
}

} // namespace ACS::VdaSim
