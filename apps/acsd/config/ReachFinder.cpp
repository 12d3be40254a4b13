#include "config/ReachFinder.hpp"

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

namespace ACS::Acsd
{

ReachFinder::ReachFinder(const Planning::SiteMap& site, std::string_view vehicleTypeID, bool bRestricted)
    : _lanes(site.GetNodes().size()),
      _backwards(site.GetNodes().size())
{
    for (const Planning::SiteEdge& edge : site.GetEdges())
    {
        const Planning::SiteEdgeRule* const ruleOrNull = edge.FindRuleOrNull(vehicleTypeID);
        const std::size_t from = *site.FindNodeIndexOrNull(edge.startNodeID);
        const std::size_t to = *site.FindNodeIndexOrNull(edge.endNodeID);
        if (ruleOrNull == nullptr || site.GetNodes()[from].FindRuleOrNull(vehicleTypeID) == nullptr
            || site.GetNodes()[to].FindRuleOrNull(vehicleTypeID) == nullptr)
        {
            continue;
        }
        const bool bEmpty = !bRestricted || ruleOrNull->IsPermitted(Planning::ELoad::Empty);
        const bool bLoaded = !bRestricted || ruleOrNull->IsPermitted(Planning::ELoad::Loaded);
        _lanes[from].push_back({to, bEmpty, bLoaded});
        _backwards[to].push_back({from, bEmpty, bLoaded});
    }
}

Reach ReachFinder::Find(const Nodes& starts, const Nodes& docks) const
{
    const std::vector<bool> none(_lanes.size(), false);
    Reach reach{{none, none}, {none, none}};
    for (const std::size_t start : starts)
    {
        reach.empty.arrived[start] = true;
        reach.loaded.arrived[start] = true;
    }
    Visit(_lanes, reach.empty, &Lane::bEmpty, starts);
    Visit(_lanes, reach.loaded, &Lane::bLoaded, starts);
    bool bMore = true;
    while (bMore)
    {
        const bool bLoaded = TryVisit(reach.loaded, &Lane::bLoaded, reach.empty, docks);
        bMore = TryVisit(reach.empty, &Lane::bEmpty, reach.loaded, docks) || bLoaded;
    }
    return reach;
}

std::vector<bool> ReachFinder::FindTargets(std::size_t start, Planning::ELoad load, const std::vector<bool>& closed)
    const
{
    return FindArrived(_lanes, start, load, closed);
}

std::vector<bool> ReachFinder::FindSources(std::size_t target, Planning::ELoad load, const std::vector<bool>& closed)
    const
{
    return FindArrived(_backwards, target, load, closed);
}

bool ReachFinder::HasLaneTo(std::size_t node) const
{
    return !_backwards[node].empty();
}

bool ReachFinder::IsPassed(std::size_t node) const
{
    return std::ranges::any_of(_backwards[node], [this, node](const Lane& from) {
        return std::ranges::any_of(_lanes[node], [&from](const Lane& lane) { return lane.to != from.to; });
    });
}

bool ReachFinder::IsBypassed(const std::vector<bool>& closed, Planning::ELoad load) const
{
    const auto isOpen = load == Planning::ELoad::Loaded ? &Lane::bLoaded : &Lane::bEmpty;
    const auto findNeighbours = [&closed, isOpen](const LaneTable& lanes) {
        std::set<std::size_t> neighbours;
        for (std::size_t node = 0; node < closed.size(); ++node)
        {
            for (const Lane& lane : closed[node] ? lanes[node] : std::vector<Lane>())
            {
                if (lane.*isOpen && !closed[lane.to])
                {
                    neighbours.insert(lane.to);
                }
            }
        }
        return neighbours;
    };
    const std::set<std::size_t> exits = findNeighbours(_lanes);
    std::vector<bool> targets(_lanes.size(), false);
    std::ranges::for_each(exits, [&targets](std::size_t node) { targets[node] = true; });
    const std::set<std::size_t> entries = findNeighbours(_backwards);
    return std::ranges::all_of(entries, [&](std::size_t entry) {
        return IsReached(entry, targets, exits.size(), closed, isOpen);
    });
}

void ReachFinder::Visit(const LaneTable& lanes, LoadReach& reach, bool Lane::*isOpen, Nodes nodes)
{
    while (!nodes.empty())
    {
        const std::size_t node = nodes.back();
        nodes.pop_back();
        if (reach.left[node])
        {
            continue;
        }
        reach.left[node] = true;
        for (const Lane& lane : lanes[node])
        {
            if (lane.*isOpen)
            {
                reach.arrived[lane.to] = true;
                nodes.push_back(lane.to);
            }
        }
    }
}

bool ReachFinder::TryVisit(LoadReach& reach, bool Lane::*isOpen, const LoadReach& other, const Nodes& docks) const
{
    Nodes added;
    std::ranges::copy_if(docks, std::back_inserter(added), [&reach, &other](std::size_t dock) {
        return other.arrived[dock] && !reach.left[dock];
    });
    Visit(_lanes, reach, isOpen, added);
    return !added.empty();
}

bool ReachFinder::IsReached(
    std::size_t start,
    const std::vector<bool>& targets,
    std::size_t count,
    const std::vector<bool>& closed,
    bool Lane::*isOpen) const
{
    std::vector<bool> seen = closed;
    Nodes open{start};
    seen[start] = true;
    for (std::size_t next = 0; next < open.size(); ++next)
    {
        count -= targets[open[next]] ? 1U : 0U;
        if (count == 0)
        {
            return true;
        }
        for (const Lane& lane : _lanes[open[next]])
        {
            if (lane.*isOpen && !seen[lane.to])
            {
                seen[lane.to] = true;
                open.push_back(lane.to);
            }
        }
    }
    return count == 0;
}

std::vector<bool> ReachFinder::FindArrived(
    const LaneTable& lanes,
    std::size_t start,
    Planning::ELoad load,
    const std::vector<bool>& closed)
{
    LoadReach reach{std::vector<bool>(lanes.size(), false), closed};
    reach.left.resize(lanes.size(), false);
    reach.left[start] = false;
    reach.arrived[start] = true;
    Visit(lanes, reach, load == Planning::ELoad::Loaded ? &Lane::bLoaded : &Lane::bEmpty, {start});
    for (std::size_t node = 0; node < closed.size(); ++node)
    {
        reach.arrived[node] = reach.arrived[node] && (!closed[node] || node == start);
    }
    return std::move(reach.arrived);
}

} // namespace ACS::Acsd
