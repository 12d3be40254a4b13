#include "work/JobOutcomes.hpp"

namespace ACS::Planning
{

JobOutcomes::JobOutcomes(EngineState& engine, LoadWatch& loads, PlanWork& work)
    : _transaction(engine.transaction),
      _loads(loads),
      _work(work)
{
}

void JobOutcomes::OnJobStarted(Robot& robot, const JobStarted& event)
{
    if (robot.activity != EActivity::Works || GetJobID(*robot.planOrNull) != event.jobID)
    {
        return;
    }
    if (robot.job.IsUnresolved())
    {
        return; // an operator resolves it
    }
    robot.work.MarkCommandTaken();
    robot.changes.bWork = true;
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
    if (TryEndOverdueJob(robot, event.jobID, true))
    {
        return;
    }
    if (robot.activity != EActivity::Works || GetJobID(*robot.planOrNull) != event.jobID || robot.job.IsUnresolved())
    {
        return;
    }
    OnJobStarted(robot, JobStarted{event.jobID});
    _work.EndJob(robot, {});
}

void JobOutcomes::OnJobFailed(Robot& robot, const JobFailed& event)
{
    if (TryEndOverdueJob(robot, event.jobID, false))
    {
        return;
    }
    if (robot.activity != EActivity::Works || GetJobID(*robot.planOrNull) != event.jobID || robot.job.IsUnresolved())
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
    robot.planOrNull->jobDeadline.reset();
    _work.DropJob(robot);
    _work.FailPlan(*robot.planOrNull, "The job exceeded its time limit.");
}

void JobOutcomes::OnJobUnknown(Robot& robot, const JobUnknown& event)
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
    const bool bOverdue = robot.job.IsOverdue(event.jobID);
    const bool bOfPlan = robot.activity == EActivity::Works && GetJobID(*robot.planOrNull) == event.jobID;
    if ((bOverdue || bOfPlan) && !robot.job.IsUnresolved())
    {
        // After a restart, a progress token that does not prove this job proves none of the later jobs either.
        if (robot.job.IsRecovering() && bOfPlan && !robot.job.GetOrNull()->progressToken.empty())
        {
            robot.work.MarkUnresolved();
        }
        robot.changes.bWork = true;
        _work.SuspendJob(robot, event.reason);
    }
}

} // namespace ACS::Planning
