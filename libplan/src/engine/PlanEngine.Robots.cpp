#include "engine/PlanEngine.Impl.hpp"
#include "robot/NodesAhead.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <span>
#include <utility>

namespace ACS::Planning
{

Alarm PlanEngine::Impl::MakeLinkAlarm(const Robot& robot, std::string message) const
{
    return MakeAlarm(GetRobotID(robot), ALARM_LINK_LOST, EAlarmLevel::Heavy, std::move(message));
}

void PlanEngine::Impl::OnLink(Robot& robot, const LinkChanged& event)
{
    if (robot.bOnline == event.bOnline)
    {
        return;
    }
    robot.bOnline = event.bOnline;
    Alarm alarm = MakeLinkAlarm(robot, "The connection to the robot is lost.");
    if (event.bOnline)
    {
        ClearAlarm(alarm);
        _bDispatchNeeded = true;
        return;
    }
    // Where it is and how it does is old news when it comes back.
    robot.state.reset();
    robot.charging.OnLinkLost();
    _bDispatchNeeded = true;
    RaiseAlarm(std::move(alarm));
}

void PlanEngine::Impl::OnState(Robot& robot, const StateChanged& event)
{
    if (!robot.bOnline)
    {
        return;
    }
    const bool bWasUsable = IsUsable(robot);
    const bool bFirst = !robot.state.has_value();
    const bool bWasPaused = !bFirst && robot.state->bPaused;
    // Whoever has it in hand need not let it hear what it is told.
    const bool bBack = bFirst || (!robot.state->bAutomatic && event.bAutomatic);
    robot.state = event;
    CompareErrors(robot);
    if (!robot.drive.has_value())
    {
        Place(robot);
    }
    else if (event.bDriving && robot.drive->goal == EDriveGoal::Step && robot.planOrNull != nullptr)
    {
        MarkStepBegun(*robot.planOrNull);
    }
    robot.bWorkTouched = robot.work.TryCheckEvidence(event, robot.planOrNull != nullptr) || robot.bWorkTouched;
    CompareLoads(robot);
    UpdatePause(robot, bBack, bWasPaused);
    UpdateStandstill(robot);
    UpdateBattery(robot);
    if (IsUsable(robot) && !bWasUsable)
    {
        robot.homeRefusals = 0;
        _bDispatchNeeded = true;
    }
}

/// Where a robot without a drive stands, and where it may still go on an order that is none of the engine's.
void PlanEngine::Impl::Place(Robot& robot)
{
    const std::string& nodeID = robot.state->lastNodeID;
    const std::optional<std::size_t> node = _site.FindNodeIndexOrNull(nodeID);
    if (!node.has_value())
    {
        OnPositionLost(robot);
        return;
    }
    const std::vector<std::size_t> claim = ListClaimed(robot, *node);
    std::vector<std::size_t> ahead = FindNodesAhead(
        _site,
        robot.state,
        *node,
        node == robot.node ? robot.aheadNodes : ListPossibleAhead(robot, *node));
    std::erase_if(ahead, [&claim](std::size_t between) { return std::ranges::count(claim, between) > 0; });
    std::vector<std::size_t> held(claim);
    held.insert(held.end(), ahead.begin(), ahead.end());
    if (robot.bPlaced && node == robot.node && held == robot.heldNodes)
    {
        return;
    }
    std::erase_if(robot.possibleNodes, [&ahead](std::size_t supposed) {
        return std::ranges::count(ahead, supposed) == 0;
    });
    ReleasePossibleNodes(claim);
    if (!_traffic.TryStand(robot.index, *node, std::span(claim).subspan(1), ahead))
    {
        const auto taken = std::ranges::find_if(claim, [this, &robot](std::size_t other) {
            return !_traffic.IsFreeFor(other, robot.index);
        });
        const std::size_t holder = *_traffic.GetHolderOrNull(*taken);
        robot.bPlaced = false;
        // Where it is all the same nobody else is let.
        _traffic.HoldPossible(robot.index, held);
        RaiseAlarm(MakePlaceAlarm(
            robot,
            fmt::format(
                "It {} node {}, which {} holds.",
                taken == claim.begin() ? "stands on" : "may still go to",
                _site.GetNodes()[*taken].nodeID,
                GetRobotID(_robots[holder]))));
        return;
    }
    ClearAlarm(MakePlaceAlarm(robot, {}));
    // An order that is none of the engine's may be given up between two nodes, too.
    robot.aheadNodes.assign(held.begin() + 1, held.end());
    robot.homeRefusals = node == robot.node ? robot.homeRefusals : 0;
    robot.node = node;
    robot.heldNodes = std::move(held);
    robot.bPlaced = true;
    robot.plannedRoute.reset();
    ++_standingChanges;
    if (const SiteStation* stationOrNull = _site.FindStationAtOrNull(nodeID); stationOrNull != nullptr)
    {
        robot.position = stationOrNull->stationID;
    }
    _bDispatchNeeded = true;
}

Alarm PlanEngine::Impl::MakePlaceAlarm(const Robot& robot, std::string message) const
{
    return MakeAlarm(GetRobotID(robot), ALARM_PLACE, EAlarmLevel::Heavy, std::move(message));
}

/// Somebody has taken it off the map, or it does not know where it is. What it held stays its own until it tells a node.
void PlanEngine::Impl::OnPositionLost(Robot& robot)
{
    if (!std::exchange(robot.bPlaced, false))
    {
        return;
    }
    const std::string& nodeID = robot.state->lastNodeID;
    RaiseAlarm(MakePlaceAlarm(
        robot,
        nodeID.empty() ? "It does not tell any more on which node it stands."
                       : fmt::format("It stands on node {}, which the map does not have.", nodeID)));
}

/// The node on which it stands first, then those to which it may still go.
std::vector<std::size_t> PlanEngine::Impl::ListClaimed(const Robot& robot, std::size_t node) const
{
    std::vector<std::size_t> claim{node};
    for (const std::string& heldID : robot.state->heldNodeIDs)
    {
        const std::optional<std::size_t> held = _site.FindNodeIndexOrNull(heldID);
        if (held.has_value() && std::ranges::count(claim, *held) == 0)
        {
            claim.push_back(*held);
        }
    }
    return claim;
}

/// Sets and clears an alarm for each error that came or went.
void PlanEngine::Impl::CompareErrors(Robot& robot)
{
    const std::string& robotID = GetRobotID(robot);
    ReportAlarms(_alarms.ClearIf([&robot, &robotID](const Alarm& alarm) {
        return alarm.robotID == robotID && !alarm.errorCode.starts_with(ALARM_PREFIX)
            && std::ranges::count(robot.state->errors, alarm.errorCode, &RobotError::errorCode) == 0;
    }));
    for (const RobotError& error : robot.state->errors)
    {
        const bool bOutweighed = std::ranges::any_of(robot.state->errors, [&error](const RobotError& other) {
            return other.errorCode == error.errorCode && other.level == EAlarmLevel::Heavy
                && error.level != EAlarmLevel::Heavy;
        });
        if (!bOutweighed)
        {
            RaiseAlarm(MakeAlarm(robotID, error.errorCode, error.level, error.message));
        }
    }
}

void PlanEngine::Impl::OnNodePassed(Robot& robot, const NodePassed& event)
{
    if (!robot.drive.has_value() || robot.drive->driveID != event.driveID)
    {
        return;
    }
    const std::vector<RouteNode>& nodes = robot.drive->route.nodes;
    const auto found = std::ranges::find(nodes, event.nodeID, &RouteNode::nodeID);
    const auto routeIndex = static_cast<std::size_t>(found - nodes.begin());
    if (found == nodes.end() || routeIndex < robot.drive->passed)
    {
        Note(robot, fmt::format("told a node that is not ahead on its way: {}", event.nodeID));
        return;
    }
    robot.drive->bTaken = true;
    robot.work.MarkCommandTaken();
    robot.bWorkTouched = true;
    if (!robot.drive->bConfirmed)
    {
        robot.drive->bConfirmed = true;
        CancelTimer(EEngineTimer::DriveExtension, GetRobotID(robot));
    }
    if (routeIndex > 0 && robot.drive->goal == EDriveGoal::Step && robot.planOrNull != nullptr)
    {
        MarkStepBegun(*robot.planOrNull);
    }
    if (TryAdvance(robot, routeIndex))
    {
        UpdateApproach(robot);
        ExtendBase(robot);
    }
}

/// Arrival is reported before the robot docks. A robot whose drive is to be cancelled has not arrived.
void PlanEngine::Impl::UpdateApproach(Robot& robot)
{
    const ActiveDrive& drive = *robot.drive;
    if (drive.bTaken && drive.goal == EDriveGoal::Step && robot.planOrNull != nullptr && !drive.IsCancelling()
        && drive.IsApproaching())
    {
        MarkArrived(robot);
    }
}

/// The robot is at or beyond this node of its way: what lies behind is free for others. False: another robot holds the
/// node, as this one drove on without leave.
bool PlanEngine::Impl::TryAdvance(Robot& robot, std::size_t routeIndex)
{
    ActiveDrive& drive = *robot.drive;
    if (routeIndex >= drive.grantedCount)
    {
        const std::span<const std::size_t> nodes(drive.nodes);
        const std::span<const std::size_t> overrun =
            nodes.subspan(drive.grantedCount, routeIndex + 1 - drive.grantedCount);
        if (drive.reroute.has_value() || !_traffic.TryOverrun(robot.index, overrun))
        {
            RaiseAlarm(MakePlaceAlarm(
                robot,
                fmt::format("It drove on to node {} without leave.", drive.route.nodes[routeIndex].nodeID)));
            return false;
        }
        Note(robot, "drove on beyond what was released");
        drive.grantedCount = routeIndex + 1;
    }
    if (routeIndex > drive.passed)
    {
        _traffic.Pass(robot.index, routeIndex - drive.passed);
        _bDispatchNeeded = true;
        robot.aheadNodes.clear();
        robot.possibleNodes.clear();
        robot.homeRefusals = 0;
    }
    drive.passed = routeIndex;
    robot.node = drive.nodes[routeIndex];
    return true;
}

/// The robot stands on drive->passed, or between it and the next node: nothing else of the way is its own any more.
void PlanEngine::Impl::EndDrive(Robot& robot)
{
    const std::string& robotID = GetRobotID(robot);
    const ActiveDrive& drive = *robot.drive;
    if (!drive.bConfirmed)
    {
        CancelTimer(EEngineTimer::DriveExtension, robotID);
    }
    // A pause has still to be shown.
    const bool bControlOpen = robot.planOrNull != nullptr && robot.planOrNull->record.progress.control.has_value();
    if (drive.IsCancelling() && !bControlOpen)
    {
        StopConfirming(robot);
    }
    const std::size_t begin = drive.passed + 1;
    if (!drive.bConfirmed)
    {
        robot.aheadNodes = FindNodesAhead(
            _site,
            robot.state,
            *robot.node,
            robot.aheadNodes); // of the drive before: this one it never had
    }
    else if (begin < drive.grantedCount)
    {
        robot.aheadNodes = FindNodesAhead(
            _site,
            robot.state,
            *robot.node,
            std::span(drive.nodes).subspan(begin, drive.grantedCount - begin));
    }
    else
    {
        robot.aheadNodes.clear();
    }
    robot.heldNodes.assign(1, *robot.node);
    for (const std::size_t between : robot.aheadNodes)
    {
        if (std::ranges::count(robot.heldNodes, between) == 0)
        {
            robot.heldNodes.push_back(between);
        }
    }
    const bool bStands = _traffic.TryStand(robot.index, *robot.node, {}, std::span(robot.heldNodes).subspan(1));
    assert(bStands);
    static_cast<void>(bStands);
    robot.drive.reset();
    ++_standingChanges;
    robot.plannedRoute.reset();
    robot.blockers.clear();
    _bDispatchNeeded = true;
}

void PlanEngine::Impl::OnArrived(Robot& robot, const Arrived& event)
{
    if (!robot.drive.has_value() || robot.drive->driveID != event.driveID)
    {
        return;
    }
    if (!TryAdvance(robot, robot.drive->nodes.size() - 1))
    {
        OnDriveRejected(robot, DriveRejected{event.driveID, "it went where another robot is"});
        robot.bPlaced = false;
        return;
    }
    const EDriveGoal goal = robot.drive->goal;
    const std::string nodeID = robot.drive->route.nodes.back().nodeID;
    EndDrive(robot);
    if (const SiteStation* stationOrNull = _site.FindStationAtOrNull(nodeID); stationOrNull != nullptr)
    {
        robot.position = stationOrNull->stationID;
    }
    if (goal == EDriveGoal::Home)
    {
        robot.retreatNode.reset();
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
        EndByControl(plan, *plan.record.progress.control);
        return;
    }
    MarkArrived(robot);
    if (plan.record.progress.control == EPlanControl::Cancel)
    {
        Answer(plan, false, "The robot has arrived.");
        if (plan.record.progress.state != EPlanState::Paused)
        {
            ContinueAfterControl(robot);
        }
    }
    // Otherwise the work begins when the robot is there again: the drive may well end while its arm is out of reach.
    if (IsUsable(robot))
    {
        BeginWork(robot);
    }
}

void PlanEngine::Impl::OnDriveRejected(Robot& robot, const DriveRejected& event)
{
    if (!robot.drive.has_value() || robot.drive->driveID != event.driveID)
    {
        return;
    }
    const EDriveGoal goal = robot.drive->goal;
    EndDrive(robot);
    Note(robot, "did not do its drive: " + event.reason);
    if (goal == EDriveGoal::Home)
    {
        RefuseHome(robot);
        return;
    }
    if (robot.planOrNull == nullptr)
    {
        return;
    }
    ActivePlan& plan = *robot.planOrNull;
    if (IsEnding(robot))
    {
        EndByControl(plan, *plan.record.progress.control);
        return;
    }
    FailPlan(plan, fmt::format("{} did not do its drive: {}", GetRobotID(robot), event.reason));
}

/// Whether its plan is to be cancelled or aborted.
bool PlanEngine::Impl::IsEnding(const Robot& robot)
{
    if (robot.planOrNull == nullptr)
    {
        return false;
    }
    const std::optional<EPlanControl>& control = robot.planOrNull->record.progress.control;
    return control == EPlanControl::Cancel || control == EPlanControl::Abort;
}

void PlanEngine::Impl::OnDriveCancelled(Robot& robot, const DriveCancelled& event)
{
    if (!robot.drive.has_value() || robot.drive->driveID != event.driveID)
    {
        return;
    }
    const std::vector<RouteNode>& nodes = robot.drive->route.nodes;
    const auto found = std::ranges::find(nodes, event.nodeID, &RouteNode::nodeID);
    const auto routeIndex = static_cast<std::size_t>(found - nodes.begin());
    if (found != nodes.end() && routeIndex > robot.drive->passed && !TryAdvance(robot, routeIndex))
    {
        OnDriveRejected(robot, DriveRejected{event.driveID, "it went where another robot is"});
        robot.bPlaced = false;
        return;
    }
    const bool bWanted = IsEnding(robot);
    if (robot.drive->reroute.has_value() && !bWanted)
    {
        Reroute reroute = std::move(*robot.drive->reroute);
        EndDrive(robot);
        BeginReroute(robot, std::move(reroute.route), reroute.bRetreats);
        return;
    }
    if (robot.drive->cancellation != ECancellation::None && !bWanted)
    {
        // Later than anybody waited for it, and the plan goes on: another drive takes it there.
        robot.retreatNode.reset();
        EndDrive(robot);
        return;
    }
    OnDriveRejected(robot, DriveRejected{event.driveID, "it was cancelled"});
}

} // namespace ACS::Planning
