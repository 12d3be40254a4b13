#include "PlanEngine.Impl.hpp"
#include <acs/core/Uuid.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace ACS::Planning
{

void PlanEngine::Impl::Dispatch()
{
    // What one part frees or ends may be what an earlier part waited for.
    while (std::exchange(_bDispatchNeeded, false))
    {
        AssignPlans();
        MoveWaiting();
        SendIdleHome();
        PartCircles();
    }
}

void PlanEngine::Impl::AssignPlans()
{
    std::vector<ActivePlan*> queue;
    for (const auto& [key, plan] : _pending)
    {
        queue.push_back(plan);
    }
    for (ActivePlan* plan : queue)
    {
        const bool bAnyIdle = std::ranges::any_of(_robots, [](const Robot& robot) {
            return robot.planOrNull == nullptr && !robot.drive.has_value() && IsUsable(robot);
        });
        if (!bAnyIdle)
        {
            return;
        }
        if (Robot* robotOrNull = FindNearestOrNull(*plan); robotOrNull != nullptr)
        {
            BeginPlan(*plan, *robotOrNull);
        }
    }
}

PlanEngine::Impl::Robot* PlanEngine::Impl::FindNearestOrNull(const ActivePlan& plan)
{
    std::vector<Robot*> idle;
    for (const std::size_t index : plan.resolved.candidates)
    {
        Robot& robot = _robots[index];
        if (robot.planOrNull == nullptr && !robot.drive.has_value() && IsUsable(robot))
        {
            idle.push_back(&robot);
        }
    }
    if (idle.size() < 2)
    {
        return idle.empty() ? nullptr : idle.front();
    }
    Robot* nearest = idle.front();
    double shortest = std::numeric_limits<double>::infinity();
    for (Robot* robot : idle)
    {
        const std::string& vehicleTypeID = robot->options->vehicleTypeID;
        const std::size_t dock = *_admission.FindDockOrNull(plan.resolved.steps.front().stationID, vehicleTypeID);
        const std::optional<Route> route = _router.FindRouteOrNull(
            vehicleTypeID,
            _site.GetNodes()[*robot->node].nodeID,
            _site.GetNodes()[dock].nodeID);
        if (route.has_value() && route->travelSeconds < shortest)
        {
            shortest = route->travelSeconds;
            nearest = robot;
        }
    }
    return nearest;
}

/// Robots that must get to a place, in the order of their plans.
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
    std::ranges::sort(waiting, [](const Robot* left, const Robot* right) {
        return left->planOrNull->key < right->planOrNull->key;
    });
    return waiting;
}

std::optional<std::size_t> PlanEngine::Impl::GetTargetOrNull(const Robot& robot) const
{
    if (robot.planOrNull == nullptr || robot.bRetreats)
    {
        return robot.homeNode;
    }
    return _admission.FindDockOrNull(
        robot.planOrNull->resolved.steps[robot.planOrNull->step].stationID,
        robot.options->vehicleTypeID);
}

void PlanEngine::Impl::MoveWaiting()
{
    for (Robot* robot : GetWaiting())
    {
        static_cast<void>(TryDrive(*robot));
    }
}

void PlanEngine::Impl::SendIdleHome()
{
    for (Robot& robot : _robots)
    {
        const bool bIdle = robot.planOrNull == nullptr && !robot.drive.has_value() && !robot.bHomeRefused;
        if (bIdle && IsUsable(robot) && robot.homeNode.has_value() && robot.homeNode != robot.node)
        {
            static_cast<void>(TryDrive(robot));
        }
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
        robot.bRetreats = false;
        if (robot.planOrNull != nullptr && GetTargetOrNull(robot) == target)
        {
            BeginWork(robot);
        }
        return true;
    }
    if (!TryFindWish(robot, *target))
    {
        OnNoRoute(robot, *target);
        return false;
    }
    if (TryBeginDrive(robot, *robot.wish))
    {
        return true;
    }
    // Around those who stand in the way and have no reason to leave soon.
    const auto isStandingInTheWay = [this, &robot](std::size_t node) {
        const std::optional<std::size_t> holder = _reservations.GetHolderOrNull(node);
        return holder.has_value() && *holder != robot.index && !_robots[*holder].drive.has_value();
    };
    const std::vector<std::size_t> nodes = GetIndices(*robot.wish);
    if (!_reservations.IsFreeFor(*target, robot.index) || std::ranges::none_of(nodes, isStandingInTheWay))
    {
        return false;
    }
    const std::optional<Route> detour = _router.FindRouteOrNull(
        robot.options->vehicleTypeID,
        _site.GetNodes()[*robot.node].nodeID,
        _site.GetNodes()[*target].nodeID,
        isStandingInTheWay);
    return detour.has_value() && TryBeginDrive(robot, *detour);
}

bool PlanEngine::Impl::TryFindWish(Robot& robot, std::size_t target)
{
    if (!robot.wish.has_value() || robot.wishTarget != target)
    {
        robot.wishTarget = target;
        robot.wish = _router.FindRouteOrNull(
            robot.options->vehicleTypeID,
            _site.GetNodes()[*robot.node].nodeID,
            _site.GetNodes()[target].nodeID);
    }
    return robot.wish.has_value();
}

void PlanEngine::Impl::OnNoRoute(Robot& robot, std::size_t target)
{
    const std::string text = fmt::format(
        "{} has no way from {} to {}.",
        GetRobotID(robot),
        _site.GetNodes()[*robot.node].nodeID,
        _site.GetNodes()[target].nodeID);
    if (robot.planOrNull != nullptr && !robot.bRetreats)
    {
        FailPlan(*robot.planOrNull, text);
        return;
    }
    robot.bRetreats = false;
    robot.bHomeRefused = true;
    StartTimer(EEngineTimer::HomeRetry, GetRobotID(robot), _options.homeRetry);
    Note(robot, text);
}

std::vector<std::size_t> PlanEngine::Impl::GetIndices(const Route& route) const
{
    std::vector<std::size_t> indices;
    for (const RouteNode& node : route.nodes)
    {
        indices.push_back(*_site.FindNodeIndexOrNull(node.nodeID));
    }
    return indices;
}

bool PlanEngine::Impl::TryBeginDrive(Robot& robot, const Route& route)
{
    ActiveDrive drive;
    drive.nodes = GetIndices(route);
    if (!_reservations.TryClaim(drive.nodes, robot.index))
    {
        return false;
    }
    drive.driveID = Core::MakeUuid(_random);
    drive.route = route;
    drive.releasedCount = std::min(_options.baseLength, drive.nodes.size() - 1);
    drive.goal = robot.planOrNull == nullptr || robot.bRetreats ? EGoal::Home : EGoal::Step;
    robot.bTouched = true;
    Command(robot, Drive{drive.driveID, drive.route, drive.releasedCount});
    StartTimer(EEngineTimer::DriveExtension, GetRobotID(robot), _options.extensionDelay);
    robot.drive = std::move(drive);
    return true;
}

/// A robot that wants to drive and cannot: it holds its place until it can.
bool PlanEngine::Impl::IsStanding(std::size_t robot) const
{
    const Robot& candidate = _robots[robot];
    return !candidate.drive.has_value() && candidate.activity != EActivity::Works && IsUsable(candidate);
}

std::vector<std::size_t> PlanEngine::Impl::GetStandingBlockers(Robot& robot)
{
    std::vector<std::size_t> blockers;
    const std::optional<std::size_t> target = GetTargetOrNull(robot);
    if (!target.has_value() || robot.node == target || !TryFindWish(robot, *target))
    {
        return blockers;
    }
    for (const std::size_t node : GetIndices(*robot.wish))
    {
        const std::optional<std::size_t> holder = _reservations.GetHolderOrNull(node);
        if (holder.has_value() && *holder != robot.index && IsStanding(*holder))
        {
            blockers.push_back(*holder);
        }
    }
    return blockers;
}

/// Robots that stand and wait for each other in a circle stay so for ever: the least urgent one that can goes home first.
void PlanEngine::Impl::PartCircles()
{
    std::vector<Robot*> waiting = GetWaiting();
    if (waiting.empty())
    {
        return;
    }
    std::vector<std::vector<std::size_t>> blockers(_robots.size());
    for (Robot& robot : _robots)
    {
        if (IsStanding(robot.index))
        {
            blockers[robot.index] = GetStandingBlockers(robot);
        }
    }
    const auto isInCircle = [&blockers](std::size_t start) {
        std::vector<bool> reached(blockers.size(), false);
        std::vector<std::size_t> open = blockers[start];
        while (!open.empty())
        {
            const std::size_t robot = open.back();
            open.pop_back();
            if (!reached[robot])
            {
                reached[robot] = true;
                open.insert(open.end(), blockers[robot].begin(), blockers[robot].end());
            }
        }
        return static_cast<bool>(reached[start]);
    };
    std::ranges::reverse(waiting);
    for (Robot* robot : waiting)
    {
        const bool bCanRetreat =
            !robot->bRetreats && !robot->bHomeRefused && robot->homeNode.has_value() && robot->homeNode != robot->node;
        if (!bCanRetreat || !isInCircle(robot->index))
        {
            continue;
        }
        robot->bRetreats = true;
        if (TryDrive(*robot))
        {
            Note(*robot, "goes home first, out of the way of robots that wait for its place");
            return;
        }
        robot->bRetreats = false;
    }
}

} // namespace ACS::Planning
