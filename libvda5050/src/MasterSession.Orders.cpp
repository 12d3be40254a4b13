#include "MasterSession.Impl.hpp"
#include <acs/vda5050/ActionMachine.hpp>
#include <acs/vda5050/EVda5050Error.hpp>

#include <tuple>
#include <utility>

namespace ACS::VDA5050
{

std::uint32_t MasterSession::Impl::GetShownUpdateID() const
{
    return _vehicle.IsShowingOrder(_orderID) ? _vehicle.GetStateOrNull()->orderUpdateID : 0;
}

void MasterSession::Impl::AddToRoute(const OrderMessage& order, bool bUpdate)
{
    _route.Extend(order);
    _actions.TrackOrder(order, _route.ListActionIDs(), bUpdate);
}

void MasterSession::Impl::SettleInFlight(const ActionIndex& shown, MasterActions& out)
{
    const OrderOutbox::Answer answer = _outbox.OnState(*_vehicle.GetStateOrNull(), shown);
    switch (answer.kind)
    {
        case OrderOutbox::EAnswer::Shown:
        {
            const bool bUpdate = _outbox.IsAccepted();
            AddToRoute(_outbox.Accept(*_vehicle.GetStateOrNull(), out), bUpdate);
            break;
        }
        case OrderOutbox::EAnswer::Rejected:
            RejectInFlight(answer.errorType, answer.reason, out);
            break;
        case OrderOutbox::EAnswer::Unresolved:
            _withdrawnOrders.Add(_orderID, _outbox.GetInFlightOrNull(), true);
            out.emplace_back(OrderLost{
                _orderID,
                "the vehicle was restarted, or not connected, after the order was sent, and may have executed it"});
            EndOrder(out);
            break;
        case OrderOutbox::EAnswer::None:
        default:
            break;
    }
}

void MasterSession::Impl::RejectInFlight(const std::string& errorType, const std::string& reason, MasterActions& out)
{
    const bool bAccepted = _outbox.IsAccepted();
    if (const OrderMessage* const showable = _outbox.GetShowableOrNull(); showable != nullptr && !bAccepted)
    {
        _withdrawnOrders.Add(_orderID, showable, true);
    }
    _outbox.Reject(errorType, reason, out);
    if (!bAccepted)
    {
        EndOrder(out);
    }
}

bool MasterSession::Impl::IsOrderDone() const
{
    // What has ended is no longer tracked.
    return !_outbox.IsContinued() && _outbox.IsEmpty() && _route.IsReached() && !_vehicle.IsBusy()
        && !_actions.HasShownOrderAction();
}

bool MasterSession::Impl::IsClearedAtEnd() const
{
    const StateMessage& state = *_vehicle.GetStateOrNull();
    const bool bCleared = state.orderID.empty() && !_vehicle.IsBusy();
    if (!bCleared || _outbox.IsContinued() || !_outbox.IsEmpty()
        || !_route.IsEnd(state.lastNodeID, state.lastNodeSequenceID))
    {
        return false;
    }
    // A vehicle that was restarted may show the first node too.
    return state.lastNodeSequenceID > 0 || _actions.HasShownAllEnds();
}

bool MasterSession::Impl::IsCancelAnswered() const
{
    const ActionState* const shown = _cancelActionID.empty() ? nullptr : _vehicle.FindActionOrNull(_cancelActionID);
    return shown != nullptr && IsTerminal(shown->actionStatus);
}

void MasterSession::Impl::UpdateCleared(MasterActions& out)
{
    const bool bAtEnd = IsClearedAtEnd();
    if (bAtEnd)
    {
        _route.ReportReached(*_vehicle.GetStateOrNull(), out);
    }
    if (IsCancelAnswered())
    {
        return; // which decides
    }
    if (bAtEnd)
    {
        out.emplace_back(OrderFinished{_orderID});
        EndOrder(out);
    }
    else
    {
        LoseAccepted("the vehicle holds no order", out);
    }
}

void MasterSession::Impl::UpdateOrder(MasterActions& out)
{
    if (!_outbox.IsAccepted())
    {
        return;
    }
    const StateMessage& state = *_vehicle.GetStateOrNull();
    if (state.orderID.empty())
    {
        UpdateCleared(out);
        return;
    }
    if (state.orderID != _orderID)
    {
        LoseAccepted("the vehicle holds " + state.orderID, out);
        return;
    }
    _route.ReportReached(state, out);
    if (GetOrderPhase() == EOrderPhase::Cancelling)
    {
        return;
    }
    if (IsOrderDone())
    {
        out.emplace_back(OrderFinished{_orderID});
        EndOrder(out);
    }
    else if (!_vehicle.IsBusy() && !_route.IsReached())
    {
        // A base that is done leaves its horizon in nodeStates; nothing left means that it was dropped.
        LoseAccepted("the vehicle cleared the order", out);
    }
}

void MasterSession::Impl::LoseAccepted(std::string reason, MasterActions& out)
{
    if (const OrderMessage* const showable = _outbox.GetShowableOrNull())
    {
        _withdrawnOrders.Add(_orderID, showable, false);
    }
    out.emplace_back(OrderLost{_orderID, std::move(reason)});
    EndOrder(out);
}

void MasterSession::Impl::EndOrder(MasterActions& out)
{
    _outbox.EndOrder(out);
    _actions.EndOrder(out);
    if (_pendingActions.TryRemove(_cancelActionID))
    {
        _actions.Remove(_cancelActionID); // sent again it would end the next order
    }
    _orderID.clear();
    _cancelActionID.clear();
    _route.Clear();
}

bool MasterSession::Impl::IsOrderSent() const noexcept
{
    return !_orderID.empty() && (_outbox.IsAccepted() || _outbox.GetSentOrNull() != nullptr);
}

Core::Result<void> MasterSession::Impl::Cancel(Core::Now now, MasterActions& out)
{
    if (_orderID.empty())
    {
        return Core::Fail(EVda5050Error::NoOrder, {}, "an order that runs", {});
    }
    if (!_cancelActionID.empty())
    {
        return {};
    }
    if (!_outbox.IsAccepted() && _outbox.GetShowableOrNull() == nullptr)
    {
        out.emplace_back(OrderCancelled{_orderID}); // a cancelOrder would end the order of another master
        EndOrder(out);
        return {};
    }
    Action action;
    action.actionType = ActionTypes::CANCEL_ORDER;
    Core::Result<std::string> actionID = SendInstantAction(std::move(action), now, out);
    if (!actionID)
    {
        return tl::unexpected(actionID.error());
    }
    _cancelActionID = std::move(*actionID);
    _outbox.Withdraw(out);
    return {};
}

void MasterSession::Impl::UpdateCancel(MasterActions& out)
{
    if (_cancelActionID.empty() || _pendingActions.IsPending(_cancelActionID) || _vehicle.GetStateOrNull() == nullptr)
    {
        return;
    }
    const ActionState* const shown = _vehicle.FindActionOrNull(_cancelActionID);
    if (shown == nullptr)
    {
        // Settled without being shown: refused by an error, or never answered.
        EndCancel(EActionStatus::Failed, out);
    }
    else if (IsTerminal(shown->actionStatus))
    {
        EndCancel(shown->actionStatus, out);
    }
}

void MasterSession::Impl::EndCancel(EActionStatus status, MasterActions& out)
{
    const bool bHeld = _outbox.IsAccepted() && _vehicle.IsShowingOrder(_orderID);
    const bool bOpen = bHeld && (!_vehicle.GetStateOrNull()->nodeStates.empty() || _actions.HasShownOrderAction());
    if (status == EActionStatus::Failed && (bHeld ? IsOrderDone() : _outbox.IsAccepted() && IsClearedAtEnd()))
    {
        out.emplace_back(OrderFinished{_orderID});
    }
    else if (status == EActionStatus::Failed && bOpen)
    {
        out.emplace_back(CancelFailed{_orderID, "the vehicle still holds the order"});
        _cancelActionID.clear();
        _outbox.Restore(*_vehicle.GetStateOrNull(), out);
        return;
    }
    else
    {
        out.emplace_back(OrderCancelled{_orderID});
    }
    if (const OrderMessage* const showable = _outbox.GetShowableOrNull(); showable != nullptr || !bHeld)
    {
        _withdrawnOrders.Add(_orderID, showable, false);
    }
    EndOrder(out);
}

void MasterSession::Impl::CancelReappeared(Core::Now now, MasterActions& out)
{
    if (!_orderID.empty() || !_vehicle.CanReceive())
    {
        return;
    }
    const StateMessage& state = *_vehicle.GetStateOrNull();
    const std::optional<WithdrawnOrders::EReappearance> reappeared = _withdrawnOrders.TakeReappearedOrNull(state);
    if (!reappeared.has_value())
    {
        return;
    }
    out.emplace_back(OrderReappeared{state.orderID});
    if (*reappeared == WithdrawnOrders::EReappearance::Ended)
    {
        out.emplace_back(OrderFinished{state.orderID});
        return;
    }
    BeginOrder(state.orderID, OrderNumbers(state.orderUpdateID, {}));
    _outbox.SetAccepted(state.orderUpdateID);
    std::ignore = Cancel(now, out);
}

} // namespace ACS::VDA5050
