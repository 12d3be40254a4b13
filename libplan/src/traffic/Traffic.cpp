#include "traffic/Traffic.hpp"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <numeric>
#include <utility>

namespace ACS::Planning
{

Traffic::Traffic(const SiteMap& site, double clearance)
    : _ways(site, clearance),
      _holders(site.GetNodes().size()),
      _covers(_holders.size(), 0),
      _arriving(_holders.size())
{
    for (const SiteEdge& edge : site.GetEdges())
    {
        for (const SiteEdgeRule& rule : edge.rules)
        {
            const auto [entry, bNew] = _graphs.try_emplace(rule.vehicleTypeID);
            if (bNew && IsLoadRestricted(site, rule.vehicleTypeID))
            {
                entry->second.emplace_back(site, rule.vehicleTypeID, ELoad::Empty);
                entry->second.emplace_back(site, rule.vehicleTypeID, ELoad::Loaded);
            }
            else if (bNew)
            {
                entry->second.emplace_back(site, rule.vehicleTypeID, ELoad::Unknown);
            }
        }
    }
}

void Traffic::AddRobot(std::string_view vehicleTypeID, std::optional<std::size_t> homeOrNull)
{
    Vehicle& vehicle = _vehicles.emplace_back();
    const auto found = _graphs.find(vehicleTypeID);
    vehicle.parking.home = homeOrNull;
    for (const FloorGraph& floor :
         found == _graphs.end() ? std::span<const FloorGraph>() : std::span<const FloorGraph>(found->second))
    {
        vehicle.parking.graphs.emplace_back().floor = &floor;
    }
    if (homeOrNull.has_value())
    {
        _ways.AddHome(*homeOrNull);
    }
    _bReturnsKnown = false;
    ++_changes.fixed;
    Note(false);
}

void Traffic::SetBlocked(const std::vector<bool>& nodes, const std::vector<bool>& edges)
{
    _ways.SetBlocked(nodes, edges);
    ++_changes.fixed;
    Note(false);
}

void Traffic::SetStandIn(std::size_t robot, std::optional<std::size_t> standInOrNull)
{
    Parking& parking = _vehicles[robot].parking;
    if (parking.standIn != standInOrNull)
    {
        _ways.SetStandIn(parking, standInOrNull);
        ++_changes.fixed;
        Note(false);
    }
}

bool Traffic::IsRefusedForBlocks() const noexcept
{
    return _bBlocksRefuse;
}

bool Traffic::IsSpur(std::string_view vehicleTypeID, std::size_t node) const
{
    const auto found = _graphs.find(vehicleTypeID);
    return found != _graphs.end() && IsDeadEnd(found->second, node);
}

const std::vector<std::uint32_t>& Traffic::GetNear(std::size_t node) const
{
    return _ways.GetNear(node);
}

bool Traffic::IsNear(std::size_t left, std::size_t right) const
{
    return _ways.IsNear(left, right);
}

void Traffic::SetMovable(std::size_t robot, bool bMovable)
{
    if (std::exchange(_vehicles[robot].bMovable, bMovable) != bMovable)
    {
        ++_changes.fixed;
        Note(false);
    }
}

bool Traffic::IsMovable(std::size_t robot) const
{
    return _vehicles[robot].bMovable;
}

std::size_t Traffic::GetEnd(const Vehicle& vehicle)
{
    return vehicle.heading.value_or(vehicle.path.back());
}

/// A safe state of all robots remains one where nodes were only given back or granted.
void Traffic::Note(bool bOnlyFreed)
{
    bOnlyFreed = !std::exchange(_bPassedOn, false) && bOnlyFreed;
    for (std::optional<SafeState>& safeState : _safeStates)
    {
        if (!bOnlyFreed || !safeState.has_value() || !safeState->bAll)
        {
            safeState.reset();
        }
    }
    _changes.disturbs += bOnlyFreed ? 0U : 1U;
    ++_changes.freed;
}

void Traffic::NoteFixed(std::size_t robot)
{
    _vehicles[robot].changes += _bTrial ? 0U : 1U;
    if (!_vehicles[robot].bMovable)
    {
        ++_changes.fixed;
    }
}

void Traffic::Hold(std::size_t robot, std::size_t node)
{
    NoteFixed(robot);
    _holders[node] = robot;
    for (const std::uint32_t near : _ways.GetNear(node))
    {
        ++_covers[near];
    }
}

void Traffic::Free(std::size_t node)
{
    NoteFixed(*_holders[node]);
    _holders[node].reset();
    _changes.refuges += !_bTrial && _ways.IsRefuge(node) ? 1U : 0U;
    for (const std::uint32_t near : _ways.GetNear(node))
    {
        --_covers[near];
    }
}

/// A robot that awaits the node gets it at once: no other robot can reserve it in between.
void Traffic::GiveBack(std::size_t node)
{
    Free(node);
    const auto waiting = std::ranges::find(_awaited, node, &Awaited::node);
    if (waiting == _awaited.end())
    {
        return;
    }
    const std::size_t robot = waiting->robot;
    _awaited.erase(waiting);
    Hold(robot, node);
    _vehicles[robot].extra.push_back(node);
    _bPassedOn = true;
}

bool Traffic::TryStand(
    std::size_t robot,
    std::size_t node,
    std::span<const std::size_t> extra,
    std::span<const std::size_t> possible)
{
    const auto isOthers = [this, robot](std::size_t wanted) {
        return _holders[wanted].has_value() && _holders[wanted] != robot;
    };
    if (isOthers(node) || std::ranges::any_of(extra, isOthers))
    {
        return false;
    }
    std::vector<std::size_t> wanted(extra.begin(), extra.end());
    wanted.insert(wanted.end(), possible.begin(), possible.end());
    // Nodes that it holds already affect no other robot.
    const auto isOwn = [this, robot](std::size_t held) {
        return _holders[held] == robot;
    };
    const bool bHeld = isOwn(node) && std::ranges::all_of(wanted, isOwn);
    Vehicle& vehicle = _vehicles[robot];
    ++vehicle.changes;
    vehicle.heading.reset();
    std::vector<std::size_t> held = std::exchange(vehicle.path, {node});
    std::ranges::move(std::exchange(vehicle.extra, {}), std::back_inserter(held));
    std::erase_if(_awaited, [robot](const Awaited& awaited) { return awaited.robot == robot; });
    if (!isOwn(node))
    {
        Hold(robot, node);
    }
    for (const std::size_t old : held)
    {
        if (old != node && std::ranges::count(wanted, old) == 0)
        {
            GiveBack(old);
        }
        else if (old != node && std::ranges::count(vehicle.extra, old) == 0)
        {
            vehicle.extra.push_back(old);
        }
    }
    HoldPossible(robot, wanted);
    Note(bHeld);
    return true;
}

void Traffic::SetHeading(std::size_t robot, std::optional<std::size_t> headingOrNull)
{
    if (headingOrNull.has_value() && _holders[*headingOrNull] != robot)
    {
        headingOrNull.reset(); // another robot is there
    }
    if (std::exchange(_vehicles[robot].heading, headingOrNull) != headingOrNull)
    {
        Note(false);
    }
}

void Traffic::HoldPossible(std::size_t robot, std::span<const std::size_t> nodes)
{
    for (const std::size_t node : nodes)
    {
        if (!_holders[node].has_value())
        {
            Hold(robot, node);
            _vehicles[robot].extra.push_back(node);
            Note(false);
        }
        else if (const Awaited awaited{robot, node};
                 _holders[node] != robot && std::ranges::count(_awaited, awaited) == 0)
        {
            _awaited.push_back(awaited);
        }
    }
}

void Traffic::SetDestination(std::size_t robot, std::optional<std::size_t> nodeOrNull)
{
    std::optional<std::size_t>& destination = _vehicles[robot].destination;
    if (destination.has_value())
    {
        std::erase(_arriving[*destination], robot);
    }
    destination = nodeOrNull;
    if (destination.has_value())
    {
        _arriving[*destination].push_back(robot);
    }
}

std::vector<std::size_t> Traffic::GetArriving(std::size_t node) const
{
    std::vector<std::size_t> robots;
    for (const std::uint32_t near : _ways.GetNear(node))
    {
        robots.insert(robots.end(), _arriving[near].begin(), _arriving[near].end());
    }
    std::ranges::sort(robots);
    return robots;
}

void Traffic::Disown(std::size_t robot, std::size_t node)
{
    std::erase(_awaited, Awaited{robot, node});
    if (std::erase(_vehicles[robot].extra, node) > 0)
    {
        GiveBack(node);
        Note(true);
    }
}

std::size_t Traffic::Extend(std::size_t robot, std::span<const std::size_t> ahead)
{
    _blockers.clear();
    _bBlocksRefuse = false;
    Vehicle& vehicle = _vehicles[robot];
    assert(!vehicle.path.empty());
    std::size_t count = 0;
    const auto isBlocked = [this](std::size_t node) {
        return _ways.IsBlocked(node);
    };
    // A node that it holds already and is to pass again is granted when it has passed it the first time.
    while (count < ahead.size() && IsFreeFor(ahead[count], robot) && !isBlocked(ahead[count])
           && std::ranges::count(vehicle.path, ahead[count]) == 0)
    {
        ++count;
    }
    if (count == 0)
    {
        _blockers = ahead.empty() ? std::vector<std::size_t>() : GetHolders(ahead.front(), robot);
        _bBlocksRefuse = !ahead.empty() && isBlocked(ahead.front());
        return 0;
    }
    if (!IsSafe(robot, ahead.first(count)))
    {
        // The next node at least; the others are requested again later.
        count = count > 1 && IsSafe(robot, ahead.first(1)) ? 1 : 0;
    }
    for (const std::size_t node : ahead.first(count))
    {
        if (std::erase(vehicle.extra, node) == 0)
        {
            Hold(robot, node);
        }
        vehicle.path.push_back(node);
    }
    if (count > 0)
    {
        ++vehicle.changes;
        vehicle.heading.reset();
        _blockers.clear();
        _bBlocksRefuse = false;
        Note(true);
    }
    return count;
}

bool Traffic::TryOverrun(std::size_t robot, std::span<const std::size_t> ahead)
{
    Vehicle& vehicle = _vehicles[robot];
    const bool bTaken = std::ranges::any_of(ahead, [this, &vehicle](std::size_t node) {
        return _holders[node].has_value() && std::ranges::count(vehicle.extra, node) == 0;
    });
    if (bTaken)
    {
        return false;
    }
    for (const std::size_t node : ahead)
    {
        if (std::erase(vehicle.extra, node) == 0)
        {
            Hold(robot, node);
        }
        vehicle.path.push_back(node);
    }
    Note(false);
    return true;
}

void Traffic::Pass(std::size_t robot, std::size_t count)
{
    Vehicle& vehicle = _vehicles[robot];
    assert(count < vehicle.path.size());
    for (std::size_t i = 0; i < count; ++i)
    {
        GiveBack(vehicle.path[i]);
    }
    vehicle.path.erase(vehicle.path.begin(), vehicle.path.begin() + static_cast<std::ptrdiff_t>(count));
    if (count > 0)
    {
        std::erase_if(_awaited, [robot](const Awaited& awaited) { return awaited.robot == robot; });
        std::ranges::for_each(std::exchange(vehicle.extra, {}), [this](std::size_t node) { GiveBack(node); });
        Note(true);
    }
}

void Traffic::Shorten(std::size_t robot, std::size_t count)
{
    Vehicle& vehicle = _vehicles[robot];
    assert(count > 0);
    while (vehicle.path.size() > count)
    {
        GiveBack(vehicle.path.back());
        vehicle.path.pop_back();
    }
    Note(true);
}

std::optional<std::size_t> Traffic::GetHolderOrNull(std::size_t node) const
{
    return _holders[node];
}

std::span<const std::size_t> Traffic::GetHeld(std::size_t robot) const
{
    return _vehicles[robot].path;
}

std::vector<std::size_t> Traffic::ListReserved(std::size_t robot) const
{
    std::vector<std::size_t> nodes = _vehicles[robot].path;
    nodes.insert(nodes.end(), _vehicles[robot].extra.begin(), _vehicles[robot].extra.end());
    return nodes;
}

bool Traffic::IsFreeFor(std::size_t node, std::size_t robot) const
{
    return _covers[node] == 0 || std::ranges::all_of(_ways.GetNear(node), [this, robot](std::uint32_t near) {
               return !_holders[near].has_value() || _holders[near] == robot;
           });
}

bool Traffic::IsOpenFor(std::size_t node, std::size_t robot) const
{
    return IsFreeFor(node, robot) && !_ways.IsHomeOfOther(_vehicles[robot].parking, node);
}

bool Traffic::IsRefugeOfOther(std::size_t node, std::size_t robot) const
{
    return _ways.IsRefugeOfOther(_vehicles[robot].parking, node, ESafeStateScope::AsIs);
}

std::vector<std::size_t> Traffic::GetHolders(std::size_t node, std::size_t robot) const
{
    std::vector<std::size_t> holders;
    for (const std::uint32_t near : _ways.GetNear(node))
    {
        const std::optional<std::size_t>& holder = _holders[near];
        if (holder.has_value() && *holder != robot && std::ranges::count(holders, *holder) == 0)
        {
            holders.push_back(*holder);
        }
    }
    return holders;
}

const std::vector<std::size_t>& Traffic::GetBlockers() const noexcept
{
    return _blockers;
}

std::vector<std::size_t> Traffic::GetFixed(std::size_t robot) const
{
    std::vector<std::size_t> fixed;
    for (std::size_t other = 0; other < _vehicles.size(); ++other)
    {
        const bool bHolds = !_vehicles[other].path.empty() || !_vehicles[other].extra.empty();
        if (other != robot && !_vehicles[other].bMovable && bHolds)
        {
            fixed.push_back(other);
        }
    }
    return fixed;
}

std::uint64_t Traffic::GetFreedCount() const noexcept
{
    return _changes.freed;
}

} // namespace ACS::Planning
