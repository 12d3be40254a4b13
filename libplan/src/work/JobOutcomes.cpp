#include "work/JobOutcomes.hpp"

namespace ACS::Planning
{

JobOutcomes::JobOutcomes(EngineState& engine, LoadWatch& loads, RejectionWatch& rejections, PlanWork& work)
    : _transaction(engine.transaction),
      _loads(loads),
      _rejections(rejections),
      _work(work)
{
}

void JobOutcomes::OnJobStarted(Robot& robot, const JobStarted& event)
{
    if (!IsPresent(robot, event.jobID))
    {
        return;
    }
    robot.job.MarkBegun(event.jobID);
    _rejections.EndRow(robot);
    robot.work.MarkCommandTaken();
    robot.changes.MarkWork();
    _work.EndRecovery(robot);
    ActivePlan& plan = *robot.planOrNull;
    if (GetJobState(plan) == EJobState::Instructed)
    {
        _transaction.ChangeJob(plan, EJobState::InProgress, {});
    }
}

bool JobOutcomes::TryEndOverdueJob(Robot& robot, const std::string& jobID, bool bDone)
{
    if (!robot.job.IsOverdue(jobID))
    {
        return false;
    }
    _transaction.CancelTimer(EEngineTimer::JobEnd, robot.GetID());
    if (bDone)
    {
        _transaction.ClearAlarm(PlanWork::MakeDroppedAlarm(robot));
        _loads.MoveCarrier(robot, *robot.job.GetOrNull());
    }
    _work.ReleaseJob(robot);
    _transaction.RequestDispatch();
    return true;
}

void JobOutcomes::OnJobEndTimeout(Robot& robot)
{
    if (robot.job.IsOverdue() && !robot.job.IsUnresolved())
    {
        _work.SuspendJob(robot, "its plan has ended, and the robot has not reported the end of the job");
    }
}

void JobOutcomes::OnJobFinished(Robot& robot, const JobFinished& event)
{
    robot.job.MarkBegun(event.jobID);
    EndAtRobot(robot, event.jobID);
    if (TryEndOverdueJob(robot, event.jobID, true) || !IsPresent(robot, event.jobID))
    {
        return;
    }
    OnJobStarted(robot, JobStarted{event.jobID});
    _work.EndJob(robot, {});
}

void JobOutcomes::OnJobFailed(Robot& robot, const JobFailed& event)
{
    EndAtRobot(robot, event.jobID);
    if (TryEndOverdueJob(robot, event.jobID, false) || !IsPresent(robot, event.jobID))
    {
        return;
    }
    _work.ReleaseJob(robot);
    _work.FailPlan(*robot.planOrNull, event.reason);
}

void JobOutcomes::OnJobTimeout(Robot& robot)
{
    if (robot.activity != EActivity::Works)
    {
        return;
    }
    robot.planOrNull->jobClock.deadline.reset();
    if (robot.view.state.has_value() && !robot.view.state->bAutomatic)
    {
        _work.LimitJob(robot); // the operator has interrupted it
        return;
    }
    _work.DropJob(robot);
    _work.FailPlan(*robot.planOrNull, "The job exceeded its time limit.");
}

void JobOutcomes::OnJobRejected(Robot& robot, const JobRejected& event)
{
    EndAtRobot(robot, event.jobID);
    if (TryEndOverdueJob(robot, event.jobID, false) || !IsPresent(robot, event.jobID))
    {
        return;
    }
    if (robot.planOrNull->record.progress.control == EPlanControl::Abort)
    {
        _work.EndByControl(*robot.planOrNull, EPlanControl::Abort);
        return;
    }
    _work.RepeatJob(robot, robot.job.GetOrNull()->commandID);
    _rejections.OnRejected(robot, event.reason);
}

void JobOutcomes::OnJobInterrupted(Robot& robot, const JobInterrupted& event)
{
    EndAtRobot(robot, event.jobID);
    if (TryEndOverdueJob(robot, event.jobID, false) || !IsPresent(robot, event.jobID))
    {
        return;
    }
    if (robot.planOrNull->record.progress.control == EPlanControl::Abort)
    {
        _work.EndByControl(*robot.planOrNull, EPlanControl::Abort);
    }
    else if (robot.planOrNull->repetition.bInterrupted)
    {
        _work.SuspendJob(robot, "the robot has interrupted it twice, the second time because " + event.reason);
    }
    else
    {
        _transaction.Note(robot, "repeats its job, which was interrupted: " + event.reason);
        _work.RepeatJob(robot, {});
        robot.planOrNull->repetition.bInterrupted = true;
    }
}

void JobOutcomes::OnJobUnknown(Robot& robot, const JobUnknown& event)
{
    EndAtRobot(robot, event.jobID);
    if (TryEndOverdueJob(robot, event.jobID, false) || !IsPresent(robot, event.jobID))
    {
        return;
    }
    ActivePlan& plan = *robot.planOrNull;
    // A job that begins again is InProgress since its first command.
    if (robot.job.HasBegun() || (robot.job.IsRecovering() && GetJobState(plan) == EJobState::InProgress))
    {
        _work.SuspendJob(robot, "the robot had started the job and no longer has it");
    }
    else if (robot.job.GetOrNull()->commandID.empty())
    {
        _work.SuspendJob(robot, "an earlier request for the outcome was not answered");
    }
    else if (plan.record.progress.control == EPlanControl::Abort)
    {
        _work.EndByControl(plan, EPlanControl::Abort);
    }
    else
    {
        _work.RepeatJob(robot, robot.job.GetOrNull()->commandID);
    }
}

void JobOutcomes::OnJobUnresolved(Robot& robot, const JobUnresolved& event)
{
    if (robot.job.IsResolvedRecovering(event.jobID) && robot.planOrNull != nullptr)
    {
        robot.work.MarkUnresolved(); // as below
    }
    EndAtRobot(robot, event.jobID);
    const bool bOverdue = robot.job.IsOverdue(event.jobID);
    const bool bOfPlan = robot.activity == EActivity::Works && GetJobID(*robot.planOrNull) == event.jobID;
    if ((bOverdue || bOfPlan) && !robot.job.IsUnresolved())
    {
        // After a restart, a progress token that does not prove this job proves none of the later jobs either.
        if (robot.job.IsRecovering() && bOfPlan && !robot.job.GetOrNull()->progressToken.empty())
        {
            robot.work.MarkUnresolved();
        }
        robot.changes.MarkWork();
        _work.SuspendJob(robot, event.reason);
    }
}

void JobOutcomes::EndAtRobot(Robot& robot, const std::string& jobID)
{
    if (robot.job.TryEndResolved(jobID))
    {
        robot.changes.MarkWork();
    }
    else if (robot.job.IsResolvedRecoveryDue())
    {
        _work.RecoverResolvedJob(robot);
    }
}

bool JobOutcomes::IsPresent(const Robot& robot, const std::string& jobID)
{
    return robot.activity == EActivity::Works && GetJobID(*robot.planOrNull) == jobID && !robot.job.IsUnresolved();
}

} // namespace ACS::Planning
