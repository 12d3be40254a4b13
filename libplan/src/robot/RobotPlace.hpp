#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// Where a robot is, and where it may be. Kept by PlaceTracker and TrafficCoordinator. Nodes by index in the map.
struct RobotPlace
{
    std::optional<std::size_t> node; ///< The node it is on or has passed last.
    bool bPlaced = false;            ///< The position is known since the start.
    std::string position;            ///< The last station at which it was.
    /// After a restart: the stored nodes where it may be; once it has reported its node, those of them that are ahead.
    std::vector<std::size_t> possibleNodes;
    std::vector<std::size_t> heldNodes; ///< Without a drive: its node and those to which it may still drive.
    /// Without a drive: nodes after its own on its former route that it may have reached, or may still reach.
    std::vector<std::size_t> aheadNodes;
    /// During a drive: a node that it reports and that is not granted to it; reserved as a possible node.
    std::optional<std::size_t> strayNode;
    /// It is stationary between its node and this one. It cannot turn round there, so its next drive begins with this lane.
    std::optional<std::size_t> heading;

    /// Whether it is on this node, and not between it and the next one.
    [[nodiscard]] bool IsOn(std::optional<std::size_t> wantedOrNull) const
    {
        return node == wantedOrNull && !heading.has_value();
    }
};

} // namespace ACS::Planning
