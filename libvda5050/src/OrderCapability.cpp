#include "OrderCapability.hpp"

#include "ActionFault.hpp"
#include "OrderErrors.hpp"
#include "OrderFindings.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>

namespace ACS::VDA5050
{

namespace
{

/// Optional members that change what the vehicle does; descriptions are for people and always taken.
template <typename TElement>
struct OptionalMember
{
    std::string_view path; ///< As a factsheet names it.
    bool (*isThere)(const TElement&);
};

constexpr std::array NODE_MEMBERS{
    OptionalMember<OrderNode>{
        "order.nodes.nodePosition",
        [](const OrderNode& node) {
            return node.nodePosition.has_value();
        }},
    OptionalMember<OrderNode>{
        "order.nodes.nodePosition.theta",
        [](const OrderNode& node) {
            return node.nodePosition.has_value() && node.nodePosition->theta.has_value();
        }},
    OptionalMember<OrderNode>{
        "order.nodes.nodePosition.allowedDeviationXY",
        [](const OrderNode& node) {
            return node.nodePosition.has_value() && node.nodePosition->allowedDeviationXY.has_value();
        }},
    OptionalMember<OrderNode>{
        "order.nodes.nodePosition.allowedDeviationTheta",
        [](const OrderNode& node) {
            return node.nodePosition.has_value() && node.nodePosition->allowedDeviationTheta.has_value();
        }},
};

constexpr std::array EDGE_MEMBERS{
    OptionalMember<OrderEdge>{
        "order.edges.maxSpeed",
        [](const OrderEdge& edge) {
            return edge.maxSpeed.has_value();
        }},
    OptionalMember<OrderEdge>{
        "order.edges.maxHeight",
        [](const OrderEdge& edge) {
            return edge.maxHeight.has_value();
        }},
    OptionalMember<OrderEdge>{
        "order.edges.minHeight",
        [](const OrderEdge& edge) {
            return edge.minHeight.has_value();
        }},
    OptionalMember<OrderEdge>{
        "order.edges.orientation",
        [](const OrderEdge& edge) {
            return edge.orientation.has_value();
        }},
    OptionalMember<OrderEdge>{
        "order.edges.orientationType",
        [](const OrderEdge& edge) {
            return edge.orientationType.has_value();
        }},
    OptionalMember<OrderEdge>{
        "order.edges.direction",
        [](const OrderEdge& edge) {
            return !edge.direction.empty();
        }},
    OptionalMember<OrderEdge>{
        "order.edges.rotationAllowed",
        [](const OrderEdge& edge) {
            return edge.bRotationAllowed.has_value();
        }},
    OptionalMember<OrderEdge>{
        "order.edges.maxRotationSpeed",
        [](const OrderEdge& edge) {
            return edge.maxRotationSpeed.has_value();
        }},
    OptionalMember<OrderEdge>{
        "order.edges.length",
        [](const OrderEdge& edge) {
            return edge.length.has_value();
        }},
    OptionalMember<OrderEdge>{
        "order.edges.trajectory",
        [](const OrderEdge& edge) {
            return edge.trajectory.has_value();
        }},
    OptionalMember<OrderEdge>{
        "order.edges.corridor",
        [](const OrderEdge& edge) {
            return edge.corridor.has_value();
        }},
};

constexpr std::array ORDER_MEMBERS{
    OptionalMember<OrderMessage>{
        "order.zoneSetId",
        [](const OrderMessage& order) {
            return !order.zoneSetID.empty();
        }},
};

void AddElement(VehicleError& error, const OrderNode& node)
{
    AddReference(error, ReferenceKeys::NODE_ID, node.nodeID);
}

void AddElement(VehicleError& error, const OrderEdge& edge)
{
    AddReference(error, ReferenceKeys::EDGE_ID, edge.edgeID);
}

void AddElement(VehicleError& /*error*/, const OrderMessage& /*order*/)
{
}

/// Listing a member supports those that it lies in too.
std::optional<EParameterSupport> GetSupportOrNull(const FactsheetMessage& factsheet, std::string_view path)
{
    std::optional<EParameterSupport> support;
    for (const OptionalParameter& listed : factsheet.protocolFeatures.optionalParameters)
    {
        if (listed.parameter == path)
        {
            return listed.support;
        }
        const bool bInside = listed.parameter.size() > path.size() && listed.parameter.starts_with(path)
            && listed.parameter[path.size()] == '.';
        support = bInside ? EParameterSupport::Supported : support;
    }
    return support;
}

/// One violation a member: what is wrong with it is wrong on every element.
template <typename TElements, typename TMembers>
void CheckMembers(
    const TElements& elements,
    const TMembers& members,
    const FactsheetMessage& factsheet,
    OrderFindings& unusable)
{
    for (const auto& member : members)
    {
        const std::optional<EParameterSupport> support = GetSupportOrNull(factsheet, member.path);
        const bool bRequired = support == EParameterSupport::Required;
        if (support.has_value() && !bRequired)
        {
            continue;
        }
        const auto offender = std::find_if(elements.begin(), elements.end(), [&member, bRequired](const auto& element) {
            return member.isThere(element) != bRequired;
        });
        if (offender != elements.end())
        {
            const std::string path(member.path);
            VehicleError& error =
                unusable.Add(bRequired ? "the vehicle needs " + path : "the vehicle does not support " + path);
            AddReference(error, ReferenceKeys::PARAMETER, path);
            AddElement(error, *offender);
        }
    }
}

template <typename TElement>
void CheckActions(
    const TElement& element,
    EActionScope scope,
    const FactsheetMessage& factsheet,
    OrderFindings& unusable)
{
    for (const Action& action : element.actions)
    {
        const std::optional<ActionFault> fault = FindActionFaultOrNull(factsheet, action, scope);
        if (fault.has_value())
        {
            VehicleError& error = unusable.Add(fault->rule);
            AddReference(error, ReferenceKeys::ACTION_ID, action.actionID);
            AddReference(error, ReferenceKeys::PARAMETER, fault->field);
            AddElement(error, element);
        }
    }
}

/// The sizes of an order that a factsheet can limit.
struct OrderSizes
{
    std::size_t nodeActions = 0;
    std::size_t edgeActions = 0;
    std::size_t parameters = 0;
    std::size_t knots = 0;
    std::size_t controlPoints = 0;
    std::vector<std::string_view> ids;
};

void MeasureActions(const std::vector<Action>& actions, std::size_t& most, OrderSizes& sizes)
{
    most = std::max(most, actions.size());
    for (const Action& action : actions)
    {
        sizes.parameters = std::max(sizes.parameters, action.actionParameters.size());
        sizes.ids.emplace_back(action.actionID);
    }
}

OrderSizes Measure(const OrderMessage& order)
{
    OrderSizes sizes;
    sizes.ids.emplace_back(order.orderID);
    for (const OrderNode& node : order.nodes)
    {
        MeasureActions(node.actions, sizes.nodeActions, sizes);
        sizes.ids.emplace_back(node.nodeID);
    }
    for (const OrderEdge& edge : order.edges)
    {
        MeasureActions(edge.actions, sizes.edgeActions, sizes);
        sizes.ids.emplace_back(edge.edgeID);
        if (edge.trajectory.has_value())
        {
            sizes.knots = std::max(sizes.knots, edge.trajectory->knotVector.size());
            sizes.controlPoints = std::max(sizes.controlPoints, edge.trajectory->controlPoints.size());
        }
    }
    return sizes;
}

void CheckSizes(const OrderContext& context, OrderFindings& unusable)
{
    struct Limit
    {
        std::string_view name;
        std::size_t found;
        std::optional<std::uint32_t> allowed;
    };
    const OrderMessage& order = unusable.GetOrder();
    const MaximumArrayLengths& arrays = context.factsheet->protocolLimits.maxArrayLengths;
    const MaximumStringLengths& strings = context.factsheet->protocolLimits.maxStringLengths;
    const OrderSizes sizes = Measure(order);
    const auto longest = std::ranges::max_element(sizes.ids, {}, &std::string_view::size);
    const std::array limits{
        Limit{"maxStringLens.msgLen", context.payloadBytes, strings.message},
        Limit{"maxStringLens.idLen", longest->size(), strings.identifier},
        Limit{"maxArrayLens.order.nodes", order.nodes.size(), arrays.orderNodes},
        Limit{"maxArrayLens.order.edges", order.edges.size(), arrays.orderEdges},
        Limit{"maxArrayLens.node.actions", sizes.nodeActions, arrays.nodeActions},
        Limit{"maxArrayLens.edge.actions", sizes.edgeActions, arrays.edgeActions},
        Limit{"maxArrayLens.actions.actionsParameters", sizes.parameters, arrays.actionParameters},
        Limit{"maxArrayLens.trajectory.knotVector", sizes.knots, arrays.trajectoryKnotVector},
        Limit{"maxArrayLens.trajectory.controlPoints", sizes.controlPoints, arrays.trajectoryControlPoints}};
    for (const Limit& limit : limits)
    {
        const std::uint32_t allowed = limit.allowed.value_or(0);
        if (allowed != 0 && limit.found > allowed)
        {
            const std::string name(limit.name);
            VehicleError& error = unusable.Add(
                "the order is too large: " + name + " is " + std::to_string(allowed) + ", found "
                + std::to_string(limit.found));
            AddReference(error, ReferenceKeys::PARAMETER, name);
        }
    }
    const auto isNumerical = [](std::string_view text) {
        return std::ranges::all_of(text, [](char letter) { return letter >= '0' && letter <= '9'; });
    };
    if (strings.bIdentifierNumericalOnly.value_or(false) && !std::ranges::all_of(sizes.ids, isNumerical))
    {
        AddReference(
            unusable.Add("the vehicle takes numbers as ids only"),
            ReferenceKeys::PARAMETER,
            "maxStringLens.idNumericalOnly");
    }
}

void CheckMaps(const OrderContext& context, OrderFindings& unusable)
{
    if (context.mapIDs.empty() && !context.bMapsKnown)
    {
        return;
    }
    for (const OrderNode& node : unusable.GetOrder().nodes)
    {
        if (!node.nodePosition.has_value()
            || std::ranges::find(context.mapIDs, node.nodePosition->mapID) != context.mapIDs.end())
        {
            continue;
        }
        VehicleError& error = unusable.Add("the vehicle does not have the map " + node.nodePosition->mapID);
        AddReference(error, ReferenceKeys::MAP_ID, node.nodePosition->mapID);
        AddElement(error, node);
    }
}

} // namespace

std::vector<OrderViolation> FindUnusable(const OrderMessage& order, const OrderContext& context)
{
    OrderFindings unusable(order, ErrorTypes::ORDER_ERROR);
    if (context.factsheet != nullptr)
    {
        const FactsheetMessage& factsheet = *context.factsheet;
        for (const OrderNode& node : order.nodes)
        {
            CheckActions(node, EActionScope::Node, factsheet, unusable);
        }
        for (const OrderEdge& edge : order.edges)
        {
            CheckActions(edge, EActionScope::Edge, factsheet, unusable);
        }
        if (!factsheet.protocolFeatures.optionalParameters.empty())
        {
            CheckMembers(std::array{std::cref(order)}, ORDER_MEMBERS, factsheet, unusable);
            CheckMembers(order.nodes, NODE_MEMBERS, factsheet, unusable);
            CheckMembers(order.edges, EDGE_MEMBERS, factsheet, unusable);
        }
        CheckSizes(context, unusable);
    }
    CheckMaps(context, unusable);
    return unusable.Take();
}

} // namespace ACS::VDA5050
