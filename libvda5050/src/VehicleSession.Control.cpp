#include "ActionFault.hpp"
#include "OrderErrors.hpp"
#include "VehicleSession.Impl.hpp"

#include <string>
#include <utility>

namespace ACS::VDA5050
{

/// startPause or stopPause.
void VehicleSession::Impl::ChangePause(const Action& action, const Header& header, VehicleActions& out)
{
    if (_pause.IsOverridden())
    {
        FailInstantAction(
            action,
            header,
            ErrorTypes::INSTANT_ACTION_ERROR,
            {"the vehicle's own switch overrides " + action.actionType, {}});
        return;
    }
    const bool bWasPaused = IsPaused();
    if (action.actionType == ActionTypes::START_PAUSE)
    {
        _actions.AddInstant(action, EActionStatus::Running);
        _pause.Start(action.actionID);
    }
    else
    {
        _actions.SetStatus(_pause.Stop(), EActionStatus::Failed, "stopPause came first");
        _actions.AddInstant(action, EActionStatus::Finished);
    }
    FollowPause(bWasPaused, out);
}

void VehicleSession::Impl::FollowPause(bool bWasPaused, VehicleActions& out)
{
    if (IsPaused() == bWasPaused)
    {
        return;
    }
    _schedule.Request();
    if (bWasPaused)
    {
        _actions.ResumePaused(out);
    }
    else
    {
        _drive.Stop(out);
        _actions.PauseRunning(out);
    }
}

void VehicleSession::Impl::OnHardwarePause(bool bPaused, bool bOverridesMaster, Core::Now now, VehicleActions& out)
{
    const bool bWasPaused = IsPaused();
    _pause.SetSwitch(bPaused, bOverridesMaster);
    FollowPause(bWasPaused, out);
    Advance(out);
    Settle(now, out);
}

void VehicleSession::Impl::StartCancel(const Action& action, const Header& header, VehicleActions& out)
{
    if (!IsExecuting())
    {
        FailInstantAction(action, header, ErrorTypes::NO_ORDER_TO_CANCEL, {"there is no order to cancel", {}});
        return;
    }
    // Of 3.0; a master that names the order must not end another one.
    constexpr const char* ORDER_ID = "orderId";
    if (FindParameterOrNull(action, ORDER_ID) != nullptr
        && GetTextParameterOrNull(action, ORDER_ID) != _order.GetOrderID())
    {
        const std::string rule = "the order to cancel is not the one that runs: " + _order.GetOrderID();
        FailInstantAction(action, header, ErrorTypes::NO_ORDER_TO_CANCEL, {rule, ORDER_ID});
        return;
    }
    // Without its position the vehicle does not reach a node.
    const bool bLost = _reports.IsPositionLost();
    _actions.AddInstant(action, EActionStatus::Running);
    if (_order.TryBeginCancel(action.actionID))
    {
        _actions.StopOrder("the order was cancelled", out);
        _drive.Cancel(_options.bStopsBetweenNodes || bLost, out);
    }
    else if (bLost)
    {
        _drive.Cancel(true, out);
    }
}

void VehicleSession::Impl::FinishIfStationary(VehicleActions& out)
{
    if (_drive.IsStationary())
    {
        _actions.SetStatus(_pause.TakeFinished(), EActionStatus::Finished);
    }
    if (_order.IsCancelling() && _drive.CanFinishCancel() && !_actions.HasOpen())
    {
        ClearOrder(_drive.IsBetweenNodes(), out);
    }
}

void VehicleSession::Impl::ClearOrder(bool bNodeLeft, VehicleActions& out)
{
    if (_drive.IsEndReached())
    {
        PassFrontNode();
    }
    _drive.Clear();
    _actions.ClearQueue();
    _actions.SetStatus(_order.Clear(bNodeLeft, out), EActionStatus::Finished);
    _schedule.Request();
}

void VehicleSession::Impl::OnOperatingMode(EOperatingMode mode, Core::Now now, VehicleActions& out)
{
    const bool bManual = mode == EOperatingMode::Manual || _reports.GetMode() == EOperatingMode::Manual;
    if (!_reports.TryChangeMode(mode))
    {
        return;
    }
    const bool bBetweenNodes = _drive.IsBetweenNodes();
    if (_reports.IsLed())
    {
        _errors.End(SessionErrors::ELifetime::UntilMode, _errors.GetMark());
    }
    else
    {
        _drive.Stop(out);
    }
    if (bManual && IsExecuting())
    {
        const std::string reason = "the operating mode changed";
        _actions.StopOrder(reason, out);
        _actions.FailOrder(reason);
        ClearOrder(true, out); // in MANUAL it is moved by hand
    }
    if (mode == EOperatingMode::Manual && _options.bForgetsInManual)
    {
        _order.Forget();
        _drive.Forget(bBetweenNodes);
        _actions.Forget();
    }
    Advance(out);
    Settle(true, now, out);
}

} // namespace ACS::VDA5050
