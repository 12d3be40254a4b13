#include "engine/StoreGate.hpp"

#include <acs/core/Overloaded.hpp>
#include <acs/plan/EPlanningError.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <iterator>
#include <utility>
#include <vector>

namespace ACS::Planning
{

namespace
{

/// Moves no element if there is none yet.
template <typename TElement>
void Append(std::vector<TElement>& list, std::vector<TElement> added)
{
    if (list.empty())
    {
        list = std::move(added);
    }
    else
    {
        list.insert(list.end(), std::make_move_iterator(added.begin()), std::make_move_iterator(added.end()));
    }
}

} // namespace

StoreGate::StoreGate(EngineState& engine, ControlAnswers& answers, const PlaceTracker& places, PlanWork& work)
    : _options(engine.options),
      _plans(engine.plans),
      _fleet(engine.fleet),
      _outbox(engine.outbox),
      _transaction(engine.transaction),
      _call(engine.call),
      _backlog(engine.backlog),
      _answers(answers),
      _places(places),
      _work(work)
{
}

void StoreGate::Commit(EngineActions& out)
{
    CollectWork();
    std::vector<StoreChange> changes = _backlog.CollectChanges();
    for (PlanProgressed& progress : _plans.CollectProgress())
    {
        changes.emplace_back(std::move(progress));
    }
    Append(changes, _transaction.CollectChanges());
    if (!_backlog.IsWorthTrying(changes))
    {
        _backlog.Add(std::move(changes));
        ReleaseActions(out);
        return;
    }
    EngineActions withheld;
    EngineActions& dependent = changes.empty() ? out : withheld;
    if (!changes.empty())
    {
        std::ranges::move(_acknowledged, std::back_inserter(changes));
        _acknowledged.clear();
    }
    // Without a change the attempt is what the next call stores: that the alarm is cleared.
    if (_backlog.TryBeginAttempt())
    {
        StartStoreRetry(dependent);
    }
    for (SendReport& report : _backlog.CollectReports())
    {
        dependent.emplace_back(std::move(report));
    }
    Append(dependent, _transaction.CollectActions());
    if (changes.empty())
    {
        return;
    }
    StoreBatch batch{std::move(changes)};
    _gate.Close(batch, std::move(withheld));
    out.emplace_back(StorePlans{std::move(batch)});
}

void StoreGate::CollectWork()
{
    for (const std::size_t index : TakeInOrder(_fleet.GetChanged().work))
    {
        Robot& robot = _fleet[index];
        if (!robot.changes.TryUnmarkWork())
        {
            continue;
        }
        RobotWorkChanged work = robot.work.Make(robot.GetID());
        work.bPauseAsked = robot.control.pause.IsPaused() || robot.control.pause.IsResuming();
        if (const StartJob* jobOrNull = robot.job.GetOrNull(); jobOrNull != nullptr)
        {
            work.job = *jobOrNull;
        }
        work.abandonedJobID = robot.job.GetAbandonedID();
        // An arm whose motor is off shows none: what was stored is still needed after another crash.
        if (robot.view.state.has_value() && !robot.view.state->restartEvidence.progressToken.empty())
        {
            work.progressToken = robot.view.state->restartEvidence.progressToken;
        }
        if (!robot.drive.has_value()) // during a drive nodes only become fewer, which alone is no reason to write
        {
            work.nodeIDs = _places.ListNodes(robot);
        }
        if (robot.work.TryBeginStore(work))
        {
            work.nodeIDs = _places.ListNodes(robot);
            robot.work.OnStored(work);
            _transaction.Store(std::move(work));
        }
    }
}

void StoreGate::Acknowledge(const MessageAcknowledged& command)
{
    if (!_outbox.TryRemove(command.sequence))
    {
        return;
    }
    if (_acknowledged.empty())
    {
        _transaction.StartTimer(EEngineTimer::Acknowledged, {}, _options.acknowledgedDelay);
    }
    _acknowledged.emplace_back(ReportRemoved{command.sequence});
}

void StoreGate::StoreAcknowledged()
{
    _transaction.Store(std::exchange(_acknowledged, {}));
}

void StoreGate::OnStored(const Core::Result<void>& result, Core::Now now, EngineActions& out)
{
    CommitGate::Transaction transaction = _gate.Open();
    if (result.has_value())
    {
        std::ranges::move(_backlog.CollectRefusals(), std::back_inserter(out));
        Append(out, std::move(transaction.dependent));
        return;
    }
    _transaction.SetNow(now);
    _backlog.OnFailed();
    const bool bUnknown = result.error().code == EPlanningError::StoreOutcomeUnknown;
    const bool bPlanRefused = RecoverBatch(transaction.batch, bUnknown) > 0;
    ReleaseWithoutStore(transaction.dependent, bPlanRefused, result.error(), out);
    ReportStoreFailure(Core::Describe(result.error()), out);
}

bool StoreGate::IsStoring() const noexcept
{
    return _gate.IsClosed();
}

void StoreGate::OnStoreLost(std::string_view reason, Core::Now now, EngineActions& out)
{
    assert(!_gate.IsClosed());
    if (_backlog.TryFailAttempt() || _backlog.IsFailing())
    {
        return; // the alarm is active, and the retry timer runs
    }
    _transaction.SetNow(now);
    _backlog.OnFailed();
    ReportStoreFailure(reason, out);
}

void StoreGate::ReportStoreFailure(std::string_view reason, EngineActions& out)
{
    _transaction.RaiseAlarm(MakeStoreAlarm("Plans cannot be stored: " + std::string(reason)));
    _backlog.Add(_transaction.CollectChanges());
    ReleaseActions(out);
    StartStoreRetry(out);
}

void StoreGate::ReleaseActions(EngineActions& out)
{
    for (EngineAction& action : _transaction.CollectActions())
    {
        if (auto* reportOrNull = std::get_if<SendReport>(&action); reportOrNull != nullptr)
        {
            _backlog.HoldBack(std::move(*reportOrNull));
            continue;
        }
        out.push_back(std::move(action));
    }
}

void StoreGate::StartStoreRetry(EngineActions& out)
{
    out.emplace_back(StartEngineTimer{{EEngineTimer::StoreRetry, {}}, _options.storeRetry});
}

std::size_t StoreGate::RecoverBatch(const StoreBatch& batch, bool bUnknown)
{
    std::size_t refused = 0;
    for (const StoreChange& change : batch.changes)
    {
        const auto* removedOrNull = std::get_if<PlanRemoved>(&change);
        if (removedOrNull != nullptr && _plans.IsReplaced(removedOrNull->sequence))
        {
            continue; // restored below
        }
        if (_call.controlID.has_value() && std::holds_alternative<ReceiptAdded>(change))
        {
            continue; // the control is refused
        }
        const auto* addedOrNull = std::get_if<PlanAdded>(&change);
        if (addedOrNull == nullptr)
        {
            _backlog.Add({change});
            continue;
        }
        ++refused;
        if (bUnknown)
        {
            _backlog.NoteUnknown(addedOrNull->record.plan.planID);
        }
        _plans.Withdraw(addedOrNull->record.plan.planID);
    }
    for (const std::string& planID : _call.begunPlanIDs)
    {
        if (ActivePlan* begunOrNull = _plans.FindActiveOrNull(planID); begunOrNull != nullptr)
        {
            begunOrNull->bUnstored = true;
        }
    }
    if (_call.controlID.has_value())
    {
        // A crash would lose the result it is owed, so it is refused. Its effects stay.
        _call.unstoredControlIDs.insert(*_call.controlID);
    }
    _transaction.Store(_plans.RestoreReplaced());
    return refused;
}

void StoreGate::ReleaseWithoutStore(
    const EngineActions& withheld,
    bool bPlanRefused,
    const Core::Error& error,
    EngineActions& out)
{
    const bool bUnknown = error.code == EPlanningError::StoreOutcomeUnknown;
    const std::string refusal = fmt::format(
        "The {} cannot be stored: {}",
        _call.controlID.has_value() ? "request" : "plan",
        Core::Describe(error));
    for (const EngineAction& action : withheld)
    {
        std::visit(
            Core::Overloaded{
                [this](const StorePlans& typed) { _backlog.Add(typed.batch.changes); },
                [this](const SendReport& typed) { _backlog.HoldBack(typed); },
                [this, &out, &refusal, bPlanRefused, bUnknown](const ReplyCommand& typed) {
                    const auto repeated = _call.repeatedPlanIDs.find(typed.replyToken);
                    const bool bKnown =
                        repeated != _call.repeatedPlanIDs.end() && _plans.FindRecordOrNull(repeated->second) != nullptr;
                    const bool bRefusedNow =
                        (bPlanRefused && typed.bAccepted && !bKnown) || _call.controlID.has_value();
                    ReplyCommand reply = bRefusedNow ? ReplyCommand{typed.replyToken, false, refusal} : typed;
                    if (bRefusedNow && bUnknown)
                    {
                        _backlog.WithholdRefusal(std::move(reply));
                        return;
                    }
                    out.emplace_back(std::move(reply));
                },
                [this, &out](const CommandRobot& typed) {
                    if (!TryWithdraw(typed))
                    {
                        out.emplace_back(typed);
                    }
                },
                [&out](const auto& typed) {
                    out.emplace_back(typed);
                }},
            action);
    }
}

bool StoreGate::TryWithdraw(const CommandRobot& command)
{
    Robot& robot = *_fleet.FindOrNull(command.robotID);
    const auto* jobOrNull = std::get_if<StartJob>(&command.command);
    if (jobOrNull != nullptr && robot.planOrNull != nullptr && robot.planOrNull->bUnstored)
    {
        _work.RepeatJob(robot, jobOrNull->commandID);
        return true;
    }
    if (_call.controlID.has_value() && std::holds_alternative<Planning::Pause>(command.command))
    {
        WithdrawPause(robot);
        return true;
    }
    return false;
}

void StoreGate::WithdrawPause(Robot& robot)
{
    robot.control.pause.Reset();
    robot.changes.MarkWork();
    _transaction.RequestDispatch();
    PlanProgress& progress = robot.planOrNull->record.progress;
    if (progress.control == EPlanControl::Pause)
    {
        _answers.Forget(*robot.planOrNull, *_call.controlID);
        progress.control.reset();
        progress.controlCount = 0;
        _answers.StopConfirmingControl(robot);
    }
}

Alarm StoreGate::MakeStoreAlarm(std::string message)
{
    return MakeAlarm(OWN_ROBOT_ID, ALARM_STORE, EAlarmLevel::Heavy, std::move(message));
}

void StoreGate::CheckStoreRecovery()
{
    if (!_backlog.TryRecover())
    {
        return;
    }
    _call.unstoredControlIDs.clear();
    _transaction.RequestDispatch();
    for (const auto& [planID, plan] : _plans.GetActive())
    {
        if (std::exchange(plan->bUnstored, false) && plan->robot.has_value())
        {
            _fleet[*plan->robot].changes.MarkStatus();
        }
    }
    _transaction.ClearAlarm(MakeStoreAlarm({}));
}

} // namespace ACS::Planning
