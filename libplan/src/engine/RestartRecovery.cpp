#include "engine/RestartRecovery.hpp"

#include "robot/JobCommand.hpp"
#include <acs/plan/PlanSummaries.hpp>
#include <acs/plan/PlanTransitions.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <tuple>
#include <utility>

namespace ACS::Planning
{

RestartRecovery::RestartRecovery(
    EngineState& engine,
    TscControl& tsc,
    ControlAnswers& answers,
    PlaceTracker& places,
    StatusPublisher& status,
    PlanWork& work)
    : _options(engine.options),
      _site(engine.site),
      _admission(engine.admission),
      _plans(engine.plans),
      _fleet(engine.fleet),
      _alarms(engine.alarms),
      _outbox(engine.outbox),
      _transaction(engine.transaction),
      _backlog(engine.backlog),
      _startup(engine.startup),
      _hold(engine.hold),
      _tsc(tsc),
      _answers(answers),
      _places(places),
      _status(status),
      _work(work)
{
}

void RestartRecovery::Restore(StoredState state)
{
    _hold.Restore(std::move(state.holdReason));
    _outbox.Restore(std::move(state.outbox), state.lastReportSequence);
    RestoreAlarms(std::move(state.alarms));
    std::ranges::for_each(state.carriers, [this](const CarriersChanged& stored) { RestoreCarriers(stored); });
    for (const RobotWorkChanged& work : state.robotWorks)
    {
        RestoreRobot(work);
    }
    for (const std::string& robotID : state.robotsInMaintenance)
    {
        if (Robot* robotOrNull = _fleet.FindOrNull(robotID); robotOrNull != nullptr)
        {
            robotOrNull->view.bInMaintenance = true;
            _status.Reset(*robotOrNull);
        }
    }
    // The history in the order in which the plans ended, whatever the wall clock was set to, then the unfinished plans in the
    // order of their acceptance. Records of former versions have no storedAt.
    std::ranges::sort(state.plans, {}, [](const PlanRecord& record) {
        const PlanProgress& progress = record.progress;
        return progress.endedAt.has_value()
            ? std::tuple(false, progress.storedAt, *progress.endedAt, record.sequence)
            : std::tuple(true, std::chrono::milliseconds(), Core::WallTime(), record.sequence);
    });
    for (PlanRecord& record : state.plans)
    {
        RestorePlan(std::move(record));
    }
    for (Robot& robot : _fleet)
    {
        RestoreOverdue(robot);
    }
    _tsc.RestoreTSC(state.tscState.value_or(ETscState::Auto));
    BeginStartup(!_plans.GetActive().empty() || !state.robotWorks.empty());
    _transaction.StartTimer(EEngineTimer::Dispatch, {}, {});
}

void RestartRecovery::RestoreCarriers(const CarriersChanged& stored)
{
    Robot* robotOrNull = _fleet.FindOrNull(stored.robotID);
    if (robotOrNull == nullptr)
    {
        return;
    }
    Robot& robot = *robotOrNull;
    robot.ports.Restore(stored);
    _status.Reset(robot);
    CarriersChanged record = robot.ports.MakeRecord(stored.robotID);
    if (record.ports != stored.ports)
    {
        _transaction.Store(std::move(record));
    }
    if (const std::string stranded = robot.ports.DescribeStranded(); !stranded.empty())
    {
        const std::string text = fmt::format(
            "The ports of {} have changed in the configuration, and the record has carriers at ports that no longer exist: {}. "
            "Ports that are new have an unknown carrier. Check the ports and correct the record.",
            stored.robotID,
            stranded);
        _transaction.Note(robot, text);
        _transaction.RaiseAlarm(MakeAlarm(stored.robotID, ALARM_PORT, EAlarmLevel::Light, text));
    }
}

void RestartRecovery::RestoreRobot(const RobotWorkChanged& work)
{
    Robot* robotOrNull = _fleet.FindOrNull(work.robotID);
    if (robotOrNull == nullptr)
    {
        return;
    }
    Robot& robot = *robotOrNull;
    robot.work.Restore(work);
    if (work.job.has_value())
    {
        robot.job.Begin(*work.job);
    }
    robot.job.RestoreAbandoned(work.abandonedJobID);
    if (work.resolvedJob.has_value())
    {
        robot.job.RestoreResolved(*work.resolvedJob);
    }
    for (const std::string& nodeID : work.nodeIDs)
    {
        if (const std::optional<std::size_t> node = _site.FindNodeIndexOrNull(nodeID); node.has_value())
        {
            robot.place.possibleNodes.push_back(*node);
        }
    }
    if (work.bPauseAsked)
    {
        robot.control.pause.Resume(); // unless its plan is paused (RestoreControl)
    }
}

void RestartRecovery::RestorePlan(PlanRecord record)
{
    if (IsFinal(record.progress.state))
    {
        _transaction.Store(_plans.RestoreFinished(std::move(record)));
        return;
    }
    ActivePlan& plan = _plans.RestoreActive(std::move(record));
    Core::Result<ResolvedPlan> resolved = _admission.Resolve(plan.record.plan);
    const std::string& robotID = plan.record.progress.robotID;
    Robot* robotOrNull = _fleet.FindOrNull(robotID);
    const bool bRobotGone = !robotID.empty() && (robotOrNull == nullptr || robotOrNull->planOrNull != nullptr);
    const bool bRobotUnfit = resolved.has_value() && robotOrNull != nullptr
        && std::ranges::count(resolved->candidates, robotOrNull->index) == 0;
    if (!resolved.has_value() || bRobotGone || bRobotUnfit)
    {
        std::string reason = robotID + (bRobotGone ? " is not available" : " can no longer execute it");
        if (!resolved.has_value())
        {
            reason = Core::Describe(resolved.error());
        }
        EndUnfit(
            plan,
            "The plan no longer fits the site or its robots, which changed while the ACS was stopped: " + reason);
        return;
    }
    plan.resolved = std::move(*resolved);
    if (robotOrNull != nullptr)
    {
        RestoreWork(plan, *robotOrNull);
        RestoreControl(plan, *robotOrNull);
    }
    else if (const std::optional<EPlanControl> control = plan.record.progress.control; control.has_value())
    {
        _work.EndByControl(plan, *control); // its robot had not accepted its first command
    }
    else if (plan.record.progress.state == EPlanState::Pending) // else it is held in the queue
    {
        _plans.Enqueue(plan);
    }
}

void RestartRecovery::RestoreWork(ActivePlan& plan, Robot& robot)
{
    FindPosition(plan);
    const StepProgress& step = plan.record.progress.steps[plan.step];
    const EJobState job = GetJobState(plan);
    plan.robot = robot.index;
    robot.planOrNull = &plan;
    robot.activity = EActivity::Waits;
    robot.changes.MarkStatus();
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
        robot.changes.MarkWork();
        _work.SuspendJob(robot, "an older version of the ACS started it and stored no command ID");
        return;
    }
    plan.madeJobID = HasJob(plan) ? std::string() : jobOrNull->jobID;
    RequestJobOutcome(robot);
}

void RestartRecovery::RestoreControl(ActivePlan& plan, Robot& robot)
{
    PlanProgress& progress = plan.record.progress;
    const bool bWorks = robot.activity == EActivity::Works;
    if (!progress.control.has_value())
    {
        const bool bPaused = progress.state == EPlanState::Paused;
        if (bPaused && (robot.control.pause.IsResuming() || bWorks))
        {
            robot.control.pause.Pause();
        }
        return;
    }
    constexpr std::size_t MOST_OWED = 1'000;
    const std::size_t leastOwed = progress.controlOrigin == EControlOrigin::MCS ? 1 : 0;
    progress.controlCount = std::clamp<std::size_t>(progress.controlCount, leastOwed, MOST_OWED);
    switch (*progress.control)
    {
        case EPlanControl::Pause:
            robot.control.pause.Reset();
            if (!bWorks || !_options.controls.bPausesAfterJob)
            {
                robot.control.pause.Pause();
            }
            break;
        case EPlanControl::Resume:
            robot.control.pause.Resume();
            break;
        case EPlanControl::Cancel:
        case EPlanControl::Abort:
        default:
            robot.control.bStandstillAwaited = !bWorks;
            break;
    }
    if (!bWorks || progress.control == EPlanControl::Resume || robot.control.pause.IsPaused())
    {
        const bool bEnding = robot.control.bStandstillAwaited;
        _answers.StartConfirming(robot, bEnding ? _options.controls.cancelTimeout : _options.controls.pauseTimeout);
    }
}

void RestartRecovery::RestoreAlarms(std::vector<Alarm> alarms)
{
    _alarms.Restore(std::move(alarms));
    // The store worked again, but the crash came before the alarm was cleared.
    if (std::ranges::count(_alarms.GetAlarms(), ALARM_STORE, &Alarm::errorCode) > 0)
    {
        _backlog.RestoreFailing();
    }
    _transaction.ReportAlarms(_alarms.ClearIf([this](const Alarm& alarm) {
        const Robot* const robotOrNull = _fleet.FindOrNull(alarm.robotID);
        const bool bRobotGone = alarm.robotID != OWN_ROBOT_ID && robotOrNull == nullptr;
        const bool bChargerGone = alarm.errorCode == ALARM_CHARGE && robotOrNull != nullptr
            && !robotOrNull->options->chargingStationID.has_value();
        return bRobotGone || bChargerGone || alarm.errorCode == ALARM_STALL || alarm.errorCode == ALARM_WAIT
            || alarm.errorCode == ALARM_REJECTIONS || alarm.errorCode == ALARM_INCOMPATIBLE;
    }));
}

void RestartRecovery::RestoreOverdue(Robot& robot)
{
    const bool bOfPlan = robot.planOrNull != nullptr && robot.activity == EActivity::Works;
    if (robot.job.GetOrNull() != nullptr && !bOfPlan)
    {
        robot.job.MarkOverdue();
        RequestJobOutcome(robot);
        _transaction.Command(robot, CancelJob{robot.job.GetOrNull()->jobID});
        _transaction.StartTimer(EEngineTimer::JobEnd, robot.GetID(), _options.controls.jobEndTimeout);
    }
    else if (robot.job.IsResolvedRecoveryDue())
    {
        _work.RecoverResolvedJob(robot);
    }
}

void RestartRecovery::EndUnfit(ActivePlan& plan, const std::string& reason)
{
    FindPosition(plan);
    if (!plan.record.progress.robotID.empty())
    {
        const PlanSummary summary = MakeSummary(plan.record);
        Alarm alarm = MakeAlarm(
            plan.record.progress.robotID,
            ALARM_INTERRUPTED,
            EAlarmLevel::Heavy,
            "Plan ended by the restart: it no longer fits the site or its robots. Check the robot and its carriers.");
        alarm.planID = summary.planID;
        alarm.stepNo = summary.stepNo;
        alarm.jobID = summary.jobID;
        _transaction.RaiseAlarm(std::move(alarm));
    }
    if (plan.record.progress.state == EPlanState::InProgress)
    {
        _work.FailPlan(plan, reason);
    }
    else
    {
        _work.EndPlan(plan, EPlanState::Aborted, reason);
    }
}

void RestartRecovery::RequestJobOutcome(Robot& robot)
{
    robot.job.BeginRecovery();
    _transaction.Command(robot, RecoverJob{*robot.job.GetOrNull(), robot.work.GetEarlierIDs()});
}

bool RestartRecovery::IsPositionAwaited(const Robot& robot)
{
    return !robot.view.state.has_value() && !robot.view.bInMaintenance;
}

void RestartRecovery::BeginStartup(bool bHasWork)
{
    constexpr std::chrono::seconds MISSING_DELAY{30}; ///< Until a missing robot is an alarm, without a barrier.
    if (_options.restartWait.count() > 0)
    {
        _startup.Begin(bHasWork);
        _transaction.StartTimer(EEngineTimer::Startup, {}, _options.restartWait);
    }
    else
    {
        _places.ReservePossibleNodes();
        _transaction.StartTimer(EEngineTimer::Startup, {}, MISSING_DELAY);
    }
}

void RestartRecovery::OnStartupDue()
{
    if (_startup.IsWaiting())
    {
        EndStartup();
    }
    RaiseMissing();
}

void RestartRecovery::UpdateStartup()
{
    if (_startup.IsWaiting() && std::ranges::none_of(_fleet, IsPositionAwaited))
    {
        _transaction.CancelTimer(EEngineTimer::Startup, {});
        EndStartup();
    }
}

void RestartRecovery::EndStartup()
{
    _places.ReservePossibleNodes();
    if (_startup.TryRelease())
    {
        _transaction.RequestDispatch();
        if (_tsc.GetState() == ETscState::Auto)
        {
            _tsc.PublishTscState(ETscState::Paused);
        }
    }
}

void RestartRecovery::RaiseMissing()
{
    for (const Robot& robot : _fleet)
    {
        if (!IsPositionAwaited(robot))
        {
            continue;
        }
        if (robot.view.bOnline)
        {
            _transaction.RaiseAlarm(
                PlaceTracker::MakePlaceAlarm(robot, "Robot connected, but it reports no state. Check the robot."));
            continue;
        }
        const bool bHasWork = robot.planOrNull != nullptr || robot.job.GetOrNull() != nullptr;
        Alarm alarm = MakeLinkAlarm(
            robot.GetID(),
            bHasWork
                ? "The robot has unfinished work and has not connected since the start of the ACS. Check the robot and its network."
                : "The robot has not connected since the start of the ACS. Check the robot and its network.");
        if (!robot.options->connectionHint.empty())
        {
            alarm.message += " " + robot.options->connectionHint;
        }
        if (!robot.place.possibleNodes.empty())
        {
            alarm.message +=
                " The nodes of its last position stay reserved until it reconnects or is set to maintenance.";
        }
        _transaction.RaiseAlarm(std::move(alarm));
    }
}

} // namespace ACS::Planning
