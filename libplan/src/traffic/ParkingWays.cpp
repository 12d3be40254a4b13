#include "traffic/ParkingWays.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <queue>
#include <utility>

namespace ACS::Planning
{

ParkingWays::ParkingWays(const SiteMap& site, double clearance)
    : _near(site.GetNodes().size()),
      _homes(_near.size(), 0),
      _claims{std::vector<std::uint16_t>(_near.size(), 0), std::vector<std::uint16_t>(_near.size(), 0)},
      _standIns(_near.size(), 0)
{
    _scratch.seen.assign(_near.size(), 0);
    FindNear(site, clearance);
}

void ParkingWays::FindNear(const SiteMap& site, double clearance)
{
    const std::vector<SiteNode>& nodes = site.GetNodes();
    std::vector<std::uint32_t> byX(nodes.size());
    std::iota(byX.begin(), byX.end(), 0U);
    std::ranges::sort(byX, {}, [&nodes](std::uint32_t node) { return nodes[node].x; });
    for (std::size_t i = 0; i < byX.size(); ++i)
    {
        const SiteNode& left = nodes[byX[i]];
        _near[byX[i]].push_back(byX[i]);
        for (std::size_t next = i + 1; next < byX.size() && nodes[byX[next]].x - left.x <= clearance; ++next)
        {
            const SiteNode& right = nodes[byX[next]];
            if (left.mapID == right.mapID && GetDistance(left, right) <= clearance)
            {
                _near[byX[i]].push_back(byX[next]);
                _near[byX[next]].push_back(byX[i]);
            }
        }
    }
}

const std::vector<std::uint32_t>& ParkingWays::GetNear(std::size_t node) const
{
    return _near[node];
}

bool ParkingWays::IsNear(std::size_t left, std::size_t right) const
{
    return std::ranges::count(_near[left], right) > 0;
}

void ParkingWays::AddHome(std::size_t node)
{
    std::ranges::for_each(_near[node], [this](std::uint32_t near) { ++_homes[near]; });
}

void ParkingWays::SetBlocked(const std::vector<bool>& nodes, const std::vector<bool>& edges)
{
    const bool bAny = std::ranges::count(nodes, true) + std::ranges::count(edges, true) > 0;
    _blockedNodes = bAny ? nodes : std::vector<bool>();
    _blockedEdges = bAny ? edges : std::vector<bool>();
}

bool ParkingWays::IsAnyBlocked() const noexcept
{
    return !_blockedNodes.empty();
}

bool ParkingWays::IsBlocked(std::size_t node) const
{
    return IsAnyBlocked() && _blockedNodes[node];
}

std::uint64_t ParkingWays::GetReleasedCount() const noexcept
{
    return _released;
}

/// A home on a lane, between the homes of others, has no guaranteed route back.
void ParkingWays::FindReturns(Parking& parking) const
{
    parking.bCanReturn = parking.home.has_value() && !parking.graphs.empty();
    if (!parking.home.has_value())
    {
        return;
    }
    for (LoadGraph& graph : parking.graphs)
    {
        FindReturns(parking, graph);
        const bool bReturns =
            std::ranges::any_of(graph.floor->GetLanesFrom(*parking.home), [this, &parking, &graph](const Lane& lane) {
                return !IsHomeOfOther(parking, lane.to) && graph.returns[lane.to];
            });
        parking.bCanReturn = parking.bCanReturn && bReturns;
    }
}

/// From the home backwards, around the homes of others.
void ParkingWays::FindReturns(const Parking& parking, LoadGraph& graph) const
{
    graph.returns.assign(_near.size(), false);
    graph.returns[*parking.home] = true;
    _scratch.open.assign(1, static_cast<std::uint32_t>(*parking.home));
    for (std::size_t next = 0; next < _scratch.open.size(); ++next)
    {
        for (const std::size_t index : graph.floor->GetLanesTo(_scratch.open[next]))
        {
            const std::size_t from = graph.floor->GetLanes()[index].from;
            if (!graph.returns[from])
            {
                graph.returns[from] = true;
                if (!IsHomeOfOther(parking, from))
                {
                    _scratch.open.push_back(static_cast<std::uint32_t>(from));
                }
            }
        }
    }
}

/// Dijkstra's algorithm, backwards from the home. Starts again, with twice as many nodes as before: robots are mostly near their
/// home, and a search over the whole floor for each robot would delay a start.
void ParkingWays::FindWaysHome(const LoadGraph& graph, std::size_t home, std::size_t from) const
{
    using OpenNode = std::pair<double, std::size_t>;
    const FloorGraph& floor = *graph.floor;
    std::vector<double> seconds(_near.size(), std::numeric_limits<double>::infinity());
    std::vector<std::uint32_t> next(_near.size(), NOWHERE);
    std::priority_queue<OpenNode, std::vector<OpenNode>, std::greater<>> open;
    const std::size_t least = 2 * graph.nearest;
    graph.nextToHome.assign(_near.size(), NOWHERE);
    graph.nearest = 0;
    seconds[home] = 0;
    open.emplace(0, home);
    bool bFound = false;
    while (!open.empty() && (!bFound || graph.nearest < least))
    {
        const auto [reached, node] = open.top();
        open.pop();
        if (reached > seconds[node])
        {
            continue;
        }
        graph.nextToHome[node] = next[node];
        ++graph.nearest;
        bFound = bFound || node == from;
        for (const std::size_t index : floor.GetLanesTo(node))
        {
            const Lane& lane = floor.GetLanes()[index];
            if (reached + lane.seconds < seconds[lane.from])
            {
                seconds[lane.from] = reached + lane.seconds;
                next[lane.from] = static_cast<std::uint32_t>(node);
                open.emplace(seconds[lane.from], lane.from);
            }
        }
    }
    graph.nearest = open.empty() ? _near.size() : graph.nearest;
}

bool ParkingWays::IsBlocked(const Lane& lane) const
{
    return IsAnyBlocked() && (_blockedNodes[lane.to] || _blockedEdges[lane.edge]);
}

std::size_t ParkingWays::GetParking(const Parking& parking, ESafeStateScope scope) const
{
    return scope == ESafeStateScope::AsIs && IsAnyBlocked() ? parking.standIn.value_or(*parking.home) : *parking.home;
}

bool ParkingWays::IsHomeOfOther(const Parking& parking, std::size_t node) const
{
    return IsOfOther(parking.home, node, _homes);
}

/// A route around covered nodes and the homes of others, so that the order of parking does not matter.
bool ParkingWays::HasWay(
    const Parking& parking,
    const LoadGraph& graph,
    std::size_t from,
    std::size_t to,
    const std::vector<std::uint16_t>& covers,
    ESafeStateScope scope) const
{
    const bool bAround = scope == ESafeStateScope::AsIs && IsAnyBlocked();
    if (from == to)
    {
        return true;
    }
    if (covers[to] > 0)
    {
        return false;
    }
    ++_scratch.search;
    _scratch.open.assign(1, static_cast<std::uint32_t>(from));
    _scratch.seen[from] = _scratch.search;
    for (std::size_t next = 0; next < _scratch.open.size(); ++next)
    {
        for (const Lane& lane : graph.floor->GetLanesFrom(_scratch.open[next]))
        {
            if (bAround && IsBlocked(lane))
            {
                continue;
            }
            if (lane.to == to)
            {
                return true;
            }
            if (_scratch.seen[lane.to] != _scratch.search && covers[lane.to] == 0 && !IsHomeOfOther(parking, lane.to))
            {
                _scratch.seen[lane.to] = _scratch.search;
                _scratch.open.push_back(static_cast<std::uint32_t>(lane.to));
            }
        }
    }
    return false;
}

bool ParkingWays::HasStraightWayHome(
    const Parking& parking,
    const LoadGraph& graph,
    std::size_t from,
    const std::vector<std::uint16_t>& covers) const
{
    const bool bKnown = from == *parking.home || graph.nearest == _near.size()
        || (!graph.nextToHome.empty() && graph.nextToHome[from] != NOWHERE);
    if (!bKnown)
    {
        FindWaysHome(graph, *parking.home, from);
    }
    for (std::size_t node = from; node != *parking.home; node = graph.nextToHome[node])
    {
        const std::uint32_t next = graph.nextToHome[node];
        if (next == NOWHERE || covers[next] > 0 || IsHomeOfOther(parking, next))
        {
            return false;
        }
    }
    return true;
}

/// covers: of all other robots. A route is needed with each load with which the map has one from there, so that a job that
/// changes the load leaves the state safe. A station that can be left with one load only needs that of this load: the job there
/// is assumed to end, as for every robot that works.
bool ParkingWays::CanGoHome(
    const Parking& parking,
    std::size_t from,
    const std::vector<std::uint16_t>& covers,
    ESafeStateScope scope) const
{
    const auto returns = [from](const LoadGraph& graph) {
        return graph.returns[from];
    };
    return parking.bCanReturn && std::ranges::any_of(parking.graphs, returns)
        && std::ranges::all_of(
               parking.graphs,
               [this, &parking, &covers, &returns, from, scope](const LoadGraph& graph) {
                   const bool bAround = scope == ESafeStateScope::AsIs && IsAnyBlocked();
                   return !returns(graph) || (!bAround && HasStraightWayHome(parking, graph, from, covers))
                       || HasWay(parking, graph, from, GetParking(parking, scope), covers, scope);
               });
}

void ParkingWays::FindRefuges(const std::map<std::string, std::vector<FloorGraph>, std::less<>>& graphs)
{
    std::vector<bool> deadEnds(_near.size());
    for (std::size_t node = 0; node < deadEnds.size(); ++node)
    {
        deadEnds[node] = std::ranges::all_of(graphs, [node](const auto& entry) {
            const bool bUsed = std::ranges::any_of(entry.second, [node](const FloorGraph& graph) {
                return !graph.GetLanesFrom(node).empty() || !graph.GetLanesTo(node).empty();
            });
            return !bUsed || IsDeadEnd(entry.second, node);
        });
    }
    _refuges.assign(_near.size(), false);
    for (std::size_t node = 0; node < deadEnds.size(); ++node)
    {
        _refuges[node] = std::ranges::all_of(_near[node], [&deadEnds](std::uint32_t near) { return deadEnds[near]; });
    }
}

bool ParkingWays::IsRefuge(std::size_t node) const
{
    return !_refuges.empty() && _refuges[node];
}

void ParkingWays::SetStandIn(Parking& parking, std::optional<std::size_t> standInOrNull)
{
    ChangePlace(parking.standIn, standInOrNull, _standIns);
}

/// Moves what the place adds to the count of each node that it excludes.
void ParkingWays::ChangePlace(
    std::optional<std::size_t>& placeOrNull,
    std::optional<std::size_t> nextOrNull,
    std::vector<std::uint16_t>& counts) const
{
    if (placeOrNull.has_value())
    {
        std::ranges::for_each(_near[*placeOrNull], [&counts](std::uint32_t near) { --counts[near]; });
    }
    placeOrNull = nextOrNull;
    if (placeOrNull.has_value())
    {
        std::ranges::for_each(_near[*placeOrNull], [&counts](std::uint32_t near) { ++counts[near]; });
    }
}

bool ParkingWays::IsOfOther(
    const std::optional<std::size_t>& ownOrNull,
    std::size_t node,
    const std::vector<std::uint16_t>& counts) const
{
    const std::size_t own = ownOrNull.has_value() && IsNear(*ownOrNull, node) ? 1 : 0;
    return counts[node] > own;
}

bool ParkingWays::IsRefugeOfOther(const Parking& parking, std::size_t node, ESafeStateScope scope) const
{
    const auto index = static_cast<std::size_t>(scope);
    return IsOfOther(parking.refuges[index], node, _claims[index]);
}

bool ParkingWays::IsRefugeFor(const Parking& parking, std::size_t node, ESafeStateScope scope) const
{
    const bool bStandIn = scope == ESafeStateScope::AsIs && IsOfOther(parking.standIn, node, _standIns);
    return _refuges[node] && !IsHomeOfOther(parking, node) && !bStandIn && !IsRefugeOfOther(parking, node, scope)
        && std::ranges::all_of(parking.graphs, [node](const LoadGraph& graph) { return graph.returns[node]; });
}

void ParkingWays::Claim(Parking& parking, std::optional<std::size_t> nodeOrNull, ESafeStateScope scope)
{
    const auto index = static_cast<std::size_t>(scope);
    std::optional<std::size_t>& refuge = parking.refuges[index];
    if (refuge != nodeOrNull)
    {
        _released += refuge.has_value() ? 1U : 0U;
        ChangePlace(refuge, nodeOrNull, _claims[index]);
    }
}

bool ParkingWays::TryClaimHome(
    Parking& parking,
    std::size_t from,
    const std::vector<std::uint16_t>& covers,
    ESafeStateScope scope)
{
    const bool bGoes = CanGoHome(parking, from, covers, scope);
    if (bGoes)
    {
        Claim(parking, std::nullopt, scope);
    }
    return bGoes;
}

/// What is found for one state holds for each state in which others hold less: so a refuge may be claimed even if the grant is
/// refused in the end.
std::optional<std::size_t> ParkingWays::FindParkingOrNull(
    Parking& parking,
    std::size_t from,
    const std::vector<std::uint16_t>& covers,
    ESafeStateScope scope)
{
    if (TryClaimHome(parking, from, covers, scope))
    {
        return GetParking(parking, scope);
    }
    const std::optional<std::size_t> refuge = FindRefugeOrNull(parking, from, covers, scope);
    if (refuge.has_value())
    {
        Claim(parking, refuge, scope);
    }
    return refuge;
}

/// With each load with which it may continue from there.
bool ParkingWays::CanGoTo(
    const Parking& parking,
    std::size_t from,
    std::size_t refuge,
    const std::vector<std::uint16_t>& covers,
    ESafeStateScope scope) const
{
    const auto returns = [from](const LoadGraph& graph) {
        return graph.returns[from];
    };
    return std::ranges::any_of(parking.graphs, returns)
        && std::ranges::all_of(
               parking.graphs,
               [this, &parking, &covers, &returns, from, refuge, scope](const LoadGraph& graph) {
                   return !returns(graph) || HasWay(parking, graph, from, refuge, covers, scope);
               });
}

std::optional<std::size_t> ParkingWays::FindRefugeOrNull(
    const Parking& parking,
    std::size_t from,
    const std::vector<std::uint16_t>& covers,
    ESafeStateScope scope,
    std::optional<std::size_t> avoidedOrNull) const
{
    if (!parking.bCanReturn)
    {
        return std::nullopt;
    }
    const std::optional<std::size_t> former = parking.refuges[static_cast<std::size_t>(scope)];
    if (former.has_value() && former != avoidedOrNull && IsRefugeFor(parking, *former, scope)
        && CanGoTo(parking, from, *former, covers, scope))
    {
        return former;
    }
    const auto isFound = [this, &parking, &covers, from, scope, avoidedOrNull](std::size_t node) {
        return node != avoidedOrNull && IsRefugeFor(parking, node, scope) && (node == from || covers[node] == 0)
            && (parking.graphs.size() == 1 || CanGoTo(parking, from, node, covers, scope));
    };
    if (isFound(from))
    {
        return from;
    }
    const bool bAround = scope == ESafeStateScope::AsIs && IsAnyBlocked();
    std::vector<std::size_t> open{from};
    std::vector<bool> seen(_near.size(), false);
    seen[from] = true;
    for (std::size_t next = 0; next < open.size(); ++next)
    {
        for (const Lane& lane : parking.graphs.back().floor->GetLanesFrom(open[next]))
        {
            if (seen[lane.to] || covers[lane.to] > 0 || IsHomeOfOther(parking, lane.to) || (bAround && IsBlocked(lane)))
            {
                continue;
            }
            if (isFound(lane.to))
            {
                return lane.to;
            }
            seen[lane.to] = true;
            open.push_back(lane.to);
        }
    }
    return std::nullopt;
}

} // namespace ACS::Planning
