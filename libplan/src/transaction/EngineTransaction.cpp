#include "transaction/EngineTransaction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace ACS::Planning
{

EngineTransaction::EngineTransaction(
    Core::IRandom& random,
    PlanBook& plans,
    AlarmBook& alarms,
    ReportOutbox& outbox,
    const OutboxRoom& room)
    : _random(random),
      _plans(plans),
      _alarms(alarms),
      _outbox(outbox),
      _room(room)
{
}

void EngineTransaction::AddObserver(IPlanObserver& observer)
{
    _observers.emplace_back(observer);
}

void EngineTransaction::SetNow(Core::Now now)
{
    _now = now;
}

const Core::Now& EngineTransaction::GetNow() const noexcept
{
    return _now;
}

void EngineTransaction::Store(StoreChange change)
{
    _changes.push_back(std::move(change));
}

void EngineTransaction::PublishRobotStatus(const RobotStatus& status)
{
    for (IPlanObserver& observer : _observers)
    {
        observer.OnRobotStatusChanged(status, _now);
    }
    _actions.emplace_back(RobotStatusChanged{status});
}

void EngineTransaction::PublishTscState(ETscState state, ETscState from)
{
    _actions.emplace_back(TscStateChanged{state});
    for (IPlanObserver& observer : _observers)
    {
        observer.OnTscChanged(state, from, _now);
    }
}

void EngineTransaction::RequestDispatch() noexcept
{
    _bDispatchNeeded = true;
}

bool EngineTransaction::IsDispatchNeeded() const noexcept
{
    return _bDispatchNeeded;
}

bool EngineTransaction::TryBeginDispatch() noexcept
{
    return std::exchange(_bDispatchNeeded, false);
}

std::vector<StoreChange> EngineTransaction::CollectChanges()
{
    return std::exchange(_changes, {});
}

EngineActions EngineTransaction::CollectActions()
{
    return std::exchange(_actions, {});
}

std::string_view EngineTransaction::AddReport(Report report)
{
    return AddReport(std::move(report), std::nullopt);
}

std::string_view EngineTransaction::AddReport(Report report, std::optional<std::uint64_t> replacedOrNull)
{
    const OutboxEntry& entry = _outbox.Add(std::move(report), _now.wall, _random);
    _changes.emplace_back(ReportAdded{entry});
    _actions.emplace_back(SendReport{entry, replacedOrNull});
    return entry.transactionID;
}

std::optional<std::uint64_t> EngineTransaction::RemoveReportOrNull(const Alarm& alarm)
{
    const std::optional<std::uint64_t> former = _outbox.FindAlarmOrNull(alarm);
    if (!former.has_value() || !_outbox.TryRemove(*former))
    {
        return std::nullopt;
    }
    const auto ofThisCall = std::ranges::find_if(_actions, [&former](const EngineAction& action) {
        const auto* sendOrNull = std::get_if<SendReport>(&action);
        return sendOrNull != nullptr && sendOrNull->entry.sequence == *former;
    });
    if (ofThisCall == _actions.end())
    {
        _changes.emplace_back(ReportRemoved{*former});
        return former;
    }
    const std::optional<std::uint64_t> replaced = std::get<SendReport>(*ofThisCall).replaced;
    _actions.erase(ofThisCall);
    std::erase_if(_changes, [&former](const StoreChange& change) {
        const auto* addedOrNull = std::get_if<ReportAdded>(&change);
        return addedOrNull != nullptr && addedOrNull->entry.sequence == *former;
    });
    return replaced;
}

void EngineTransaction::WatchOutbox()
{
    if (_room.IsFull())
    {
        RaiseAlarm(MakeAlarm(
            OWN_ROBOT_ID,
            ALARM_OUTBOX,
            EAlarmLevel::Heavy,
            fmt::format(
                "Outbox full: {} reports are not acknowledged, accepted plans can cause {} more, and new plans are refused. "
                "Check the MCS and its connection.",
                _outbox.GetUnacknowledged().size(),
                _plans.GetReportsAhead())));
    }
    else if (_room.IsFree())
    {
        ClearAlarm(MakeAlarm(OWN_ROBOT_ID, ALARM_OUTBOX, EAlarmLevel::Heavy, {}));
    }
}

void EngineTransaction::StartTimer(EEngineTimer kind, const std::string& robotID, Core::Duration delay)
{
    _actions.emplace_back(StartEngineTimer{{kind, robotID}, delay});
}

void EngineTransaction::CancelTimer(EEngineTimer kind, const std::string& robotID)
{
    _actions.emplace_back(CancelEngineTimer{{kind, robotID}});
}

void EngineTransaction::Command(Robot& robot, RobotCommand command)
{
    robot.changes.MarkWork();
    _actions.emplace_back(CommandRobot{robot.GetID(), std::move(command)});
}

void EngineTransaction::Note(const Robot& robot, const std::string& text)
{
    for (IPlanObserver& observer : _observers)
    {
        observer.OnNote(robot.GetID(), text, _now);
    }
}

void EngineTransaction::ChangePlan(ActivePlan& plan, EPlanState state, std::string message)
{
    const EPlanState from = _plans.Change(plan, state, message, _now.wall);
    const std::string_view transactionID = AddReport(PlanReport{plan.record.plan.planID, state, std::move(message)});
    for (IPlanObserver& observer : _observers)
    {
        observer.OnPlanChanged(plan.record, from, transactionID, _now);
    }
}

void EngineTransaction::ChangeStep(ActivePlan& plan, EStepState state, std::string message)
{
    ChangeStepAt(plan, plan.step, state, std::move(message));
}

void EngineTransaction::ChangeStepAt(ActivePlan& plan, std::size_t index, EStepState state, std::string message)
{
    const EStepState from = _plans.ChangeStep(plan, index, state);
    const std::string_view transactionID = AddReport(StepReport{
        plan.record.plan.planID,
        plan.record.progress.robotID,
        plan.record.plan.steps[index].stepNo,
        state,
        std::move(message)});
    for (IPlanObserver& observer : _observers)
    {
        observer.OnStepChanged(plan.record, index, from, transactionID, _now);
    }
}

void EngineTransaction::ChangeJob(ActivePlan& plan, EJobState state, std::string message)
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
    for (IPlanObserver& observer : _observers)
    {
        observer.OnJobChanged(plan.record, plan.step, plan.job, from, transactionID, _now);
    }
}

void EngineTransaction::Store(std::vector<StoreChange> changes)
{
    std::ranges::move(changes, std::back_inserter(_changes));
}

void EngineTransaction::ReportAlarms(const std::vector<ErrorReport>& reports)
{
    for (const ErrorReport& report : reports)
    {
        const Alarm& alarm = report.alarm;
        _changes.push_back(report.bSet ? StoreChange(AlarmSet{alarm}) : StoreChange(AlarmCleared{alarm}));
        const std::string_view transactionID =
            AddReport(report, _room.ShouldMergeAlarms() ? RemoveReportOrNull(alarm) : std::nullopt);
        for (IPlanObserver& observer : _observers)
        {
            observer.OnAlarmChanged(alarm, report.bSet, transactionID, _now);
        }
    }
}

void EngineTransaction::RaiseAlarm(Alarm alarm)
{
    ReportAlarms(_alarms.Raise(std::move(alarm), _now.steady));
}

void EngineTransaction::ClearAlarm(const Alarm& alarm)
{
    ReportAlarms(_alarms.Clear(alarm, _now.steady));
}

void EngineTransaction::WatchAlarms()
{
    const std::optional<Core::SteadyTime> next = _alarms.GetNextDelayedOrNull();
    if (next.has_value() && (!_alarmQuietAt.has_value() || *next < *_alarmQuietAt))
    {
        _alarmQuietAt = next;
        StartTimer(EEngineTimer::AlarmQuiet, {}, *next - _now.steady);
    }
}

void EngineTransaction::OnAlarmQuiet()
{
    _alarmQuietAt.reset();
    ReportAlarms(_alarms.ApplyDelayed(_now.steady));
}

void EngineTransaction::Reply(ReplyToken token, bool bAccepted, std::string message)
{
    _actions.emplace_back(ReplyCommand{token, bAccepted, std::move(message)});
    _bCommandAccepted = bAccepted;
}

bool EngineTransaction::HasAcceptedCommand() const noexcept
{
    return _bCommandAccepted;
}

} // namespace ACS::Planning
