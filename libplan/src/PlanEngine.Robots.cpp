#include "PlanEngine.Impl.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

namespace ACS::Planning
{

void PlanEngine::Impl::OnLink(Robot& robot, const LinkChanged& event)
{
    if (robot.bOnline == event.bOnline)
    {
        return;
    }
    robot.bOnline = event.bOnline;
    Alarm alarm;
    alarm.robotID = GetRobotID(robot);
    alarm.errorCode = ALARM_LINK_LOST;
    alarm.level = EAlarmLevel::Heavy;
    alarm.message = "The connection to the robot is lost.";
    if (event.bOnline)
    {
        ClearAlarm(alarm);
        _bDispatchNeeded = true;
        return;
    }
    // Where it is and how it does is old news when it comes back.
    robot.state.reset();
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
    robot.state = event;
    CompareErrors(robot);
    if (!robot.drive.has_value())
    {
        Place(robot);
    }
    else if (event.bDriving && robot.drive->goal == EGoal::Step && robot.planOrNull != nullptr)
    {
        MarkStepBegun(*robot.planOrNull);
    }
    FollowPause(robot, bFirst, bWasPaused);
    FollowStand(robot);
    if (IsUsable(robot) && !bWasUsable)
    {
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
        return;
    }
    std::vector<std::size_t> claim{*node};
    for (const std::string& heldID : robot.state->heldNodeIDs)
    {
        const std::optional<std::size_t> held = _site.FindNodeIndexOrNull(heldID);
        if (held.has_value() && std::ranges::count(claim, *held) == 0)
        {
            claim.push_back(*held);
        }
    }
    if (robot.bPlaced && node == robot.node && claim == robot.heldNodes)
    {
        return;
    }
    Alarm alarm;
    alarm.robotID = GetRobotID(robot);
    alarm.errorCode = ALARM_PLACE;
    alarm.level = EAlarmLevel::Heavy;
    if (!_reservations.TryClaim(claim, robot.index))
    {
        const auto taken = std::ranges::find_if(claim, [this, &robot](std::size_t other) {
            return !_reservations.IsFreeFor(other, robot.index);
        });
        const std::size_t holder = *_reservations.GetHolderOrNull(*taken);
        alarm.message = fmt::format(
            "It {} node {}, which {} holds.",
            taken == claim.begin() ? "stands on" : "may still go to",
            _site.GetNodes()[*taken].nodeID,
            GetRobotID(_robots[holder]));
        robot.bPlaced = false;
        // Where it is all the same nobody else is let.
        for (const std::size_t other : claim)
        {
            static_cast<void>(_reservations.TryClaim(std::span(&other, 1), robot.index));
        }
        RaiseAlarm(std::move(alarm));
        return;
    }
    ClearAlarm(alarm);
    _reservations.ReleaseAllBut(claim, robot.index);
    robot.node = node;
    robot.heldNodes = std::move(claim);
    robot.bPlaced = true;
    robot.wish.reset();
    if (const SiteStation* stationOrNull = _site.FindStationAtOrNull(nodeID); stationOrNull != nullptr)
    {
        robot.position = stationOrNull->stationID;
    }
    _bDispatchNeeded = true;
}

/// Sets and clears an alarm for each error that came or went.
void PlanEngine::Impl::CompareErrors(Robot& robot)
{
    const std::string& robotID = GetRobotID(robot);
    std::vector<Alarm> gone;
    for (const Alarm& alarm : _alarms)
    {
        const bool bRobotsOwn = alarm.robotID == robotID && !alarm.errorCode.starts_with(ALARM_PREFIX);
        const bool bActive = std::ranges::any_of(robot.state->errors, [&alarm](const RobotError& error) {
            return error.errorCode == alarm.errorCode;
        });
        if (bRobotsOwn && !bActive)
        {
            gone.push_back(alarm);
        }
    }
    for (const Alarm& alarm : gone)
    {
        ClearAlarm(alarm);
    }
    for (const RobotError& error : robot.state->errors)
    {
        Alarm alarm;
        alarm.robotID = robotID;
        alarm.errorCode = error.errorCode;
        alarm.level = error.level;
        alarm.message = error.message;
        RaiseAlarm(std::move(alarm));
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
    if (!robot.drive->bConfirmed)
    {
        robot.drive->bConfirmed = true;
        CancelTimer(EEngineTimer::DriveExtension, GetRobotID(robot));
    }
    if (routeIndex > 0 && robot.drive->goal == EGoal::Step && robot.planOrNull != nullptr)
    {
        MarkStepBegun(*robot.planOrNull);
    }
    Advance(robot, routeIndex);
    ExtendBase(robot);
}

/// The robot is at or beyond this node of its way: what lies behind is free for others.
void PlanEngine::Impl::Advance(Robot& robot, std::size_t routeIndex)
{
    ActiveDrive& drive = *robot.drive;
    for (std::size_t i = drive.passed; i < routeIndex; ++i)
    {
        _reservations.Release(drive.nodes[i], robot.index);
        _bDispatchNeeded = true;
    }
    drive.passed = routeIndex;
    robot.node = drive.nodes[routeIndex];
}

/// Keeps the base ahead of the robot. Longer than asked for, so that not every node costs an update.
void PlanEngine::Impl::ExtendBase(Robot& robot)
{
    ActiveDrive& drive = *robot.drive;
    const std::size_t reached = drive.passed + 1;
    if (drive.bCancelling || drive.releasedCount >= drive.nodes.size()
        || drive.releasedCount >= reached + _options.baseLength)
    {
        return;
    }
    drive.releasedCount = std::min(drive.nodes.size(), reached + 2 * _options.baseLength);
    Command(robot, ExtendDrive{drive.driveID, drive.releasedCount});
}

/// The robot stands on drive->passed: nothing else of the way is its own any more.
void PlanEngine::Impl::EndDrive(Robot& robot)
{
    const std::string& robotID = GetRobotID(robot);
    if (!robot.drive->bConfirmed)
    {
        CancelTimer(EEngineTimer::DriveExtension, robotID);
    }
    if (robot.drive->bCancelling)
    {
        StopConfirming(robot);
    }
    robot.drive.reset();
    robot.wish.reset();
    _reservations.ReleaseAllBut(robot.node, robot.index);
    _bDispatchNeeded = true;
}

void PlanEngine::Impl::OnArrived(Robot& robot, const Arrived& event)
{
    if (!robot.drive.has_value() || robot.drive->driveID != event.driveID)
    {
        return;
    }
    Advance(robot, robot.drive->nodes.size() - 1);
    const EGoal goal = robot.drive->goal;
    const std::string nodeID = robot.drive->route.nodes.back().nodeID;
    EndDrive(robot);
    if (const SiteStation* stationOrNull = _site.FindStationAtOrNull(nodeID); stationOrNull != nullptr)
    {
        robot.position = stationOrNull->stationID;
    }
    if (goal == EGoal::Home)
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
            GoOn(robot);
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
    const EGoal goal = robot.drive->goal;
    EndDrive(robot);
    Note(robot, "did not do its drive: " + event.reason);
    if (goal == EGoal::Home)
    {
        robot.retreatNode.reset();
        robot.bHomeRefused = true;
        StartTimer(EEngineTimer::HomeRetry, GetRobotID(robot), _options.homeRetry);
        return;
    }
    if (robot.planOrNull == nullptr)
    {
        return;
    }
    ActivePlan& plan = *robot.planOrNull;
    if (plan.record.progress.control == EPlanControl::Cancel || plan.record.progress.control == EPlanControl::Abort)
    {
        EndByControl(plan, *plan.record.progress.control);
        return;
    }
    FailPlan(plan, fmt::format("{} did not do its drive: {}", GetRobotID(robot), event.reason));
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
    if (found != nodes.end() && routeIndex > robot.drive->passed)
    {
        Advance(robot, routeIndex);
    }
    OnDriveRejected(robot, DriveRejected{event.driveID, "it was cancelled"});
}

void PlanEngine::Impl::OnJobStarted(Robot& robot, const JobStarted& event)
{
    if (robot.activity != EActivity::Works || GetJobID(*robot.planOrNull) != event.jobID)
    {
        return;
    }
    if (robot.bUncertain)
    {
        return; // an operator has been asked
    }
    FindOut(robot);
    ActivePlan& plan = *robot.planOrNull;
    if (HasJob(plan) && plan.record.progress.steps[plan.step].jobs[plan.job] == EJobState::Instructed)
    {
        ChangeJob(plan, EJobState::InProgress, {});
    }
}

bool PlanEngine::Impl::TryEndOverdueJob(Robot& robot, const std::string& jobID)
{
    if (robot.overdueJobID != jobID)
    {
        return false;
    }
    if (robot.bUncertain)
    {
        return true; // an operator has been asked
    }
    ReleaseJob(robot);
    robot.overdueJobID.reset();
    _bDispatchNeeded = true;
    return true;
}

void PlanEngine::Impl::OnJobFinished(Robot& robot, const JobFinished& event)
{
    if (TryEndOverdueJob(robot, event.jobID))
    {
        return;
    }
    if (robot.activity != EActivity::Works || GetJobID(*robot.planOrNull) != event.jobID || robot.bUncertain)
    {
        return;
    }
    OnJobStarted(robot, JobStarted{event.jobID});
    EndJob(robot);
}

void PlanEngine::Impl::OnJobFailed(Robot& robot, const JobFailed& event)
{
    if (TryEndOverdueJob(robot, event.jobID))
    {
        return;
    }
    if (robot.activity != EActivity::Works || GetJobID(*robot.planOrNull) != event.jobID || robot.bUncertain)
    {
        return;
    }
    ReleaseJob(robot);
    FailPlan(*robot.planOrNull, event.reason);
}

void PlanEngine::Impl::OnJobTimeout(Robot& robot)
{
    if (robot.activity != EActivity::Works)
    {
        return;
    }
    robot.planOrNull->jobDeadline.reset();
    robot.overdueJobID = GetJobID(*robot.planOrNull);
    Command(robot, CancelJob{*robot.overdueJobID});
    FailPlan(*robot.planOrNull, "The job took longer than its limit.");
}

} // namespace ACS::Planning
