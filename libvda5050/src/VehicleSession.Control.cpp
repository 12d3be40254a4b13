#include "OrderErrors.hpp"
#include "VehicleSession.Impl.hpp"

#include <algorithm>
#include <utility>

namespace ACS::VDA5050
{

void VehicleSession::Impl::StopMoving(VehicleActions& out)
{
    if (_bLegActive)
    {
        _bLegActive = false;
        _bHalting = true;
        out.emplace_back(StopDriving{});
    }
}

/// After StopDriving the vehicle counts as moving until the owner reports that it is stationary.
bool VehicleSession::Impl::IsStationary() const
{
    return !_bDriving && !_bHalting;
}

bool VehicleSession::Impl::IsPauseOverridden(const Action& action, const Header& header)
{
    if (_bPauseOverridden)
    {
        FailInstantAction(
            action,
            header,
            ErrorTypes::INSTANT_ACTION_ERROR,
            {"the vehicle's own switch overrides " + action.actionType, {}});
    }
    return _bPauseOverridden;
}

void VehicleSession::Impl::StartPause(const Action& action, const Header& header, VehicleActions& out)
{
    if (IsPauseOverridden(action, header))
    {
        return;
    }
    AddInstantAction(action, EActionStatus::Running);
    _pauseActionIDs.push_back(action.actionID);
    const bool bWasPaused = IsPaused();
    _bMasterPause = true;
    if (!bWasPaused)
    {
        EnterPause(out);
    }
}

void VehicleSession::Impl::StopPause(const Action& action, const Header& header, VehicleActions& out)
{
    if (IsPauseOverridden(action, header))
    {
        return;
    }
    for (const std::string& actionID : std::exchange(_pauseActionIDs, {}))
    {
        SetStatus(actionID, EActionStatus::Failed, "stopPause came first");
    }
    const bool bWasPaused = IsPaused();
    _bMasterPause = false;
    _bHardwarePause = false;
    AddInstantAction(action, EActionStatus::Finished);
    if (bWasPaused)
    {
        LeavePause(out);
    }
}

void VehicleSession::Impl::OnHardwarePause(bool bPaused, bool bOverridesMaster, Core::Now now, VehicleActions& out)
{
    const bool bWasPaused = IsPaused();
    _bHardwarePause = bPaused;
    _bPauseOverridden = bOverridesMaster;
    if (IsPaused() != bWasPaused)
    {
        _bStateDue = true;
        if (bWasPaused)
        {
            LeavePause(out);
        }
        else
        {
            EnterPause(out);
        }
    }
    Advance(out);
    Settle(now, out);
}

bool VehicleSession::Impl::IsPaused() const noexcept
{
    return _bMasterPause || _bHardwarePause;
}

void VehicleSession::Impl::EnterPause(VehicleActions& out)
{
    StopMoving(out);
    for (const ReportedAction& tracked : _actions)
    {
        if (tracked.IsRunningInOrder())
        {
            out.emplace_back(PauseAction{tracked.action.actionID});
        }
    }
}

void VehicleSession::Impl::LeavePause(VehicleActions& out) const
{
    for (const ReportedAction& tracked : _actions)
    {
        if (tracked.machine.GetStatus() == EActionStatus::Paused)
        {
            out.emplace_back(ResumeAction{tracked.action.actionID});
        }
    }
}

void VehicleSession::Impl::FinishPauseIfStationary()
{
    if (!IsStationary())
    {
        return;
    }
    for (const std::string& actionID : std::exchange(_pauseActionIDs, {}))
    {
        SetStatus(actionID, EActionStatus::Finished);
    }
}

void VehicleSession::Impl::StartCancel(const Action& action, const Header& header, VehicleActions& out)
{
    if (!IsExecuting())
    {
        FailInstantAction(action, header, ErrorTypes::NO_ORDER_TO_CANCEL, {"there is no order to cancel", {}});
        return;
    }
    const bool bFirst = _cancelActionIDs.empty();
    AddInstantAction(action, EActionStatus::Running);
    _cancelActionIDs.push_back(action.actionID);
    if (!bFirst)
    {
        return;
    }
    StopOrderActions("the order was cancelled", out);
    if (_options.bStopsBetweenNodes || !_bLegBegun)
    {
        StopMoving(out);
        return;
    }
    // Bound to nodes, and between two of them, be it paused: drives on to the next one, whose actions have failed.
    _bLastLeg = true;
    _route.Cut(1);
    _route.DropFrontActions();
}

/// Waiting actions fail; running ones get StopAction.
void VehicleSession::Impl::StopOrderActions(const std::string& reason, VehicleActions& out)
{
    _actionQueue.clear();
    for (ReportedAction& tracked : _actions)
    {
        if (tracked.IsInstant() || tracked.IsEnded())
        {
            continue;
        }
        tracked.bCancelled = true;
        if (tracked.bStarted)
        {
            out.emplace_back(StopAction{tracked.action.actionID, false});
        }
        if (!tracked.bStarted || tracked.machine.GetStatus() == EActionStatus::Paused)
        {
            static_cast<void>(_actions.TrySetStatus(tracked, EActionStatus::Failed, reason));
        }
    }
}

void VehicleSession::Impl::FinishCancelIfStationary(VehicleActions& out)
{
    // Outside of its corridor a vehicle does not get to the next node by itself.
    const bool bOnTheWay = _bLegActive || (_bLastLeg && !_bEndReached && !_corridorError.has_value());
    if (!_cancelActionIDs.empty() && IsStationary() && !bOnTheWay && _actions.CountOpen() == 0)
    {
        ClearOrder(out);
    }
}

void VehicleSession::Impl::DiscardRoute()
{
    _route.Clear();
    _actionQueue.clear();
    _bEdgeEntered = false;
    _bLegBegun = false;
    _bEndReached = false;
    _bHeldByFailure = false;
    _corridorError.reset();
}

void VehicleSession::Impl::ClearOrder(VehicleActions& out)
{
    if (_bEndReached)
    {
        PassFrontNode();
    }
    DiscardRoute();
    _bLegActive = false;
    _bLastLeg = false;
    _bCleared = true;
    _bOrderRunning = false;
    _bStateDue = true;
    for (const std::string& actionID : std::exchange(_cancelActionIDs, {}))
    {
        SetStatus(actionID, EActionStatus::Finished);
    }
    out.emplace_back(OrderCleared{_orderID});
}

bool VehicleSession::Impl::TrySetOutsideCorridor(bool bOutside, Core::Now now, VehicleActions& out)
{
    if (!_bEdgeEntered || _route.IsEmpty() || !_route.HasCorridor(0))
    {
        return false;
    }
    if (bOutside != _corridorError.has_value())
    {
        _bStateDue = true;
        _corridorError.reset();
    }
    if (bOutside)
    {
        const std::string& edgeID = _route.GetEdgeID(0);
        VehicleError& error = _corridorError.emplace();
        error.errorType = ErrorTypes::OUTSIDE_OF_CORRIDOR;
        error.errorLevel = EErrorLevel::Fatal;
        error.errorDescription = "outside of the corridor of " + edgeID;
        AddReference(error, ReferenceKeys::TOPIC, GetTopicName(ETopic::Order));
        AddReference(error, ReferenceKeys::EDGE_ID, edgeID);
        StopMoving(out);
        FinishCancelIfStationary(out);
    }
    Advance(out);
    Settle(now, out);
    return true;
}

void VehicleSession::Impl::OnOperatingMode(EOperatingMode mode, Core::Now now, VehicleActions& out)
{
    if (mode == _operatingMode)
    {
        return;
    }
    const bool bManual = mode == EOperatingMode::Manual || _operatingMode == EOperatingMode::Manual;
    const bool bBetweenNodes = _bLegBegun;
    _operatingMode = mode;
    _bStateDue = true;
    if (!CanMoveByItself())
    {
        StopMoving(out);
    }
    else
    {
        std::erase_if(_sessionErrors, [](const SessionError& known) {
            return known.lifetime == EErrorLifetime::UntilMode && known.bShown;
        });
    }
    if (bManual && IsExecuting())
    {
        const std::string reason = "the operating mode changed";
        StopOrderActions(reason, out);
        for (ReportedAction& tracked : _actions)
        {
            if (!tracked.IsInstant() && !tracked.IsEnded())
            {
                static_cast<void>(_actions.TrySetStatus(tracked, EActionStatus::Failed, reason));
            }
        }
        ClearOrder(out);
    }
    if (mode == EOperatingMode::Manual && _options.bForgetsInManual)
    {
        ForgetOrder(bBetweenNodes);
    }
    Advance(out);
    Settle(now, out);
}

void VehicleSession::Impl::ForgetOrder(bool bBetweenNodes)
{
    _orderID.clear();
    _orderUpdateID = 0;
    _zoneSetID.clear();
    _lastNodeSequenceID = 0;
    if (bBetweenNodes)
    {
        _lastNodeID.clear();
    }
    _actions.EraseIf([](const ReportedAction& tracked) { return !tracked.IsInstant() || tracked.IsEnded(); });
}

bool VehicleSession::Impl::CanMoveByItself() const
{
    return IsLedByMaster(_operatingMode);
}

} // namespace ACS::VDA5050
