#include "traffic/TrafficCoordinator.hpp"

#include "traffic/BlockText.hpp"
#include <acs/core/Uuid.hpp>

#include <algorithm>
#include <span>
#include <utility>

namespace ACS::Planning
{

TrafficCoordinator::TrafficCoordinator(
    EngineState& engine,
    ControlAnswers& answers,
    ChargingControl& charging,
    PlaceTracker& places,
    const WaitingRobots& waiting)
    : _options(engine.options),
      _site(engine.site),
      _random(engine.random),
      _admission(engine.admission),
      _blocks(engine.blocks),
      _fleet(engine.fleet),
      _transaction(engine.transaction),
      _answers(answers),
      _charging(charging),
      _places(places),
      _waiting(waiting),
      _routes(engine.site, engine.blocks),
      _visits(engine, _routes),
      _traffic(places.GetTraffic())
{
}

void TrafficCoordinator::ExtendDrives()
{
    std::vector<Robot*> driving;
    for (Robot& robot : _fleet)
    {
        if (!robot.drive.has_value() || !robot.drive->bConfirmed || !_traffic.IsMovable(robot.index))
        {
            continue;
        }
        const ActiveDrive& drive = *robot.drive;
        const bool bAsks =
            drive.grantedCount < drive.nodes.size() && robot.search.refusedAt != _traffic.GetFreedCount();
        // Nodes granted while the robot could not continue are released now.
        const bool bWants = bAsks || drive.releasedCount < drive.grantedCount;
        if (bWants)
        {
            driving.push_back(&robot);
        }
    }
    std::ranges::sort(driving, IsMoreUrgent);
    std::ranges::for_each(driving, [this](Robot* robot) { ExtendBase(*robot); });
}

void TrafficCoordinator::ExtendBase(Robot& robot)
{
    ActiveDrive& drive = *robot.drive;
    const std::size_t reached = drive.passed + 1;
    if (drive.IsCancelling() || drive.bLeftRoute || !robot.CanAdvance())
    {
        return;
    }
    const Block* const blockOrNull = FindDriveBlockOrNull(robot);
    if (blockOrNull != nullptr)
    {
        NoteBlock(robot, BlockBook::Describe(*blockOrNull));
        robot.search.blockers.clear();
    }
    else if (drive.grantedCount < drive.nodes.size() && drive.grantedCount < reached + _options.baseLength)
    {
        GrantFurther(robot);
    }
    if (drive.grantedCount > drive.releasedCount)
    {
        drive.releasedCount = drive.grantedCount;
        _transaction.Command(robot, ExtendDrive{drive.driveID, drive.releasedCount});
    }
}

EDriveAttempt TrafficCoordinator::TryDrive(Robot& robot)
{
    const std::optional<std::size_t> target = _waiting.GetTargetOrNull(robot);
    if (!target.has_value())
    {
        return EDriveAttempt::Waits;
    }
    if (robot.IsStopping())
    {
        robot.search.blockers.clear();
        return EDriveAttempt::Waits;
    }
    if (robot.place.IsOn(target))
    {
        robot.parking.retreatNode.reset();
        return EDriveAttempt::AtTarget;
    }
    // Between two nodes it is not at its target, even if it has just left it and has no way back.
    if (robot.place.node == target && !_routes.FindLaneOrNull(robot, *target).has_value())
    {
        return EDriveAttempt::NoRoute;
    }
    const bool bFirst = !RoutePlanner::HasRoute(robot, *target);
    if (TryNoteBlock(robot, *target))
    {
        return TryLeaveLane(robot) ? EDriveAttempt::Begun : EDriveAttempt::Waits;
    }
    if (!_routes.TryPlanRoute(robot, *target))
    {
        return EDriveAttempt::NoRoute;
    }
    if (_waiting.IsYielding(robot))
    {
        robot.search.blockers.assign(1, robot.search.yield->leader);
        return EDriveAttempt::Waits;
    }
    std::vector<std::size_t> holders = ListLasting(robot, *target);
    if (!holders.empty())
    {
        robot.search.blockers = std::move(holders);
        return EDriveAttempt::Waits;
    }
    if (!bFirst && robot.search.refusedAt == _traffic.GetFreedCount())
    {
        return EDriveAttempt::Waits;
    }
    if (!_traffic.CanServe(robot.index, *target))
    {
        robot.search.blockers = _traffic.GetFixed(robot.index);
        robot.search.refusedAt = _traffic.GetFreedCount();
        robot.search.block = robot.search.blockers.empty() ? CUT_OFF : "";
        return EDriveAttempt::Waits;
    }
    const bool bBegun = TryBeginPlannedRoute(robot);
    robot.search.refusedAt = _traffic.GetFreedCount();
    return bBegun ? EDriveAttempt::Begun : EDriveAttempt::Waits;
}

bool TrafficCoordinator::TryBeginPlannedRoute(Robot& robot)
{
    std::vector<std::size_t> standing;
    std::vector<std::size_t> fixed;
    for (const std::size_t node : robot.search.plannedRoute->nodes)
    {
        for (const std::size_t holder : _traffic.GetHolders(node, robot.index))
        {
            if (!_traffic.IsMovable(holder))
            {
                fixed.push_back(holder);
            }
            else if (!_fleet[holder].drive.has_value())
            {
                standing.push_back(holder);
            }
        }
    }
    if (fixed.empty() && standing.empty())
    {
        return TryBeginDrive(robot, *robot.search.plannedRoute);
    }
    // The detour is kept until a robot stops, starts, or becomes movable or not.
    if (robot.search.detourAt != _places.GetStandingChanges()
        || robot.search.detourTarget != robot.search.plannedRoute->target
        || robot.search.detourLoad != robot.search.plannedRoute->load)
    {
        const auto isStandingInTheWay = [this, &robot](std::size_t node) {
            const std::vector<std::size_t> holders = _traffic.GetHolders(node, robot.index);
            return std::ranges::any_of(holders, [this](std::size_t holder) {
                return !_fleet[holder].drive.has_value() || !_traffic.IsMovable(holder);
            });
        };
        robot.search.detour = _routes.PlanRouteOrNull(robot, robot.search.plannedRoute->target, isStandingInTheWay);
        robot.search.detourAt = _places.GetStandingChanges();
        robot.search.detourTarget = robot.search.plannedRoute->target;
        robot.search.detourLoad = robot.search.plannedRoute->load;
    }
    if (robot.search.detour.has_value())
    {
        return TryBeginDrive(robot, *robot.search.detour);
    }
    if (!fixed.empty())
    {
        robot.search.blockers = std::move(fixed);
        return false;
    }
    return TryBeginDrive(robot, *robot.search.plannedRoute);
}

std::optional<PlannedRoute> TrafficCoordinator::PlanRouteOrNull(
    const Robot& robot,
    std::size_t target,
    const Router::NodeFilter& isExcluded) const
{
    return _routes.PlanRouteOrNull(robot, target, isExcluded);
}

bool TrafficCoordinator::TryBeginDrive(Robot& robot, const PlannedRoute& plannedRoute)
{
    if (robot.IsStopping())
    {
        robot.search.blockers.clear();
        return false;
    }
    const std::size_t wanted = std::min(_options.baseLength, plannedRoute.nodes.size() - 1);
    const std::size_t granted =
        Extend(robot, std::span(plannedRoute.nodes).subspan(1, wanted), plannedRoute.nodes.back());
    if (granted == 0)
    {
        return false;
    }
    _charging.EndCharging(robot);
    ActiveDrive drive;
    drive.driveID = Core::MakeUUID(_random);
    robot.work.AddCommand(drive.driveID);
    drive.load = plannedRoute.load;
    drive.route = plannedRoute.route;
    if (robot.place.heading == plannedRoute.nodes[1])
    {
        RoutePlanner::ReachStart(robot, drive.route);
    }
    drive.nodes = plannedRoute.nodes;
    drive.grantedCount = granted + 1;
    // The last node is not released yet: the robot needs a horizon.
    drive.releasedCount = std::min({_options.baseLength, drive.grantedCount, drive.nodes.size() - 1});
    drive.goal =
        robot.planOrNull == nullptr || robot.parking.retreatNode.has_value() ? EDriveGoal::Home : EDriveGoal::Step;
    robot.changes.MarkStatus();
    if (drive.goal == EDriveGoal::Step)
    {
        robot.search.yield.reset();
        robot.planOrNull->bStepArrived = false;
    }
    _transaction.Command(robot, Drive{drive.driveID, drive.route, drive.releasedCount});
    _transaction.StartTimer(EEngineTimer::DriveExtension, robot.GetID(), _options.extensionDelay);
    robot.drive = std::move(drive);
    _traffic.SetDestination(robot.index, robot.drive->nodes.back());
    _places.NoteStandingChanged();
    return true;
}

void TrafficCoordinator::RefuseHome(Robot& robot, std::string reason)
{
    constexpr unsigned MOST_DOUBLINGS = 6;
    robot.parking.retreatNode.reset();
    robot.parking.bRefused = true;
    robot.parking.refusal = std::move(reason);
    robot.changes.MarkStatus();
    _transaction.StartTimer(
        EEngineTimer::HomeRetry,
        robot.GetID(),
        _options.homeRetry * (1U << robot.parking.refusals));
    robot.parking.refusals = std::min(robot.parking.refusals + 1, MOST_DOUBLINGS);
}

bool TrafficCoordinator::TryReroute(Robot& robot, PlannedRoute plannedRoute, bool bRetreats)
{
    const std::size_t wanted = std::min(_options.baseLength, plannedRoute.nodes.size() - 1);
    if (_traffic.Extend(robot.index, std::span(plannedRoute.nodes).subspan(1, wanted)) == 0)
    {
        return false;
    }
    ActiveDrive& drive = *robot.drive;
    drive.reroute = Reroute{std::move(plannedRoute), bRetreats};
    drive.cancellation = ECancellation::Awaited;
    _transaction.Command(robot, CancelDrive{drive.driveID});
    _answers.StartConfirming(robot, _options.controls.cancelTimeout);
    return true;
}

void TrafficCoordinator::BeginReroute(Robot& robot, PlannedRoute plannedRoute, bool bRetreats)
{
    if (plannedRoute.nodes.front() != robot.place.node || plannedRoute.load != robot.GetLoad()
        || _blocks.CountOpen(plannedRoute.route, 1) < plannedRoute.nodes.size())
    {
        return; // The robot has moved since, has another load, or its route is blocked: it waits as any other.
    }
    if (bRetreats)
    {
        robot.parking.retreatNode = plannedRoute.target;
    }
    robot.search.plannedRoute = std::move(plannedRoute);
    if (_traffic.IsMovable(robot.index) && robot.IsUsable())
    {
        static_cast<void>(TryBeginDrive(robot, *robot.search.plannedRoute));
    }
}

void TrafficCoordinator::AbandonReroute(Robot& robot)
{
    if (!robot.drive.has_value() || !robot.drive->reroute.has_value())
    {
        return;
    }
    ActiveDrive& drive = *robot.drive;
    drive.reroute.reset();
    drive.StopAwaitingCancellation();
    _traffic.Shorten(robot.index, drive.grantedCount - drive.passed);
    _transaction.RequestDispatch();
}

std::size_t TrafficCoordinator::Extend(Robot& robot, std::span<const std::size_t> ahead, std::size_t target)
{
    const std::size_t open = _traffic.CountBeforeWayOut(robot.index, ahead, target);
    const std::size_t granted = open == 0 ? 0 : _traffic.Extend(robot.index, ahead.first(open));
    robot.search.blockers = open == 0 ? _traffic.GetHolders(target, robot.index) : _traffic.GetBlockers();
    NoteBlock(robot, open > 0 && _traffic.IsRefusedForBlocks() ? CUT_OFF : "");
    return granted;
}

const VisitForecast& TrafficCoordinator::GetVisits() const noexcept
{
    return _visits;
}

std::vector<std::size_t> TrafficCoordinator::ListLasting(const Robot& robot, std::size_t target) const
{
    constexpr double SLACK_SECONDS = 10; ///< It may wait this time on the lane.
    std::vector<std::size_t> holders = _waiting.GetTargetHolders(robot, target);
    if (holders.empty() || robot.planOrNull == nullptr || robot.parking.retreatNode.has_value())
    {
        return holders;
    }
    const double travel = _visits.GetTravelSeconds(robot, *robot.place.node, target);
    std::erase_if(holders, [this, target, travel](std::size_t other) {
        const Robot& holder = _fleet[other];
        return _waiting.IsMoving(holder) && _visits.GetDeparture(holder, target) <= travel + SLACK_SECONDS;
    });
    return holders;
}

const Router& TrafficCoordinator::GetRouter() const noexcept
{
    return _routes.GetRouter();
}

void TrafficCoordinator::OnExtensionDue(Robot& robot)
{
    if (robot.drive.has_value())
    {
        robot.drive->bConfirmed = true;
        _transaction.RequestDispatch();
    }
}

void TrafficCoordinator::OnHomeRetry(Robot& robot)
{
    robot.parking.bRefused = false;
    robot.changes.MarkStatus();
    _transaction.RequestDispatch();
}

} // namespace ACS::Planning
