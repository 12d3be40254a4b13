#pragma once

#include <acs/plan/RobotEvent.hpp>
#include <acs/plan/SiteMap.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace ACS::Planning
{

/// Which of the nodes ahead a robot without a drive keeps: all while it still drives or its state is unknown, then those
/// between which it has stopped.
[[nodiscard]] std::vector<std::size_t> FindNodesAhead(
    const SiteMap& site,
    const std::optional<StateChanged>& stateOrNull,
    std::size_t node,
    std::span<const std::size_t> ahead);

/// The neighbours of the node between which and the node the robot is stationary, for a robot whose route is not known: it was
/// driven by hand, or it drove while nothing could be stored.
[[nodiscard]] std::vector<std::size_t> FindNodesBeside(
    const SiteMap& site,
    const StateChanged& state,
    std::size_t node);

} // namespace ACS::Planning
