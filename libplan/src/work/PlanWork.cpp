#include "work/PlanWork.hpp"

#include "robot/JobCommand.hpp"
#include <acs/core/Uuid.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace ACS::Planning
{

PlanWork::PlanWork(EngineState& engine, ControlAnswers& answers, LoadWatch& loads, StatusPublisher& status)
    : _options(engine.options),
      _site(engine.site),
      _hold(engine.hold),
      _random(engine.random),
      _plans(engine.plans),
      _jobTimes(engine.jobTimes),
      _fleet(engine.fleet),
      _alarms(engine.alarms),
      _transaction(engine.transaction),
      _answers(answers),
      _loads(loads),
      _status(status),
      _assignment(engine)
{
}

PlanAssignment& PlanWork::GetAssignment() noexcept
{
    return _assignment;
}

void PlanWork::MarkStepBegun(ActivePlan& plan)
{
    if (plan.record.progress.steps[plan.step].state == EStepState::Dispatched)
    {
        _transaction.ChangeStep(plan, EStepState::InProgress, {});
    }
}

void PlanWork::MarkArrived(Robot& robot)
{
    ActivePlan& plan = *robot.planOrNull;
    _assignment.Start(plan);
    if (!std::exchange(plan.record.progress.bArrived, true))
    {
        _plans.MarkProgressed(plan.record.plan.planID);
    }
    MarkStepBegun(plan);
    if (!std::exchange(plan.bStepArrived, true))
    {
        _status.PublishStatus(robot, ERobotStatus::Arrival);
    }
}

void PlanWork::UpdateApproach(Robot& robot)
{
    const ActiveDrive& drive = *robot.drive;
    if (drive.bTaken && drive.goal == EDriveGoal::Step && robot.planOrNull != nullptr && !drive.IsCancelling()
        && drive.IsApproaching())
    {
        MarkArrived(robot);
    }
}

void PlanWork::BeginWork(Robot& robot)
{
    MarkArrived(robot);
    if (robot.planOrNull->bUnstored || PortCheck::DescribeMissingTrayOrNull(robot).has_value())
    {
        return; // the start of the plan is not stored yet, or the tray is missing
    }
    robot.activity = EActivity::Works;
    BeginJob(robot);
}

void PlanWork::BeginJob(Robot& robot)
{
    ActivePlan& plan = *robot.planOrNull;
    robot.changes.MarkStatus();
    plan.bJobBegun = true;
    if (!HasJob(plan))
    {
        plan.madeJobID = Core::MakeUUID(_random);
    }
    if (robot.work.IsUnresolved())
    {
        SuspendUnresolvedJob(robot);
        return;
    }
    if (HasJob(plan) && GetJobState(plan) == EJobState::Pending)
    {
        _transaction.ChangeJob(plan, EJobState::Instructed, {});
    }
    const std::string repeated = std::exchange(plan.repetition.commandID, {});
    StartJob job = MakeStartJob(robot);
    job.commandID = repeated.empty() ? Core::MakeUUID(_random) : repeated;
    job.jobNumber = robot.work.NumberJob(!repeated.empty(), _random);
    job.progressToken = robot.view.state.has_value() ? robot.view.state->restartEvidence.progressToken : std::string();
    job.nodeID = robot.place.node.has_value() ? _site.GetNodes()[*robot.place.node].nodeID : std::string();
    robot.work.AddCommand(job.commandID);
    robot.job.Begin(job);
    plan.jobClock.begunAt = _transaction.GetNow().steady;
    _transaction.Command(robot, std::move(job));
    LimitJob(robot);
}

void PlanWork::LimitJob(Robot& robot)
{
    const ActivePlan& plan = *robot.planOrNull;
    const std::chrono::milliseconds timeout = plan.resolved.steps[plan.step].rule->timeout;
    if (timeout.count() > 0)
    {
        StartJobTimer(robot, timeout);
    }
}

void PlanWork::StartJobTimer(Robot& robot, Core::Duration limit)
{
    robot.planOrNull->jobClock.deadline = _transaction.GetNow().steady + limit;
    _transaction.StartTimer(EEngineTimer::JobTimeout, robot.GetID(), limit);
}

void PlanWork::StopJobTimer(Robot& robot)
{
    if (robot.planOrNull->jobClock.deadline.has_value())
    {
        robot.planOrNull->jobClock.deadline.reset();
        _transaction.CancelTimer(EEngineTimer::JobTimeout, robot.GetID());
    }
}

void PlanWork::EndJob(Robot& robot, std::string message)
{
    ActivePlan& plan = *robot.planOrNull;
    StopJobTimer(robot);
    if (plan.jobClock.begunAt.has_value())
    {
        _jobTimes.Note(plan.resolved.steps[plan.step].stationID, _transaction.GetNow().steady - *plan.jobClock.begunAt);
    }
    ReleaseJob(robot);
    plan.jobClock.timeLeft.reset();
    _loads.MoveCarrier(robot, MakeStartJob(robot));
    _transaction.ChangeJob(plan, EJobState::Completed, std::move(message));
    const bool bStepDone = plan.job + 1 >= plan.record.plan.steps[plan.step].jobs.size();
    const bool bAborting = plan.record.progress.control == EPlanControl::Abort;
    if (bStepDone && (!bAborting || _options.controls.bAbortReportsStep))
    {
        _transaction.ChangeStep(plan, EStepState::Completed, {});
    }
    if (bAborting)
    {
        EndByControl(plan, EPlanControl::Abort);
        return;
    }
    if (bStepDone)
    {
        LeaveStep(robot);
        return;
    }
    ++plan.job;
    plan.repetition = {};
    ContinuePlan(robot);
}

void PlanWork::LeaveStep(Robot& robot)
{
    ActivePlan& plan = *robot.planOrNull;
    const std::optional<std::size_t> next = FindOpenStepOrNull(plan, plan.step + 1);
    plan.next = next.has_value() ? EContinuation::Step : EContinuation::End;
    if (!next.has_value() && plan.record.progress.state != EPlanState::Paused)
    {
        EndPlan(plan, EPlanState::Completed, {});
        return;
    }
    if (next.has_value())
    {
        plan.step = *next;
        plan.job = 0;
    }
    ContinuePlan(robot);
}

void PlanWork::ContinuePlan(Robot& robot)
{
    const ActivePlan& plan = *robot.planOrNull;
    if (!robot.IsHeld())
    {
        BeginNext(robot);
        return;
    }
    // Continues when the pause ends.
    robot.activity = EActivity::Waits;
    robot.changes.MarkStatus();
    if (plan.record.progress.control == EPlanControl::Pause && !robot.control.pause.IsPaused())
    {
        ConfirmPause(robot);
    }
}

void PlanWork::BeginNext(Robot& robot)
{
    if (robot.planOrNull->next == EContinuation::Step)
    {
        _assignment.BeginStep(*robot.planOrNull, robot);
        return;
    }
    if (robot.IsUsable() && !PortCheck::DescribeMissingTrayOrNull(robot).has_value() && !_hold.IsActive())
    {
        BeginJob(robot);
        return;
    }
    // Continues when the robot, or the tray, is available again, or the hold of the restart ends.
    robot.activity = EActivity::Waits;
    robot.changes.MarkStatus();
}

void PlanWork::ConfirmPause(Robot& robot)
{
    ActivePlan& plan = *robot.planOrNull;
    plan.jobClock.begunAt.reset(); // the time until the job's end includes the pause
    if (plan.jobClock.deadline.has_value())
    {
        const Core::Duration least = std::chrono::milliseconds(1);
        plan.jobClock.timeLeft = std::max(least, *plan.jobClock.deadline - _transaction.GetNow().steady);
        StopJobTimer(robot);
    }
    _status.PublishStatus(robot, ERobotStatus::Stopped);
    robot.changes.MarkStatus();
    if (plan.record.progress.state != EPlanState::Paused)
    {
        _transaction.ChangePlan(
            plan,
            EPlanState::Paused,
            fmt::format("Paused by {}.", ControlAnswers::DescribeOrigin(plan, EPlanControl::Pause)));
    }
    _answers.Answer(plan, true, "The plan is paused.");
}

void PlanWork::FailPlan(ActivePlan& plan, const std::string& reason)
{
    _assignment.Start(plan);
    const bool bAborting =
        plan.record.progress.control == EPlanControl::Abort && !_options.controls.bJobFailureFailsAbort;
    if (plan.record.progress.state == EPlanState::Paused && !bAborting)
    {
        _answers.LeavePause(plan, reason);
    }
    const EJobState job = GetJobState(plan);
    if (job == EJobState::Instructed || job == EJobState::InProgress)
    {
        _transaction.ChangeJob(plan, EJobState::Failed, reason);
    }
    if (bAborting)
    {
        EndByControl(plan, EPlanControl::Abort);
        return;
    }
    const EStepState step = plan.record.progress.steps[plan.step].state;
    if (step == EStepState::Dispatched || step == EStepState::InProgress)
    {
        _transaction.ChangeStep(plan, EStepState::Failed, reason);
    }
    EndPlan(plan, EPlanState::Failed, reason);
}

void PlanWork::EndPlan(ActivePlan& plan, EPlanState state, const std::string& message)
{
    if (!PlanBook::CanEnd(plan, state))
    {
        _answers.LeavePause(plan, message);
    }
    _transaction.ChangePlan(plan, state, message);
    const bool bAsAsked = (plan.record.progress.control == EPlanControl::Cancel && state == EPlanState::Cancelled)
        || (plan.record.progress.control == EPlanControl::Abort && state == EPlanState::Aborted);
    const bool bReasoned = !bAsAsked && !message.empty();
    _answers.Answer(
        plan,
        bAsAsked,
        fmt::format("The plan is {}{}{}", GetText(state), bReasoned ? ": " : ".", bReasoned ? message : ""));
    if (plan.robot.has_value())
    {
        Robot& robot = _fleet[*plan.robot];
        StopJobTimer(robot);
        _answers.ReleasePause(robot);
        if (!robot.job.IsOverdue())
        {
            ReleaseJob(robot);
        }
        PlanAssignment::FreeRobot(robot);
    }
    _transaction.RequestDispatch();
    if (state == EPlanState::Completed)
    {
        // A robot that has completed a plan was checked; otherwise these alarms would stay indefinitely.
        _transaction.ReportAlarms(_alarms.ClearIf([&plan](const Alarm& alarm) {
            return alarm.robotID == plan.record.progress.robotID
                && (alarm.errorCode == ALARM_INTERRUPTED || alarm.errorCode == ALARM_DROPPED);
        }));
    }
    _transaction.Store(_plans.End(plan));
}

void PlanWork::EndByControl(ActivePlan& plan, EPlanControl control)
{
    EndPlan(
        plan,
        control == EPlanControl::Cancel ? EPlanState::Cancelled : EPlanState::Aborted,
        fmt::format("Ended by {}.", ControlAnswers::DescribeOrigin(plan, control)));
}

void PlanWork::DropJob(Robot& robot)
{
    const ActivePlan& plan = *robot.planOrNull;
    robot.job.MarkOverdue();
    _transaction.Command(robot, CancelJob{GetJobID(plan)});
    _transaction.StartTimer(EEngineTimer::JobEnd, robot.GetID(), _options.controls.jobEndTimeout);
    if (GetJobState(plan) == EJobState::InProgress)
    {
        RaiseDropped(robot);
    }
}

void PlanWork::RaiseDropped(const Robot& robot)
{
    const ActionRule& rule = *robot.planOrNull->resolved.steps[robot.planOrNull->step].rule;
    if (rule.from != EPlaceRule::None || rule.to != EPlaceRule::None)
    {
        _transaction.RaiseAlarm(MakeDroppedAlarm(robot));
    }
}

Alarm PlanWork::MakeDroppedAlarm(const Robot& robot)
{
    Alarm alarm = MakeAlarm(
        robot.GetID(),
        ALARM_DROPPED,
        EAlarmLevel::Heavy,
        "Job cancelled after it had begun. Check whether the robot still has the carrier.");
    AddJob(alarm, *robot.job.GetOrNull());
    return alarm;
}

void PlanWork::SuspendUnresolvedJob(Robot& robot)
{
    robot.planOrNull->repetition.commandID.clear();
    robot.job.Begin(MakeStartJob(robot));
    robot.changes.MarkWork();
    SuspendJob(robot, "the robot may have done work that the ACS could not store before it stopped");
}

void PlanWork::SuspendJob(Robot& robot, const std::string& reason)
{
    robot.job.MarkUnresolved();
    robot.changes.MarkStatus();
    const StartJob& job = *robot.job.GetOrNull();
    Alarm alarm = MakeUnresolvedAlarm(robot);
    const bool bOfPlan = robot.planOrNull != nullptr && !robot.job.IsOverdue();
    alarm.message = fmt::format(
        "Outcome of {} at {} unknown: {}. Check the robot and the station, then answer {}.",
        job.action,
        job.position,
        reason,
        bOfPlan
            ? "done (the plan continues with the next job), failed (the plan fails) or again (the job was not done and "
              "nothing was moved: it is repeated). Or skip the step (the plan continues with the next step, and the job has no "
              "further report), or abort the plan from the MCS"
            : "done (the carrier was moved) or failed (it was not). The robot is available again after that, and after the end of "
              "the program that its arm may run");
    _transaction.RaiseAlarm(std::move(alarm));
    if (!bOfPlan)
    {
        return;
    }
    StopJobTimer(robot);
    robot.planOrNull->jobClock.begunAt.reset();  // it no longer shows how long a job takes
    robot.planOrNull->jobClock.timeLeft.reset(); // of a pause: the job is not continued
    if (robot.planOrNull->record.progress.control == EPlanControl::Abort)
    {
        AbortUnresolvedJob(robot);
    }
}

void PlanWork::AbortUnresolvedJob(Robot& robot)
{
    RaiseDropped(robot);
    AbandonJob(robot);
    EndByControl(*robot.planOrNull, EPlanControl::Abort);
}

void PlanWork::AbandonJob(Robot& robot)
{
    _transaction.Command(robot, CancelJob{robot.job.GetOrNull()->jobID});
    robot.job.Abandon();
}

void PlanWork::RecoverResolvedJob(Robot& robot)
{
    robot.job.BeginResolvedRecovery();
    const StartJob& job = *robot.job.GetResolvedOrNull();
    _transaction.Command(robot, RecoverJob{job, robot.work.GetEarlierIDs()});
    _transaction.Command(robot, CancelJob{job.jobID}); // the robot is occupied until it has reported the end
}

Alarm PlanWork::MakeUnresolvedAlarm(const Robot& robot)
{
    Alarm alarm = MakeAlarm(robot.GetID(), ALARM_UNRESOLVED, EAlarmLevel::Heavy, {});
    AddJob(alarm, *robot.job.GetOrNull());
    return alarm;
}

void PlanWork::ReleaseJob(Robot& robot)
{
    if (robot.job.GetOrNull() == nullptr)
    {
        return;
    }
    _transaction.ClearAlarm(MakeUnresolvedAlarm(robot));
    robot.job.Release();
    if (robot.planOrNull != nullptr)
    {
        robot.planOrNull->jobClock.begunAt.reset();
    }
    robot.changes.MarkWork();
    if (robot.job.IsResolvedRecoveryDue())
    {
        RecoverResolvedJob(robot);
    }
}

void PlanWork::RepeatJob(Robot& robot, std::string commandID)
{
    StopJobTimer(robot);
    ReleaseJob(robot);
    robot.work.ForgetCommand(commandID);
    robot.planOrNull->repetition.commandID = std::move(commandID);
    robot.activity = EActivity::Waits;
    robot.changes.MarkStatus();
    _transaction.RequestDispatch();
    if (robot.planOrNull->record.progress.control == EPlanControl::Pause && !robot.control.pause.IsPaused())
    {
        ConfirmPause(robot); // the pause was waiting for the end of the job
    }
}

void PlanWork::EndRecovery(Robot& robot)
{
    if (!robot.job.TryEndRecovery())
    {
        return;
    }
    _transaction.ClearAlarm(MakeUnresolvedAlarm(robot));
    const PlanProgress& progress = robot.planOrNull->record.progress;
    // A paused job that an abort lets end runs again.
    if (progress.state == EPlanState::Paused && progress.control != EPlanControl::Abort)
    {
        const std::chrono::milliseconds timeout =
            robot.planOrNull->resolved.steps[robot.planOrNull->step].rule->timeout;
        robot.planOrNull->jobClock.timeLeft =
            timeout.count() > 0 ? std::optional<Core::Duration>(timeout) : std::nullopt;
        return;
    }
    LimitJob(robot);
}

} // namespace ACS::Planning
