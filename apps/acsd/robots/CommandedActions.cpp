#include "robots/CommandedActions.hpp"

#include <tuple>
#include <utility>

namespace ACS::Acsd
{

void CommandedActions::Send(
    std::string_view actionType,
    VDA5050::MasterSession& session,
    Core::Now now,
    VDA5050::MasterActions& out)
{
    const bool bPause =
        actionType == VDA5050::ActionTypes::START_PAUSE || actionType == VDA5050::ActionTypes::STOP_PAUSE;
    std::string& actionID = bPause ? _pauseID : _chargeID;
    std::ignore = session.TryWithdrawInstantAction(actionID);
    VDA5050::Action action;
    action.actionType = actionType;
    // If an offline vehicle did not pause, its next state shows that. The engine has its own time limit for a pause.
    actionID = session.SendInstantAction(std::move(action), now, out).value_or(std::string());
}

bool CommandedActions::IsCommanded(const VDA5050::ActionState& action) const noexcept
{
    const bool bMayBeFormer = _chargeID.empty() && action.actionType == VDA5050::ActionTypes::START_CHARGING;
    return bMayBeFormer || (!action.actionID.empty() && (action.actionID == _pauseID || action.actionID == _chargeID));
}

} // namespace ACS::Acsd
