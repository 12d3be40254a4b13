#include "MasterSession.Impl.hpp"
#include <acs/vda5050/ActionMachine.hpp>
#include <acs/vda5050/EVda5050Error.hpp>

#include <algorithm>
#include <iterator>
#include <tuple>
#include <utility>

namespace ACS::VDA5050
{

Core::Result<void> MasterSession::Impl::Cancel(Core::Now now, MasterActions& out)
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

void MasterSession::Impl::UpdateCancel(MasterActions& out)
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

void MasterSession::Impl::EndCancel(EActionStatus status, MasterActions& out)
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
    if (!bHeld)
    {
        Withdraw(_withdrawn.has_value() ? &*_withdrawn : nullptr, false);
    }
    EndOrder(out);
}

void MasterSession::Impl::Withdraw(const OrderMessage* messageOrNull, bool bRejected)
{
    WithdrawnOrder order{_orderID, {}, bRejected};
    const auto add = [&order](const auto& elements) {
        for (const auto& element : elements)
        {
            std::ranges::transform(element.actions, std::back_inserter(order.actionIDs), &Action::actionID);
        }
    };
    if (messageOrNull != nullptr)
    {
        add(messageOrNull->nodes);
        add(messageOrNull->edges);
    }
    constexpr std::size_t MOST_WITHDRAWN = 16;
    if (_withdrawnOrders.size() == MOST_WITHDRAWN)
    {
        _withdrawnOrders.erase(_withdrawnOrders.begin());
    }
    std::ranges::sort(order.actionIDs);
    _withdrawnOrders.push_back(std::move(order));
}

bool MasterSession::Impl::IsRunning(const WithdrawnOrder& order) const
{
    return IsBusy() || std::ranges::any_of(_state->actionStates, [&order](const ActionState& action) {
               return !IsTerminal(action.actionStatus) && std::ranges::binary_search(order.actionIDs, action.actionID);
           });
}

/// An order that ended for us before the vehicle had it: that may come late, from a queue.
void MasterSession::Impl::CancelReappeared(Core::Now now, MasterActions& out)
{
    const auto found = std::ranges::find(_withdrawnOrders, _state->orderID, &WithdrawnOrder::orderID);
    if (_phase != EOrderPhase::None || found == _withdrawnOrders.end() || _link != EVehicleLink::Online
        || !IsUnderMasterControl())
    {
        return;
    }
    const bool bRuns = IsRunning(*found);
    if (!bRuns && !found->bRejected)
    {
        return; // one that was cancelled as soon as it came
    }
    const std::string orderID = std::move(found->orderID);
    _withdrawnOrders.erase(found);
    out.emplace_back(OrderReappeared{orderID});
    if (!bRuns)
    {
        out.emplace_back(OrderFinished{orderID});
        return;
    }
    BeginOrder(orderID, _state->orderUpdateID);
    _bAccepted = true;
    _phase = EOrderPhase::Active;
    std::ignore = Cancel(now, out);
}

} // namespace ACS::VDA5050
