#pragma once

#include <acs/vda5050/Action.hpp>
#include <acs/vda5050/OrderMessage.hpp>
#include <acs/vda5050/StateMessage.hpp>
#include <acs/vda5050/Vda5050Codec.hpp>

#include <cstddef>
#include <optional>
#include <string_view>

namespace ACS::VDA5050
{

/// How the room of a state is shared out, so that what a vehicle publishes can be read by every receiver that has the limits
/// of this library's codec. The rest is for errors and for data of the owner.
namespace StateRoom
{
inline constexpr std::size_t KIB = 1024;
inline constexpr std::size_t ORDER_BYTES = 2 * KIB * KIB;
inline constexpr std::size_t ARRAY = 10'000; ///< Elements that the codec reads.
inline constexpr std::size_t INSTANT_ACTIONS = 128;
inline constexpr std::size_t INSTANT_BYTES = 512 * KIB;
// A vehicle can still be stopped, and set free again, where the others have used up theirs.
inline constexpr std::size_t CONTROL_ACTIONS = INSTANT_ACTIONS + 32;
inline constexpr std::size_t CONTROL_BYTES = INSTANT_BYTES + 256 * KIB;
inline constexpr std::size_t ORDER_ACTIONS = ARRAY - CONTROL_ACTIONS;
static_assert(ORDER_BYTES + CONTROL_BYTES < CodecLimits{}.payloadBytes * 3 / 4);
} // namespace StateRoom

// At least as many bytes as the element takes in a state.
[[nodiscard]] std::size_t MeasureText(std::string_view text);
[[nodiscard]] std::size_t MeasureTrajectory(const std::optional<Trajectory>& trajectoryOrNull);

/// Of an Action or an ActionState; with a short result.
template <typename TAction>
[[nodiscard]] std::size_t MeasureActionState(const TAction& action)
{
    constexpr std::size_t FIXED = 160;
    return FIXED + MeasureText(action.actionID) + MeasureText(action.actionType)
        + MeasureText(action.actionDescription);
}

/// Of an OrderNode or a NodeState.
template <typename TNode>
[[nodiscard]] std::size_t MeasureNodeState(const TNode& node)
{
    // Names of members, and numbers of any length.
    constexpr std::size_t FIXED = 80;
    constexpr std::size_t POSITION = 128;
    const std::size_t position = node.nodePosition.has_value() ? POSITION + MeasureText(node.nodePosition->mapID) : 0;
    return FIXED + MeasureText(node.nodeID) + MeasureText(node.nodeDescription) + position;
}

/// Of an OrderEdge or an EdgeState.
template <typename TEdge>
[[nodiscard]] std::size_t MeasureEdgeState(const TEdge& edge)
{
    constexpr std::size_t FIXED = 80;
    return FIXED + MeasureText(edge.edgeID) + MeasureText(edge.edgeDescription) + MeasureTrajectory(edge.trajectory);
}

/// Removes the information entries from a state that is too long: no program evaluates them.
void DropTextsForPeople(StateMessage& state);

} // namespace ACS::VDA5050
