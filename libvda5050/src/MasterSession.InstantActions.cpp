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
    const std::size_t most = _rules.GetMaximumInstantActions();
    while (!actions.empty())
    {
        const auto end = actions.begin() + static_cast<std::ptrdiff_t>(std::min(most, actions.size()));
        InstantActionsMessage message;
        message.actions.assign(std::move_iterator(actions.begin()), std::move_iterator(end));
        actions.erase(actions.begin(), end);
        _topics.Publish(ETopic::InstantActions, message, now, out);
    }
}

void MasterSession::Impl::ResendInstantActions(Core::Now now, MasterActions& out)
{
    if (!_vehicle.CanReceive())
    {
        return;
    }
    RemoveTracked(_pendingActions.TakeSpent(_options.resendCount, out));
    std::vector<Action> actions = _pendingActions.Resend();
    if (!actions.empty())
    {
        PublishInstantActions(std::move(actions), now, out);
        out.emplace_back(StartMasterTimer{EMasterTimer::ResendInstantActions, _options.resendInterval});
    }
    UpdateCancel(out);
}

void MasterSession::Impl::RemoveTracked(const std::vector<std::string>& actionIDs)
{
    for (const std::string& actionID : actionIDs)
    {
        _actions.Remove(actionID);
    }
}

std::string MasterSession::Impl::MakeActionID(std::string_view actionType, Core::Now now)
{
    constexpr int MOST_TRIES = 100; // an id that has to be short may be in use
    std::string id = _rules.MakeActionID(actionType, ++_ownActionCount, now);
    for (int i = 1; i < MOST_TRIES && (_actions.IsTracked(id) || _vehicle.FindActionOrNull(id) != nullptr); ++i)
    {
        id = _rules.MakeActionID(actionType, ++_ownActionCount, now);
    }
    return id;
}

Core::Result<std::string> MasterSession::Impl::SendInstantAction(Action action, Core::Now now, MasterActions& out)
{
    const bool bTaken = _vehicle.IsUnderMasterControl() || IsRequest(action.actionType);
    if (!_vehicle.IsOnline() || !bTaken)
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
    const Core::Result<void> fit = _rules.FitInstantAction(action, _topics, now);
    if (!fit)
    {
        return tl::unexpected(fit.error());
    }
    std::string actionID = action.actionID;
    const ActionState* const shown = _vehicle.FindActionOrNull(actionID);
    if (_actions.IsTracked(actionID) || (shown != nullptr && shown->actionType != action.actionType))
    {
        return Core::Fail(EVda5050Error::InvalidOrder, "actionId", "an actionId that no other action uses", actionID);
    }
    if (shown != nullptr)
    {
        out.emplace_back(
            ActionChanged{shown->actionID, shown->actionType, shown->actionStatus, shown->resultDescription});
        if (!IsTerminal(shown->actionStatus))
        {
            _actions.TrackInstant(action, true);
        }
        return actionID;
    }
    if (!IsRequest(action.actionType))
    {
        const StateMessage* const state = _vehicle.GetStateOrNull();
        if (_pendingActions.IsEmpty())
        {
            out.emplace_back(StartMasterTimer{EMasterTimer::ResendInstantActions, _options.resendInterval});
        }
        _pendingActions.Add(action, state != nullptr ? std::optional(state->orderID) : std::nullopt);
        _actions.TrackInstant(action, false);
    }
    PublishInstantActions({std::move(action)}, now, out);
    return actionID;
}

bool MasterSession::Impl::TryWithdrawInstantAction(std::string_view actionID)
{
    if (actionID == _cancelActionID || !_pendingActions.TryRemove(actionID))
    {
        return false;
    }
    _actions.Remove(actionID);
    return true;
}

} // namespace ACS::VDA5050
