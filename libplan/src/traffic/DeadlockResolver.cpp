#include "traffic/DeadlockResolver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace ACS::Planning
{

namespace
{

/// Limit per step; after that other robots must clear the route.
constexpr std::size_t DETOURS_AT_MOST = 3;

} // namespace

DeadlockResolver::DeadlockResolver(
    EngineState& engine,
    const TscControl& tsc,
    PlaceTracker& places,
    WaitingRobots& waiting,
    TrafficCoordinator& coordinator)
    : _site(engine.site),
      _admission(engine.admission),
      _fleet(engine.fleet),
      _transaction(engine.transaction),
      _tsc(tsc),
      _waiting(waiting),
      _coordinator(coordinator),
      _traffic(places.GetTraffic())
{
}

DeadlockResolver::Round DeadlockResolver::TryResolveDeadlock()
{
    const std::vector<Robot*> stuck = _waiting.ListDeadlocked();
    if (stuck.empty())
    {
        return {};
    }
    if (std::ranges::any_of(stuck, [this](Robot* robotOrNull) { return TryDetour(*robotOrNull); })
        || std::ranges::any_of(stuck, [this, &stuck](Robot* robotOrNull) { return TryMakeWay(*robotOrNull, stuck); }))
    {
        return {true, nullptr};
    }
    // The most urgent robot does not yield to one that waits, too.
    const auto helpable =
        std::ranges::find_if(stuck, [this](const Robot* robot) { return _waiting.IsHelpable(*robot); });
    Robot& first = **(helpable == stuck.end() ? stuck.begin() : helpable);
    if (first.drive.has_value() || !_waiting.IsYielding(first))
    {
        return {};
    }
    first.search.yield.reset();
    return {false, &first};
}

bool DeadlockResolver::TryDetour(Robot& robot)
{
    const bool bHome = robot.planOrNull == nullptr || robot.parking.retreatNode.has_value();
    const std::optional<std::size_t> target = _waiting.GetTargetOrNull(robot);
    if (!target.has_value() || robot.place.IsOn(target) || robot.control.bConfirming
        || _coordinator.FindTargetBlockOrNull(robot, *target) != nullptr
        || (!bHome && robot.search.detours >= DETOURS_AT_MOST) || !_waiting.GetTargetHolders(robot, *target).empty())
    {
        return false;
    }
    const auto isInTheWay = [this, &robot, bHome](std::size_t node) {
        if (bHome)
        {
            return !_traffic.IsOpenFor(node, robot.index);
        }
        const std::vector<std::size_t> holders = _traffic.GetHolders(node, robot.index);
        return std::ranges::any_of(holders, [this](std::size_t holder) { return !_waiting.IsMoving(_fleet[holder]); });
    };
    std::optional<PlannedRoute> detour = _coordinator.PlanRouteOrNull(robot, *target, isInTheWay);
    if (!detour.has_value())
    {
        return false;
    }
    const bool bBegun = robot.drive.has_value()
        ? _coordinator.TryReroute(robot, std::move(*detour), robot.parking.retreatNode.has_value())
        : _coordinator.TryBeginDrive(robot, *detour);
    robot.search.detours += bBegun && !bHome ? 1U : 0U;
    return bBegun;
}

bool DeadlockResolver::TryMakeWay(Robot& leader, const std::vector<Robot*>& stuck)
{
    if (leader.parking.retreatNode.has_value() || !_waiting.IsHelpable(leader))
    {
        return false;
    }
    const std::vector<Robot*> blockers = _waiting.GetBlockersOf(leader);
    const auto tryRetreat = [this, &leader](Robot* robotOrNull) {
        return robotOrNull != &leader && TryRetreat(*robotOrNull, leader);
    };
    if (std::ranges::any_of(blockers, tryRetreat) || std::any_of(stuck.rbegin(), stuck.rend(), tryRetreat))
    {
        return true;
    }
    if (std::ranges::count(blockers, &leader) > 0)
    {
        const auto other = std::ranges::find_if(blockers, [this, &leader](Robot* robot) {
            return robot != &leader && _waiting.IsWaiting(*robot);
        });
        if (other != blockers.end() && TryRetreat(leader, **other))
        {
            return true;
        }
    }
    return std::ranges::any_of(blockers, [this, &leader](Robot* robot) {
        return robot != &leader && TryStepAside(*robot, leader);
    });
}

bool DeadlockResolver::TryRetreat(Robot& robot, const Robot& leader)
{
    if (!_traffic.IsMovable(robot.index) || _waiting.IsMoving(robot) || robot.parking.bRefused
        || robot.control.bConfirming)
    {
        return false;
    }
    std::optional<PlannedRoute> plannedRoute = PlanRetreatOrNull(robot, leader);
    if (!plannedRoute.has_value())
    {
        return false;
    }
    const std::size_t target = plannedRoute->target;
    bool bBegun = false;
    if (robot.drive.has_value())
    {
        bBegun = _coordinator.TryReroute(robot, std::move(*plannedRoute), true);
    }
    else
    {
        robot.parking.retreatNode = target;
        bBegun = _coordinator.TryBeginDrive(robot, *plannedRoute);
        robot.parking.retreatNode = bBegun ? robot.parking.retreatNode : std::nullopt;
    }
    if (bBegun)
    {
        WaitingRobots::YieldTo(robot, leader);
        _transaction.Note(
            robot,
            fmt::format("drives to node {} to clear the route of {}", _site.GetNodes()[target].nodeID, leader.GetID()));
    }
    return bBegun;
}

/// To its parking position or, if that is nearer or the way there is not free, to its refuge. Where that is the target of the leader
/// and the only place that the robot could go to, to another refuge.
std::optional<PlannedRoute> DeadlockResolver::PlanRetreatOrNull(const Robot& robot, const Robot& leader)
{
    const std::optional<std::size_t> parking = robot.parking.GetParkingOrNull();
    const std::optional<std::size_t> ofLeader = _waiting.GetTargetOrNull(leader);
    const std::optional<std::size_t> refuge = _traffic.FindRefugeOrNull(robot.index);
    std::optional<PlannedRoute> best = PlanRetreatToOrNull(robot, parking);
    if (refuge == ofLeader && refuge != parking)
    {
        return best.has_value() ? best : PlanRetreatToOrNull(robot, _traffic.FindRefugeOrNull(robot.index, ofLeader));
    }
    std::optional<PlannedRoute> route = PlanRetreatToOrNull(robot, refuge);
    const bool bNearer =
        route.has_value() && (!best.has_value() || route->route.travelSeconds < best->route.travelSeconds);
    return bNearer ? route : best;
}

std::optional<PlannedRoute> DeadlockResolver::PlanRetreatToOrNull(
    const Robot& robot,
    std::optional<std::size_t> targetOrNull) const
{
    const bool bGoesThere = robot.drive.has_value() && robot.drive->nodes.back() == targetOrNull;
    if (!targetOrNull.has_value() || bGoesThere || robot.place.IsOn(targetOrNull)
        || robot.parking.retreatNode == targetOrNull || !_coordinator.IsOpenDock(*targetOrNull)
        || !_traffic.GetHolders(*targetOrNull, robot.index).empty())
    {
        return std::nullopt;
    }
    return _coordinator.PlanRouteOrNull(robot, *targetOrNull, [this, &robot](std::size_t node) {
        return !_traffic.IsOpenFor(node, robot.index);
    });
}

bool DeadlockResolver::TryStepAside(Robot& robot, const Robot& leader)
{
    const std::optional<std::size_t> wanted = _waiting.GetTargetOrNull(leader);
    const bool bInTheWay = leader.search.plannedRoute.has_value() && robot.place.node.has_value()
        && std::ranges::any_of(leader.search.plannedRoute->nodes,
                               [this, &robot](std::size_t node) { return _traffic.IsNear(node, *robot.place.node); });
    const bool bWorks = robot.planOrNull != nullptr && (robot.search.block.empty() || !_waiting.IsWaiting(robot));
    if (!bInTheWay || bWorks || robot.drive.has_value() || !_traffic.IsMovable(robot.index) || !_tsc.CanDriveHome()
        || robot.parking.bRefused || !wanted.has_value())
    {
        return false;
    }
    std::vector<bool> avoided(_site.GetNodes().size(), false);
    for (const Robot& other : _fleet)
    {
        for (const std::size_t node : other.search.plannedRoute.has_value() && &other != &robot
                 ? other.search.plannedRoute->nodes
                 : std::vector<std::size_t>())
        {
            avoided[node] = true;
        }
    }
    std::optional<PlannedRoute> best;
    for (const SiteStation& station : _site.GetStations())
    {
        const std::optional<std::size_t> dock =
            _admission.FindDockOrNull(station.stationID, robot.options->vehicleTypeID);
        if (!dock.has_value() || avoided[*dock] || !_coordinator.IsOpenDock(*dock) || dock == wanted
            || robot.place.IsOn(dock) || !_traffic.IsOpenFor(*dock, robot.index)
            || !_waiting.GetTargetHolders(robot, *dock).empty())
        {
            continue;
        }
        std::optional<PlannedRoute> plannedRoute =
            _coordinator.PlanRouteOrNull(robot, *dock, [this, &robot](std::size_t node) {
                return !_traffic.IsFreeFor(node, robot.index);
            });
        if (plannedRoute.has_value()
            && (!best.has_value() || plannedRoute->route.travelSeconds < best->route.travelSeconds))
        {
            best = std::move(plannedRoute);
        }
    }
    if (!best.has_value())
    {
        return false;
    }
    robot.parking.retreatNode = best->target;
    if (!_coordinator.TryBeginDrive(robot, *best))
    {
        robot.parking.retreatNode.reset();
        return false;
    }
    _transaction.Note(robot, fmt::format("moves aside to clear the route of {}", leader.GetID()));
    return true;
}

} // namespace ACS::Planning
