#include "traffic/Traffic.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <queue>
#include <utility>

namespace ACS::Planning
{

void Traffic::FindReturns()
{
    if (std::exchange(_bReturnsKnown, true))
    {
        return;
    }
    _ways.FindRefuges(_graphs);
    std::ranges::for_each(_vehicles, [this](Vehicle& vehicle) { _ways.FindReturns(vehicle.parking); });
}

void Traffic::Cover(const Vehicle& vehicle, std::vector<std::uint16_t>& covers, bool bAdd) const
{
    const auto change = [this, &covers, bAdd](std::size_t node) {
        for (const std::uint32_t near : _ways.GetNear(node))
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

bool Traffic::HasOpenStart(const Vehicle& vehicle) const
{
    return !_ways.IsAnyBlocked() || !vehicle.heading.has_value()
        || std::ranges::any_of(vehicle.parking.graphs, [this, &vehicle](const LoadGraph& graph) {
               return std::ranges::any_of(
                   graph.floor->GetLanesFrom(vehicle.path.back()),
                   [this, &vehicle](const Lane& lane) { return lane.to == vehicle.heading && !_ways.IsBlocked(lane); });
           });
}

/// Robots that can park do so and free their nodes for the rest; the order makes no difference. All granted nodes of a robot
/// count as occupied until then, because it may stop on any of them.
Traffic::SafeState Traffic::FindSafeState(ESafeStateScope standing)
{
    SafeState found;
    found.reachable.assign(_vehicles.size(), false);
    FindReturns();
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
    std::optional<SafeState>& safeState = _safeStates[static_cast<std::size_t>(standing)];
    if (!safeState.has_value())
    {
        safeState = FindSafeState(standing);
    }
    return *safeState;
}

bool Traffic::CanServe(std::size_t robot, std::size_t node) const
{
    const Vehicle& vehicle = _vehicles[robot];
    if (vehicle.path.empty() || !vehicle.parking.home.has_value() || vehicle.parking.graphs.empty()
        || (!IsAnyFixed() && !_ways.IsAnyBlocked()))
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
        return std::ranges::any_of(
            vehicle.parking.graphs,
            [this, &vehicle, &covered, node, scope](const LoadGraph& graph) {
                return _ways.HasWay(vehicle.parking, graph, GetEnd(vehicle), node, covered, scope);
            });
    };
    const auto canLeave =
        [this, &vehicle, node](const LoadGraph& graph, const std::vector<std::uint16_t>& covered, EScope scope) {
            return _ways.HasWay(vehicle.parking, graph, node, _ways.GetParking(vehicle.parking, scope), covered, scope);
        };
    const bool bLeaves = std::ranges::any_of(vehicle.parking.graphs, [&canLeave, &none](const LoadGraph& graph) {
        return canLeave(graph, none, EScope::AllMove);
    });
    if (!bLeaves || !canReach(none, EScope::AllMove))
    {
        return true; // neither because of robots that cannot move nor because of blocks
    }
    return HasOpenStart(vehicle) && canReach(covers, EScope::AsIs)
        && std::ranges::all_of(vehicle.parking.graphs, [&canLeave, &covers, &none](const LoadGraph& graph) {
               return canLeave(graph, covers, EScope::AsIs) || !canLeave(graph, none, EScope::AllMove);
           });
}

} // namespace ACS::Planning
