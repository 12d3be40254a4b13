#include "traffic/Traffic.hpp"

#include <algorithm>
#include <utility>

// Where robots can wait instead of parking.

namespace ACS::Planning
{

void Traffic::FindRefuges()
{
    const auto isDeadEnd = [this](std::size_t node) {
        return std::ranges::all_of(_graphs, [this, node](const auto& entry) {
            const bool bUsed = std::ranges::any_of(entry.second, [node](const FloorGraph& graph) {
                return !graph.GetLanesFrom(node).empty() || !graph.GetLanesTo(node).empty();
            });
            return !bUsed || IsSpur(entry.first, node);
        });
    };
    std::vector<bool> deadEnds(_holders.size());
    for (std::size_t node = 0; node < deadEnds.size(); ++node)
    {
        deadEnds[node] = isDeadEnd(node);
    }
    _refuges.assign(_holders.size(), false);
    for (std::size_t node = 0; node < deadEnds.size(); ++node)
    {
        _refuges[node] = std::ranges::all_of(_near[node], [&deadEnds](std::uint32_t near) { return deadEnds[near]; });
    }
}

bool Traffic::IsRefuge(std::size_t node) const
{
    return !_refuges.empty() && _refuges[node];
}

std::optional<std::size_t> Traffic::FindRefugeOrNull(std::size_t robot)
{
    FindReturns();
    Vehicle& vehicle = _vehicles[robot];
    const ESafeStateScope scope = IsAnyBlocked() || IsAnyFixed() ? ESafeStateScope::AsIs : ESafeStateScope::AllMove;
    if (vehicle.path.empty() || !vehicle.bCanReturn)
    {
        return std::nullopt;
    }
    std::optional<std::size_t> refuge = vehicle.refuges[static_cast<std::size_t>(scope)];
    Cover(vehicle, _covers, false);
    if (!refuge.has_value() || !CanGoTo(vehicle, GetEnd(vehicle), *refuge, _covers, scope))
    {
        refuge = FindRefugeOrNull(vehicle, GetEnd(vehicle), _covers, scope);
    }
    Cover(vehicle, _covers, true);
    return refuge;
}

void Traffic::CoverNode(std::size_t node, std::vector<std::uint16_t>& covers) const
{
    std::ranges::for_each(_near[node], [&covers](std::uint32_t near) { ++covers[near]; });
}

bool Traffic::IsRefugeFor(const Vehicle& vehicle, std::size_t node, ESafeStateScope scope) const
{
    const std::optional<std::size_t>& own = vehicle.refuges[static_cast<std::size_t>(scope)];
    const std::size_t ownClaims = own.has_value() && IsNear(*own, node) ? 1 : 0;
    return _refuges[node] && !IsHomeOfOther(vehicle, node)
        && _claims[static_cast<std::size_t>(scope)][node] <= ownClaims
        && std::ranges::all_of(vehicle.graphs, [node](const LoadGraph& graph) { return graph.returns[node]; });
}

void Traffic::ClaimRefuge(Vehicle& vehicle, std::optional<std::size_t> nodeOrNull, ESafeStateScope scope)
{
    std::vector<std::uint16_t>& claims = _claims[static_cast<std::size_t>(scope)];
    std::optional<std::size_t>& refuge = vehicle.refuges[static_cast<std::size_t>(scope)];
    if (refuge == nodeOrNull)
    {
        return;
    }
    if (refuge.has_value())
    {
        std::ranges::for_each(_near[*refuge], [&claims](std::uint32_t near) { --claims[near]; });
        ++_changes.refuges;
    }
    refuge = nodeOrNull;
    if (refuge.has_value())
    {
        std::ranges::for_each(_near[*refuge], [&claims](std::uint32_t near) { ++claims[near]; });
    }
}

/// What is found for one state holds for each state in which others hold less: so a refuge may be claimed even if the grant is
/// refused in the end.
std::optional<std::size_t> Traffic::FindParkingOrNull(
    Vehicle& vehicle,
    std::size_t from,
    const std::vector<std::uint16_t>& covers,
    ESafeStateScope scope)
{
    if (CanGoHome(vehicle, from, covers, scope))
    {
        ClaimRefuge(vehicle, std::nullopt, scope);
        return GetParking(vehicle, scope);
    }
    if (!vehicle.bCanReturn)
    {
        return std::nullopt;
    }
    const std::optional<std::size_t> former = vehicle.refuges[static_cast<std::size_t>(scope)];
    if (former.has_value() && IsRefugeFor(vehicle, *former, scope) && CanGoTo(vehicle, from, *former, covers, scope))
    {
        return former;
    }
    const std::optional<std::size_t> found = FindRefugeOrNull(vehicle, from, covers, scope);
    if (found.has_value())
    {
        ClaimRefuge(vehicle, found, scope);
    }
    return found;
}

/// With each load with which it may continue from there.
bool Traffic::CanGoTo(
    const Vehicle& vehicle,
    std::size_t from,
    std::size_t refuge,
    const std::vector<std::uint16_t>& covers,
    ESafeStateScope scope) const
{
    const auto returns = [from](const LoadGraph& graph) {
        return graph.returns[from];
    };
    return std::ranges::any_of(vehicle.graphs, returns)
        && std::ranges::all_of(
               vehicle.graphs,
               [this, &vehicle, &covers, &returns, from, refuge, scope](const LoadGraph& graph) {
                   return !returns(graph) || HasWay(vehicle, graph, from, refuge, covers, scope);
               });
}

/// The nearest one, by the number of nodes.
std::optional<std::size_t> Traffic::FindRefugeOrNull(
    const Vehicle& vehicle,
    std::size_t from,
    const std::vector<std::uint16_t>& covers,
    ESafeStateScope scope) const
{
    const auto isFound = [this, &vehicle, &covers, from, scope](std::size_t node) {
        return IsRefugeFor(vehicle, node, scope) && (node == from || covers[node] == 0)
            && (vehicle.graphs.size() == 1 || CanGoTo(vehicle, from, node, covers, scope));
    };
    if (isFound(from))
    {
        return from;
    }
    const bool bAround = scope == ESafeStateScope::AsIs && IsAnyBlocked();
    std::vector<std::size_t> open{from};
    std::vector<bool> seen(_holders.size(), false);
    seen[from] = true;
    for (std::size_t next = 0; next < open.size(); ++next)
    {
        for (const Lane& lane : vehicle.graphs.back().floor->GetLanesFrom(open[next]))
        {
            if (seen[lane.to] || covers[lane.to] > 0 || IsHomeOfOther(vehicle, lane.to) || (bAround && IsBlocked(lane)))
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

std::size_t Traffic::CountBeforeWayOut(std::size_t robot, std::span<const std::size_t> ahead, std::size_t target) const
{
    const std::vector<std::size_t> holders = GetHolders(target, robot);
    if (holders.empty() || ahead.empty())
    {
        return ahead.size();
    }
    std::vector<std::uint16_t> covers(_covers.size(), 0);
    Cover(_vehicles[robot], covers, true);
    const auto isClosed = [this, &covers](std::size_t holder) {
        const Vehicle& vehicle = _vehicles[holder];
        return vehicle.home.has_value() && !vehicle.path.empty()
            && std::ranges::none_of(vehicle.graphs, [this, &vehicle, &covers](const LoadGraph& graph) {
                   return HasWay(vehicle, graph, GetEnd(vehicle), *vehicle.home, covers, ESafeStateScope::AllMove);
               });
    };
    std::size_t count = 0;
    for (; count < ahead.size(); ++count)
    {
        CoverNode(ahead[count], covers);
        if (std::ranges::any_of(holders, isClosed))
        {
            break;
        }
    }
    return count;
}

} // namespace ACS::Planning
