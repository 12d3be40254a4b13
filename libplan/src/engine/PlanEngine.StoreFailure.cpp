#include "engine/PlanEngine.Impl.hpp"
#include <acs/core/Overloaded.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <iterator>
#include <utility>

namespace ACS::Planning
{

void PlanEngine::Impl::OnStored(const Core::Result<void>& result, Core::Now now, EngineActions& out)
{
    const CommitGate::Transaction transaction = _gate.Open();
    if (result.has_value())
    {
        std::ranges::copy(transaction.dependent, std::back_inserter(out));
        return;
    }
    const std::string reason = Core::Describe(result.error());
    _now = now;
    _backlog.OnFailed();
    const bool bPlanRefused = RecoverBatch(transaction.batch) > 0;
    ReleaseWithoutStore(transaction.dependent, bPlanRefused, reason, out);
    ReportStoreFailure(reason, out);
}

bool PlanEngine::Impl::IsStoring() const noexcept
{
    return _gate.IsClosed();
}

void PlanEngine::Impl::OnStoreLost(std::string_view reason, Core::Now now, EngineActions& out)
{
    assert(!_gate.IsClosed());
    if (_backlog.IsFailing())
    {
        return; // it is tried again all the time, and fails for this or for another reason
    }
    _now = now;
    _backlog.OnFailed();
    ReportStoreFailure(reason, out);
}

/// By the alarm, which waits for the store with all the rest, and tries again from now on.
void PlanEngine::Impl::ReportStoreFailure(std::string_view reason, EngineActions& out)
{
    RaiseAlarm(MakeStoreAlarm("Plans cannot be stored: " + std::string(reason)));
    _backlog.Add(std::exchange(_changes, {}));
    ReleaseActions(out);
    StartStoreRetry(out);
}

/// The actions of a call whose changes are not stored: all but the reports.
void PlanEngine::Impl::ReleaseActions(EngineActions& out)
{
    for (EngineAction& action : std::exchange(_actions, {}))
    {
        if (auto* reportOrNull = std::get_if<SendReport>(&action); reportOrNull != nullptr)
        {
            _backlog.HoldBack(std::move(reportOrNull->entry));
            continue;
        }
        out.push_back(std::move(action));
    }
}

void PlanEngine::Impl::StartStoreRetry(EngineActions& out)
{
    out.emplace_back(StartEngineTimer{{EEngineTimer::StoreRetry, {}}, _options.storeRetry});
}

/// What is to be stored later, but for new plans: they are not told to anybody and not begun, as if they had never come.
/// Gives how many there were.
std::size_t PlanEngine::Impl::RecoverBatch(const StoreBatch& batch)
{
    std::size_t refused = 0;
    for (const StoreChange& change : batch.changes)
    {
        const auto* removedOrNull = std::get_if<PlanRemoved>(&change);
        if (removedOrNull != nullptr && _plans.IsReplaced(removedOrNull->sequence))
        {
            continue; // it comes back below
        }
        const auto* addedOrNull = std::get_if<PlanAdded>(&change);
        if (addedOrNull == nullptr)
        {
            _backlog.Add({change});
            continue;
        }
        ++refused;
        _plans.Withdraw(addedOrNull->record.plan.planID);
    }
    for (const std::string& planID : _begun)
    {
        if (ActivePlan* begunOrNull = _plans.FindActiveOrNull(planID); begunOrNull != nullptr)
        {
            begunOrNull->bUnstored = true;
        }
    }
    if (_asked.has_value())
    {
        // Its outcome would be owed, and a crash would forget it. What it has set going stays so.
        _unstoredIDs.insert(*_asked);
    }
    Store(_plans.RestoreReplaced());
    return refused;
}

/// What depends on the batch: reports wait, new plans and controls are rejected, everything else is released.
void PlanEngine::Impl::ReleaseWithoutStore(
    const EngineActions& withheld,
    bool bPlanRefused,
    std::string_view reason,
    EngineActions& out)
{
    const std::string refusal =
        fmt::format("The {} cannot be stored: {}", _asked.has_value() ? "request" : "plan", reason);
    for (const EngineAction& action : withheld)
    {
        std::visit(
            Core::Overloaded{
                [this](const StorePlans& typed) { _backlog.Add(typed.batch.changes); },
                [this](const SendReport& typed) { _backlog.HoldBack(typed.entry); },
                [this, &out, &refusal, bPlanRefused](const ReplyCommand& typed) {
                    const auto repeated = _repeated.find(typed.replyToken);
                    const bool bKnown =
                        repeated != _repeated.end() && _plans.FindRecordOrNull(repeated->second) != nullptr;
                    const bool bRefusedNow = (bPlanRefused && typed.bAccepted && !bKnown) || _asked.has_value();
                    out.emplace_back(bRefusedNow ? ReplyCommand{typed.replyToken, false, refusal} : typed);
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

/// What a robot must not do while nobody could know of it after a crash.
bool PlanEngine::Impl::TryWithdraw(const CommandRobot& command)
{
    Robot& robot = _robots[_robotIndices.find(command.robotID)->second];
    const auto* jobOrNull = std::get_if<StartJob>(&command.command);
    if (jobOrNull != nullptr && robot.planOrNull != nullptr && robot.planOrNull->bUnstored)
    {
        RepeatJob(robot, jobOrNull->commandID);
        return true;
    }
    if (_asked.has_value() && std::holds_alternative<Planning::Pause>(command.command))
    {
        WithdrawPause(robot);
        return true;
    }
    return false;
}

/// The control that wanted it is refused. After a crash nobody would know who has stopped the robot.
void PlanEngine::Impl::WithdrawPause(Robot& robot)
{
    robot.pause.Reset();
    robot.bWorkTouched = true;
    _bDispatchNeeded = true;
    PlanProgress& progress = robot.planOrNull->record.progress;
    if (progress.control == EPlanControl::Pause)
    {
        progress.control.reset();
        progress.controlCount = 0;
        _plans.MarkProgressed(robot.planOrNull->record.plan.planID);
        StopConfirmingControl(robot);
    }
}

Alarm PlanEngine::Impl::MakeStoreAlarm(std::string message)
{
    return MakeAlarm(OWN_ROBOT_ID, ALARM_STORE, EAlarmLevel::Heavy, std::move(message));
}

/// A call after a batch that did not fail.
void PlanEngine::Impl::CheckStoreRecovery()
{
    if (!_backlog.TryRecover())
    {
        return;
    }
    _unstoredIDs.clear();
    _bDispatchNeeded = true;
    for (const auto& [planID, plan] : _plans.GetActive())
    {
        if (std::exchange(plan->bUnstored, false) && plan->robot.has_value())
        {
            _robots[*plan->robot].bTouched = true;
        }
    }
    ClearAlarm(MakeStoreAlarm({}));
}

} // namespace ACS::Planning
