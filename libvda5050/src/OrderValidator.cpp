#include "AngleBound.hpp"
#include "OrderErrors.hpp"
#include "OrderFindings.hpp"
#include "OrderGeometry.hpp"
#include <acs/vda5050/OrderValidator.hpp>
#include <acs/vda5050/Topic.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

namespace ACS::VDA5050
{

namespace
{

constexpr std::uint32_t SEQUENCE_STEP = 2;
constexpr double NO_BOUND = std::numeric_limits<double>::max();

void CheckSequence(const OrderMessage& order, OrderFindings& findings)
{
    std::uint32_t expected = order.nodes.front().sequenceID;
    if (expected % SEQUENCE_STEP != 0)
    {
        findings.Add("the sequenceId of a node must be even", ReferenceKeys::NODE_ID, order.nodes.front().nodeID);
    }
    for (std::size_t index = 0; index < order.nodes.size(); ++index)
    {
        const OrderNode& node = order.nodes[index];
        if (node.sequenceID != expected)
        {
            findings.Add("sequenceIds must follow each other without a gap", ReferenceKeys::NODE_ID, node.nodeID);
        }
        if (index < order.edges.size() && order.edges[index].sequenceID != expected + 1)
        {
            findings.Add(
                "sequenceIds must follow each other without a gap",
                ReferenceKeys::EDGE_ID,
                order.edges[index].edgeID);
        }
        expected += SEQUENCE_STEP;
    }
}

void CheckBase(const OrderMessage& order, OrderFindings& findings)
{
    if (!order.nodes.front().bReleased)
    {
        findings.Add("the first node must be released", ReferenceKeys::NODE_ID, order.nodes.front().nodeID);
    }
    for (std::size_t index = 0; index < order.edges.size(); ++index)
    {
        const OrderEdge& edge = order.edges[index];
        const bool bJoined = order.nodes[index].bReleased && order.nodes[index + 1].bReleased;
        if (edge.bReleased && !bJoined)
        {
            findings.Add("the nodes of a released edge must be released", ReferenceKeys::EDGE_ID, edge.edgeID);
        }
        if (!edge.bReleased && order.nodes[index + 1].bReleased)
        {
            findings.Add("nothing after the begin of the horizon may be released", ReferenceKeys::EDGE_ID, edge.edgeID);
        }
    }
}

/// NaN is out of every range.
bool IsWithin(const std::optional<double>& valueOrNull, double minimum, double maximum)
{
    return !valueOrNull.has_value() || (*valueOrNull >= minimum && *valueOrNull <= maximum);
}

bool HasBadNumbers(const NodePosition& position)
{
    return !std::isfinite(position.x) || !std::isfinite(position.y) || !IsWithin(position.theta, -PI_BOUND, PI_BOUND)
        || !IsWithin(position.allowedDeviationXY, 0.0, NO_BOUND)
        || !IsWithin(position.allowedDeviationTheta, 0.0, PI_BOUND);
}

bool HasBadNumbers(const OrderEdge& edge)
{
    const bool bCorridor = !edge.corridor.has_value()
        || (IsWithin(edge.corridor->leftWidth, 0.0, NO_BOUND) && IsWithin(edge.corridor->rightWidth, 0.0, NO_BOUND));
    return !bCorridor || !IsWithin(edge.orientation, -PI_BOUND, PI_BOUND) || !IsWithin(edge.maxSpeed, 0.0, NO_BOUND)
        || !IsWithin(edge.maxRotationSpeed, 0.0, NO_BOUND) || !IsWithin(edge.length, 0.0, NO_BOUND)
        || !IsWithin(edge.maxHeight, -NO_BOUND, NO_BOUND) || !IsWithin(edge.minHeight, -NO_BOUND, NO_BOUND);
}

void CheckNodes(const OrderMessage& order, OrderFindings& findings)
{
    for (const OrderNode& node : order.nodes)
    {
        if (node.nodeID.empty())
        {
            findings.Add("a node must have a nodeId");
        }
        if (node.nodePosition.has_value() && HasBadNumbers(*node.nodePosition))
        {
            findings.Add("the position of a node must be inside its ranges", ReferenceKeys::NODE_ID, node.nodeID);
        }
    }
}

void CheckEdges(const OrderMessage& order, OrderFindings& findings)
{
    for (std::size_t index = 0; index < order.edges.size(); ++index)
    {
        const OrderEdge& edge = order.edges[index];
        if (edge.startNodeID != order.nodes[index].nodeID || edge.endNodeID != order.nodes[index + 1].nodeID)
        {
            findings.Add(
                "an edge must have the nodeIds of the nodes before and after it",
                ReferenceKeys::EDGE_ID,
                edge.edgeID);
        }
        if (edge.edgeID.empty())
        {
            findings.Add("an edge must have an edgeId");
        }
        if (HasBadNumbers(edge))
        {
            findings.Add("the numbers of an edge must be inside their ranges", ReferenceKeys::EDGE_ID, edge.edgeID);
        }
        const std::string_view fault =
            edge.trajectory.has_value() ? FindTrajectoryFault(*edge.trajectory) : std::string_view();
        if (!fault.empty())
        {
            findings.Add(std::string(fault), ReferenceKeys::EDGE_ID, edge.edgeID);
        }
    }
}

void CheckActions(const OrderMessage& order, OrderFindings& findings)
{
    std::vector<std::string_view> ids;
    const auto check = [&ids, &findings](const std::vector<Action>& actions) {
        for (const Action& action : actions)
        {
            ids.push_back(action.actionID);
            const bool bNull = std::ranges::any_of(action.actionParameters, [](const ActionParameter& parameter) {
                return parameter.value.GetText() == "null";
            });
            if (action.actionID.empty() || bNull)
            {
                findings.Add(
                    "an action must have an actionId and no parameter that is null",
                    ReferenceKeys::ACTION_ID,
                    action.actionID);
            }
        }
    };
    for (const OrderNode& node : order.nodes)
    {
        check(node.actions);
    }
    for (const OrderEdge& edge : order.edges)
    {
        check(edge.actions);
    }
    std::ranges::sort(ids);
    const auto repeated = std::ranges::adjacent_find(ids);
    if (repeated != ids.end())
    {
        findings.Add("actionIds must be unique", ReferenceKeys::ACTION_ID, std::string(*repeated));
    }
}

/// Names that all states repeat until the order ends.
void CheckNames(const OrderMessage& order, OrderFindings& findings)
{
    const auto check = [&findings](std::string_view name) {
        if (name.size() > LONGEST_FOREIGN_TEXT)
        {
            findings.Add(
                "a name must have at most " + std::to_string(LONGEST_FOREIGN_TEXT) + " bytes: " + std::string(name));
        }
    };
    const auto checkActions = [&check](const std::vector<Action>& actions) {
        for (const Action& action : actions)
        {
            check(action.actionID);
            check(action.actionType);
        }
    };
    check(order.orderID);
    check(order.zoneSetID);
    for (const OrderNode& node : order.nodes)
    {
        check(node.nodeID);
        check(node.nodePosition.has_value() ? node.nodePosition->mapID : std::string_view());
        checkActions(node.actions);
    }
    for (const OrderEdge& edge : order.edges)
    {
        check(edge.edgeID);
        checkActions(edge.actions);
    }
}

} // namespace

OrderViolation MakeOrderViolation(const OrderMessage& order, std::string_view errorType, std::string rule)
{
    rule.resize(CutForeignText(rule).size());
    VehicleError error;
    error.errorType = errorType;
    error.errorDescription = rule;
    AddReference(error, ReferenceKeys::TOPIC, GetTopicName(ETopic::Order));
    AddReference(error, ReferenceKeys::HEADER_ID, std::to_string(order.header.headerID));
    AddReference(error, ReferenceKeys::ORDER_ID, order.orderID);
    AddReference(error, ReferenceKeys::ORDER_UPDATE_ID, std::to_string(order.orderUpdateID));
    return OrderViolation{std::move(rule), std::move(error)};
}

std::vector<OrderViolation> ValidateOrder(const OrderMessage& order)
{
    OrderFindings findings(order, ErrorTypes::VALIDATION_ERROR);
    if (order.orderID.empty())
    {
        findings.Add("an order must have an orderId");
    }
    if (order.nodes.empty() || order.edges.size() + 1 != order.nodes.size())
    {
        findings.Add("an order must have at least one node, and one edge less than nodes");
        return findings.Take();
    }
    CheckSequence(order, findings);
    CheckBase(order, findings);
    CheckNodes(order, findings);
    CheckEdges(order, findings);
    CheckActions(order, findings);
    CheckNames(order, findings);
    return findings.Take();
}

} // namespace ACS::VDA5050
