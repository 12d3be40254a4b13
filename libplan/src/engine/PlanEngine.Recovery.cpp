#include "engine/PlanEngine.Impl.hpp"

#include <algorithm>
#include <utility>

namespace ACS::Planning
{

void PlanEngine::Impl::Restore(StoredState state, Core::Now now, EngineActions& out)
{
    Begin(now);
    _outbox.Restore(std::move(state.outbox), state.lastReportSequence);
    RestoreAlarms(std::move(state.alarms));
    for (const CarriersChanged& stored : state.carriers)
    {
        const auto found = _robotIndices.find(stored.robotID);
        if (found != _robotIndices.end())
        {
            Robot& robot = _robots[found->second];
            robot.ports.Restore(stored.carrierIDs);
            robot.lastStatus = MakeStatus(robot, DeriveStatus(robot));
        }
    }
    for (const RobotWorkChanged& work : state.robotWorks)
    {
        RestoreRobot(work);
    }
    for (const std::string& robotID : state.robotsInMaintenance)
    {
        if (Robot* robotOrNull = FindRobotOrNull(robotID); robotOrNull != nullptr)
        {
            robotOrNull->bInMaintenance = true;
            robotOrNull->lastStatus = MakeStatus(*robotOrNull, DeriveStatus(*robotOrNull));
        }
    }
    std::ranges::sort(state.plans, {}, &PlanRecord::sequence);
    for (PlanRecord& record : state.plans)
    {
        RestorePlan(std::move(record));
    }
    for (Robot& robot : _robots)
    {
        RestoreOverdue(robot);
    }
    RestoreTsc(state.tscState);
    BeginStartup(!_plans.GetActive().empty() || !state.robotWorks.empty());
    StartTimer(EEngineTimer::Dispatch, {}, {});
    End(out);
}

/// What was paused stays so: nothing is begun. What was being worked on goes on to its end.
void PlanEngine::Impl::RestoreTsc(ETscState stored)
{
    _tscState = ETscState::Auto;
    if (_options.bTscStartsPaused || stored != ETscState::Auto)
    {
        _tscState = _plans.IsAnyRunning() ? ETscState::Pausing : ETscState::Paused;
    }
    if (_tscState != stored)
    {
        _changes.emplace_back(TscChanged{_tscState});
    }
}

/// An alarm about a robot that was removed would never be cleared, and drives start again.
void PlanEngine::Impl::RestoreAlarms(std::vector<Alarm> alarms)
{
    _alarms.Restore(std::move(alarms));
    // Set when the store worked again, to be cleared by what was not called any more.
    if (std::ranges::count(_alarms.GetAlarms(), ALARM_STORE, &Alarm::errorCode) > 0)
    {
        _backlog.RestoreFailing();
    }
    ReportAlarms(_alarms.ClearIf([this](const Alarm& alarm) {
        const bool bRobotGone = alarm.robotID != OWN_ROBOT_ID && !_robotIndices.contains(alarm.robotID);
        return bRobotGone || alarm.errorCode == ALARM_STALL;
    }));
}

/// The row of a robot that is no longer configured is kept in case the robot returns.
void PlanEngine::Impl::RestoreRobot(const RobotWorkChanged& work)
{
    const auto found = _robotIndices.find(work.robotID);
    if (found == _robotIndices.end())
    {
        return;
    }
    Robot& robot = _robots[found->second];
    robot.work.Restore(work);
    if (work.job.has_value())
    {
        robot.job.Begin(*work.job);
    }
    for (const std::string& nodeID : work.nodeIDs)
    {
        if (const std::optional<std::size_t> node = _site.FindNodeIndexOrNull(nodeID); node.has_value())
        {
            robot.possibleNodes.push_back(*node);
        }
    }
    if (work.bPauseAsked)
    {
        robot.pause.Resume(); // where no plan wants it to stand
    }
}

void PlanEngine::Impl::RestorePlan(PlanRecord record)
{
    if (IsFinal(record.progress.state))
    {
        Store(_plans.RestoreFinished(std::move(record)));
        return;
    }
    ActivePlan& plan = _plans.RestoreActive(std::move(record));
    Core::Result<ResolvedPlan> resolved = _admission.Resolve(plan.record.plan);
    const std::string& robotID = plan.record.progress.robotID;
    const auto robot = _robotIndices.find(robotID);
    const bool bRobotGone =
        !robotID.empty() && (robot == _robotIndices.end() || _robots[robot->second].planOrNull != nullptr);
    if (!resolved.has_value() || bRobotGone)
    {
        const std::string reason = resolved.has_value() ? robotID + " is gone" : Core::Describe(resolved.error());
        EndUnfit(
            plan,
            "While the ACS was down, the site, its robots or what plans may ask for have changed: " + reason);
        return;
    }
    plan.resolved = std::move(*resolved);
    if (!robotID.empty())
    {
        RestoreWork(plan, _robots[robot->second]);
        RestoreControl(plan, _robots[robot->second]);
    }
    else if (plan.record.progress.state == EPlanState::Pending) // else it is held in the queue
    {
        _plans.Enqueue(plan);
    }
}

/// What was planned does not fit what there is now. Where a robot had it, an alarm says where to look.
void PlanEngine::Impl::EndUnfit(ActivePlan& plan, const std::string& reason)
{
    FindPosition(plan);
    if (!plan.record.progress.robotID.empty())
    {
        const PlanSummary summary = MakeSummary(plan.record);
        Alarm alarm = MakeAlarm(
            plan.record.progress.robotID,
            ALARM_INTERRUPTED,
            EAlarmLevel::Heavy,
            "This plan cannot go on after the restart: look at the robot and its carriers.");
        alarm.planID = summary.planID;
        alarm.stepNo = summary.stepNo;
        alarm.jobID = summary.jobID;
        RaiseAlarm(std::move(alarm));
    }
    if (plan.record.progress.state == EPlanState::InProgress)
    {
        FailPlan(plan, reason);
    }
    else
    {
        EndPlan(plan, EPlanState::Aborted, reason);
    }
}

/// The plan stays with its robot. The robot is asked for the outcome of an unfinished job; everything else resumes.
void PlanEngine::Impl::RestoreWork(ActivePlan& plan, Robot& robot)
{
    FindPosition(plan);
    const StepProgress& step = plan.record.progress.steps[plan.step];
    const EJobState job = GetJobState(plan);
    plan.robot = robot.index;
    robot.planOrNull = &plan;
    robot.activity = EActivity::Waits;
    robot.bTouched = true;
    const EContinuation unbegun = step.state == EStepState::Pending ? EContinuation::Step : EContinuation::Job;
    plan.next = IsFinal(step.state) ? EContinuation::End : unbegun;
    const StartJob* jobOrNull = robot.job.GetOrNull();
    const bool bOpen = jobOrNull != nullptr && jobOrNull->planID == plan.record.plan.planID;
    // A store older than schema version 3 has no rows of robots.
    const bool bUntraced = !bOpen && robot.work.GetStored().robotID.empty() && job != EJobState::Pending
        && !IsFinal(job) && !IsFinal(step.state);
    const bool bStepWorked = bOpen || plan.job > 0 || job != EJobState::Pending;
    plan.bStepArrived = bStepWorked;
    plan.bJobBegun = bStepWorked || plan.step > 0;
    plan.record.progress.bArrived = plan.record.progress.bArrived || plan.bJobBegun;
    if (!bOpen && !bUntraced)
    {
        return;
    }
    robot.activity = EActivity::Works;
    if (bUntraced)
    {
        robot.job.Begin(MakeStartJob(robot));
        robot.bWorkTouched = true;
        SuspendJob(robot, "the ACS that commanded it did not write down how to ask for it");
        return;
    }
    plan.madeJobID = HasJob(plan) ? std::string() : jobOrNull->jobID;
    RequestJobOutcome(robot);
}

/// An outcome that was open is still owed, once; and what was paused stays so.
void PlanEngine::Impl::RestoreControl(ActivePlan& plan, Robot& robot)
{
    PlanProgress& progress = plan.record.progress;
    const bool bWorks = robot.activity == EActivity::Works;
    if (!progress.control.has_value())
    {
        const bool bPaused = progress.state == EPlanState::Paused;
        if (bPaused && (robot.pause.IsResuming() || bWorks))
        {
            robot.pause.Pause();
        }
        return;
    }
    constexpr std::size_t MOST_OWED = 1'000;
    progress.controlCount = std::clamp<std::size_t>(progress.controlCount, 1, MOST_OWED);
    switch (*progress.control)
    {
        case EPlanControl::Pause:
            robot.pause.Reset();
            if (!bWorks || !_options.controls.bPausesAfterJob)
            {
                robot.pause.Pause();
            }
            break;
        case EPlanControl::Resume:
            robot.pause.Resume();
            break;
        case EPlanControl::Cancel:
        case EPlanControl::Abort:
        default:
            robot.bStandstillAwaited = !bWorks;
            break;
    }
    if (!bWorks || progress.control == EPlanControl::Resume || robot.pause.IsPaused())
    {
        const bool bEnding = robot.bStandstillAwaited;
        StartConfirming(robot, bEnding ? _options.controls.cancelTimeout : _options.controls.pauseTimeout);
    }
}

/// Of a plan that is over.
void PlanEngine::Impl::RestoreOverdue(Robot& robot)
{
    const bool bOfPlan = robot.planOrNull != nullptr && robot.activity == EActivity::Works;
    if (robot.job.GetOrNull() != nullptr && !bOfPlan)
    {
        robot.job.MarkOverdue();
        RequestJobOutcome(robot);
        StartTimer(EEngineTimer::JobEnd, GetRobotID(robot), _options.controls.jobEndTimeout);
    }
}

void PlanEngine::Impl::RequestJobOutcome(Robot& robot)
{
    robot.job.BeginRecovery();
    Command(robot, RecoverJob{*robot.job.GetOrNull(), robot.work.GetEarlierIDs()});
}

/// A drive that was to be cancelled before the restart: the adapter gives up what is left of it, and here it stands.
void PlanEngine::Impl::UpdateStandstill(Robot& robot)
{
    const StateChanged& state = *robot.state;
    if (!robot.bStandstillAwaited || !robot.bPlaced || state.bOccupied || state.bDriving)
    {
        return;
    }
    robot.bStandstillAwaited = false;
    ActivePlan& plan = *robot.planOrNull;
    const EPlanControl control = *plan.record.progress.control;
    const bool bArrived = robot.node == GetTargetOrNull(robot);
    if (control != EPlanControl::Cancel || !bArrived || _options.controls.cancelUntil == ECancelWindow::FirstJob)
    {
        EndByControl(plan, control);
        return;
    }
    MarkArrived(robot);
    Answer(plan, false, "The robot has arrived.");
    if (plan.record.progress.state != EPlanState::Paused)
    {
        ContinueAfterControl(robot);
    }
}

} // namespace ACS::Planning
