#include "engine/PlanEngine.Impl.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace ACS::Planning
{

void PlanEngine::Impl::OnJobStarted(Robot& robot, const JobStarted& event)
{
    if (robot.activity != EActivity::Works || GetJobID(*robot.planOrNull) != event.jobID)
    {
        return;
    }
    if (robot.job.IsUnresolved())
    {
        return; // an operator has been asked
    }
    robot.work.MarkCommandTaken();
    robot.bWorkTouched = true;
    EndRecovery(robot);
    ActivePlan& plan = *robot.planOrNull;
    if (GetJobState(plan) == EJobState::Instructed)
    {
        ChangeJob(plan, EJobState::InProgress, {});
    }
}

/// Its plan is over, but what it did to the robot's ports counts. The robot's word is as good as an operator's.
bool PlanEngine::Impl::TryEndOverdueJob(Robot& robot, const std::string& jobID, bool bDone)
{
    if (!robot.job.IsOverdue(jobID))
    {
        return false;
    }
    CancelTimer(EEngineTimer::JobEnd, GetRobotID(robot));
    if (bDone)
    {
        ClearAlarm(MakeDroppedAlarm(robot));
        MoveCarrier(robot, *robot.job.GetOrNull());
    }
    ReleaseJob(robot);
    _bDispatchNeeded = true;
    return true;
}

/// The robot cannot be used until an operator resolves the job.
void PlanEngine::Impl::OnJobEndTimeout(Robot& robot)
{
    if (robot.job.IsOverdue() && !robot.job.IsUnresolved())
    {
        SuspendJob(robot, "its plan is over, and the robot does not tell the job's end");
    }
}

void PlanEngine::Impl::OnJobFinished(Robot& robot, const JobFinished& event)
{
    if (TryEndOverdueJob(robot, event.jobID, true))
    {
        return;
    }
    if (robot.activity != EActivity::Works || GetJobID(*robot.planOrNull) != event.jobID || robot.job.IsUnresolved())
    {
        return;
    }
    OnJobStarted(robot, JobStarted{event.jobID});
    EndJob(robot, {});
}

void PlanEngine::Impl::OnJobFailed(Robot& robot, const JobFailed& event)
{
    if (TryEndOverdueJob(robot, event.jobID, false))
    {
        return;
    }
    if (robot.activity != EActivity::Works || GetJobID(*robot.planOrNull) != event.jobID || robot.job.IsUnresolved())
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
    DropJob(robot);
    FailPlan(*robot.planOrNull, "The job took longer than its limit.");
}

/// Instead of beginning the present job.
void PlanEngine::Impl::SuspendDoubtfulJob(Robot& robot)
{
    robot.planOrNull->repeatedCommandID.clear();
    robot.job.Begin(MakeStartJob(robot));
    robot.bWorkTouched = true;
    SuspendJob(robot, "the robot may have done work that the ACS could not write down before it stopped");
}

Alarm PlanEngine::Impl::MakeUnresolvedAlarm(const Robot& robot) const
{
    Alarm alarm = MakeAlarm(GetRobotID(robot), ALARM_UNRESOLVED, EAlarmLevel::Heavy, {});
    AddJob(alarm, *robot.job.GetOrNull());
    return alarm;
}

/// The job is not repeated, and the robot gets no other work, until an operator has checked.
void PlanEngine::Impl::SuspendJob(Robot& robot, const std::string& reason)
{
    robot.job.MarkUnresolved();
    robot.bTouched = true;
    const StartJob& job = *robot.job.GetOrNull();
    Alarm alarm = MakeUnresolvedAlarm(robot);
    const bool bOfPlan = robot.planOrNull != nullptr && !robot.job.IsOverdue();
    alarm.message = fmt::format(
        "It is unknown whether {} was done at {}: {}. Check the robot and that place, then answer {}.",
        job.action,
        job.position,
        reason,
        bOfPlan
            ? "done (the plan continues with the next job), failed (the plan fails) or again (it was not done and nothing "
              "was moved: it starts again now). Or skip the step (the plan continues with the next step; the job has no "
              "further report), or have the MCS abort the plan"
            : "done (the carrier is where it was to go) or failed (it is where it was); the robot is free again then");
    RaiseAlarm(std::move(alarm));
    if (!bOfPlan)
    {
        return;
    }
    StopJobTimer(robot);
    if (robot.planOrNull->record.progress.control == EPlanControl::Abort)
    {
        AbortUnresolvedJob(robot);
    }
}

/// Aborting the plan does not require an operator to resolve its job.
void PlanEngine::Impl::AbortUnresolvedJob(Robot& robot)
{
    RaiseDropped(robot);
    EndByControl(*robot.planOrNull, EPlanControl::Abort);
}

/// The robot has reported the outcome of the job.
void PlanEngine::Impl::EndRecovery(Robot& robot)
{
    if (!robot.job.TryEndRecovery())
    {
        return;
    }
    ClearAlarm(MakeUnresolvedAlarm(robot));
    if (robot.planOrNull->record.progress.state == EPlanState::Paused)
    {
        const std::chrono::milliseconds timeout =
            robot.planOrNull->resolved.steps[robot.planOrNull->step].rule->timeout;
        robot.planOrNull->jobTimeLeft = timeout.count() > 0 ? std::optional<Core::Duration>(timeout) : std::nullopt;
        return;
    }
    LimitJob(robot);
}

/// Nothing is open any more about the job that the robot was commanded.
void PlanEngine::Impl::ReleaseJob(Robot& robot)
{
    if (robot.job.GetOrNull() == nullptr)
    {
        return;
    }
    ClearAlarm(MakeUnresolvedAlarm(robot));
    robot.job.Release();
    robot.bWorkTouched = true;
}

/// As soon as the robot stands at the place and may work. The ID is usually that of the job which is released here.
void PlanEngine::Impl::RepeatJob(Robot& robot, std::string commandID)
{
    StopJobTimer(robot);
    ReleaseJob(robot);
    robot.planOrNull->repeatedCommandID = std::move(commandID);
    robot.activity = EActivity::Waits;
    robot.bTouched = true;
    _bDispatchNeeded = true;
    if (robot.planOrNull->record.progress.control == EPlanControl::Pause && !robot.pause.IsPaused())
    {
        ConfirmPause(robot); // it was to wait for the job's end
    }
}

void PlanEngine::Impl::OnJobUnknown(Robot& robot, const JobUnknown& event)
{
    if (TryEndOverdueJob(robot, event.jobID, false))
    {
        return;
    }
    if (robot.activity != EActivity::Works || GetJobID(*robot.planOrNull) != event.jobID || robot.job.IsUnresolved())
    {
        return;
    }
    ActivePlan& plan = *robot.planOrNull;
    if (GetJobState(plan) == EJobState::InProgress)
    {
        SuspendJob(robot, "the robot does not know it, though it had begun it");
    }
    else if (robot.job.GetOrNull()->commandID.empty())
    {
        SuspendJob(robot, "what became of it was asked before, and not answered");
    }
    else if (plan.record.progress.control == EPlanControl::Abort)
    {
        EndByControl(plan, EPlanControl::Abort);
    }
    else
    {
        RepeatJob(robot, robot.job.GetOrNull()->commandID);
    }
}

void PlanEngine::Impl::OnJobUncertain(Robot& robot, const JobUncertain& event)
{
    const bool bOverdue = robot.job.IsOverdue(event.jobID);
    const bool bOfPlan = robot.activity == EActivity::Works && GetJobID(*robot.planOrNull) == event.jobID;
    if ((bOverdue || bOfPlan) && !robot.job.IsUnresolved())
    {
        // After a restart, marks without this job have none of the later jobs either.
        if (robot.job.IsRecovering() && bOfPlan && !robot.job.GetOrNull()->mark.empty())
        {
            robot.work.MarkDoubtful();
        }
        robot.bWorkTouched = true;
        SuspendJob(robot, event.reason);
    }
}

/// The robot that has the job, by its index.
std::optional<std::size_t> PlanEngine::Impl::FindWorkerOrNull(const SettleJob& command) const
{
    const auto robot = std::ranges::find_if(_robots, [&command](const Robot& candidate) {
        const StartJob* jobOrNull = candidate.job.GetOrNull();
        return jobOrNull != nullptr && jobOrNull->planID == command.planID && jobOrNull->jobID == command.jobID;
    });
    return robot == _robots.end() ? std::nullopt : std::optional(robot->index);
}

/// Answered are jobs that are held, those of plans that are over, and those of robots that are not there to tell.
std::optional<std::string> PlanEngine::Impl::GetRejectionReasonOrNull(const SettleJob& command) const
{
    const std::optional<std::size_t> worker = FindWorkerOrNull(command);
    if (!worker.has_value())
    {
        return "No robot has such a job.";
    }
    const Robot& robot = _robots[*worker];
    const bool bOver = robot.job.IsOverdue();
    if (bOver && command.answer == EJobAnswer::Again)
    {
        return "Its plan is over: answer done or failed.";
    }
    if (robot.job.IsUnresolved() || bOver)
    {
        return std::nullopt;
    }
    if (robot.bOnline)
    {
        return fmt::format("{} will tell how it ends.", GetRobotID(robot));
    }
    return command.answer == EJobAnswer::Again
        ? std::optional(fmt::format("{} is not there to do it again: answer done or failed.", GetRobotID(robot)))
        : std::nullopt;
}

void PlanEngine::Impl::Settle(const SettleJob& command)
{
    if (std::optional<std::string> reason = GetRejectionReasonOrNull(command))
    {
        _actions.emplace_back(ReplyCommand{command.replyToken, false, std::move(*reason)});
        return;
    }
    Robot& robot = _robots[*FindWorkerOrNull(command)];
    _actions.emplace_back(ReplyCommand{command.replyToken, true, "Received."});
    robot.bTouched = true;
    ApplyAnswer(robot, command.answer);
}

/// A job that was done and never stored as commanded is reported from its beginning.
void PlanEngine::Impl::CatchUp(Robot& robot)
{
    ActivePlan& plan = *robot.planOrNull;
    MarkArrived(robot);
    plan.bJobBegun = true;
    if (HasJob(plan) && GetJobState(plan) == EJobState::Pending)
    {
        ChangeJob(plan, EJobState::Instructed, {});
    }
}

void PlanEngine::Impl::ApplyAnswer(Robot& robot, EJobAnswer answer)
{
    robot.job.Resolve();
    const std::string jobID = robot.job.GetOrNull()->jobID;
    if (TryEndOverdueJob(robot, jobID, answer == EJobAnswer::Done))
    {
        return;
    }
    switch (answer)
    {
        case EJobAnswer::Done:
            CatchUp(robot);
            OnJobStarted(robot, JobStarted{jobID});
            EndJob(robot, "Reported as done by the operator.");
            break;
        case EJobAnswer::Again:
            robot.work.TryClearDoubt(); // nor was anything after it done
            RepeatJob(robot, {});
            break;
        case EJobAnswer::Failed:
        default:
            OnJobFailed(robot, JobFailed{jobID, "The operator says that it was not done."});
            break;
    }
}

} // namespace ACS::Planning
