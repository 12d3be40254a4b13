#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace ACS::Planning
{

/// The robots for which RobotChanges has marks, by index: a call of the engine visits these, not the whole fleet.
struct ChangedRobots
{
    std::vector<std::size_t> status;
    std::vector<std::size_t> work;
};

/// Empties the list. Returns the robots in the order of the fleet.
[[nodiscard]] inline std::vector<std::size_t> TakeInOrder(std::vector<std::size_t>& robots)
{
    std::vector<std::size_t> taken = std::exchange(robots, {});
    std::ranges::sort(taken);
    taken.erase(std::unique(taken.begin(), taken.end()), taken.end());
    return taken;
}

} // namespace ACS::Planning
