#include "traffic/Traffic.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <queue>
#include <utility>

namespace ACS::Planning
{

namespace
{

constexpr std::uint32_t NOWHERE = std::numeric_limits<std::uint32_t>::max();

} // namespace

/// A home on a lane, between the homes of others, has no guaranteed route back.
void Traffic::FindReturns()
{
    if (std::exchange(_bReturnsKnown, true))
    {
        return;
    }
    const std::vector<std::uint16_t> none(_covers.size(), 0);
    for (Vehicle& vehicle : _vehicles)
    {
        vehicle.bCanReturn =
            vehicle.home.has_value() && vehicle.graphOrNull != nullptr
            && std::ranges::any_of(
                vehicle.graphOrNull->GetLanesFrom(*vehicle.home),
                [this, &vehicle, &none](const Lane& lane) {
                    return !IsHomeOfOther(vehicle, lane.to) && HasWay(vehicle, lane.to, *vehicle.home, none);
                });
    }
}

/// Dijkstra's algorithm, backwards from the home.
void Traffic::FindWaysHome(Vehicle& vehicle) const
{
    using OpenNode = std::pair<double, std::size_t>;
    const FloorGraph& graph = *vehicle.graphOrNull;
    std::vector<double> seconds(_holders.size(), std::numeric_limits<double>::infinity());
    std::priority_queue<OpenNode, std::vector<OpenNode>, std::greater<>> open;
    vehicle.nextToHome.assign(_holders.size(), NOWHERE);
    seconds[*vehicle.home] = 0;
    open.emplace(0, *vehicle.home);
    while (!open.empty())
    {
        const auto [reached, node] = open.top();
        open.pop();
        if (reached > seconds[node])
        {
            continue;
        }
        for (const std::size_t index : graph.GetLanesTo(node))
        {
            const Lane& lane = graph.GetLanes()[index];
            if (reached + lane.seconds < seconds[lane.from])
            {
                seconds[lane.from] = reached + lane.seconds;
                vehicle.nextToHome[lane.from] = static_cast<std::uint32_t>(node);
                open.emplace(seconds[lane.from], lane.from);
            }
        }
    }
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
    return std::ranges::any_of(_vehicles, [](const Vehicle& vehicle) {
        return !vehicle.bMovable && (!vehicle.path.empty() || !vehicle.extra.empty());
    });
}

bool Traffic::IsHomeOfOther(const Vehicle& vehicle, std::size_t node) const
{
    const std::size_t own = vehicle.home.has_value() && IsNear(*vehicle.home, node) ? 1 : 0;
    return _homes[node] > own;
}

/// A route around covered nodes and the homes of others, so that the order of parking does not matter.
bool Traffic::HasWay(const Vehicle& vehicle, std::size_t from, std::size_t to, const std::vector<std::uint16_t>& covers)
    const
{
    if (from == to)
    {
        return true;
    }
    if (covers[to] > 0)
    {
        return false;
    }
    ++_search;
    _open.assign(1, static_cast<std::uint32_t>(from));
    _seen[from] = _search;
    for (std::size_t next = 0; next < _open.size(); ++next)
    {
        for (const Lane& lane : vehicle.graphOrNull->GetLanesFrom(_open[next]))
        {
            if (lane.to == to)
            {
                return true;
            }
            if (_seen[lane.to] != _search && covers[lane.to] == 0 && !IsHomeOfOther(vehicle, lane.to))
            {
                _seen[lane.to] = _search;
                _open.push_back(static_cast<std::uint32_t>(lane.to));
            }
        }
    }
    return false;
}

bool Traffic::HasStraightWayHome(const Vehicle& vehicle, std::size_t from, const std::vector<std::uint16_t>& covers)
    const
{
    for (std::size_t node = from; node != *vehicle.home; node = vehicle.nextToHome[node])
    {
        const std::uint32_t next = vehicle.nextToHome[node];
        if (next == NOWHERE || covers[next] > 0 || IsHomeOfOther(vehicle, next))
        {
            return false;
        }
    }
    return true;
}

/// covers: of all other robots.
bool Traffic::CanGoHome(const Vehicle& vehicle, std::size_t from, const std::vector<std::uint16_t>& covers)
{
    FindReturns();
    if (!vehicle.bCanReturn)
    {
        return false;
    }
    return HasStraightWayHome(vehicle, from, covers) || HasWay(vehicle, from, *vehicle.home, covers);
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
        const auto isGone = [this, &covers, &found, &bChanged](std::size_t robot) {
            const Vehicle& vehicle = _vehicles[robot];
            Cover(vehicle, covers, false);
            if (CanGoHome(vehicle, GetEnd(vehicle), covers))
            {
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

/// Whether each robot that could park before still can with the nodes held on trial. One that cannot is a blocker.
bool Traffic::IsAsGood(ESafeStateScope standing, std::size_t robot)
{
    const SafeState after = FindSafeState(standing);
    bool bGood = true;
    for (std::size_t other = 0; other < _vehicles.size(); ++other)
    {
        const bool bLost = _safeStates[static_cast<std::size_t>(standing)].reachable[other] && !after.reachable[other];
        bGood = bGood && !bLost;
        if (bLost && other != robot && std::ranges::count(_blockers, other) == 0)
        {
            _blockers.push_back(other);
        }
    }
    return bGood;
}

bool Traffic::IsSafe(std::size_t robot, std::span<const std::size_t> ahead)
{
    Vehicle& vehicle = _vehicles[robot];
    // A robot that can park before all others leaves the floor as if it had never been there.
    Cover(vehicle, _covers, false);
    const bool bFirst = vehicle.bMovable && CanGoHome(vehicle, ahead.back(), _covers);
    Cover(vehicle, _covers, true);
    if (bFirst)
    {
        return true;
    }
    // The present state, before the nodes are held on trial.
    static_cast<void>(GetSafeState(ESafeStateScope::AllMove));
    const std::size_t heldCount = vehicle.path.size();
    std::vector<std::size_t> held;
    const auto take = [this, robot, ahead, &vehicle, &held] {
        for (const std::size_t node : ahead)
        {
            vehicle.path.push_back(node);
            if (std::ranges::count(vehicle.extra, node) == 0)
            {
                Hold(robot, node);
                held.push_back(node);
            }
        }
    };
    const auto giveBack = [this, heldCount, &vehicle, &held] {
        vehicle.path.resize(heldCount);
        std::ranges::for_each(held, [this](std::size_t node) { Free(node); });
        held.clear();
    };
    take();
    bool bSafe = IsAsGood(ESafeStateScope::AllMove, robot);
    giveBack();
    if (bSafe && IsAnyFixed())
    {
        static_cast<void>(GetSafeState(ESafeStateScope::AsIs));
        take();
        bSafe = IsAsGood(ESafeStateScope::AsIs, robot);
        giveBack();
    }
    if (!bSafe && _blockers.empty())
    {
        _blockers = GetFixed(robot);
    }
    return bSafe;
}

bool Traffic::CanServe(std::size_t robot, std::size_t node) const
{
    const Vehicle& vehicle = _vehicles[robot];
    if (vehicle.path.empty() || !vehicle.home.has_value() || vehicle.graphOrNull == nullptr || !IsAnyFixed())
    {
        return true;
    }
    const auto canServe = [this, &vehicle, node](const std::vector<std::uint16_t>& covers) {
        return HasWay(vehicle, GetEnd(vehicle), node, covers) && HasWay(vehicle, node, *vehicle.home, covers);
    };
    std::vector<std::uint16_t> covers(_covers.size(), 0);
    const std::vector<std::uint16_t> none = covers;
    for (const Vehicle& other : _vehicles)
    {
        if (!other.bMovable && &other != &vehicle)
        {
            Cover(other, covers, true);
        }
    }
    return canServe(covers) || !canServe(none);
}

} // namespace ACS::Planning
