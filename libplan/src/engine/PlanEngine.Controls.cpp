#include "engine/PlanEngine.Impl.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <utility>

namespace ACS::Planning
{

namespace
{

/// A transactionID is one request's of its command; another command may have the same.
std::string MakeRequestID(const ControlPlan& command)
{
    return fmt::format("{} {}", GetText(command.control), command.transactionID);
}

} // namespace

void PlanEngine::Impl::ReportControlResult(
    EPlanControl control,
    const std::string& planID,
    bool bSucceeded,
    std::string message)
{
    AddReport(ControlResultReport{control, planID, bSucceeded, std::move(message)});
}

/// Register D-23: after a crash the Ack may have been lost, and not the control.
bool PlanEngine::Impl::IsRepetition(const ControlPlan& command) const
{
    const PlanRecord* recordOrNull = _plans.FindRecordOrNull(command.planID);
    return recordOrNull != nullptr && !command.transactionID.empty()
        && std::ranges::count(recordOrNull->progress.requestIDs, MakeRequestID(command)) > 0;
}

void PlanEngine::Impl::Remember(PlanProgress& progress, const ControlPlan& command)
{
    constexpr std::size_t MOST_REMEMBERED = 64; // an MCS without an Ack may send one again after many others
    if (command.transactionID.empty())
    {
        return;
    }
    if (progress.requestIDs.size() == MOST_REMEMBERED)
    {
        progress.requestIDs.erase(progress.requestIDs.begin());
    }
    progress.requestIDs.push_back(MakeRequestID(command));
    _plans.MarkProgressed(command.planID);
}

/// A control is open from here on until Answer.
void PlanEngine::Impl::Ask(ActivePlan& plan, EPlanControl control)
{
    _plans.MarkProgressed(plan.record.plan.planID);
    plan.record.progress.control = control;
    plan.record.progress.controlCount = 1;
}

/// The outcome of the control that is open, if one is: once for each time that it was asked for.
void PlanEngine::Impl::Answer(ActivePlan& plan, bool bSucceeded, const std::string& message)
{
    const std::optional<EPlanControl> control = std::exchange(plan.record.progress.control, std::nullopt);
    if (!control.has_value())
    {
        return;
    }
    _plans.MarkProgressed(plan.record.plan.planID);
    if (plan.robot.has_value())
    {
        Robot& robot = _robots[*plan.robot];
        robot.bStandstillAwaited = false;
        StopConfirmingControl(robot);
    }
    for (std::size_t count = std::exchange(plan.record.progress.controlCount, 0); count > 0; --count)
    {
        ReportControlResult(*control, plan.record.plan.planID, bSucceeded, message);
    }
}

/// Register D-19, D-20.
void PlanEngine::Impl::RefuseControl(const ControlPlan& command)
{
    PlanRecord* finishedOrNull = _plans.FindFinishedOrNull(command.planID);
    const bool bKnown = finishedOrNull != nullptr;
    const std::string reason = bKnown ? fmt::format("The plan is already {}.", GetText(finishedOrNull->progress.state))
                                      : fmt::format("There is no plan {}.", command.planID);
    _actions.emplace_back(ReplyCommand{command.replyToken, bKnown, bKnown ? "Received." : reason});
    if (bKnown)
    {
        Remember(finishedOrNull->progress, command);
    }
    if (bKnown || _options.controls.bResultAfterRefusal)
    {
        ReportControlResult(command.control, command.planID, false, reason);
    }
}

void PlanEngine::Impl::Control(const ControlPlan& command)
{
    const bool bRepeated = IsRepetition(command);
    if (_backlog.IsFailing() && (!bRepeated || _unstoredIDs.contains(MakeRequestID(command))))
    {
        _actions.emplace_back(
            ReplyCommand{command.replyToken, false, "The request cannot be stored, as the store fails: ask again."});
        return;
    }
    if (bRepeated)
    {
        _actions.emplace_back(ReplyCommand{command.replyToken, true, "Received."});
        return;
    }
    _asked = MakeRequestID(command);
    ActivePlan* planOrNull = _plans.FindActiveOrNull(command.planID);
    if (planOrNull == nullptr)
    {
        RefuseControl(command);
        return;
    }
    _actions.emplace_back(ReplyCommand{command.replyToken, true, "Received."});
    ActivePlan& plan = *planOrNull;
    Remember(plan.record.progress, command);
    if (plan.record.progress.control == command.control)
    {
        ++plan.record.progress.controlCount;
        _plans.MarkProgressed(command.planID);
        return;
    }
    const bool bEnding = plan.record.progress.control == EPlanControl::Abort
        || (plan.record.progress.control == EPlanControl::Cancel && command.control != EPlanControl::Abort);
    if (bEnding)
    {
        ReportControlResult(
            command.control,
            command.planID,
            false,
            fmt::format("{}Plan of this plan is under way.", GetText(*plan.record.progress.control)));
        return;
    }
    Apply(command.control, plan);
}

void PlanEngine::Impl::Apply(EPlanControl control, ActivePlan& plan)
{
    switch (control)
    {
        case EPlanControl::Cancel:
            Cancel(plan);
            break;
        case EPlanControl::Abort:
            Abort(plan);
            break;
        case EPlanControl::Pause:
            Pause(plan);
            break;
        case EPlanControl::Resume:
            Resume(plan);
            break;
        default:
            assert(false && "a control has no case");
            break;
    }
}

/// Section 6.5, register D-14.
bool PlanEngine::Impl::IsCancellable(const ActivePlan& plan) const
{
    switch (_options.controls.cancelUntil)
    {
        case ECancelWindow::Dispatch:
            return !plan.robot.has_value();
        case ECancelWindow::FirstJob:
            return !plan.bJobBegun;
        case ECancelWindow::FirstArrival:
        default:
            return !plan.record.progress.bArrived;
    }
}

void PlanEngine::Impl::Cancel(ActivePlan& plan)
{
    if (!IsCancellable(plan))
    {
        const char* reason = _options.controls.cancelUntil == ECancelWindow::Dispatch
            ? "A robot has the plan."
            : (plan.bJobBegun ? "The work has begun." : "The robot has arrived.");
        ReportControlResult(EPlanControl::Cancel, plan.record.plan.planID, false, reason);
        return;
    }
    Answer(plan, false, "CancelPlan came in between.");
    StopDrive(plan, EPlanControl::Cancel);
}

/// Sections 6.6 and 6.14, register D-15, D-16.
void PlanEngine::Impl::Abort(ActivePlan& plan)
{
    Answer(plan, false, "AbortPlan came in between.");
    const bool bJobRuns = plan.robot.has_value() && _robots[*plan.robot].activity == EActivity::Works;
    if (!bJobRuns)
    {
        StopDrive(plan, EPlanControl::Abort);
        return;
    }
    Robot& robot = _robots[*plan.robot];
    Ask(plan, EPlanControl::Abort);
    if (robot.job.IsUnresolved())
    {
        AbortUnresolvedJob(robot);
        return;
    }
    const bool bPaused = plan.record.progress.state == EPlanState::Paused;
    const bool bFinishes = bPaused ? _options.controls.bAbortFinishesPausedJob : !_options.controls.bAbortStopsJob;
    if (!bFinishes)
    {
        DropJob(robot);
        EndByControl(plan, EPlanControl::Abort);
        return;
    }
    ReleasePause(robot);
    if (plan.jobTimeLeft.has_value())
    {
        StartJobTimer(robot, *std::exchange(plan.jobTimeLeft, std::nullopt));
    }
}

/// The robot is told to give its job up, and is not used before it has told the job's end.
void PlanEngine::Impl::DropJob(Robot& robot)
{
    const ActivePlan& plan = *robot.planOrNull;
    robot.job.MarkOverdue();
    Command(robot, CancelJob{GetJobID(plan)});
    StartTimer(EEngineTimer::JobEnd, GetRobotID(robot), _options.controls.jobEndTimeout);
    if (GetJobState(plan) == EJobState::InProgress)
    {
        RaiseDropped(robot);
    }
}

void PlanEngine::Impl::RaiseDropped(const Robot& robot)
{
    const ActionRule& rule = *robot.planOrNull->resolved.steps[robot.planOrNull->step].rule;
    if (rule.from != EPlaceRule::None || rule.to != EPlaceRule::None)
    {
        RaiseAlarm(MakeDroppedAlarm(robot));
    }
}

Alarm PlanEngine::Impl::MakeDroppedAlarm(const Robot& robot) const
{
    Alarm alarm = MakeAlarm(
        GetRobotID(robot),
        ALARM_DROPPED,
        EAlarmLevel::Heavy,
        "A job that had begun was given up: look whether the robot still holds what it moved.");
    AddJob(alarm, *robot.job.GetOrNull());
    return alarm;
}

/// Ends the plan at once, or, where its robot is under way to the step's place, when the robot stands.
void PlanEngine::Impl::StopDrive(ActivePlan& plan, EPlanControl control)
{
    Ask(plan, control);
    Robot* robotOrNull = plan.robot.has_value() ? &_robots[*plan.robot] : nullptr;
    if (robotOrNull == nullptr || !robotOrNull->drive.has_value() || robotOrNull->drive->goal == EDriveGoal::Home)
    {
        EndByControl(plan, control);
        return;
    }
    if (std::exchange(robotOrNull->drive->cancellation, ECancellation::Awaited) != ECancellation::Awaited)
    {
        Command(*robotOrNull, CancelDrive{robotOrNull->drive->driveID});
    }
    // Between two nodes a vehicle may have to go on to the next one before it can give its drive up.
    ReleasePause(*robotOrNull);
    StartConfirming(*robotOrNull, _options.controls.cancelTimeout);
}

void PlanEngine::Impl::EndByControl(ActivePlan& plan, EPlanControl control)
{
    EndPlan(
        plan,
        control == EPlanControl::Cancel ? EPlanState::Cancelled : EPlanState::Aborted,
        fmt::format("Ended by {}Plan.", GetText(control)));
}

/// With what a pause, or a control that came to nothing, has held up.
void PlanEngine::Impl::ContinueAfterControl(Robot& robot)
{
    ActivePlan& plan = *robot.planOrNull;
    ReleasePause(robot);
    _bDispatchNeeded = true;
    robot.bTouched = true;
    if (plan.next == EContinuation::End)
    {
        EndPlan(plan, EPlanState::Completed, {});
        return;
    }
    if (plan.jobTimeLeft.has_value())
    {
        StartJobTimer(robot, *std::exchange(plan.jobTimeLeft, std::nullopt));
    }
    if (plan.next == EContinuation::Step)
    {
        BeginStep(plan, robot);
    }
    if (robot.drive.has_value())
    {
        ExtendBase(robot);
    }
}

void PlanEngine::Impl::StartConfirming(Robot& robot, Core::Duration limit)
{
    robot.bConfirming = true;
    StartTimer(EEngineTimer::ControlConfirm, GetRobotID(robot), limit);
}

void PlanEngine::Impl::StopConfirming(Robot& robot)
{
    if (std::exchange(robot.bConfirming, false))
    {
        CancelTimer(EEngineTimer::ControlConfirm, GetRobotID(robot));
    }
}

/// What it is to confirm beside the control has its time anew: that it gives its present way up for another one.
void PlanEngine::Impl::StopConfirmingControl(Robot& robot)
{
    StopConfirming(robot);
    if (robot.drive.has_value() && robot.drive->reroute.has_value())
    {
        StartConfirming(robot, _options.controls.cancelTimeout);
    }
}

void PlanEngine::Impl::StartJobTimer(Robot& robot, Core::Duration limit)
{
    robot.planOrNull->jobDeadline = _now.steady + limit;
    StartTimer(EEngineTimer::JobTimeout, GetRobotID(robot), limit);
}

void PlanEngine::Impl::StopJobTimer(Robot& robot)
{
    if (robot.planOrNull->jobDeadline.has_value())
    {
        robot.planOrNull->jobDeadline.reset();
        CancelTimer(EEngineTimer::JobTimeout, GetRobotID(robot));
    }
}

/// The robot has not shown in time that it stopped, or that it goes on: what was asked for came to nothing.
void PlanEngine::Impl::OnControlTimeout(Robot& robot)
{
    AbandonReroute(robot);
    if (robot.planOrNull == nullptr || !robot.planOrNull->record.progress.control.has_value())
    {
        return;
    }
    ActivePlan& plan = *robot.planOrNull;
    const EPlanControl control = *plan.record.progress.control;
    if (robot.drive.has_value())
    {
        robot.drive->StopAwaitingCancellation();
        UpdateApproach(robot);
    }
    const bool bStaysPaused = control != EPlanControl::Pause && plan.record.progress.state == EPlanState::Paused;
    if (bStaysPaused)
    {
        Answer(
            plan,
            false,
            control == EPlanControl::Resume ? "The robot did not show that it goes on; the plan stays paused."
                                            : "The robot did not confirm that it stopped; the plan stays paused.");
        robot.pause.Pause();
        Command(robot, Planning::Pause{});
        return;
    }
    if (plan.record.progress.state == EPlanState::Paused)
    {
        LeavePause(plan, "PausePlan failed: the robot did not confirm that it stopped.");
    }
    Answer(plan, false, "The robot did not confirm that it stopped; the plan goes on.");
    ContinueAfterControl(robot);
}

} // namespace ACS::Planning
