#include "ActionBook.hpp"

#include "OrderErrors.hpp"
#include "StateRoom.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

namespace ACS::VDA5050
{

namespace
{

/// Maximum number of evicted actions, whose ids must not be performed again.
constexpr std::size_t MAXIMUM_EVICTED = 256;

/// A vehicle can always be stopped, and set free again, even where its state has no room to show it.
bool IsControl(const Action& action)
{
    return action.actionType == ActionTypes::CANCEL_ORDER || action.actionType == ActionTypes::START_PAUSE
        || action.actionType == ActionTypes::STOP_PAUSE;
}

/// As it waits.
ActionState MakeInstantState(const Action& action)
{
    return ActionState{
        action.actionID,
        action.actionType,
        std::string(CutForeignText(action.actionDescription)),
        EActionStatus::Waiting,
        {}};
}

} // namespace

ActionBook::ActionBook(const FactsheetMessage& factsheet)
    : _factsheet(factsheet)
{
}

void ActionBook::BeginOrder()
{
    _actions.EraseIf(
        [](const ReportedAction& tracked) { return !tracked.IsInstant() || (tracked.IsEnded() && tracked.bShown); });
    _evicted.clear();
    _queue.clear();
}

void ActionBook::AddOrderAction(
    const Action& action,
    EActionScope scope,
    const std::string& elementID,
    std::uint32_t sequenceID)
{
    ActionState state{action.actionID, action.actionType, action.actionDescription, EActionStatus::Waiting, {}};
    _actions.Add(ReportedAction{action, ActionMachine(std::move(state)), scope, elementID, sequenceID});
}

void ActionBook::MarkOvertaken()
{
    for (ReportedAction& tracked : _actions)
    {
        tracked.bOvertaken = tracked.IsInstant() && !tracked.IsEnded();
    }
}

void ActionBook::DropFrom(std::uint32_t firstSequenceID)
{
    _actions.EraseIf([firstSequenceID](const ReportedAction& tracked) {
        return !tracked.IsInstant() && !tracked.IsEnded() && tracked.sequenceID >= firstSequenceID;
    });
}

void ActionBook::EvictSurplus()
{
    const std::size_t stated = _factsheet.protocolLimits.maxArrayLengths.stateActionStates.value_or(0);
    while (stated != 0 && _actions.GetSize() > stated && TryEvict())
    {
    }
}

void ActionBook::Enqueue(std::span<const Action> actions)
{
    std::ranges::transform(actions, std::back_inserter(_queue), &Action::actionID);
}

ReportedAction* ActionBook::TakeStartableOrNull()
{
    while (!_queue.empty())
    {
        ReportedAction* nextOrNull = _actions.FindOrNull(_queue.front());
        const bool bWaits =
            nextOrNull != nullptr && !nextOrNull->bStarted && nextOrNull->machine.GetStatus() == EActionStatus::Waiting;
        const bool bHard = bWaits && nextOrNull->action.blockingType == EBlockingType::Hard;
        if (bWaits && (_actions.CountRunningHard() > 0 || (bHard && _actions.CountRunning() > 0)))
        {
            return nullptr;
        }
        _queue.pop_front();
        if (bWaits)
        {
            return nextOrNull;
        }
    }
    return nullptr;
}

void ActionBook::ClearQueue()
{
    _queue.clear();
}

void ActionBook::StopOrder(const std::string& reason, VehicleActions& out)
{
    _queue.clear();
    for (ReportedAction& tracked : _actions)
    {
        if (tracked.IsInstant() || tracked.IsEnded())
        {
            continue;
        }
        tracked.bCancelled = true;
        if (tracked.bStarted)
        {
            out.emplace_back(StopAction{tracked.action.actionID, false});
        }
        if (!tracked.bStarted || tracked.machine.GetStatus() == EActionStatus::Paused)
        {
            TrySetStatus(tracked, EActionStatus::Failed, reason);
        }
    }
}

void ActionBook::FailOrder(const std::string& reason)
{
    for (ReportedAction& tracked : _actions)
    {
        if (!tracked.IsInstant() && !tracked.IsEnded())
        {
            TrySetStatus(tracked, EActionStatus::Failed, reason);
        }
    }
}

void ActionBook::Forget()
{
    _actions.EraseIf([](const ReportedAction& tracked) { return !tracked.IsInstant() || tracked.IsEnded(); });
}

bool ActionBook::IsRepeated(const Action& action)
{
    const ReportedAction* const knownOrNull = _actions.FindOrNull(action.actionID);
    const bool bHeld =
        knownOrNull != nullptr && knownOrNull->IsInstant() && knownOrNull->action.actionType == action.actionType;
    return bHeld || std::ranges::any_of(_evicted, [&action](const EvictedAction& evicted) {
               return evicted.actionID == action.actionID && evicted.actionType == action.actionType;
           });
}

std::string ActionBook::FindClash(const Action& action)
{
    if (std::max(action.actionID.size(), action.actionType.size()) > LONGEST_FOREIGN_TEXT)
    {
        return "actionId or actionType is too long";
    }
    const bool bUsed = _actions.FindOrNull(action.actionID) != nullptr
        || std::ranges::find(_evicted, action.actionID, &EvictedAction::actionID) != _evicted.end();
    return bUsed ? "the actionId is in use already" : std::string();
}

ReportedAction& ActionBook::AddInstant(const Action& action, EActionStatus status, std::string_view result)
{
    ActionState state = MakeInstantState(action);
    state.actionStatus = status;
    state.resultDescription = result;
    return _actions.Add(ReportedAction{action, ActionMachine(std::move(state)), EActionScope::Instant});
}

bool ActionBook::TryMakeRoomFor(const Action& action)
{
    const bool bControl = IsControl(action);
    const std::size_t mostActions = bControl ? StateRoom::CONTROL_ACTIONS : StateRoom::INSTANT_ACTIONS;
    const std::size_t mostBytes = bControl ? StateRoom::CONTROL_BYTES : StateRoom::INSTANT_BYTES;
    const std::size_t bytes = MeasureActionState(MakeInstantState(action));
    const std::size_t stated = _factsheet.protocolLimits.maxArrayLengths.stateActionStates.value_or(0);
    while (true)
    {
        const bool bFull = _actions.CountInstant() >= mostActions || _actions.GetInstantBytes() + bytes > mostBytes;
        const bool bBeyond = stated != 0 && _actions.GetSize() >= stated;
        if (!bFull && !bBeyond)
        {
            return true;
        }
        if (!TryEvict())
        {
            return bControl && !bFull;
        }
    }
}

bool ActionBook::TryEvict()
{
    const auto oldest = std::ranges::find_if(_actions, [](const ReportedAction& tracked) {
        return tracked.IsInstant() && tracked.IsEnded() && tracked.bShown;
    });
    if (oldest == _actions.end())
    {
        return false;
    }
    if (_evicted.size() >= MAXIMUM_EVICTED)
    {
        _evicted.erase(_evicted.begin());
    }
    _evicted.push_back(EvictedAction{oldest->action.actionID, oldest->action.actionType});
    _actions.Erase(oldest);
    return true;
}

void ActionBook::Start(ReportedAction& action, VehicleActions& out)
{
    _actions.MarkStarted(action);
    out.emplace_back(StartAction{action.action, action.scope, action.elementID, action.sequenceID});
}

bool ActionBook::TrySetStatus(ReportedAction& action, EActionStatus status, std::string resultDescription)
{
    return _actions.TrySetStatus(action, status, std::move(resultDescription));
}

void ActionBook::SetStatus(const std::vector<std::string>& actionIDs, EActionStatus status, const std::string& result)
{
    for (const std::string& actionID : actionIDs)
    {
        if (ReportedAction* const found = _actions.FindOrNull(actionID))
        {
            TrySetStatus(*found, status, result);
        }
    }
}

void ActionBook::PauseRunning(VehicleActions& out)
{
    for (ReportedAction& tracked : _actions)
    {
        if (tracked.IsRunningInOrder())
        {
            tracked.bPauseAsked = tracked.machine.GetStatus() != EActionStatus::Paused;
            out.emplace_back(PauseAction{tracked.action.actionID});
        }
    }
}

void ActionBook::ResumePaused(VehicleActions& out) const
{
    for (const ReportedAction& tracked : _actions)
    {
        if (tracked.machine.GetStatus() == EActionStatus::Paused)
        {
            out.emplace_back(ResumeAction{tracked.action.actionID});
        }
    }
}

void ActionBook::MarkShown()
{
    for (ReportedAction& tracked : _actions)
    {
        tracked.bShown = tracked.IsEnded();
    }
}

ReportedAction* ActionBook::FindOrNull(std::string_view actionID)
{
    return _actions.FindOrNull(actionID);
}

bool ActionBook::HasOpen() const noexcept
{
    return _actions.CountOpen() > 0;
}

bool ActionBook::HasOpenOnEdge(std::uint32_t sequenceID) const
{
    return std::ranges::any_of(_actions, [sequenceID](const ReportedAction& tracked) {
        return tracked.scope == EActionScope::Edge && tracked.sequenceID == sequenceID && !tracked.IsEnded();
    });
}

bool ActionBook::CanDrive() const noexcept
{
    return _queue.empty() && _actions.CountRunningBlocking() == 0;
}

void ActionBook::Fill(StateMessage& state) const
{
    state.actionStates.reserve(_actions.GetSize());
    for (const ReportedAction& tracked : _actions)
    {
        state.actionStates.push_back(tracked.machine.GetState());
    }
}

void ActionBook::Fill(OrderContext& context, std::uint32_t baseEnd) const
{
    for (const ReportedAction& tracked : _actions)
    {
        const bool bInstant = tracked.IsInstant();
        // An end that no state has shown yet makes no way.
        const bool bInstantStays = bInstant && !(tracked.IsEnded() && tracked.bShown);
        // What has ended may be of a route that was cancelled and had the same sequenceIds.
        const bool bOfBase = !bInstant && (tracked.sequenceID < baseEnd || tracked.IsEnded());
        if (bInstantStays)
        {
            context.instantActionIDs.push_back(tracked.action.actionID);
        }
        if (bInstant || bOfBase)
        {
            context.actionIDs.push_back(tracked.action.actionID);
        }
        context.keptActions += bOfBase || bInstantStays ? 1U : 0U;
        context.keptBytes += bOfBase ? MeasureActionState(tracked.machine.GetState()) : 0;
    }
}

} // namespace ACS::VDA5050
