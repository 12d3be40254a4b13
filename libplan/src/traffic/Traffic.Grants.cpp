#include "traffic/Traffic.hpp"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <utility>

// Whether nodes can be granted.

namespace ACS::Planning
{

/// Whether each robot that could park before still can with the nodes held on trial. One that cannot is a blocker.
bool Traffic::IsAsGood(ESafeStateScope standing, std::size_t robot, Refusal& refusal)
{
    const std::optional<SafeState>& before = _safeStates[static_cast<std::size_t>(standing)];
    assert(before.has_value()); // see IsSafe
    const SafeState after = FindSafeState(standing);
    bool bGood = true;
    refusal.stuck.clear();
    for (std::size_t other = 0; other < _vehicles.size(); ++other)
    {
        const bool bLost = before->reachable[other] && !after.reachable[other];
        bGood = bGood && !bLost;
        if (bLost && other != robot && std::ranges::count(_blockers, other) == 0)
        {
            _blockers.push_back(other);
        }
        if (!after.reachable[other] && !_vehicles[other].path.empty())
        {
            refusal.stuck.emplace_back(other, _vehicles[other].changes);
        }
    }
    return bGood;
}

std::optional<std::size_t> Traffic::ParkOrNull(
    Vehicle& vehicle,
    const std::vector<std::uint16_t>& covers,
    ESafeStateScope scope)
{
    if (vehicle.path.empty() || (scope == ESafeStateScope::AsIs && (!vehicle.bMovable || !HasOpenStart(vehicle))))
    {
        return std::nullopt;
    }
    return _ways.FindParkingOrNull(vehicle.parking, GetEnd(vehicle), covers, scope);
}

/// Others that hold nodes on its quickest route home.
void Traffic::AddInTheWay(const Vehicle& vehicle, std::vector<std::size_t>& robots) const
{
    if (vehicle.path.empty())
    {
        return;
    }
    for (const LoadGraph& graph : vehicle.parking.graphs)
    {
        if (graph.nextToHome.empty())
        {
            continue;
        }
        for (std::uint32_t node = graph.nextToHome[GetEnd(vehicle)]; node != ParkingWays::NOWHERE;
             node = graph.nextToHome[node])
        {
            for (const std::uint32_t near : _ways.GetNear(node))
            {
                const std::optional<std::size_t>& holder = _holders[near];
                if (holder.has_value() && std::ranges::count(robots, *holder) == 0)
                {
                    robots.push_back(*holder);
                }
            }
        }
    }
}

/// If the robot can park before the others, all others can do afterwards what they could do before: the grant is safe. So the
/// floor need not be searched beyond the robots that are in its way.
bool Traffic::CanParkSoon(std::size_t robot, ESafeStateScope scope)
{
    constexpr std::size_t MOST_ROBOTS = 32;
    std::vector<std::uint16_t> covers = _covers;
    std::vector<std::size_t> robots{robot};
    std::vector<bool> gone(1, false);
    for (bool bChanged = true; std::exchange(bChanged, false);)
    {
        for (std::size_t i = 0; i < robots.size() && robots.size() <= MOST_ROBOTS; ++i)
        {
            gone.resize(robots.size(), false);
            Vehicle& vehicle = _vehicles[robots[i]];
            if (gone[i])
            {
                continue;
            }
            Cover(vehicle, covers, false);
            const std::optional<std::size_t> parking = ParkOrNull(vehicle, covers, scope);
            gone[i] = parking.has_value();
            bChanged = bChanged || gone[i];
            if (gone[i] && i == 0)
            {
                return true;
            }
            if (gone[i])
            {
                CoverNode(*parking, covers);
            }
            else
            {
                Cover(vehicle, covers, true);
                AddInTheWay(vehicle, robots);
            }
        }
    }
    return false;
}

bool Traffic::IsRefusedStill(const Refusal& refusal, std::span<const std::size_t> ahead) const
{
    return refusal.disturbedAt == _changes.disturbs && refusal.fixedAt == _changes.fixed
        && refusal.refugesAt == _changes.refuges + _ways.GetReleasedCount() && !refusal.stuck.empty()
        && std::ranges::equal(refusal.ahead, ahead)
        && std::ranges::all_of(refusal.stuck, [this](const std::pair<std::size_t, std::uint64_t>& robot) {
               return _vehicles[robot.first].changes == robot.second;
           });
}

void Traffic::AddBlockers(const std::vector<std::size_t>& robots)
{
    std::ranges::copy_if(robots, std::back_inserter(_blockers), [this](std::size_t robot) {
        return std::ranges::count(_blockers, robot) == 0;
    });
}

/// A robot that can go home before all others leaves the floor as if it had never been there.
bool Traffic::TryLeaveFirst(std::size_t robot, std::size_t from)
{
    Vehicle& vehicle = _vehicles[robot];
    Cover(vehicle, _covers, false);
    const bool bLeaves = vehicle.bMovable
        && _ways.TryClaimHome(vehicle.parking, from, _covers, ESafeStateScope::AllMove)
        && (!_ways.IsAnyBlocked() || _ways.TryClaimHome(vehicle.parking, from, _covers, ESafeStateScope::AsIs));
    Cover(vehicle, _covers, true);
    return bLeaves;
}

bool Traffic::TryTakeRefuge(std::size_t robot, std::size_t from, bool bAsIs)
{
    Vehicle& vehicle = _vehicles[robot];
    Cover(vehicle, _covers, false);
    const bool bTakes = vehicle.bMovable
        && _ways.FindParkingOrNull(vehicle.parking, from, _covers, ESafeStateScope::AllMove).has_value()
        && (!bAsIs || _ways.FindParkingOrNull(vehicle.parking, from, _covers, ESafeStateScope::AsIs).has_value());
    Cover(vehicle, _covers, true);
    return bTakes;
}

bool Traffic::IsSafe(std::size_t robot, std::span<const std::size_t> ahead)
{
    FindReturns();
    Vehicle& vehicle = _vehicles[robot];
    Refusal& refusal = vehicle.refusals[ahead.size() == 1 ? 1 : 0];
    if (IsRefusedStill(refusal, ahead))
    {
        AddBlockers(refusal.blockers);
        _bBlocksRefuse = _bBlocksRefuse || refusal.bForBlocks;
        return false;
    }
    const bool bAsIs = IsAnyFixed() || _ways.IsAnyBlocked();
    if (TryLeaveFirst(robot, ahead.back()))
    {
        return true;
    }
    // Which refuges the other robots need, before this one takes one; also the state before the nodes are held on trial.
    static_cast<void>(GetSafeState(ESafeStateScope::AllMove));
    if (bAsIs)
    {
        static_cast<void>(GetSafeState(ESafeStateScope::AsIs));
    }
    if (TryTakeRefuge(robot, ahead.back(), bAsIs))
    {
        return true;
    }
    const std::size_t heldCount = vehicle.path.size();
    const std::optional<std::size_t> heading = vehicle.heading;
    const std::vector<std::size_t> extra = vehicle.extra;
    std::vector<std::size_t> held;
    const auto take = [this, robot, ahead, &vehicle, &held] {
        _bTrial = true;
        vehicle.heading.reset();
        for (const std::size_t node : ahead)
        {
            vehicle.path.push_back(node);
            if (std::erase(vehicle.extra, node) == 0)
            {
                Hold(robot, node);
                held.push_back(node);
            }
        }
    };
    const auto giveBack = [this, heldCount, heading, &extra, &vehicle, &held] {
        vehicle.heading = heading;
        vehicle.path.resize(heldCount);
        vehicle.extra = extra;
        std::ranges::for_each(held, [this](std::size_t node) { Free(node); });
        held.clear();
        _bTrial = false;
    };
    take();
    const bool bSoon = CanParkSoon(robot, ESafeStateScope::AllMove)
        && (!bAsIs || (vehicle.bMovable && CanParkSoon(robot, ESafeStateScope::AsIs)));
    giveBack();
    if (bSoon)
    {
        return true;
    }
    const std::vector<std::size_t> former = std::exchange(_blockers, {});
    take();
    bool bSafe = IsAsGood(ESafeStateScope::AllMove, robot, refusal);
    giveBack();
    _bBlocksRefuse = false;
    if (bSafe && bAsIs)
    {
        take();
        bSafe = IsAsGood(ESafeStateScope::AsIs, robot, refusal);
        giveBack();
        _bBlocksRefuse = !bSafe && _ways.IsAnyBlocked();
    }
    if (!bSafe && _blockers.empty() && former.empty())
    {
        _blockers = GetFixed(robot);
    }
    refusal.ahead.assign(ahead.begin(), ahead.end());
    refusal.blockers = std::exchange(_blockers, former);
    AddBlockers(refusal.blockers);
    refusal.bForBlocks = _bBlocksRefuse;
    refusal.disturbedAt = _changes.disturbs;
    refusal.fixedAt = _changes.fixed;
    refusal.refugesAt = _changes.refuges + _ways.GetReleasedCount();
    if (bSafe)
    {
        refusal.stuck.clear();
    }
    return bSafe;
}

} // namespace ACS::Planning
