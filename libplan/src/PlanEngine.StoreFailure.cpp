#include "PlanEngine.Impl.hpp"
#include <acs/core/Overloaded.hpp>

#include <algorithm>
#include <iterator>
#include <utility>

namespace ACS::Planning
{

void PlanEngine::Impl::OnStoreFailed(
    const StoreBatch& batch,
    std::span<const EngineAction> skipped,
    std::string_view reason,
    Core::Now now,
    EngineActions& out)
{
    _now = now;
    _bStoreFailing = true;
    _bStoreAttempted = false;
    std::string refusal = "The plan cannot be stored: " + std::string(reason);
    bool bPlanRefused = false;
    for (const StoreChange& change : batch.changes)
    {
        const auto* removedOrNull = std::get_if<PlanRemoved>(&change);
        if (removedOrNull != nullptr
            && std::ranges::count(_replaced, removedOrNull->sequence, &PlanRecord::sequence) > 0)
        {
            continue; // it comes back below
        }
        const auto* addedOrNull = std::get_if<PlanAdded>(&change);
        if (addedOrNull == nullptr)
        {
            _unsaved.push_back(change);
            continue;
        }
        // Not told to anybody and not begun: as if it had never come.
        bPlanRefused = true;
        const auto found = _plans.find(addedOrNull->record.plan.planID);
        if (found != _plans.end())
        {
            _pending.erase(found->second->key);
            _plans.erase(found);
        }
    }
    for (const std::string& planID : _begun)
    {
        if (const auto begun = _plans.find(planID); begun != _plans.end())
        {
            begun->second->bUnstored = true;
        }
    }
    if (_asked.has_value())
    {
        // Its outcome would be owed, and a crash would forget it. What it has set going stays so.
        refusal = "The request cannot be stored: " + std::string(reason);
        _unstoredIDs.insert(*_asked);
    }
    for (PlanRecord& record : std::exchange(_replaced, {}))
    {
        RememberFinished(std::move(record));
    }
    Alarm alarm;
    alarm.robotID = OWN_ROBOT_ID;
    alarm.errorCode = ALARM_STORE;
    alarm.level = EAlarmLevel::Heavy;
    alarm.message = "Plans cannot be stored: " + std::string(reason);
    for (const EngineAction& action : skipped)
    {
        std::visit(
            Core::Overloaded{
                [this](const StorePlans& typed) {
                    _unsaved.insert(_unsaved.end(), typed.batch.changes.begin(), typed.batch.changes.end());
                },
                [this](const SendReport& typed) { _held.push_back(typed.entry); },
                [this, &out, &refusal, bPlanRefused](const ReplyCommand& typed) {
                    const auto repeated = _repeated.find(typed.replyToken);
                    const bool bKnown = repeated != _repeated.end()
                        && (_plans.contains(repeated->second) || _finished.contains(repeated->second));
                    const bool bRefusedNow = (bPlanRefused && typed.bAccepted && !bKnown) || _asked.has_value();
                    out.emplace_back(bRefusedNow ? ReplyCommand{typed.replyToken, false, refusal} : typed);
                },
                [&out](const auto& typed) {
                    out.emplace_back(typed);
                }},
            action);
    }
    RaiseAlarm(std::move(alarm));
    std::ranges::move(_changes, std::back_inserter(_unsaved));
    _changes.clear();
    for (EngineAction& action : _actions)
    {
        if (auto* reportOrNull = std::get_if<SendReport>(&action); reportOrNull != nullptr)
        {
            _held.push_back(std::move(reportOrNull->entry));
        }
    }
    _actions.clear();
    out.emplace_back(StartEngineTimer{{EEngineTimer::StoreRetry, {}}, _options.storeRetry});
}

/// A call after a batch that did not fail.
void PlanEngine::Impl::NoteStoreSuccess()
{
    if (!_bStoreFailing || !_bStoreAttempted)
    {
        return;
    }
    _bStoreFailing = false;
    _unstoredIDs.clear();
    _bDispatchNeeded = true;
    for (const auto& [planID, plan] : _plans)
    {
        plan->bUnstored = false;
    }
    Alarm alarm;
    alarm.robotID = OWN_ROBOT_ID;
    alarm.errorCode = ALARM_STORE;
    ClearAlarm(alarm);
}

} // namespace ACS::Planning
