#include "OrderErrors.hpp"
#include <acs/vda5050/OrderValidator.hpp>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

namespace ACS::VDA5050
{

namespace
{

OrderJudgement Reject(std::vector<OrderViolation> violations)
{
    return OrderJudgement{EOrderVerdict::Reject, std::move(violations)};
}

OrderJudgement Reject(const OrderMessage& order, std::string_view errorType, const std::string& rule)
{
    return Reject({OrderViolation{rule, MakeOrderError(order, errorType, rule)}});
}

void CheckActions(
    const std::vector<Action>& actions,
    EActionScope scope,
    const OrderMessage& order,
    const OrderContext& context,
    std::vector<OrderViolation>& out)
{
    for (const Action& action : actions)
    {
        if (!CanPerform(*context.factsheet, action.actionType, scope))
        {
            const std::string rule = "the vehicle cannot perform " + action.actionType + " here";
            OrderViolation& violation =
                out.emplace_back(OrderViolation{rule, MakeOrderError(order, ErrorTypes::ORDER_ERROR, rule)});
            AddReference(violation.error, ReferenceKeys::ACTION_ID, action.actionID);
        }
    }
}

/// Actions that the vehicle cannot perform, and maps that it does not have.
std::vector<OrderViolation> FindImpossible(const OrderMessage& order, const OrderContext& context)
{
    std::vector<OrderViolation> violations;
    const bool bActionsKnown = context.factsheet != nullptr && !context.factsheet->protocolFeatures.agvActions.empty();
    for (const OrderNode& node : order.nodes)
    {
        if (bActionsKnown)
        {
            CheckActions(node.actions, EActionScope::Node, order, context, violations);
        }
        const bool bMapKnown = context.mapIDs.empty() || !node.nodePosition.has_value()
            || std::ranges::find(context.mapIDs, node.nodePosition->mapID) != context.mapIDs.end();
        if (!bMapKnown)
        {
            const std::string rule = "the vehicle does not have the map " + node.nodePosition->mapID;
            OrderViolation& violation =
                violations.emplace_back(OrderViolation{rule, MakeOrderError(order, ErrorTypes::ORDER_ERROR, rule)});
            AddReference(violation.error, ReferenceKeys::MAP_ID, node.nodePosition->mapID);
        }
    }
    if (bActionsKnown)
    {
        for (const OrderEdge& edge : order.edges)
        {
            CheckActions(edge.actions, EActionScope::Edge, order, context, violations);
        }
    }
    return violations;
}

/// 6.6.4: on the first node, or inside its range. Where both positions are known they decide: a vehicle that was
/// cancelled between two nodes has a lastNodeId and does not stand on it.
bool IsAtFirstNode(const OrderNode& node, const OrderContext& context)
{
    if (!node.nodePosition.has_value() || !context.position.has_value())
    {
        return node.nodeID == context.lastNodeID;
    }
    if (node.nodePosition->mapID != context.position->mapID)
    {
        return false;
    }
    const double stated = node.nodePosition->allowedDeviationXY.value_or(0.0);
    const double allowed = stated > 0.0 ? stated : context.defaultDeviationXY;
    const double distance =
        std::hypot(node.nodePosition->x - context.position->x, node.nodePosition->y - context.position->y);
    return distance <= allowed;
}

OrderJudgement JudgeNewOrder(const OrderMessage& order, const OrderContext& context)
{
    if (context.bExecuting)
    {
        return Reject(
            order,
            ErrorTypes::ORDER_UPDATE_ERROR,
            "the order " + context.heldOrderID + " is not finished, another cannot begin");
    }
    if (context.position.has_value() && !context.position->bPositionInitialized)
    {
        return Reject(order, ErrorTypes::NO_ROUTE_ERROR, "the vehicle does not know where it is");
    }
    const OrderNode& first = order.nodes.front();
    if (!IsAtFirstNode(first, context))
    {
        OrderJudgement judgement =
            Reject(order, ErrorTypes::NO_ROUTE_ERROR, "the vehicle is not at the first node, " + first.nodeID);
        AddReference(judgement.violations.front().error, ReferenceKeys::NODE_ID, first.nodeID);
        return judgement;
    }
    return OrderJudgement{EOrderVerdict::NewOrder, {}};
}

OrderJudgement JudgeUpdate(const OrderMessage& order, const OrderContext& context)
{
    if (order.orderUpdateID < context.heldOrderUpdateID)
    {
        return Reject(
            order,
            ErrorTypes::ORDER_UPDATE_ERROR,
            "orderUpdateId is lower than " + std::to_string(context.heldOrderUpdateID));
    }
    if (context.bCancelling)
    {
        return Reject(order, ErrorTypes::ORDER_UPDATE_ERROR, "the order is being cancelled");
    }
    const OrderNode& first = order.nodes.front();
    if (first.nodeID != context.decisionNodeID || first.sequenceID != context.decisionSequenceID)
    {
        return Reject(
            order,
            ErrorTypes::ORDER_UPDATE_ERROR,
            "an update begins at the node " + context.decisionNodeID + ", sequenceId "
                + std::to_string(context.decisionSequenceID));
    }
    return OrderJudgement{EOrderVerdict::Update, {}};
}

} // namespace

OrderJudgement JudgeOrder(const OrderMessage& order, const OrderContext& context)
{
    const bool bHeld = !context.heldOrderID.empty() && order.orderID == context.heldOrderID;
    // Before everything else: a resent message is no error, whatever has changed since.
    if (bHeld && order.orderUpdateID == context.heldOrderUpdateID)
    {
        return OrderJudgement{EOrderVerdict::Discard, {}};
    }
    std::vector<OrderViolation> violations = ValidateOrder(order);
    if (!violations.empty())
    {
        return Reject(std::move(violations));
    }
    if (context.operatingMode != EOperatingMode::Automatic && context.operatingMode != EOperatingMode::SemiAutomatic)
    {
        return Reject(order, ErrorTypes::ORDER_ERROR, "the operating mode takes no orders");
    }
    violations = FindImpossible(order, context);
    if (!violations.empty())
    {
        return Reject(std::move(violations));
    }
    return bHeld ? JudgeUpdate(order, context) : JudgeNewOrder(order, context);
}

} // namespace ACS::VDA5050
