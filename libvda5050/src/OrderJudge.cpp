#include "OrderCapability.hpp"
#include "OrderErrors.hpp"
#include "OrderFindings.hpp"
#include "OrderGeometry.hpp"
#include <acs/vda5050/OrderValidator.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string_view>
#include <unordered_set>
#include <utility>

namespace ACS::VDA5050
{

namespace
{

constexpr double FULL_TURN = 2.0 * std::numbers::pi;

OrderJudgement Reject(std::vector<OrderViolation> violations)
{
    return OrderJudgement{EOrderVerdict::Reject, std::move(violations), false};
}

OrderJudgement Reject(const OrderMessage& order, std::string_view errorType, const std::string& rule)
{
    return Reject({MakeOrderViolation(order, errorType, rule)});
}

/// 6.6.4: on the first node, or inside its range. If both positions are known, they decide: after a cancel
/// between two nodes the vehicle is not on its lastNodeId.
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
    const NodePosition& target = *node.nodePosition;
    if (std::hypot(target.x - context.position->x, target.y - context.position->y)
        > GetAllowedDeviation(target, context))
    {
        return false;
    }
    // On the node itself the vehicle may still turn.
    const bool bOnNode = node.nodeID == context.lastNodeID && !context.bCleared;
    if (bOnNode || !target.theta.has_value() || !target.allowedDeviationTheta.has_value())
    {
        return true;
    }
    return std::abs(std::remainder(*target.theta - context.position->theta, FULL_TURN))
        <= *target.allowedDeviationTheta;
}

OrderJudgement RejectUnreachable(const OrderMessage& order)
{
    const std::string& nodeID = order.nodes.front().nodeID;
    OrderJudgement judgement =
        Reject(order, ErrorTypes::NO_ROUTE_ERROR, "the vehicle is not at the first node, " + nodeID);
    AddReference(judgement.violations.front().error, ReferenceKeys::NODE_ID, nodeID);
    return judgement;
}

/// An id of an order is the key of its state: none that the report still needs may come again.
std::vector<OrderViolation> FindRepeatedActions(const OrderMessage& order, const OrderContext& context, bool bUpdate)
{
    const std::vector<std::string>& reported = bUpdate ? context.actionIDs : context.instantActionIDs;
    const std::unordered_set<std::string_view> known(reported.begin(), reported.end());
    OrderFindings repeated(order, ErrorTypes::VALIDATION_ERROR);
    const auto check = [&known, &repeated](const std::vector<Action>& actions) {
        for (const Action& action : actions)
        {
            if (known.contains(action.actionID))
            {
                repeated.Add("the actionId is in use already", ReferenceKeys::ACTION_ID, action.actionID);
            }
        }
    };
    // The stitching node of an update comes with the actions that it had.
    for (std::size_t index = bUpdate ? 1 : 0; index < order.nodes.size(); ++index)
    {
        check(order.nodes[index].actions);
    }
    for (const OrderEdge& edge : order.edges)
    {
        check(edge.actions);
    }
    return repeated.Take();
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
    if (order.nodes.front().sequenceID != 0)
    {
        return Reject(order, ErrorTypes::VALIDATION_ERROR, "a new order begins with the sequenceId 0");
    }
    if (!IsAtFirstNode(order.nodes.front(), context))
    {
        return RejectUnreachable(order);
    }
    return OrderJudgement{EOrderVerdict::NewOrder, {}, false};
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
    // After a cancel the vehicle may have left lastNodeId.
    if (!context.bExecuting && context.bCleared && !IsAtFirstNode(first, context))
    {
        return RejectUnreachable(order);
    }
    return OrderJudgement{EOrderVerdict::Update, {}, false};
}

} // namespace

OrderJudgement JudgeOrder(const OrderMessage& order, const OrderContext& context)
{
    std::vector<OrderViolation> violations = ValidateOrder(order);
    if (!violations.empty())
    {
        return Reject(std::move(violations));
    }
    const bool bHeld = !context.heldOrderID.empty() && order.orderID == context.heldOrderID;
    // A resent message is no error, whatever has changed since.
    if (bHeld && order.orderUpdateID == context.heldOrderUpdateID)
    {
        return OrderJudgement{EOrderVerdict::Discard, {}, false};
    }
    if (!IsLedByMaster(context.operatingMode))
    {
        OrderJudgement judgement = Reject(order, ErrorTypes::ORDER_ERROR, "the operating mode takes no orders");
        judgement.bUntilMode = true;
        return judgement;
    }
    violations = FindUnusable(order, context);
    if (violations.empty())
    {
        violations = FindLooseEnds(order, context);
    }
    if (!violations.empty())
    {
        return Reject(std::move(violations));
    }
    OrderJudgement judgement = bHeld ? JudgeUpdate(order, context) : JudgeNewOrder(order, context);
    if (judgement.verdict != EOrderVerdict::Reject)
    {
        violations = FindRepeatedActions(order, context, bHeld);
        if (violations.empty() && context.orderCheck)
        {
            violations = context.orderCheck(order, context);
        }
    }
    return violations.empty() ? judgement : Reject(std::move(violations));
}

} // namespace ACS::VDA5050
