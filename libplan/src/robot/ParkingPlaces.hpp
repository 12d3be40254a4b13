#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace ACS::Planning
{

/// Where an idle robot waits. Nodes by index in the map.
struct ParkingPlaces
{
    std::optional<std::size_t> homeNode; ///< Its target without work; with a low battery its chargeNode.
    std::optional<std::size_t> chargeNode;
    std::optional<std::size_t> parkingNode; ///< Its home or, without one, where it blocks no robot.
    std::optional<std::size_t> standInNode; ///< Instead of its parkingNode while the way there is blocked.
    std::optional<std::size_t> retreatNode; ///< Its next target, to clear the route of others.
    unsigned refusals = 0;                  ///< In a row, without a move and without becoming available again.
    bool bRefused = false;                  ///< Until the timer HomeRetry.
    std::string refusal;                    ///< Why bRefused.

    /// Its target without work.
    [[nodiscard]] std::optional<std::size_t> GetHomeOrNull() const
    {
        return homeNode.has_value() && homeNode == parkingNode ? GetParkingOrNull() : homeNode;
    }

    [[nodiscard]] std::optional<std::size_t> GetParkingOrNull() const
    {
        return standInNode.has_value() ? standInNode : parkingNode;
    }
};

} // namespace ACS::Planning
