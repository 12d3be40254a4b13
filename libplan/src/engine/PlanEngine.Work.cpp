#include "engine/PlanEngine.Impl.hpp"
#include <acs/core/Uuid.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <utility>

namespace ACS::Planning
{

namespace
{

std::optional<std::string> GetTextForOrNull(const std::optional<Core::Location>& place, const Core::RobotID& robotID)
{
    if (!place.has_value())
    {
        return std::nullopt;
    }
    const Core::Result<Core::Location> port = place->WithRobot(robotID);
    return port.has_value() ? port->GetText() : place->GetText();
}

} // namespace

void PlanEngine::Impl::BeginPlan(ActivePlan& plan, Robot& robot)
{
    _plans.Dequeue(plan);
    plan.robot = robot.index;
    plan.rejections.clear();
    plan.record.progress.robotID = GetRobotID(robot);
    robot.planOrNull = &plan;
    robot.bHomeRefused = false;
    robot.work.BeginPlan(robot.state.has_value() ? robot.state->shownCommandID : std::nullopt);
    robot.bWorkTouched = true;
    _begun.push_back(plan.record.plan.planID);
    ChangePlan(plan, EPlanState::InProgress, fmt::format("Assigned to {}.", GetRobotID(robot)));
    BeginStep(plan, robot);
}

void PlanEngine::Impl::BeginStep(ActivePlan& plan, Robot& robot)
{
    plan.job = 0;
    plan.next = EContinuation::Job;
    plan.bStepArrived = false;
    robot.activity = EActivity::Waits;
    robot.bTouched = true;
    robot.plannedRoute.reset();
    robot.detours = 0;
    ChangeStep(plan, EStepState::Dispatched, {});
    _bDispatchNeeded = true;
}

void PlanEngine::Impl::MarkStepBegun(ActivePlan& plan)
{
    if (plan.record.progress.steps[plan.step].state == EStepState::Dispatched)
    {
        ChangeStep(plan, EStepState::InProgress, {});
    }
}

/// The robot is at the last node before its step's place, or there.
void PlanEngine::Impl::MarkArrived(Robot& robot)
{
    ActivePlan& plan = *robot.planOrNull;
    if (!std::exchange(plan.record.progress.bArrived, true))
    {
        _plans.MarkProgressed(plan.record.plan.planID);
    }
    MarkStepBegun(plan);
    if (!std::exchange(plan.bStepArrived, true))
    {
        PublishStatus(robot, ERobotStatus::Arrival);
    }
}

/// The robot stands at its step's place and can work.
void PlanEngine::Impl::BeginWork(Robot& robot)
{
    MarkArrived(robot);
    if (robot.planOrNull->bUnstored || DescribeMissingTrayOrNull(robot).has_value())
    {
        return; // after a crash nobody would know that it was ever begun; or its tray is not there
    }
    robot.activity = EActivity::Works;
    BeginJob(robot);
}

void PlanEngine::Impl::BeginJob(Robot& robot)
{
    ActivePlan& plan = *robot.planOrNull;
    robot.bTouched = true;
    plan.bJobBegun = true;
    if (!HasJob(plan))
    {
        plan.madeJobID = Core::MakeUuid(_random);
    }
    if (robot.work.IsDoubtful())
    {
        SuspendDoubtfulJob(robot);
        return;
    }
    if (HasJob(plan) && GetJobState(plan) == EJobState::Pending)
    {
        ChangeJob(plan, EJobState::Instructed, {});
    }
    const std::string repeated = std::exchange(plan.repeatedCommandID, {});
    StartJob job = MakeStartJob(robot);
    job.commandID = repeated.empty() ? Core::MakeUuid(_random) : repeated;
    job.jobNumber = robot.work.NumberJob(!repeated.empty(), _random);
    job.mark = robot.state.has_value() ? robot.state->mark : std::string();
    robot.work.AddCommand(job.commandID);
    robot.job.Begin(job);
    Command(robot, std::move(job));
    LimitJob(robot);
}

void PlanEngine::Impl::LimitJob(Robot& robot)
{
    const ActivePlan& plan = *robot.planOrNull;
    const std::chrono::milliseconds timeout = plan.resolved.steps[plan.step].rule->timeout;
    if (timeout.count() > 0)
    {
        StartJobTimer(robot, timeout);
    }
}

StartJob PlanEngine::Impl::MakeStartJob(const Robot& robot) const
{
    const ActivePlan& plan = *robot.planOrNull;
    StartJob job = MakeStartJob(plan, plan.step, plan.job, robot);
    job.jobID = GetJobID(plan);
    return job;
}

/// As the plan has it. A step without jobs has one job, without places and without an id.
StartJob PlanEngine::Impl::MakeStartJob(
    const ActivePlan& plan,
    std::size_t stepIndex,
    std::size_t jobIndex,
    const Robot& robot) const
{
    const Step& step = plan.record.plan.steps[stepIndex];
    const ResolvedStep& resolved = plan.resolved.steps[stepIndex];
    const Core::RobotID& robotID = _options.robots[robot.index].robotID;
    StartJob job;
    job.planID = plan.record.plan.planID;
    job.stepNo = step.stepNo;
    job.action = step.action;
    job.position = resolved.stationID;
    if (jobIndex < resolved.jobs.size())
    {
        job.jobID = step.jobs[jobIndex].jobID;
        job.from = GetTextForOrNull(resolved.jobs[jobIndex].from, robotID);
        job.to = GetTextForOrNull(resolved.jobs[jobIndex].to, robotID);
    }
    if (jobIndex < step.carrierIDs.size() && !step.carrierIDs[jobIndex].empty())
    {
        job.carrierID = step.carrierIDs[jobIndex];
    }
    return job;
}

/// The ports of its robot that a job empties and fills, in this order.
std::vector<PortUse> PlanEngine::Impl::ListPortUses(const Robot& robot, const StartJob& job) const
{
    const auto rule = _options.actions.find(job.action);
    const EActionEffect effect = rule == _options.actions.end() ? EActionEffect::None : rule->second.effect;
    std::vector<PortUse> uses;
    for (const bool bFills : {false, true})
    {
        const std::optional<std::string>& place = bFills ? job.to : job.from;
        const std::optional<std::size_t> port =
            IsPortChanged(effect, bFills) && place.has_value() ? robot.ports.FindPortOrNull(*place) : std::nullopt;
        if (port.has_value())
        {
            uses.push_back({*port, bFills});
        }
    }
    return uses;
}

/// What a finished job does to the robot's ports. What does not fit is reported, not refused: the robot has done it, so the
/// ports were not what the engine believed.
void PlanEngine::Impl::MoveCarrier(Robot& robot, const StartJob& job)
{
    const std::vector<PortUse> uses = ListPortUses(robot, job);
    if (uses.empty())
    {
        return;
    }
    const std::string contradiction = robot.ports.Move(uses, job.carrierID);
    Alarm alarm = MakeAlarm(GetRobotID(robot), ALARM_PORT, EAlarmLevel::Light, contradiction);
    if (contradiction.empty())
    {
        ClearAlarm(alarm);
    }
    else
    {
        RaiseAlarm(std::move(alarm));
    }
    UpdateLoadAlarm(robot);
    robot.bTouched = true;
    _changes.emplace_back(CarriersChanged{GetRobotID(robot), robot.ports.GetCarriers()});
}

void PlanEngine::Impl::EndJob(Robot& robot, std::string message)
{
    ActivePlan& plan = *robot.planOrNull;
    StopJobTimer(robot);
    ReleaseJob(robot);
    plan.jobTimeLeft.reset();
    MoveCarrier(robot, MakeStartJob(robot));
    ChangeJob(plan, EJobState::Completed, std::move(message));
    const bool bStepDone = plan.job + 1 >= plan.record.plan.steps[plan.step].jobs.size();
    const bool bAborting = plan.record.progress.control == EPlanControl::Abort;
    if (bStepDone && (!bAborting || _options.controls.bAbortReportsStep))
    {
        ChangeStep(plan, EStepState::Completed, {});
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
    ContinuePlan(robot);
}

/// On to the next step that is not skipped, or to the end.
void PlanEngine::Impl::LeaveStep(Robot& robot)
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

/// With the next job or step, unless the plan is to begin nothing further.
void PlanEngine::Impl::ContinuePlan(Robot& robot)
{
    const ActivePlan& plan = *robot.planOrNull;
    if (!IsHeld(robot))
    {
        BeginNext(robot);
        return;
    }
    // The rest is for when the pause ends.
    robot.activity = EActivity::Waits;
    robot.bTouched = true;
    if (plan.record.progress.control == EPlanControl::Pause && !robot.pause.IsPaused())
    {
        ConfirmPause(robot);
    }
}

/// What comes after a job.
void PlanEngine::Impl::BeginNext(Robot& robot)
{
    if (robot.planOrNull->next == EContinuation::Step)
    {
        BeginStep(*robot.planOrNull, robot);
        return;
    }
    if (IsUsable(robot) && !DescribeMissingTrayOrNull(robot).has_value())
    {
        BeginJob(robot);
        return;
    }
    // As soon as it is there again, or its tray is.
    robot.activity = EActivity::Waits;
    robot.bTouched = true;
}

/// Section 6.14: the job, its step and the plan at once; nothing about what never ran.
void PlanEngine::Impl::FailPlan(ActivePlan& plan, const std::string& reason)
{
    const bool bAborting =
        plan.record.progress.control == EPlanControl::Abort && !_options.controls.bJobFailureFailsAbort;
    if (plan.record.progress.state == EPlanState::Paused && !bAborting)
    {
        LeavePause(plan, reason);
    }
    const EJobState job = GetJobState(plan);
    if (job == EJobState::Instructed || job == EJobState::InProgress)
    {
        ChangeJob(plan, EJobState::Failed, reason);
    }
    if (bAborting)
    {
        EndByControl(plan, EPlanControl::Abort);
        return;
    }
    const EStepState step = plan.record.progress.steps[plan.step].state;
    if (step == EStepState::Dispatched || step == EStepState::InProgress)
    {
        ChangeStep(plan, EStepState::Failed, reason);
    }
    EndPlan(plan, EPlanState::Failed, reason);
}

/// The robot is free again, the plan is history. The plan lives to the end of this call. A control that is under way has
/// its answer in that.
void PlanEngine::Impl::EndPlan(ActivePlan& plan, EPlanState state, const std::string& message)
{
    if (!PlanBook::CanEnd(plan, state))
    {
        LeavePause(plan, message);
    }
    ChangePlan(plan, state, message);
    const bool bAsAsked = (plan.record.progress.control == EPlanControl::Cancel && state == EPlanState::Cancelled)
        || (plan.record.progress.control == EPlanControl::Abort && state == EPlanState::Aborted);
    const bool bReasoned = !bAsAsked && !message.empty();
    Answer(
        plan,
        bAsAsked,
        fmt::format("The plan is {}{}{}", GetText(state), bReasoned ? ": " : ".", bReasoned ? message : ""));
    if (plan.robot.has_value())
    {
        Robot& robot = _robots[*plan.robot];
        StopJobTimer(robot);
        ReleasePause(robot);
        if (!robot.job.IsOverdue())
        {
            ReleaseJob(robot);
        }
        robot.planOrNull = nullptr;
        robot.activity = EActivity::Idle;
        robot.bWorkTouched = robot.work.TryClearDoubt() || robot.bWorkTouched;
        robot.retreatNode.reset();
        robot.bTouched = true;
        robot.plannedRoute.reset();
    }
    _bDispatchNeeded = true;
    if (state == EPlanState::Completed)
    {
        // A robot that has completed a plan since was checked; otherwise the list of alarms would only grow.
        ReportAlarms(_alarms.ClearIf([&plan](const Alarm& alarm) {
            return alarm.robotID == plan.record.progress.robotID
                && (alarm.errorCode == ALARM_INTERRUPTED || alarm.errorCode == ALARM_DROPPED);
        }));
    }
    Store(_plans.End(plan));
}

} // namespace ACS::Planning
