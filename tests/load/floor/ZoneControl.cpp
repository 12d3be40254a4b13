#include "ZoneControl.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace ACS::Testing
{

using namespace Planning; // NOLINT(google-build-using-namespace): a test of that namespace

ZoneControl::ZoneControl(const Floor& floor, std::size_t vehicles)
    : IRuleControl(floor, vehicles),
      _remaining(vehicles)
{
    FindZones(floor);
}

void ZoneControl::FindZones(const Floor& floor)
{
    constexpr double SIDE = 9; ///< Metres.
    const std::vector<SiteNode>& nodes = floor.site.GetNodes();
    std::map<std::pair<long, long>, std::size_t> numbers;
    const auto find = [&numbers](const SiteNode& node) {
        return numbers
            .try_emplace(
                {std::lround(std::floor(node.x / SIDE)), std::lround(std::floor(node.y / SIDE))},
                numbers.size())
            .first->second;
    };
    for (const SiteNode& node : nodes)
    {
        _zones.push_back(find(node));
    }
    for (const SiteEdge& edge : floor.site.GetEdges())
    {
        if (edge.endNodeID.starts_with("D-"))
        {
            _zones[*floor.site.FindNodeIndexOrNull(edge.endNodeID)] =
                _zones[*floor.site.FindNodeIndexOrNull(edge.startNodeID)];
        }
    }
    _holders.resize(numbers.size());
}

bool ZoneControl::TryTakePlan(const Vehicle& vehicle, const Plan& plan)
{
    const std::size_t robot = GetIndex(vehicle);
    std::vector<std::size_t> nodes{vehicle.node};
    std::size_t from = vehicle.node;
    const auto add = [this, &nodes, &from](std::size_t target) {
        const std::vector<std::size_t> route = FindRoute(std::exchange(from, target), target);
        nodes.insert(nodes.end(), route.begin() + 1, route.end());
    };
    for (const Step& step : plan.steps)
    {
        add(GetDock(step.position));
    }
    add(vehicle.home);
    const bool bFree = std::ranges::all_of(nodes, [this, robot](std::size_t node) {
        return !_holders[_zones[node]].has_value() || _holders[_zones[node]] == robot;
    });
    if (!bFree)
    {
        return false;
    }
    for (std::optional<std::size_t>& holder : _holders)
    {
        holder = holder == robot ? std::nullopt : holder;
    }
    std::ranges::for_each(nodes, [this, robot](std::size_t node) { _holders[_zones[node]] = robot; });
    _remaining[robot] = std::move(nodes);
    return true;
}

std::size_t ZoneControl::Grant(const Vehicle& vehicle)
{
    return vehicle.route.size();
}

void ZoneControl::OnPassed(const Vehicle& vehicle)
{
    const std::size_t robot = GetIndex(vehicle);
    std::vector<std::size_t>& remaining = _remaining[robot];
    const std::size_t left = _zones[remaining.front()];
    remaining.erase(remaining.begin());
    const auto isInZone = [this, left](std::size_t node) {
        return _zones[node] == left;
    };
    if (std::ranges::none_of(remaining, isInZone))
    {
        _holders[left].reset();
    }
    if (remaining.size() == 1) // it is parked
    {
        _holders[_zones[remaining.front()]].reset();
    }
}

} // namespace ACS::Testing
