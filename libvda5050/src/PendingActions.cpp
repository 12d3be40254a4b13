#include "PendingActions.hpp"

#include "OrderErrors.hpp"
#include <acs/vda5050/ActionMachine.hpp>

#include <algorithm>
#include <utility>

namespace ACS::VDA5050
{

void PendingActions::Add(Action action, std::optional<std::string> orderIDOrNull)
{
    _actions.push_back(PendingAction{std::move(action), 1, std::move(orderIDOrNull)});
}

bool PendingActions::TryRemove(std::string_view actionID)
{
    const auto isMeant = [actionID](const PendingAction& pending) {
        return pending.action.actionID == actionID;
    };
    return std::erase_if(_actions, isMeant) != 0;
}

std::vector<std::string> PendingActions::OnState(
    const StateMessage& state,
    const ActionIndex& shown,
    std::string_view cancelActionID,
    MasterActions& out)
{
    std::vector<std::string> rejected;
    if (_actions.empty())
    {
        return rejected;
    }
    const auto isSettled = [&](const PendingAction& pending) {
        const std::string& actionID = pending.action.actionID;
        if (shown.FindOrNull(actionID) != nullptr)
        {
            return true;
        }
        const auto refused = std::ranges::find_if(state.errors, [&actionID](const VehicleError& error) {
            const std::string* reference = FindReferenceOrNull(error, ReferenceKeys::ACTION_ID);
            return reference != nullptr && *reference == actionID;
        });
        if (refused != state.errors.end())
        {
            out.emplace_back(InstantActionRejected{actionID, refused->errorType, refused->errorDescription});
        }
        else if (actionID != cancelActionID && IsCancelLate(pending, state))
        {
            out.emplace_back(InstantActionRejected{actionID, {}, "the order has ended before it was cancelled"});
        }
        else
        {
            return false;
        }
        rejected.push_back(actionID);
        return true;
    };
    for (PendingAction& pending : _actions)
    {
        pending.orderID = pending.orderID.value_or(state.orderID);
    }
    std::erase_if(_actions, isSettled);
    if (_actions.empty())
    {
        out.emplace_back(CancelMasterTimer{EMasterTimer::ResendInstantActions});
    }
    return rejected;
}

std::vector<std::string> PendingActions::TakeSpent(std::uint32_t resendCount, MasterActions& out)
{
    std::vector<std::string> spent;
    const auto isSpent = [resendCount, &spent, &out](const PendingAction& pending) {
        if (resendCount == 0 || pending.sendCount <= resendCount)
        {
            return false;
        }
        spent.push_back(pending.action.actionID);
        out.emplace_back(InstantActionRejected{spent.back(), {}, "the vehicle never showed the action"});
        return true;
    };
    std::erase_if(_actions, isSpent);
    return spent;
}

std::vector<Action> PendingActions::Resend()
{
    std::vector<Action> actions;
    for (PendingAction& pending : _actions)
    {
        ++pending.sendCount;
        actions.push_back(pending.action);
    }
    return actions;
}

bool PendingActions::IsPending(std::string_view actionID) const
{
    return std::ranges::any_of(_actions, [actionID](const PendingAction& pending) {
        return pending.action.actionID == actionID;
    });
}

bool PendingActions::IsEmpty() const noexcept
{
    return _actions.empty();
}

bool PendingActions::IsCancelLate(const PendingAction& pending, const StateMessage& state)
{
    if (pending.action.actionType != ActionTypes::CANCEL_ORDER)
    {
        return false;
    }
    const bool bActs = std::ranges::any_of(state.actionStates, [](const ActionState& action) {
        return !IsTerminal(action.actionStatus);
    });
    return state.orderID != *pending.orderID || (state.nodeStates.empty() && state.edgeStates.empty() && !bActs);
}

} // namespace ACS::VDA5050
