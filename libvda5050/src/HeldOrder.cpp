#include "HeldOrder.hpp"

#include <utility>

namespace ACS::VDA5050
{

void HeldOrder::Accept(const OrderMessage& order, VehicleActions& out)
{
    _orderID = order.orderID;
    _zoneSetID = order.zoneSetID;
    _bHeldByFailure = false;
    Run(order, false, out);
}

void HeldOrder::AcceptUpdate(const OrderMessage& update, VehicleActions& out)
{
    if (!update.zoneSetID.empty())
    {
        _zoneSetID = update.zoneSetID;
    }
    Run(update, true, out);
}

void HeldOrder::Run(const OrderMessage& message, bool bUpdate, VehicleActions& out)
{
    _progress = EProgress::Running;
    _orderUpdateID = message.orderUpdateID;
    out.emplace_back(OrderTaken{_orderID, _orderUpdateID, bUpdate});
}

void HeldOrder::Complete(VehicleActions& out)
{
    if (_progress == EProgress::Running)
    {
        _progress = EProgress::Idle;
        _bHeldByFailure = false;
        out.emplace_back(OrderCompleted{_orderID});
    }
}

void HeldOrder::HoldByFailure()
{
    _bHeldByFailure = true;
}

bool HeldOrder::TryBeginCancel(std::string actionID)
{
    _cancelActionIDs.push_back(std::move(actionID));
    return _cancelActionIDs.size() == 1;
}

std::vector<std::string> HeldOrder::Clear(bool bNodeLeft, VehicleActions& out)
{
    _progress = bNodeLeft ? EProgress::Cleared : EProgress::Idle;
    _bHeldByFailure = false;
    out.emplace_back(OrderCleared{_orderID});
    return std::exchange(_cancelActionIDs, {});
}

void HeldOrder::OnLastNodeSet()
{
    if (_progress == EProgress::Cleared)
    {
        _progress = EProgress::Idle;
    }
}

void HeldOrder::Forget()
{
    _orderID.clear();
    _zoneSetID.clear();
    _orderUpdateID = 0;
}

const std::string& HeldOrder::GetOrderID() const noexcept
{
    return _orderID;
}

bool HeldOrder::IsRunning() const noexcept
{
    return _progress == EProgress::Running;
}

bool HeldOrder::IsCancelling() const noexcept
{
    return !_cancelActionIDs.empty();
}

bool HeldOrder::IsHeldByFailure() const noexcept
{
    return _bHeldByFailure;
}

void HeldOrder::Fill(StateMessage& state) const
{
    state.orderID = _orderID;
    state.orderUpdateID = _orderUpdateID;
    state.zoneSetID = _zoneSetID;
}

void HeldOrder::Fill(OrderContext& context) const
{
    context.heldOrderID = _orderID;
    context.heldOrderUpdateID = _orderUpdateID;
    context.bCancelling = IsCancelling();
    context.bCleared = _progress == EProgress::Cleared;
}

} // namespace ACS::VDA5050
