#include "config/ReachFinder.hpp"

#include <algorithm>
#include <iterator>
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
