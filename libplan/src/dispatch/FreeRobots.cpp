#include "dispatch/FreeRobots.hpp"

#include <algorithm>
#include <iterator>

namespace ACS::Planning
{

FreeRobots::FreeRobots(Fleet& fleet)
{
    for (Robot& robot : fleet)
    {
        if (robot.IsFree())
        {
            _robots.push_back(&robot);
        }
    }
}

bool FreeRobots::IsEmpty() const noexcept
{
    return _robots.empty();
}

const std::vector<Robot*>& FreeRobots::List(std::span<const std::size_t> candidates)
{
    const auto [entry, bNew] = _ofCandidates.try_emplace(candidates.data());
    if (bNew)
    {
        std::ranges::copy_if(_robots, std::back_inserter(entry->second), [candidates](const Robot* robot) {
            return std::ranges::binary_search(candidates, robot->index);
        });
    }
    return entry->second;
}

void FreeRobots::Remove(const Robot& robot)
{
    std::erase(_robots, &robot);
    for (auto& [candidates, robots] : _ofCandidates)
    {
        std::erase(robots, &robot);
    }
}

} // namespace ACS::Planning
