#include "engine/PlanEngine.Impl.hpp"
#include <acs/core/Uuid.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <set>
#include <span>
#include <utility>

namespace ACS::Planning
{

/// The parking position of a robot without a home is the first free station beside the lanes with a route there and back. The
/// robot goes there only to make way.
void PlanEngine::Impl::AssignParking()
{
    std::set<std::size_t> taken;
    for (const Robot& robot : _robots)
    {
        if (robot.homeNode.has_value())
        {
            taken.insert(*robot.homeNode);
        }
        if (robot.chargeNode.has_value())
        {
            taken.insert(*robot.chargeNode);
        }
    }
    for (Robot& robot : _robots)
    {
        const RobotOptions& options = *robot.options;
        robot.parkingNode = robot.homeNode.has_value() ? robot.homeNode : robot.chargeNode;
        for (const SiteStation& station : _site.GetStations())
        {
            const std::optional<std::size_t> dock = _admission.FindDockOrNull(station.stationID, options.vehicleTypeID);
            if (!robot.parkingNode.has_value() && dock.has_value() && CanParkAt(options, *dock)
                && taken.insert(*dock).second)
            {
                robot.parkingNode = dock;
            }
        }
        _traffic.AddRobot(options.vehicleTypeID, robot.parkingNode);
        if (options.startNodeID.has_value())
        {
            const bool bStands = _traffic.TryStand(robot.index, *_site.FindNodeIndexOrNull(*options.startNodeID));
            assert(bStands);
            static_cast<void>(bStands);
        }
    }
}

bool PlanEngine::Impl::CanParkAt(const RobotOptions& robot, std::size_t dock) const
{
    if (!_traffic.IsSpur(robot.vehicleTypeID, dock))
    {
        return false;
    }
    const std::string& dockID = _site.GetNodes()[dock].nodeID;
    const std::string& startID = robot.startNodeID.value_or(dockID);
    return _router.FindRouteOrNull(robot.vehicleTypeID, startID, dockID).has_value()
        && _router.FindRouteOrNull(robot.vehicleTypeID, dockID, startID).has_value();
}

/// A robot that is not able to drive now is an obstacle for the others.
void PlanEngine::Impl::NoteMovable(const Robot& robot)
{
    const bool bMovable = IsUsable(robot) && !robot.pause.IsPaused();
    if (_traffic.IsMovable(robot.index) != bMovable)
    {
        _traffic.SetMovable(robot.index, bMovable);
        ++_standingChanges;
        _bDispatchNeeded = true;
    }
}

/// Whether its drive is to be given more. A robot that is out of reach may still tell of nodes, and then goes on.
bool PlanEngine::Impl::CanAdvance(const Robot& robot)
{
    return IsUsable(robot) ? !robot.pause.IsPaused() : !robot.bOnline && !robot.pause.IsPaused() && !IsHeld(robot);
}

/// Whether those that cannot move leave it a way to all places of the plan and from each of them home.
bool PlanEngine::Impl::CanServe(const Robot& robot, const ActivePlan& plan) const
{
    return std::ranges::all_of(plan.resolved.steps, [this, &robot](const ResolvedStep& step) {
        const std::optional<std::size_t> dock = _admission.FindDockOrNull(step.stationID, robot.options->vehicleTypeID);
        return !dock.has_value() || _traffic.CanServe(robot.index, *dock);
    });
}

/// Those with plans in the order of their plans, then those without.
bool PlanEngine::Impl::IsMoreUrgent(const Robot* left, const Robot* right)
{
    if (left->planOrNull != nullptr && right->planOrNull != nullptr)
    {
        return left->planOrNull->key < right->planOrNull->key;
    }
    if (left->planOrNull != nullptr || right->planOrNull != nullptr)
    {
        return left->planOrNull != nullptr;
    }
    return left->index < right->index;
}

/// Robots that must get to a place and stand, in the order of their plans.
std::vector<PlanEngine::Impl::Robot*> PlanEngine::Impl::GetWaiting()
{
    std::vector<Robot*> waiting;
    for (Robot& robot : _robots)
    {
        if (robot.activity == EActivity::Waits && !robot.drive.has_value() && IsUsable(robot))
        {
            waiting.push_back(&robot);
        }
    }
    std::ranges::sort(waiting, IsMoreUrgent);
    return waiting;
}

/// Robots without work that stand elsewhere than at home.
std::vector<PlanEngine::Impl::Robot*> PlanEngine::Impl::ListAwayFromHome()
{
    std::vector<Robot*> away;
    for (Robot& robot : _robots)
    {
        const bool bIdle = robot.planOrNull == nullptr && !robot.drive.has_value() && !robot.bHomeRefused;
        if (bIdle && IsUsable(robot) && robot.homeNode.has_value() && robot.homeNode != robot.node)
        {
            away.push_back(&robot);
        }
    }
    return away;
}

std::optional<std::size_t> PlanEngine::Impl::GetTargetOrNull(const Robot& robot) const
{
    if (robot.retreatNode.has_value() || robot.planOrNull == nullptr)
    {
        return robot.retreatNode.has_value() ? robot.retreatNode : robot.homeNode;
    }
    return _admission.FindDockOrNull(
        robot.planOrNull->resolved.steps[robot.planOrNull->step].stationID,
        robot.options->vehicleTypeID);
}

/// Other robots that stand on the target, or drive to it. Nobody sets out for a place that another one has first: so
/// who waits for a place waits at a place, and not on a lane.
std::vector<std::size_t> PlanEngine::Impl::GetTargetHolders(const Robot& robot, std::size_t target) const
{
    std::vector<std::size_t> holders = _traffic.GetHolders(target, robot.index);
    for (const Robot& other : _robots)
    {
        if (&other != &robot && other.drive.has_value() && _traffic.IsNear(other.drive->nodes.back(), target)
            && std::ranges::count(holders, other.index) == 0)
        {
            holders.push_back(other.index);
        }
    }
    return holders;
}

/// Robots under way first, as they stand where others want to pass.
void PlanEngine::Impl::MoveWaiting()
{
    ExtendDrives();
    for (Robot* robot : GetWaiting())
    {
        const std::vector<std::size_t> blockers = robot->blockers;
        static_cast<void>(TryDrive(*robot));
        robot->bTouched = robot->bTouched || robot->blockers != blockers;
    }
}

void PlanEngine::Impl::ExtendDrives()
{
    std::vector<Robot*> driving;
    for (Robot& robot : _robots)
    {
        if (!robot.drive.has_value() || !robot.drive->bConfirmed || !_traffic.IsMovable(robot.index))
        {
            continue;
        }
        const ActiveDrive& drive = *robot.drive;
        const bool bAsks = drive.grantedCount < drive.nodes.size() && robot.refusedAt != _traffic.GetFreedCount();
        // What was granted while the robot could not go on is released now.
        const bool bWants = bAsks || drive.releasedCount < drive.grantedCount;
        if (bWants)
        {
            driving.push_back(&robot);
        }
    }
    std::ranges::sort(driving, IsMoreUrgent);
    std::ranges::for_each(driving, [this](Robot* robot) { ExtendBase(*robot); });
}

/// Keeps the base ahead of the robot. Longer than asked for, so that not every node costs an update.
void PlanEngine::Impl::ExtendBase(Robot& robot)
{
    ActiveDrive& drive = *robot.drive;
    const std::size_t reached = drive.passed + 1;
    if (drive.IsCancelling() || !CanAdvance(robot))
    {
        return;
    }
    if (drive.grantedCount < drive.nodes.size() && drive.grantedCount < reached + _options.baseLength)
    {
        const std::size_t wanted = std::min(drive.nodes.size(), reached + 2 * _options.baseLength);
        const std::span<const std::size_t> nodes(drive.nodes);
        const std::size_t granted =
            _traffic.Extend(robot.index, nodes.subspan(drive.grantedCount, wanted - drive.grantedCount));
        drive.grantedCount += granted;
        robot.bTouched = robot.bTouched || granted > 0 || robot.blockers != _traffic.GetBlockers();
        robot.blockers = _traffic.GetBlockers();
        robot.refusedAt = _traffic.GetFreedCount();
    }
    if (drive.grantedCount > drive.releasedCount)
    {
        drive.releasedCount = drive.grantedCount;
        Command(robot, ExtendDrive{drive.driveID, drive.releasedCount});
    }
}

void PlanEngine::Impl::SendIdleHome()
{
    for (Robot* robot : ListAwayFromHome())
    {
        static_cast<void>(TryDrive(*robot));
    }
}

/// Whether the robot has begun to drive, or stands where it wants to be.
bool PlanEngine::Impl::TryDrive(Robot& robot)
{
    const std::optional<std::size_t> target = GetTargetOrNull(robot);
    if (!target.has_value())
    {
        return false;
    }
    if (robot.node == target)
    {
        robot.retreatNode.reset();
        if (robot.planOrNull != nullptr && GetTargetOrNull(robot) == target)
        {
            BeginWork(robot);
        }
        return true;
    }
    const bool bFirst = !robot.plannedRoute.has_value() || robot.plannedRoute->target != *target;
    if (!TryPlanRoute(robot, *target))
    {
        OnNoRoute(robot, *target);
        return false;
    }
    if (IsYielding(robot))
    {
        robot.blockers.assign(1, robot.yield->leader);
        return false;
    }
    std::vector<std::size_t> holders = GetTargetHolders(robot, *target);
    if (!holders.empty())
    {
        robot.blockers = std::move(holders);
        return false;
    }
    if (!bFirst && robot.refusedAt == _traffic.GetFreedCount())
    {
        return false;
    }
    if (!_traffic.CanServe(robot.index, *target))
    {
        robot.blockers = _traffic.GetFixed(robot.index);
        robot.refusedAt = _traffic.GetFreedCount();
        return false;
    }
    const bool bBegun = TryBeginPlannedRoute(robot);
    robot.refusedAt = _traffic.GetFreedCount();
    return bBegun;
}

/// Around those who stand in the way and have no reason to leave soon, where there is a way around them.
bool PlanEngine::Impl::TryBeginPlannedRoute(Robot& robot)
{
    std::vector<std::size_t> standing;
    std::vector<std::size_t> fixed;
    for (const std::size_t node : robot.plannedRoute->nodes)
    {
        for (const std::size_t holder : _traffic.GetHolders(node, robot.index))
        {
            if (!_traffic.IsMovable(holder))
            {
                fixed.push_back(holder);
            }
            else if (!_robots[holder].drive.has_value())
            {
                standing.push_back(holder);
            }
        }
    }
    if (fixed.empty() && standing.empty())
    {
        return TryBeginDrive(robot, *robot.plannedRoute);
    }
    // Who stands where is the same for many events: so is the way around.
    if (robot.detourAt != _standingChanges || robot.detourTarget != robot.plannedRoute->target)
    {
        const auto isStandingInTheWay = [this, &robot](std::size_t node) {
            const std::vector<std::size_t> holders = _traffic.GetHolders(node, robot.index);
            return std::ranges::any_of(holders, [this](std::size_t holder) {
                return !_robots[holder].drive.has_value() || !_traffic.IsMovable(holder);
            });
        };
        robot.detour = PlanRouteOrNull(robot, robot.plannedRoute->target, isStandingInTheWay);
        robot.detourAt = _standingChanges;
        robot.detourTarget = robot.plannedRoute->target;
    }
    if (robot.detour.has_value())
    {
        return TryBeginDrive(robot, *robot.detour);
    }
    if (!fixed.empty())
    {
        robot.blockers = std::move(fixed);
        return false;
    }
    return TryBeginDrive(robot, *robot.plannedRoute);
}

std::optional<PlannedRoute> PlanEngine::Impl::PlanRouteOrNull(
    const Robot& robot,
    std::size_t target,
    const Router::NodeFilter& isExcluded) const
{
    const std::vector<SiteNode>& nodes = _site.GetNodes();
    std::optional<Route> route = _router.FindRouteOrNull(
        robot.options->vehicleTypeID,
        nodes[*robot.node].nodeID,
        nodes[target].nodeID,
        isExcluded);
    if (!route.has_value())
    {
        return std::nullopt;
    }
    PlannedRoute plannedRoute;
    plannedRoute.target = target;
    for (const RouteNode& node : route->nodes)
    {
        plannedRoute.nodes.push_back(*_site.FindNodeIndexOrNull(node.nodeID));
    }
    plannedRoute.route = std::move(*route);
    return plannedRoute;
}

bool PlanEngine::Impl::TryPlanRoute(Robot& robot, std::size_t target)
{
    if (!robot.plannedRoute.has_value() || robot.plannedRoute->target != target)
    {
        robot.plannedRoute = PlanRouteOrNull(robot, target, {});
    }
    return robot.plannedRoute.has_value();
}

void PlanEngine::Impl::OnNoRoute(Robot& robot, std::size_t target)
{
    const std::string text = fmt::format(
        "{} has no way from {} to {}.",
        GetRobotID(robot),
        _site.GetNodes()[*robot.node].nodeID,
        _site.GetNodes()[target].nodeID);
    if (robot.planOrNull != nullptr && !robot.retreatNode.has_value())
    {
        FailPlan(*robot.planOrNull, text);
        return;
    }
    RefuseHome(robot);
    Note(robot, text);
}

/// Sent home again later, each time twice as late: one that stands between two nodes refuses until somebody comes.
void PlanEngine::Impl::RefuseHome(Robot& robot)
{
    constexpr unsigned MOST_DOUBLINGS = 6;
    robot.retreatNode.reset();
    robot.bHomeRefused = true;
    StartTimer(EEngineTimer::HomeRetry, GetRobotID(robot), _options.homeRetry * (1U << robot.homeRefusals));
    robot.homeRefusals = std::min(robot.homeRefusals + 1, MOST_DOUBLINGS);
}

/// Begun with the first nodes that are granted; without any it is not begun.
bool PlanEngine::Impl::TryBeginDrive(Robot& robot, const PlannedRoute& plannedRoute)
{
    if (!robot.aheadNodes.empty() && robot.state.has_value() && robot.state->bDriving)
    {
        robot.blockers.clear();
        return false; // it is still coming to a stand, and where that is nobody knows
    }
    const std::size_t wanted = std::min(_options.baseLength, plannedRoute.nodes.size() - 1);
    const std::size_t granted = _traffic.Extend(robot.index, std::span(plannedRoute.nodes).subspan(1, wanted));
    robot.blockers = _traffic.GetBlockers();
    if (granted == 0)
    {
        return false;
    }
    EndCharging(robot);
    ActiveDrive drive;
    drive.driveID = Core::MakeUuid(_random);
    robot.work.AddCommand(drive.driveID);
    drive.route = plannedRoute.route;
    drive.nodes = plannedRoute.nodes;
    drive.grantedCount = granted + 1;
    // One is always left to be released: a robot has a horizon to plan with.
    drive.releasedCount = std::min({_options.baseLength, drive.grantedCount, drive.nodes.size() - 1});
    drive.goal = robot.planOrNull == nullptr || robot.retreatNode.has_value() ? EDriveGoal::Home : EDriveGoal::Step;
    robot.bTouched = true;
    if (drive.goal == EDriveGoal::Step)
    {
        robot.yield.reset();
        robot.planOrNull->bStepArrived = false;
    }
    Command(robot, Drive{drive.driveID, drive.route, drive.releasedCount});
    StartTimer(EEngineTimer::DriveExtension, GetRobotID(robot), _options.extensionDelay);
    robot.drive = std::move(drive);
    ++_standingChanges;
    return true;
}

} // namespace ACS::Planning
