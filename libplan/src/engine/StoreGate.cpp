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
        if (const StartJob* resolvedOrNull = robot.job.GetResolvedOrNull(); resolvedOrNull != nullptr)
        {
            work.resolvedJob = *resolvedOrNull;
        }
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
        std::ranges::move(_backlog.CollectWithheld(), std::back_inserter(out));
        Append(out, std::move(transaction.dependent));
        return;
    }
    _transaction.SetNow(now);
    _backlog.OnFailed();
    const bool bUnknown = result.error().code == EPlanningError::StoreOutcomeUnknown;
    const bool bControlRefused = TryWithdrawControl(transaction);
    const bool bPlanRefused = RecoverBatch(transaction.batch, bUnknown) > 0;
    ReleaseWithoutStore(transaction.dependent, bControlRefused || bPlanRefused, result.error(), out);
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
    if (_call.control.has_value())
    {
        _call.unstoredControlIDs.insert(ControlAnswers::MakeRequestID(*_call.control));
    }
    _transaction.Store(_plans.RestoreReplaced());
    return refused;
}

bool StoreGate::TryWithdrawControl(CommitGate::Transaction& transaction)
{
    if (!_call.control.has_value())
    {
        return false;
    }
    const EPlanControl control = _call.control->control;
    const auto command = std::ranges::find_if(transaction.dependent, [control](const EngineAction& action) {
        const auto* typedOrNull = std::get_if<CommandRobot>(&action);
        return typedOrNull != nullptr
            && (control == EPlanControl::Pause
                    ? std::holds_alternative<Pause>(typedOrNull->command)
                    : control == EPlanControl::Resume && std::holds_alternative<Resume>(typedOrNull->command));
    });
    if (command == transaction.dependent.end())
    {
        return false;
    }
    Robot& robot = *_fleet.FindOrNull(std::get<CommandRobot>(*command).robotID);
    const PlanProgress& progress = robot.planOrNull->record.progress;
    const bool bConfirmed = progress.control != control; // the robot was already paused
    if (bConfirmed && _call.bResumeInterrupted)
    {
        return false; // and is about to resume
    }
    transaction.dependent.erase(command);
    if (bConfirmed)
    {
        return false;
    }
    std::erase_if(transaction.batch.changes, [](const StoreChange& change) {
        return std::holds_alternative<ReceiptAdded>(change);
    });
    _answers.Withdraw(*robot.planOrNull, *_call.control);
    _answers.StopConfirmingControl(robot);
    if (progress.state
        == EPlanState::Paused) // of a withdrawn resume, or of the resume that a withdrawn pause interrupted
    {
        robot.control.pause.Pause();
    }
    else
    {
        robot.control.pause.Reset();
    }
    robot.changes.MarkWork();
    _transaction.RequestDispatch();
    return true;
}

void StoreGate::ReleaseWithoutStore(
    const EngineActions& withheld,
    bool bRefused,
    const Core::Error& error,
    EngineActions& out)
{
    const bool bUnknown = error.code == EPlanningError::StoreOutcomeUnknown;
    const bool bControl = _call.control.has_value();
    const std::string refusal =
        fmt::format("The {} cannot be stored: {}", bControl ? "request" : "plan", Core::Describe(error));
    for (const EngineAction& action : withheld)
    {
        std::visit(
            Core::Overloaded{
                [this](const StorePlans& typed) { _backlog.Add(typed.batch.changes); },
                [this](const SendReport& typed) { _backlog.HoldBack(typed); },
                [this, &out, &refusal, bRefused, bControl, bUnknown](const ReplyCommand& typed) {
                    const auto repeated = _call.repeatedPlanIDs.find(typed.replyToken);
                    const bool bKnown =
                        repeated != _call.repeatedPlanIDs.end() && _plans.FindRecordOrNull(repeated->second) != nullptr;
                    const bool bRefusedNow = bRefused && typed.bAccepted && !bKnown;
                    ReplyCommand reply = bRefusedNow ? ReplyCommand{typed.replyToken, false, refusal} : typed;
                    if (bRefusedNow ? bUnknown : bControl)
                    {
                        _backlog.Withhold(std::move(reply));
                        return;
                    }
                    out.emplace_back(std::move(reply));
                },
                [this, &out](const CommandRobot& typed) {
                    if (!TryWithdrawJob(typed))
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

bool StoreGate::TryWithdrawJob(const CommandRobot& command)
{
    Robot& robot = *_fleet.FindOrNull(command.robotID);
    const auto* jobOrNull = std::get_if<StartJob>(&command.command);
    if (jobOrNull == nullptr || robot.planOrNull == nullptr || !robot.planOrNull->bUnstored)
    {
        return false;
    }
    _work.RepeatJob(robot, jobOrNull->commandID);
    return true;
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
