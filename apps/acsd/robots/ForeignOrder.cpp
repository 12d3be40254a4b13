#include "robots/ForeignOrder.hpp"

#include <algorithm>
#include <utility>

namespace ACS::Acsd
{

bool ForeignOrder::IsExecuted(const VDA5050::StateMessage& state, const ActionTest& isOwn)
{
    if (state.orderID.empty())
    {
        return false;
    }
    const bool bActs = std::ranges::any_of(state.actionStates, [&isOwn](const VDA5050::ActionState& action) {
        const bool bRuns = action.actionStatus == VDA5050::EActionStatus::Initializing
            || action.actionStatus == VDA5050::EActionStatus::Running
            || action.actionStatus == VDA5050::EActionStatus::Paused;
        return bRuns && !isOwn(action);
    });
    return bActs || IsDriven(state);
}

bool ForeignOrder::IsDriven(const VDA5050::StateMessage& state)
{
    return !state.orderID.empty() && (!state.nodeStates.empty() || !state.edgeStates.empty());
}

void ForeignOrder::OnConnected()
{
    _cancelledID.clear();
}

void ForeignOrder::Cancel(VDA5050::MasterSession& session, Core::Now now, VDA5050::MasterActions& out)
{
    const VDA5050::StateMessage& state = *session.GetStateOrNull();
    if (!IsDriven(state) || _cancelledID == state.orderID)
    {
        return;
    }
    VDA5050::Action action;
    action.actionType = VDA5050::ActionTypes::CANCEL_ORDER;
    if (session.SendInstantAction(std::move(action), now, out))
    {
        _cancelledID = state.orderID;
    }
}

} // namespace ACS::Acsd
