#include "MessageSizes.hpp"

#include "StateRoom.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

namespace ACS::VDA5050
{

namespace
{

void MeasureActions(const std::vector<Action>& actions, std::size_t& most, MessageSizes& sizes)
{
    most = std::max(most, actions.size());
    for (const Action& action : actions)
    {
        sizes.parameters = std::max(sizes.parameters, action.actionParameters.size());
        sizes.ids.emplace_back(action.actionID);
    }
}

bool IsNumerical(std::string_view text)
{
    return std::ranges::all_of(text, [](char letter) { return letter >= '0' && letter <= '9'; });
}

} // namespace

MessageSizes Measure(const OrderMessage& order)
{
    MessageSizes sizes;
    sizes.nodes = order.nodes.size();
    sizes.edges = order.edges.size();
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

MessageSizes Measure(const Action& action)
{
    MessageSizes sizes;
    sizes.parameters = action.actionParameters.size();
    sizes.ids.emplace_back(action.actionID);
    return sizes;
}

std::vector<ActionFault> FindSizeFaults(const MessageSizes& sizes, const ProtocolLimits& limits)
{
    struct Limit
    {
        std::string_view name;
        std::size_t found;
        std::optional<std::uint32_t> allowed;
        std::size_t most = std::numeric_limits<std::size_t>::max();
    };
    const MaximumArrayLengths& arrays = limits.maxArrayLengths;
    const MaximumStringLengths& strings = limits.maxStringLengths;
    const auto longest = std::ranges::max_element(sizes.ids, {}, &std::string_view::size);
    const std::array table{
        Limit{"maxStringLens.msgLen", sizes.payload, strings.message},
        Limit{"maxStringLens.idLen", longest == sizes.ids.end() ? 0 : longest->size(), strings.identifier},
        Limit{"maxArrayLens.order.nodes", sizes.nodes, arrays.orderNodes},
        Limit{"maxArrayLens.order.edges", sizes.edges, arrays.orderEdges},
        Limit{"maxArrayLens.node.actions", sizes.nodeActions, arrays.nodeActions},
        Limit{"maxArrayLens.edge.actions", sizes.edgeActions, arrays.edgeActions},
        Limit{"maxArrayLens.actions.actionsParameters", sizes.parameters, arrays.actionParameters},
        Limit{"maxArrayLens.trajectory.knotVector", sizes.knots, arrays.trajectoryKnotVector},
        Limit{"maxArrayLens.trajectory.controlPoints", sizes.controlPoints, arrays.trajectoryControlPoints},
        Limit{"maxArrayLens.state.nodeStates", sizes.nodeStates, arrays.stateNodeStates, StateRoom::ARRAY},
        Limit{"maxArrayLens.state.edgeStates", sizes.edgeStates, arrays.stateEdgeStates, StateRoom::ARRAY},
        Limit{
            "maxArrayLens.state.actionStates",
            sizes.actionStates,
            arrays.stateActionStates,
            StateRoom::ORDER_ACTIONS},
        Limit{"maximum length of the state", sizes.stateBytes, std::nullopt, StateRoom::ORDER_BYTES}};
    std::vector<ActionFault> faults;
    for (const Limit& limit : table)
    {
        const std::size_t stated = limit.allowed.value_or(0);
        const std::size_t allowed = stated == 0 ? limit.most : std::min(stated, limit.most);
        if (limit.found > allowed)
        {
            const std::string name(limit.name);
            faults.push_back(ActionFault{
                "too large: " + name + " is " + std::to_string(allowed) + ", found " + std::to_string(limit.found),
                name});
        }
    }
    if (strings.bIdentifierNumericalOnly.value_or(false) && !std::ranges::all_of(sizes.ids, IsNumerical))
    {
        faults.push_back(ActionFault{"the vehicle takes numbers as ids only", "maxStringLens.idNumericalOnly"});
    }
    return faults;
}

} // namespace ACS::VDA5050
