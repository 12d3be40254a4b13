#include <acs/vda5050/ActionMachine.hpp>
#include <acs/vda5050/EVda5050Error.hpp>
#include <acs/vda5050/MasterSession.hpp>

#include <algorithm>
#include <tuple>
#include <utility>

namespace ACS::VDA5050
{

Core::Result<void> MasterSession::Cancel(Core::Now now, MasterActions& out)
{
    if (_phase == EOrderPhase::None)
    {
        return Core::Fail(EVda5050Error::NoOrder, {}, "an order that runs", {});
    }
    if (_phase == EOrderPhase::Cancelling)
    {
        return {};
    }
    Action action;
    action.actionType = ActionTypes::CANCEL_ORDER;
    Core::Result<std::string> actionID = SendInstantAction(std::move(action), now, out);
    if (!actionID)
    {
        return tl::unexpected(actionID.error());
    }
    _phase = EOrderPhase::Cancelling;
    _cancelActionID = std::move(*actionID);
    // Whether the vehicle has seen what is in flight or not: it must not come again.
    _withdrawn = std::exchange(_inFlight, std::nullopt);
    if (_sendCount == 0)
    {
        _withdrawn.reset();
    }
    _queued.reset();
    out.emplace_back(CancelMasterTimer{EMasterTimer::ResendOrder});
    return {};
}

void MasterSession::FollowCancel(MasterActions& out)
{
    if (_phase != EOrderPhase::Cancelling || IsPending(_cancelActionID) || !_state.has_value())
    {
        return;
    }
    const auto action = std::ranges::find(_state->actionStates, _cancelActionID, &ActionState::actionID);
    if (action == _state->actionStates.end())
    {
        // Settled without being shown: refused by an error, or never answered.
        EndCancel(EActionStatus::Failed, out);
    }
    else if (IsTerminal(action->actionStatus))
    {
        EndCancel(action->actionStatus, out);
    }
}

void MasterSession::EndCancel(EActionStatus status, MasterActions& out)
{
    const bool bHeld = _bAccepted && _state->orderID == _orderID;
    if (status == EActionStatus::Failed && bHeld && IsOrderDone())
    {
        out.emplace_back(OrderFinished{_orderID});
    }
    else if (status == EActionStatus::Failed && bHeld && !_state->nodeStates.empty())
    {
        out.emplace_back(CancelFailed{_orderID, "the vehicle still holds the order"});
        _phase = EOrderPhase::Active;
        _cancelActionID.clear();
        _withdrawn.reset();
        return;
    }
    else
    {
        out.emplace_back(OrderCancelled{_orderID});
    }
    _withdrawnOrderID = bHeld ? std::string() : _orderID;
    EndOrder(out);
}

/// The order of a cancel that the vehicle answered before it had the order: that may come late, from a queue.
void MasterSession::CancelReappeared(Core::Now now, MasterActions& out)
{
    const bool bRuns = _state->orderID == _withdrawnOrderID && !_state->nodeStates.empty();
    if (_phase != EOrderPhase::None || _withdrawnOrderID.empty() || !bRuns || _link != EVehicleLink::Online)
    {
        return;
    }
    _orderID = std::exchange(_withdrawnOrderID, {});
    _bAccepted = true;
    _phase = EOrderPhase::Active;
    out.emplace_back(OrderReappeared{_orderID});
    std::ignore = Cancel(now, out);
}

} // namespace ACS::VDA5050
