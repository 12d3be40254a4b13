#include "OrderCapability.hpp"

#include "ActionFault.hpp"
#include "MessageSizes.hpp"
#include "OrderErrors.hpp"
#include "OrderFindings.hpp"
#include "StateRoom.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <optional>
#include <string_view>
#include <utility>

namespace ACS::VDA5050
{

namespace
{

/// An optional member that changes what the vehicle does; descriptions are for people and always accepted.
template <typename TElement>
struct OptionalMember
{
    std::string_view path; ///< As a factsheet names it.
    bool (*isThere)(const TElement&);
    /// Removes the member for a vehicle that does not support it. Null: the member demands something of the vehicle, and a drive
    /// without it would be unsafe or another one than was ordered. The order is then unusable.
    void (*leaveOut)(TElement&) = nullptr;
    /// Sets the value that restricts nothing, for a vehicle that requires the member. Null: there is no such value.
    void (*fillIn)(TElement&, const FactsheetMessage&) = nullptr;
};

constexpr std::array NODE_MEMBERS{
    // A vehicle that follows a line finds its nodes without positions.
    OptionalMember<OrderNode>{
        "order.nodes.nodePosition",
        [](const OrderNode& node) { return node.nodePosition.has_value(); },
        [](OrderNode& node) {
            node.nodePosition.reset();
        }},
    // Without an orientation the vehicle plans its own; without tolerances it uses its own.
    OptionalMember<OrderNode>{
        "order.nodes.nodePosition.theta",
        [](const OrderNode& node) { return node.nodePosition.has_value() && node.nodePosition->theta.has_value(); },
        [](OrderNode& node) {
            node.nodePosition->theta.reset();
        }},
    OptionalMember<OrderNode>{
        "order.nodes.nodePosition.allowedDeviationXY",
        [](const OrderNode& node) {
            return node.nodePosition.has_value() && node.nodePosition->allowedDeviationXY.has_value();
        },
        [](OrderNode& node) {
            node.nodePosition->allowedDeviationXY.reset();
        }},
    OptionalMember<OrderNode>{
        "order.nodes.nodePosition.allowedDeviationTheta",
        [](const OrderNode& node) {
            return node.nodePosition.has_value() && node.nodePosition->allowedDeviationTheta.has_value();
        },
        [](OrderNode& node) { node.nodePosition->allowedDeviationTheta.reset(); },
        [](OrderNode& node, const FactsheetMessage&) {
            if (node.nodePosition.has_value())
            {
                node.nodePosition->allowedDeviationTheta = std::numbers::pi;
            }
        }},
};

constexpr std::array EDGE_MEMBERS{
    OptionalMember<OrderEdge>{
        "order.edges.maxSpeed",
        [](const OrderEdge& edge) { return edge.maxSpeed.has_value(); },
        nullptr,
        [](OrderEdge& edge, const FactsheetMessage& factsheet) {
            if (factsheet.physicalParameters.speedMax > 0.0)
            {
                edge.maxSpeed = factsheet.physicalParameters.speedMax;
            }
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
    // TANGENTIAL is the default, and a type has no effect without an orientation.
    OptionalMember<OrderEdge>{
        "order.edges.orientationType",
        [](const OrderEdge& edge) { return edge.orientationType.has_value(); },
        [](OrderEdge& edge) {
            if (edge.orientationType == EOrientationType::Tangential || !edge.orientation.has_value())
            {
                edge.orientationType.reset();
            }
        },
        [](OrderEdge& edge, const FactsheetMessage&) {
            edge.orientationType = EOrientationType::Tangential;
        }},
    OptionalMember<OrderEdge>{
        "order.edges.direction",
        [](const OrderEdge& edge) {
            return !edge.direction.empty();
        }},
    // True is the default.
    OptionalMember<OrderEdge>{
        "order.edges.rotationAllowed",
        [](const OrderEdge& edge) { return edge.bRotationAllowed.has_value(); },
        [](OrderEdge& edge) {
            if (edge.bRotationAllowed == true)
            {
                edge.bRotationAllowed.reset();
            }
        },
        [](OrderEdge& edge, const FactsheetMessage&) {
            edge.bRotationAllowed = true;
        }},
    OptionalMember<OrderEdge>{
        "order.edges.maxRotationSpeed",
        [](const OrderEdge& edge) {
            return edge.maxRotationSpeed.has_value();
        }},
    // The vehicle measures the edge itself.
    OptionalMember<OrderEdge>{
        "order.edges.length",
        [](const OrderEdge& edge) { return edge.length.has_value(); },
        [](OrderEdge& edge) {
            edge.length.reset();
        }},
    OptionalMember<OrderEdge>{
        "order.edges.trajectory",
        [](const OrderEdge& edge) {
            return edge.trajectory.has_value();
        }},
    // Without a corridor the vehicle stays on the edge.
    OptionalMember<OrderEdge>{
        "order.edges.corridor",
        [](const OrderEdge& edge) { return edge.corridor.has_value(); },
        [](OrderEdge& edge) {
            edge.corridor.reset();
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

bool IsRequired(const FactsheetMessage& factsheet, std::string_view path)
{
    const std::vector<OptionalParameter>& list = *factsheet.protocolFeatures.optionalParameters;
    const auto listed = std::ranges::find(list, path, &OptionalParameter::parameter);
    return listed != list.end() && listed->support == EParameterSupport::Required;
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
        const bool bRequired = IsRequired(factsheet, member.path);
        if (!bRequired && IsSupported(factsheet, member.path))
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
void CheckActions(const TElement& element, EActionScope scope, const OrderContext& context, OrderFindings& unusable)
{
    for (const Action& action : element.actions)
    {
        const std::optional<ActionFault> fault =
            FindActionFaultOrNull(*context.factsheet, action, scope, context.parameterCheck);
        if (fault.has_value())
        {
            VehicleError& error = unusable.Add(fault->rule);
            AddReference(error, ReferenceKeys::ACTION_ID, action.actionID);
            AddReference(error, ReferenceKeys::PARAMETER, fault->field);
            AddElement(error, element);
        }
    }
}

std::size_t MeasureActionStates(const std::vector<Action>& actions)
{
    return std::accumulate(actions.begin(), actions.end(), std::size_t{0}, [](std::size_t sum, const Action& action) {
        return sum + MeasureActionState(action);
    });
}

void CheckSizes(const OrderContext& context, OrderFindings& unusable)
{
    const OrderMessage& order = unusable.GetOrder();
    const bool bUpdate = order.orderID == context.heldOrderID;
    MessageSizes sizes = Measure(order);
    sizes.payload = context.payloadBytes;
    // What the state would have to show: of an update the first node and its actions are there already.
    sizes.edgeStates = (bUpdate ? context.keptNodes : 0) + order.edges.size();
    sizes.nodeStates = sizes.edgeStates;
    sizes.actionStates =
        bUpdate ? context.keptActions : context.instantActionIDs.size() + order.nodes[0].actions.size();
    sizes.stateBytes = bUpdate ? context.keptBytes : MeasureActionStates(order.nodes[0].actions);
    for (std::size_t index = 0; index < order.edges.size(); ++index)
    {
        const OrderEdge& edge = order.edges[index];
        const OrderNode& node = order.nodes[index + 1];
        sizes.stateBytes += MeasureEdgeState(edge) + MeasureNodeState(node) + MeasureActionStates(edge.actions)
            + MeasureActionStates(node.actions);
        sizes.actionStates += edge.actions.size() + node.actions.size();
    }
    for (const ActionFault& fault : FindSizeFaults(sizes, context.factsheet->protocolLimits))
    {
        AddReference(unusable.Add(fault.rule), ReferenceKeys::PARAMETER, fault.field);
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

/// 6.10 of 2.0: an order for another zone set than the vehicle's is refused.
void CheckZoneSet(const OrderContext& context, OrderFindings& unusable)
{
    const std::string& zoneSetID = unusable.GetOrder().zoneSetID;
    if (zoneSetID.empty() || context.zoneSetIDs.empty()
        || std::ranges::find(context.zoneSetIDs, zoneSetID) != context.zoneSetIDs.end())
    {
        return;
    }
    VehicleError& error = unusable.Add("the vehicle does not have the zone set " + zoneSetID);
    AddReference(error, ReferenceKeys::PARAMETER, "order.zoneSetId");
}

template <typename TElements, typename TMembers>
void AdaptMembers(TElements& elements, const TMembers& members, const FactsheetMessage& factsheet)
{
    for (const auto& member : members)
    {
        const bool bRequired = IsRequired(factsheet, member.path);
        if (!bRequired && IsSupported(factsheet, member.path))
        {
            continue;
        }
        for (auto& element : elements)
        {
            const bool bThere = member.isThere(element);
            if (bThere && !bRequired && member.leaveOut != nullptr)
            {
                member.leaveOut(element);
            }
            else if (!bThere && bRequired && member.fillIn != nullptr)
            {
                member.fillIn(element, factsheet);
            }
        }
    }
}

template <typename TElements>
void ConvertActions(TElements& elements, const FactsheetMessage& factsheet)
{
    for (auto& element : elements)
    {
        for (Action& action : element.actions)
        {
            ConvertTexts(factsheet, action);
        }
    }
}

template <typename TMembers>
void AddSupported(const TMembers& members, std::vector<OptionalParameter>& out)
{
    for (const auto& member : members)
    {
        out.push_back({std::string(member.path), EParameterSupport::Supported, {}});
    }
}

} // namespace

void AdaptToFactsheet(OrderMessage& order, const FactsheetMessage& factsheet)
{
    if (factsheet.protocolFeatures.optionalParameters.has_value())
    {
        AdaptMembers(order.nodes, NODE_MEMBERS, factsheet);
        AdaptMembers(order.edges, EDGE_MEMBERS, factsheet);
    }
    ConvertActions(order.nodes, factsheet);
    ConvertActions(order.edges, factsheet);
}

std::vector<OptionalParameter> ListOptionalParameters()
{
    std::vector<OptionalParameter> all;
    AddSupported(ORDER_MEMBERS, all);
    AddSupported(NODE_MEMBERS, all);
    AddSupported(EDGE_MEMBERS, all);
    return all;
}

std::vector<OrderViolation> FindUnusable(const OrderMessage& order, const OrderContext& context)
{
    OrderFindings unusable(order, ErrorTypes::ORDER_ERROR);
    if (context.factsheet != nullptr)
    {
        const FactsheetMessage& factsheet = *context.factsheet;
        for (const OrderNode& node : order.nodes)
        {
            CheckActions(node, EActionScope::Node, context, unusable);
        }
        for (const OrderEdge& edge : order.edges)
        {
            CheckActions(edge, EActionScope::Edge, context, unusable);
        }
        if (factsheet.protocolFeatures.optionalParameters.has_value())
        {
            CheckMembers(std::array{std::cref(order)}, ORDER_MEMBERS, factsheet, unusable);
            CheckMembers(order.nodes, NODE_MEMBERS, factsheet, unusable);
            CheckMembers(order.edges, EDGE_MEMBERS, factsheet, unusable);
        }
        CheckSizes(context, unusable);
    }
    CheckMaps(context, unusable);
    CheckZoneSet(context, unusable);
    return unusable.Take();
}

} // namespace ACS::VDA5050
