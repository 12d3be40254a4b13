#include "MasterSession.Impl.hpp"
#include <acs/vda5050/ActionMachine.hpp>
#include <acs/vda5050/EVda5050Error.hpp>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ACS::VDA5050
{

namespace
{

bool IsRequest(std::string_view actionType)
{
    return actionType == ActionTypes::STATE_REQUEST || actionType == ActionTypes::FACTSHEET_REQUEST;
}

/// There are vehicles that take these with exactly this blocking type only.
EBlockingType ChooseBlockingType(const Action& action)
{
    if (IsRequest(action.actionType))
    {
        return EBlockingType::None;
    }
    const bool bHard = action.actionType == ActionTypes::CANCEL_ORDER || action.actionType == ActionTypes::START_PAUSE
        || action.actionType == ActionTypes::STOP_PAUSE;
    return bHard ? EBlockingType::Hard : action.blockingType;
}

} // namespace

void MasterSession::Impl::PublishInstantActions(std::vector<Action> actions, Core::Now now, MasterActions& out)
{
    const std::size_t most = GetMaximumInstantActions();
    while (!actions.empty())
    {
        const auto end = actions.begin() + static_cast<std::ptrdiff_t>(std::min(most, actions.size()));
        InstantActionsMessage message;
        message.header = MakeHeader(ETopic::InstantActions, now);
        message.actions.assign(std::move_iterator(actions.begin()), std::move_iterator(end));
        actions.erase(actions.begin(), end);
        PublishPayload(ETopic::InstantActions, _codec.Encode(message, _options.version), out);
    }
}

void MasterSession::Impl::ResendInstantActions(Core::Now now, MasterActions& out)
{
    if (_link != EVehicleLink::Online || !IsUnderMasterControl())
    {
        return;
    }
    std::vector<Action> actions;
    const auto isSpent = [this, &actions, &out](PendingAction& pending) {
        if (_options.resendCount != 0 && pending.sendCount > _options.resendCount)
        {
            out.emplace_back(InstantActionRejected{pending.action.actionID, {}, "the vehicle never showed the action"});
            RemoveTrackedAction(pending.action.actionID);
            return true;
        }
        ++pending.sendCount;
        actions.push_back(pending.action);
        return false;
    };
    std::vector<PendingAction> kept;
    for (PendingAction& pending : _pendingActions)
    {
        if (!isSpent(pending))
        {
            kept.push_back(std::move(pending));
        }
    }
    _pendingActions = std::move(kept);
    if (!actions.empty())
    {
        PublishInstantActions(std::move(actions), now, out);
        out.emplace_back(StartMasterTimer{EMasterTimer::ResendInstantActions, _options.resendInterval});
    }
    UpdateCancel(out);
}

const ActionState* MasterSession::Impl::FindShownOrNull(std::string_view actionID) const
{
    if (!_state.has_value())
    {
        return nullptr;
    }
    const auto found = std::ranges::find(_state->actionStates, actionID, &ActionState::actionID);
    return found == _state->actionStates.end() ? nullptr : &*found;
}

Core::Result<std::string> MasterSession::Impl::SendInstantAction(Action action, Core::Now now, MasterActions& out)
{
    const bool bTaken = IsUnderMasterControl() || IsRequest(action.actionType);
    if (_link != EVehicleLink::Online || !bTaken)
    {
        return Core::Fail(
            EVda5050Error::VehicleNotReady,
            {},
            bTaken ? "a vehicle that is online" : "a mode that takes instant actions",
            _options.address.serialNumber);
    }
    if (action.actionID.empty())
    {
        action.actionID = MakeActionID(action.actionType, now);
    }
    action.blockingType = ChooseBlockingType(action);
    const Core::Result<void> fit = FitInstantAction(action, now);
    if (!fit)
    {
        return tl::unexpected(fit.error());
    }
    std::string actionID = action.actionID;
    const ActionState* const shown = FindShownOrNull(actionID);
    if (IsTracked(actionID) || (shown != nullptr && shown->actionType != action.actionType))
    {
        return Core::Fail(EVda5050Error::InvalidOrder, "actionId", "an actionId that no other action uses", actionID);
    }
    if (shown != nullptr)
    {
        out.emplace_back(
            ActionChanged{shown->actionID, shown->actionType, shown->actionStatus, shown->resultDescription});
        if (!IsTerminal(shown->actionStatus))
        {
            _tracked.push_back(TrackedAction{action.actionID, action.actionType, true, true});
        }
        return actionID;
    }
    if (!IsRequest(action.actionType))
    {
        _pendingActions.push_back(PendingAction{action, 1, _state.has_value() ? _state->orderID : std::string()});
        _tracked.push_back(TrackedAction{action.actionID, action.actionType, true, false});
        out.emplace_back(StartMasterTimer{EMasterTimer::ResendInstantActions, _options.resendInterval});
    }
    PublishInstantActions({std::move(action)}, now, out);
    return actionID;
}

bool MasterSession::Impl::TryWithdrawInstantAction(std::string_view actionID)
{
    const auto isMeant = [actionID](const PendingAction& pending) {
        return pending.action.actionID == actionID;
    };
    if (actionID == _cancelActionID || std::erase_if(_pendingActions, isMeant) == 0)
    {
        return false;
    }
    RemoveTrackedAction(actionID);
    return true;
}

} // namespace ACS::VDA5050
