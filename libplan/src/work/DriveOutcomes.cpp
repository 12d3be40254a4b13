#include "work/DriveOutcomes.hpp"

#include <acs/core/ShortText.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace ACS::Planning
{

namespace
{

/// The node that the robot passed last, or a later one. A route may pass a node twice.
std::vector<RouteNode>::const_iterator FindAhead(const ActiveDrive& drive, const std::string& nodeID)
{
    const auto passed = static_cast<std::ptrdiff_t>(drive.passed);
    return std::ranges::find(drive.route.nodes.begin() + passed, drive.route.nodes.end(), nodeID, &RouteNode::nodeID);
}

} // namespace

DriveOutcomes::DriveOutcomes(
    EngineState& engine,
    TscControl& tsc,
    ControlAnswers& answers,
    RejectionWatch& rejections,
    PlaceTracker& places,
    WaitingRobots& waiting,
    TrafficCoordinator& coordinator,
    PlanWork& work,
    PlanControls& controls)
    : _options(engine.options),
      _site(engine.site),
      _fleet(engine.fleet),
      _transaction(engine.transaction),
      _answers(answers),
      _rejections(rejections),
      _waiting(waiting),
      _coordinator(coordinator),
      _deadlocks(engine, tsc, places, waiting, coordinator),
      _assignment(work.GetAssignment()),
      _work(work),
      _controls(controls)
{
}

void DriveOutcomes::MoveWaiting()
{
    _coordinator.UpdateStandIns();
    _coordinator.ExtendDrives();
    _coordinator.AvoidBlocks();
    for (Robot* robot : _waiting.GetWaiting())
    {
        const std::vector<std::size_t> blockers = robot->search.blockers;
        const std::string block = robot->search.block;
        static_cast<void>(TryMove(*robot));
        robot->changes.MarkStatus(robot->search.blockers != blockers || robot->search.block != block);
    }
}

void DriveOutcomes::SendIdleHome()
{
    for (Robot* robot : _waiting.ListAwayFromHome())
    {
        const std::vector<std::size_t> blockers = robot->search.blockers;
        const std::string block = robot->search.block;
        static_cast<void>(TryMove(*robot));
        robot->changes.MarkStatus(robot->search.blockers != blockers || robot->search.block != block);
    }
}

void DriveOutcomes::ResolveDeadlocks()
{
    for (std::size_t round = 0; round < _fleet.size(); ++round)
    {
        const DeadlockResolver::Round result = _deadlocks.TryResolveDeadlock();
        const bool bMoved = result.releasedOrNull == nullptr ? result.bMoved : TryMove(*result.releasedOrNull);
        if (!bMoved)
        {
            return;
        }
    }
}

bool DriveOutcomes::TryMove(Robot& robot)
{
    const EDriveAttempt attempt = _coordinator.TryDrive(robot);
    if (attempt == EDriveAttempt::AtTarget && robot.planOrNull != nullptr
        && _waiting.GetTargetOrNull(robot) == robot.place.node)
    {
        _work.BeginWork(robot);
    }
    else if (attempt == EDriveAttempt::NoRoute)
    {
        OnNoRoute(robot, *_waiting.GetTargetOrNull(robot));
    }
    return attempt == EDriveAttempt::AtTarget || attempt == EDriveAttempt::Begun;
}

void DriveOutcomes::OnNoRoute(Robot& robot, std::size_t target)
{
    const std::vector<SiteNode>& nodes = _site.GetNodes();
    const std::string& nodeID = nodes[*robot.place.node].nodeID;
    const std::string& targetID = nodes[target].nodeID;
    const std::string text = robot.place.node == target && robot.place.heading.has_value()
        ? fmt::format(
            "{} is between {} and {}, and has no route back to {}.",
            robot.GetID(),
            nodeID,
            nodes[*robot.place.heading].nodeID,
            targetID)
        : fmt::format("{} has no route from {} to {}.", robot.GetID(), nodeID, targetID);
    if (robot.planOrNull != nullptr && !robot.parking.retreatNode.has_value())
    {
        _work.FailPlan(*robot.planOrNull, text);
        return;
    }
    _transaction.Note(robot, text);
    _coordinator.RefuseHome(robot, text);
}

void DriveOutcomes::OnNodePassed(Robot& robot, const NodePassed& event)
{
    if (!robot.drive.has_value() || robot.drive->driveID != event.driveID)
    {
        return;
    }
    const std::vector<RouteNode>& nodes = robot.drive->route.nodes;
    const auto found = FindAhead(*robot.drive, event.nodeID);
    const auto routeIndex = static_cast<std::size_t>(found - nodes.begin());
    if (found == nodes.end())
    {
        _transaction.Note(
            robot,
            fmt::format("reported node {}, which is not ahead on its route", Core::ShortenText(event.nodeID)));
        return;
    }
    robot.drive->bTaken = true;
    if (robot.drive->goal == EDriveGoal::Step && robot.planOrNull != nullptr)
    {
        _assignment.Start(*robot.planOrNull);
    }
    robot.work.MarkCommandTaken();
    robot.changes.MarkWork();
    if (!robot.drive->bConfirmed)
    {
        robot.drive->bConfirmed = true;
        _transaction.CancelTimer(EEngineTimer::DriveExtension, robot.GetID());
    }
    if (routeIndex > 0 && robot.drive->goal == EDriveGoal::Step && robot.planOrNull != nullptr)
    {
        _work.MarkStepBegun(*robot.planOrNull);
    }
    if (routeIndex > 0)
    {
        _rejections.EndRow(robot);
    }
    if (_coordinator.TryAdvance(robot, routeIndex))
    {
        _work.UpdateApproach(robot);
        _coordinator.ExtendBase(robot);
    }
}

void DriveOutcomes::OnArrived(Robot& robot, const Arrived& event)
{
    if (!robot.drive.has_value() || robot.drive->driveID != event.driveID)
    {
        return;
    }
    if (!_coordinator.TryAdvance(robot, robot.drive->nodes.size() - 1))
    {
        OnNodeOfOther(robot);
        return;
    }
    _rejections.EndRow(robot);
    const EDriveGoal goal = robot.drive->goal;
    const std::string nodeID = robot.drive->route.nodes.back().nodeID;
    _coordinator.EndDrive(robot);
    if (const SiteStation* stationOrNull = _site.FindStationAtOrNull(nodeID); stationOrNull != nullptr)
    {
        robot.place.position = stationOrNull->stationID;
    }
    if (goal == EDriveGoal::Home)
    {
        robot.parking.retreatNode.reset();
        return;
    }
    if (robot.planOrNull == nullptr)
    {
        return;
    }
    ActivePlan& plan = *robot.planOrNull;
    const bool bCancelLate = _options.controls.cancelUntil != ECancelWindow::FirstJob;
    if (plan.record.progress.control == EPlanControl::Abort
        || (plan.record.progress.control == EPlanControl::Cancel && !bCancelLate))
    {
        _work.EndByControl(plan, *plan.record.progress.control);
        return;
    }
    _work.MarkArrived(robot);
    if (plan.record.progress.control == EPlanControl::Cancel)
    {
        _answers.Answer(plan, false, "The robot has arrived.");
        if (plan.record.progress.state != EPlanState::Paused)
        {
            _controls.ContinueAfterControl(robot);
        }
    }
    // Otherwise the work begins when the robot is available again: a drive may end while its arm is disconnected.
    if (robot.IsUsable())
    {
        _work.BeginWork(robot);
    }
}

void DriveOutcomes::OnDriveRejected(Robot& robot, const DriveRejected& event)
{
    if (!robot.drive.has_value() || robot.drive->driveID != event.driveID)
    {
        return;
    }
    if (EndFailedDriveOrNull(robot, event.reason) != nullptr)
    {
        // The plan waits, and continues with another drive from where the robot is then, or with another robot.
        _rejections.OnRejected(robot, event.reason);
        if (IsOffered(*robot.planOrNull))
        {
            _assignment.Withdraw(*robot.planOrNull);
        }
    }
}

void DriveOutcomes::OnNodeOfOther(Robot& robot)
{
    constexpr std::string_view REASON = "it entered a node that is reserved for another robot";
    // The alarm remains until the robot has a place.
    robot.drive->bOverran = false;
    robot.drive->bLeftRoute = false;
    robot.place.bPlaced = false;
    if (ActivePlan* planOrNull = EndFailedDriveOrNull(robot, REASON); planOrNull != nullptr)
    {
        _work.FailPlan(*planOrNull, fmt::format("{} did not complete its drive: {}", robot.GetID(), REASON));
    }
}

ActivePlan* DriveOutcomes::EndFailedDriveOrNull(Robot& robot, std::string_view reason)
{
    const EDriveGoal goal = robot.drive->goal;
    _coordinator.EndDrive(robot);
    const std::string text = fmt::format("did not complete its drive: {}", reason);
    _transaction.Note(robot, text);
    if (goal == EDriveGoal::Home)
    {
        _coordinator.RefuseHome(robot, fmt::format("{} {}", robot.GetID(), text));
        return nullptr;
    }
    if (robot.planOrNull != nullptr && robot.IsEnding())
    {
        _work.EndByControl(*robot.planOrNull, *robot.planOrNull->record.progress.control);
    }
    return robot.planOrNull;
}

void DriveOutcomes::OnDriveCancelled(Robot& robot, const DriveCancelled& event)
{
    if (!robot.drive.has_value() || robot.drive->driveID != event.driveID)
    {
        return;
    }
    const std::vector<RouteNode>& nodes = robot.drive->route.nodes;
    const auto found = FindAhead(*robot.drive, event.nodeID);
    const auto routeIndex = static_cast<std::size_t>(found - nodes.begin());
    if (found != nodes.end() && routeIndex > robot.drive->passed && !_coordinator.TryAdvance(robot, routeIndex))
    {
        OnNodeOfOther(robot);
        return;
    }
    const bool bWanted = robot.IsEnding();
    if (robot.drive->reroute.has_value() && !bWanted)
    {
        Reroute reroute = std::move(*robot.drive->reroute);
        _coordinator.EndDrive(robot);
        _coordinator.BeginReroute(robot, std::move(reroute.route), reroute.bRetreats);
        return;
    }
    if (robot.drive->cancellation != ECancellation::None && !bWanted)
    {
        // Cancelled after the time limit: the plan continues with another drive.
        robot.parking.retreatNode.reset();
        _coordinator.EndDrive(robot);
        return;
    }
    OnDriveRejected(robot, DriveRejected{event.driveID, "it was cancelled"});
}

} // namespace ACS::Planning
