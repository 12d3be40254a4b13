#include "traffic/Traffic.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <queue>
#include <utility>

namespace ACS::Planning
{

/// A home on a lane, between the homes of others, has no guaranteed route back.
void Traffic::FindReturns()
{
    if (std::exchange(_bReturnsKnown, true))
    {
        return;
    }
    FindRefuges();
    for (Vehicle& vehicle : _vehicles)
    {
        vehicle.bCanReturn = vehicle.home.has_value() && !vehicle.graphs.empty();
        for (LoadGraph& graph : vehicle.graphs)
        {
            if (!vehicle.home.has_value())
            {
                break;
            }
            FindReturns(vehicle, graph);
            const bool bReturns = std::ranges::any_of(
                graph.floor->GetLanesFrom(*vehicle.home),
                [this, &vehicle, &graph](const Lane& lane) {
                    return !IsHomeOfOther(vehicle, lane.to) && graph.returns[lane.to];
                });
            vehicle.bCanReturn = vehicle.bCanReturn && bReturns;
        }
    }
}

/// From the home backwards, around the homes of others.
void Traffic::FindReturns(const Vehicle& vehicle, LoadGraph& graph) const
{
    graph.returns.assign(_holders.size(), false);
    graph.returns[*vehicle.home] = true;
    _scratch.open.assign(1, static_cast<std::uint32_t>(*vehicle.home));
    for (std::size_t next = 0; next < _scratch.open.size(); ++next)
    {
        for (const std::size_t index : graph.floor->GetLanesTo(_scratch.open[next]))
        {
            const std::size_t from = graph.floor->GetLanes()[index].from;
            if (!graph.returns[from])
            {
                graph.returns[from] = true;
                if (!IsHomeOfOther(vehicle, from))
                {
                    _scratch.open.push_back(static_cast<std::uint32_t>(from));
                }
            }
        }
    }
}

/// Dijkstra's algorithm, backwards from the home. Starts again, with twice as many nodes as before: robots are mostly near their
/// home, and a search over the whole floor for each robot would delay a start.
void Traffic::FindWaysHome(const LoadGraph& graph, std::size_t home, std::size_t from) const
{
    using OpenNode = std::pair<double, std::size_t>;
    const FloorGraph& floor = *graph.floor;
    std::vector<double> seconds(_holders.size(), std::numeric_limits<double>::infinity());
    std::vector<std::uint32_t> next(_holders.size(), NOWHERE);
    std::priority_queue<OpenNode, std::vector<OpenNode>, std::greater<>> open;
    const std::size_t least = 2 * graph.nearest;
    graph.nextToHome.assign(_holders.size(), NOWHERE);
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
    graph.nearest = open.empty() ? _holders.size() : graph.nearest;
}

void Traffic::Cover(const Vehicle& vehicle, std::vector<std::uint16_t>& covers, bool bAdd) const
{
    const auto change = [this, &covers, bAdd](std::size_t node) {
        for (const std::uint32_t near : _near[node])
        {
            covers[near] = static_cast<std::uint16_t>(bAdd ? covers[near] + 1 : covers[near] - 1);
        }
    };
    std::ranges::for_each(vehicle.path, change);
    std::ranges::for_each(vehicle.extra, change);
}

bool Traffic::IsAnyFixed() const
{
    if (std::exchange(_anyFixed.at, _changes.fixed) != _changes.fixed)
    {
        _anyFixed.bAny = std::ranges::any_of(_vehicles, [](const Vehicle& vehicle) {
            return !vehicle.bMovable && (!vehicle.path.empty() || !vehicle.extra.empty());
        });
    }
    return _anyFixed.bAny;
}

bool Traffic::IsBlocked(const Lane& lane) const
{
    return IsAnyBlocked() && (_blockedNodes[lane.to] || _blockedEdges[lane.edge]);
}

bool Traffic::HasOpenStart(const Vehicle& vehicle) const
{
    return !IsAnyBlocked() || !vehicle.heading.has_value()
        || std::ranges::any_of(vehicle.graphs, [this, &vehicle](const LoadGraph& graph) {
               return std::ranges::any_of(
                   graph.floor->GetLanesFrom(vehicle.path.back()),
                   [this, &vehicle](const Lane& lane) { return lane.to == vehicle.heading && !IsBlocked(lane); });
           });
}

std::size_t Traffic::GetParking(const Vehicle& vehicle, ESafeStateScope scope) const
{
    return scope == ESafeStateScope::AsIs && IsAnyBlocked() ? vehicle.standIn.value_or(*vehicle.home) : *vehicle.home;
}

bool Traffic::IsHomeOfOther(const Vehicle& vehicle, std::size_t node) const
{
    const std::size_t own = vehicle.home.has_value() && IsNear(*vehicle.home, node) ? 1 : 0;
    return _homes[node] > own;
}

/// A route around covered nodes and the homes of others, so that the order of parking does not matter.
bool Traffic::HasWay(
    const Vehicle& vehicle,
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
            if (_scratch.seen[lane.to] != _scratch.search && covers[lane.to] == 0 && !IsHomeOfOther(vehicle, lane.to))
            {
                _scratch.seen[lane.to] = _scratch.search;
                _scratch.open.push_back(static_cast<std::uint32_t>(lane.to));
            }
        }
    }
    return false;
}

bool Traffic::HasStraightWayHome(
    const Vehicle& vehicle,
    const LoadGraph& graph,
    std::size_t from,
    const std::vector<std::uint16_t>& covers) const
{
    const bool bKnown = from == *vehicle.home || graph.nearest == _holders.size()
        || (!graph.nextToHome.empty() && graph.nextToHome[from] != NOWHERE);
    if (!bKnown)
    {
        FindWaysHome(graph, *vehicle.home, from);
    }
    for (std::size_t node = from; node != *vehicle.home; node = graph.nextToHome[node])
    {
        const std::uint32_t next = graph.nextToHome[node];
        if (next == NOWHERE || covers[next] > 0 || IsHomeOfOther(vehicle, next))
        {
            return false;
        }
    }
    return true;
}

/// covers: of all other robots. A route is needed with each load with which the map has one from there, so that a job that
/// changes the load leaves the state safe. A station that can be left with one load only needs that of this load: the job there
/// is assumed to end, as for every robot that works.
bool Traffic::CanGoHome(
    const Vehicle& vehicle,
    std::size_t from,
    const std::vector<std::uint16_t>& covers,
    ESafeStateScope scope)
{
    FindReturns();
    const auto returns = [from](const LoadGraph& graph) {
        return graph.returns[from];
    };
    return vehicle.bCanReturn && std::ranges::any_of(vehicle.graphs, returns)
        && std::ranges::all_of(
               vehicle.graphs,
               [this, &vehicle, &covers, &returns, from, scope](const LoadGraph& graph) {
                   const bool bAround = scope == ESafeStateScope::AsIs && IsAnyBlocked();
                   return !returns(graph) || (!bAround && HasStraightWayHome(vehicle, graph, from, covers))
                       || HasWay(vehicle, graph, from, GetParking(vehicle, scope), covers, scope);
               });
}

/// Robots that can park do so and free their nodes for the rest; the order makes no difference. All granted nodes of a robot
/// count as occupied until then, because it may stop on any of them.
Traffic::SafeState Traffic::FindSafeState(ESafeStateScope standing)
{
    SafeState found;
    found.reachable.assign(_vehicles.size(), false);
    found.bValid = true;
    std::vector<std::uint16_t> covers = _covers;
    std::vector<std::size_t> waiting;
    for (std::size_t i = 0; i < _vehicles.size(); ++i)
    {
        if (!_vehicles[i].path.empty() && (standing == ESafeStateScope::AllMove || _vehicles[i].bMovable))
        {
            waiting.push_back(i);
        }
    }
    for (bool bChanged = true; std::exchange(bChanged, false);)
    {
        const auto isGone = [this, &covers, &found, &bChanged, standing](std::size_t robot) {
            Vehicle& vehicle = _vehicles[robot];
            Cover(vehicle, covers, false);
            if (const std::optional<std::size_t> parking = ParkOrNull(vehicle, covers, standing); parking.has_value())
            {
                CoverNode(*parking, covers);
                found.reachable[robot] = true;
                bChanged = true;
                return true;
            }
            Cover(vehicle, covers, true);
            return false;
        };
        std::erase_if(waiting, isGone);
    }
    found.bAll = waiting.empty();
    return found;
}

const Traffic::SafeState& Traffic::GetSafeState(ESafeStateScope standing)
{
    if (!_safeStates[static_cast<std::size_t>(standing)].bValid)
    {
        _safeStates[static_cast<std::size_t>(standing)] = FindSafeState(standing);
    }
    return _safeStates[static_cast<std::size_t>(standing)];
}

bool Traffic::CanServe(std::size_t robot, std::size_t node) const
{
    const Vehicle& vehicle = _vehicles[robot];
    if (vehicle.path.empty() || !vehicle.home.has_value() || vehicle.graphs.empty()
        || (!IsAnyFixed() && !IsAnyBlocked()))
    {
        return true;
    }
    Served& served = vehicle.served;
    const std::size_t from = vehicle.path.back();
    if (served.fixedAt != _changes.fixed || served.from != from || served.heading != vehicle.heading
        || served.node != node)
    {
        served = {_changes.fixed, from, vehicle.heading, node, HasWayAround(vehicle, node)};
    }
    return served.bCan;
}

bool Traffic::HasWayAround(const Vehicle& vehicle, std::size_t node) const
{
    std::vector<std::uint16_t> covers(_covers.size(), 0);
    const std::vector<std::uint16_t> none = covers;
    for (const Vehicle& other : _vehicles)
    {
        if (!other.bMovable && &other != &vehicle)
        {
            Cover(other, covers, true);
        }
    }
    using EScope = ESafeStateScope;
    const auto canReach = [this, &vehicle, node](const std::vector<std::uint16_t>& covered, EScope scope) {
        return std::ranges::any_of(vehicle.graphs, [this, &vehicle, &covered, node, scope](const LoadGraph& graph) {
            return HasWay(vehicle, graph, GetEnd(vehicle), node, covered, scope);
        });
    };
    const auto canLeave =
        [this, &vehicle, node](const LoadGraph& graph, const std::vector<std::uint16_t>& covered, EScope scope) {
            return HasWay(vehicle, graph, node, GetParking(vehicle, scope), covered, scope);
        };
    const bool bLeaves = std::ranges::any_of(vehicle.graphs, [&canLeave, &none](const LoadGraph& graph) {
        return canLeave(graph, none, EScope::AllMove);
    });
    if (!bLeaves || !canReach(none, EScope::AllMove))
    {
        return true; // neither because of robots that cannot move nor because of blocks
    }
    return HasOpenStart(vehicle) && canReach(covers, EScope::AsIs)
        && std::ranges::all_of(vehicle.graphs, [&canLeave, &covers, &none](const LoadGraph& graph) {
               return canLeave(graph, covers, EScope::AsIs) || !canLeave(graph, none, EScope::AllMove);
           });
}

} // namespace ACS::Planning
