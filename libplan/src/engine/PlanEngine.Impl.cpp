#include "engine/PlanEngine.Impl.hpp"

#include <acs/core/Overloaded.hpp>

#include <algorithm>
#include <cassert>
#include <iterator>

namespace ACS::Planning
{

PlanEngine::Impl::Impl(EngineOptions options, SiteMap site, Core::IRandom& random)
    : _options(std::move(options)),
      _site(std::move(site)),
      _random(random),
      _router(_site),
      _admission(_options, _site),
      _traffic(_site, _options.clearance),
      _plans(_options)
{
    assert(FindMistakes(_options, _site).empty());
    _robots.resize(_options.robots.size());
    for (std::size_t i = 0; i < _robots.size(); ++i)
    {
        Robot& robot = _robots[i];
        robot.index = i;
        robot.options = &_options.robots[i];
        robot.ports = PortLedger(robot.options->ports);
        _robotIndices.emplace(GetRobotID(robot), i);
        robot.homeNode = GetHomeOrNull(robot);
        if (robot.options->chargingStationID.has_value())
        {
            robot.chargeNode =
                _admission.FindDockOrNull(*robot.options->chargingStationID, robot.options->vehicleTypeID);
        }
        robot.lastStatus = MakeStatus(robot, DeriveStatus(robot));
        robot.bTouched = false;
    }
    AssignParking();
}

void PlanEngine::Impl::SetObserver(IPlanObserver& observer)
{
    _observerOrNull = &observer;
}

void PlanEngine::Impl::HandleCommand(const PlanCommand& command, Core::Now now, EngineActions& out)
{
    Begin(now);
    std::visit(
        Core::Overloaded{
            [this](const SubmitPlan& submit) { Submit(submit); },
            [this](const ControlPlan& control) { Control(control); },
            [this](const MessageAcknowledged& acknowledged) { Acknowledge(acknowledged); },
            [this](const ControlTsc& control) { SwitchTsc(control); },
            [this](const SettleJob& settle) { Settle(settle); },
            [this](const SetMaintenance& maintenance) { Maintain(maintenance); },
            [this](const ClearAlarms& clear) { ClearByOperator(clear); },
            [this](const SetCarriers& carriers) { CorrectCarriers(carriers); },
            [this](const SkipStep& skip) {
                Skip(skip);
            }},
        command);
    if (!std::holds_alternative<MessageAcknowledged>(command))
    {
        std::ranges::for_each(_robots, [this](const Robot& robot) { NoteMovable(robot); });
    }
    End(out);
}

void PlanEngine::Impl::SubmitAll(std::span<const SubmitPlan> plans, Core::Now now, EngineActions& out)
{
    Begin(now);
    std::ranges::for_each(plans, [this](const SubmitPlan& plan) { Submit(plan); });
    End(out);
}

void PlanEngine::Impl::HandleEvent(std::string_view robotID, const RobotEvent& event, Core::Now now, EngineActions& out)
{
    const auto found = _robotIndices.find(robotID);
    if (found == _robotIndices.end())
    {
        return;
    }
    Begin(now);
    Robot& robot = _robots[found->second];
    robot.bTouched = true;
    robot.bWorkTouched = true;
    std::visit(
        Core::Overloaded{
            [this, &robot](const LinkChanged& typed) { OnLink(robot, typed); },
            [this, &robot](const StateChanged& typed) { OnState(robot, typed); },
            [this, &robot](const NodePassed& typed) { OnNodePassed(robot, typed); },
            [this, &robot](const Arrived& typed) { OnArrived(robot, typed); },
            [this, &robot](const DriveRejected& typed) { OnDriveRejected(robot, typed); },
            [this, &robot](const DriveCancelled& typed) { OnDriveCancelled(robot, typed); },
            [this, &robot](const JobStarted& typed) { OnJobStarted(robot, typed); },
            [this, &robot](const JobFinished& typed) { OnJobFinished(robot, typed); },
            [this, &robot](const JobFailed& typed) { OnJobFailed(robot, typed); },
            [this, &robot](const JobUnknown& typed) { OnJobUnknown(robot, typed); },
            [this, &robot](const JobUncertain& typed) { OnJobUncertain(robot, typed); },
            [this, &robot](const JobCheckChanged& typed) {
                OnJobCheck(robot, typed);
            }},
        event);
    NoteMovable(robot);
    End(out);
}

void PlanEngine::Impl::OnTimer(const EngineTimer& timer, Core::Now now, EngineActions& out)
{
    Begin(now);
    const auto found = _robotIndices.find(timer.robotID);
    Robot* robotOrNull = found == _robotIndices.end() ? nullptr : &_robots[found->second];
    switch (timer.kind)
    {
        case EEngineTimer::Dispatch:
            ReportAccepted();
            _bDispatchNeeded = true;
            break;
        case EEngineTimer::StoreRetry:
            _backlog.OnRetryDue(); // The end of the call stores what is left.
            break;
        case EEngineTimer::Acknowledged:
            std::ranges::move(_acknowledged, std::back_inserter(_changes));
            _acknowledged.clear();
            break;
        case EEngineTimer::DriveExtension:
            if (robotOrNull != nullptr && robotOrNull->drive.has_value())
            {
                robotOrNull->drive->bConfirmed = true; // It has had its time to say so.
                _bDispatchNeeded = true;
            }
            break;
        case EEngineTimer::ControlConfirm:
            if (robotOrNull != nullptr && std::exchange(robotOrNull->bConfirming, false))
            {
                OnControlTimeout(*robotOrNull);
            }
            break;
        case EEngineTimer::JobTimeout:
            if (robotOrNull != nullptr)
            {
                OnJobTimeout(*robotOrNull);
            }
            break;
        case EEngineTimer::HomeRetry:
            if (robotOrNull != nullptr)
            {
                robotOrNull->bHomeRefused = false;
                _bDispatchNeeded = true;
            }
            break;
        case EEngineTimer::Startup:
            EndStartup();
            RaiseMissing();
            break;
        case EEngineTimer::JobEnd:
            if (robotOrNull != nullptr)
            {
                OnJobEndTimeout(*robotOrNull);
            }
            break;
        case EEngineTimer::ChargeRetry:
            if (robotOrNull != nullptr)
            {
                OnChargeRetry(*robotOrNull);
            }
            break;
        case EEngineTimer::DriveStall:
            if (robotOrNull != nullptr)
            {
                OnDriveStall(*robotOrNull);
            }
            break;
        case EEngineTimer::LoadAlarm:
            if (robotOrNull != nullptr)
            {
                OnLoadAlarmTimer(*robotOrNull);
            }
            break;
        default:
            assert(false && "a timer has no case");
            break;
    }
    if (robotOrNull != nullptr)
    {
        NoteMovable(*robotOrNull);
    }
    End(out);
}

void PlanEngine::Impl::Begin(Core::Now now)
{
    assert(!_gate.IsClosed());
    _now = now;
    _plans.BeginCall();
    CheckStoreRecovery();
    _begun.clear();
    _asked.reset();
    _repeated.clear();
}

/// One batch for the whole call, then everything that waits for it.
void PlanEngine::Impl::End(EngineActions& out)
{
    UpdateStartup();
    if (_bDispatchNeeded && !_startup.IsHoldingWork())
    {
        Dispatch();
    }
    FinishTscPause();
    std::ranges::for_each(_robots, [this](Robot& robot) { UpdateStall(robot); });
    PublishStatusChanges();
    WatchOutbox();
    CollectWork();
    std::vector<StoreChange> changes = _backlog.CollectChanges();
    std::ranges::move(_plans.CollectProgress(), std::back_inserter(changes));
    std::ranges::move(_changes, std::back_inserter(changes));
    _changes.clear();
    if (!_backlog.IsWorthTrying(changes))
    {
        _backlog.Add(std::move(changes));
        ReleaseActions(out);
        return;
    }
    EngineActions dependent;
    if (!changes.empty())
    {
        std::ranges::move(_acknowledged, std::back_inserter(changes));
        _acknowledged.clear();
        if (_backlog.TryBeginAttempt())
        {
            StartStoreRetry(dependent);
        }
    }
    for (OutboxEntry& entry : _backlog.CollectReports())
    {
        dependent.emplace_back(SendReport{std::move(entry)});
    }
    std::ranges::move(_actions, std::back_inserter(dependent));
    _actions.clear();
    if (changes.empty())
    {
        std::ranges::move(dependent, std::back_inserter(out));
        return;
    }
    StoreBatch batch{std::move(changes)};
    _gate.Close(batch, std::move(dependent));
    out.emplace_back(StorePlans{std::move(batch)});
}

/// What robots were told in this call is stored before they are told.
void PlanEngine::Impl::CollectWork()
{
    for (Robot& robot : _robots)
    {
        if (!std::exchange(robot.bWorkTouched, false))
        {
            continue;
        }
        RobotWorkChanged work = robot.work.Make(GetRobotID(robot));
        work.bPauseAsked = robot.pause.IsPaused() || robot.pause.IsResuming();
        if (const StartJob* jobOrNull = robot.job.GetOrNull(); jobOrNull != nullptr)
        {
            work.job = *jobOrNull;
        }
        if (robot.state.has_value())
        {
            work.mark = robot.state->mark;
        }
        if (!robot.drive.has_value()) // while it drives the nodes alone are no reason to write: they only become fewer
        {
            work.nodeIDs = ListNodes(robot);
        }
        if (robot.work.TryBeginStore(work))
        {
            work.nodeIDs = ListNodes(robot);
            robot.work.OnStored(work);
            _changes.emplace_back(std::move(work));
        }
    }
}

/// Gives the report's transactionID, until the next one.
std::string_view PlanEngine::Impl::AddReport(Report report)
{
    const OutboxEntry& entry = _outbox.Add(std::move(report), _now.wall, _random);
    _changes.emplace_back(ReportAdded{entry});
    _actions.emplace_back(SendReport{entry});
    return entry.transactionID;
}

/// `outbox.max`. What runs goes on and is reported: nothing is thrown away, but nothing new begins.
void PlanEngine::Impl::WatchOutbox()
{
    constexpr std::size_t TENTH = 10;
    Alarm alarm = MakeAlarm(
        OWN_ROBOT_ID,
        ALARM_OUTBOX,
        EAlarmLevel::Heavy,
        "The MCS has not acknowledged too many reports: new plans are refused.");
    const std::size_t count = _outbox.GetUnacknowledged().size();
    if (count >= _options.maximumReports)
    {
        RaiseAlarm(std::move(alarm));
    }
    else if (count < _options.maximumReports - _options.maximumReports / TENTH)
    {
        ClearAlarm(alarm);
    }
}

void PlanEngine::Impl::PublishStatusChanges()
{
    for (Robot& robot : _robots)
    {
        if (std::exchange(robot.bTouched, false))
        {
            PublishStatus(robot, DeriveStatus(robot));
        }
    }
}

void PlanEngine::Impl::PublishStatus(Robot& robot, ERobotStatus status)
{
    RobotStatus made = MakeStatus(robot, status);
    if (made == robot.lastStatus)
    {
        return;
    }
    robot.lastStatus = std::move(made);
    if (_observerOrNull != nullptr)
    {
        _observerOrNull->OnRobotStatusChanged(robot.lastStatus, _now);
    }
    _actions.emplace_back(RobotStatusChanged{robot.lastStatus});
}

void PlanEngine::Impl::StartTimer(EEngineTimer kind, const std::string& robotID, Core::Duration delay)
{
    _actions.emplace_back(StartEngineTimer{{kind, robotID}, delay});
}

void PlanEngine::Impl::CancelTimer(EEngineTimer kind, const std::string& robotID)
{
    _actions.emplace_back(CancelEngineTimer{{kind, robotID}});
}

void PlanEngine::Impl::Command(Robot& robot, RobotCommand command)
{
    robot.bWorkTouched = true;
    _actions.emplace_back(CommandRobot{GetRobotID(robot), std::move(command)});
}

void PlanEngine::Impl::Note(const Robot& robot, const std::string& text)
{
    if (_observerOrNull != nullptr)
    {
        _observerOrNull->OnNote(GetRobotID(robot), text, _now);
    }
}

void PlanEngine::Impl::ChangePlan(ActivePlan& plan, EPlanState state, std::string message)
{
    const EPlanState from = _plans.Change(plan, state, message, _now.wall);
    const std::string_view transactionID = AddReport(PlanReport{plan.record.plan.planID, state, std::move(message)});
    if (_observerOrNull != nullptr)
    {
        _observerOrNull->OnPlanChanged(plan.record, from, transactionID, _now);
    }
}

void PlanEngine::Impl::ChangeStep(ActivePlan& plan, EStepState state, std::string message)
{
    ChangeStepAt(plan, plan.step, state, std::move(message));
}

void PlanEngine::Impl::ChangeStepAt(ActivePlan& plan, std::size_t index, EStepState state, std::string message)
{
    const EStepState from = _plans.ChangeStep(plan, index, state);
    const std::string_view transactionID = AddReport(StepReport{
        plan.record.plan.planID,
        plan.record.progress.robotID,
        plan.record.plan.steps[index].stepNo,
        state,
        std::move(message)});
    if (_observerOrNull != nullptr)
    {
        _observerOrNull->OnStepChanged(plan.record, index, from, transactionID, _now);
    }
}

void PlanEngine::Impl::ChangeJob(ActivePlan& plan, EJobState state, std::string message)
{
    if (!HasJob(plan))
    {
        return; // The engine made this job: the MCS has no id for it.
    }
    const EJobState from = _plans.ChangeJob(plan, state);
    const std::string_view transactionID = AddReport(JobReport{
        plan.record.plan.planID,
        plan.record.progress.robotID,
        plan.record.plan.steps[plan.step].stepNo,
        GetJobID(plan),
        state,
        std::move(message)});
    if (_observerOrNull != nullptr)
    {
        _observerOrNull->OnJobChanged(plan.record, plan.step, plan.job, from, transactionID, _now);
    }
}

void PlanEngine::Impl::Store(std::vector<StoreChange> changes)
{
    std::ranges::move(changes, std::back_inserter(_changes));
}

void PlanEngine::Impl::ReportAlarms(const std::vector<ErrorReport>& reports)
{
    for (const ErrorReport& report : reports)
    {
        const Alarm& alarm = report.alarm;
        _changes.push_back(report.bSet ? StoreChange(AlarmSet{alarm}) : StoreChange(AlarmCleared{alarm}));
        const std::string_view transactionID = AddReport(report);
        if (_observerOrNull != nullptr)
        {
            _observerOrNull->OnAlarmChanged(alarm, report.bSet, transactionID, _now);
        }
    }
}

void PlanEngine::Impl::RaiseAlarm(Alarm alarm)
{
    ReportAlarms(_alarms.Raise(std::move(alarm)));
}

void PlanEngine::Impl::ClearAlarm(const Alarm& alarm)
{
    ReportAlarms(_alarms.Clear(alarm));
}

} // namespace ACS::Planning
