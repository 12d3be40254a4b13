#include "OrderErrors.hpp"
#include "OrderGeometry.hpp"
#include "VehicleSession.Impl.hpp"

#include <algorithm>
#include <utility>

namespace ACS::VDA5050
{

bool VehicleSession::Impl::TryReachNode(NodeArrival arrival, Core::Now now, VehicleActions& out)
{
    if (!_drive.IsOnEdgeTo(arrival.sequenceID))
    {
        return false;
    }
    if (arrival.bStationary)
    {
        _drive.OnStationary();
    }
    LeaveEdge(std::move(arrival.edgeActions), out);
    if (!_drive.IsEndReached())
    {
        PassFrontNode();
    }
    FinishIfStationary(out);
    Advance(out);
    Settle(now, out);
    return true;
}

void VehicleSession::Impl::OnDrivingChanged(bool bDriving, Core::Now now, VehicleActions& out)
{
    if (!_drive.TryChangeDriving(bDriving))
    {
        return;
    }
    _schedule.Request(); // paused is reported only when the vehicle is stationary
    FinishIfStationary(out);
    Settle(now, out);
}

bool VehicleSession::Impl::TrySetTrajectory(
    std::uint32_t edgeSequenceID,
    Trajectory trajectory,
    Core::Now now,
    VehicleActions& out)
{
    if (!FindTrajectoryFault(trajectory).empty() || !_drive.TrySetTrajectory(edgeSequenceID, std::move(trajectory)))
    {
        return false;
    }
    Settle(true, now, out);
    return true;
}

bool VehicleSession::Impl::TrySetLastNode(std::string nodeID, Core::Now now, VehicleActions& out)
{
    if (IsExecuting())
    {
        return false;
    }
    SetLastNode(std::move(nodeID));
    Settle(now, out);
    return true;
}

void VehicleSession::Impl::SetLastNode(std::string nodeID)
{
    _drive.SetLastNode(std::move(nodeID));
    _reports.ResetDistance();
    _order.OnLastNodeSet();
    _schedule.Request();
}

bool VehicleSession::Impl::TrySetOutsideCorridor(bool bOutside, Core::Now now, VehicleActions& out)
{
    if (!_drive.HasCorridor())
    {
        return false;
    }
    if (_drive.TryChangeCorridor(bOutside, out))
    {
        _schedule.Request();
    }
    if (bOutside)
    {
        FinishIfStationary(out);
    }
    Advance(out);
    Settle(now, out);
    return true;
}

void VehicleSession::Impl::Advance(VehicleActions& out)
{
    if (!IsPaused() && _reports.IsLed())
    {
        if (_order.IsCancelling())
        {
            _drive.DriveLastLeg(out);
        }
        else
        {
            StartQueuedActions(out);
            ContinueDriving(out);
        }
    }
    // Its last action may end while the vehicle is held.
    if (!IsExecuting())
    {
        _order.Complete(out);
    }
}

void VehicleSession::Impl::StartQueuedActions(VehicleActions& out)
{
    while (!_order.IsHeldByFailure())
    {
        ReportedAction* const nextOrNull = _actions.TakeStartableOrNull();
        if (nextOrNull == nullptr)
        {
            return;
        }
        Start(*nextOrNull, out);
    }
}

void VehicleSession::Impl::ContinueDriving(VehicleActions& out)
{
    if (!_drive.CanContinue() || _order.IsHeldByFailure())
    {
        return;
    }
    if (!_drive.IsLegActive())
    {
        if (!_actions.CanDrive())
        {
            return;
        }
        if (_drive.TryEnterEdge())
        {
            // Entered only now: while an action held the vehicle at the node, the edge's actions stayed Waiting.
            _actions.Enqueue(_drive.GetRoute().GetEdgeActions(0));
            StartQueuedActions(out);
            if (!_actions.CanDrive())
            {
                return;
            }
        }
    }
    _drive.DriveToFront(out);
}

/// 6.11: the edge's actions end with the edge. The state that no longer shows the edge shows their ends.
void VehicleSession::Impl::LeaveEdge(std::vector<EdgeActionEnd> ends, VehicleActions& out)
{
    for (const Action& action : _drive.GetRoute().GetEdgeActions(0))
    {
        ReportedAction* trackedOrNull = _actions.FindOrNull(action.actionID);
        if (trackedOrNull == nullptr || trackedOrNull->IsEnded())
        {
            continue;
        }
        const auto end = std::ranges::find(ends, action.actionID, &EdgeActionEnd::actionID);
        if (trackedOrNull->bStarted && end != ends.end() && IsTerminal(end->status)
            && TryChangeStatus(*trackedOrNull, end->status, std::move(end->resultDescription), out))
        {
            continue;
        }
        if (trackedOrNull->bStarted)
        {
            out.emplace_back(StopAction{action.actionID, true});
        }
        TryChangeStatus(*trackedOrNull, EActionStatus::Failed, "its edge was left", out);
    }
    _drive.LeaveEdge(_order.IsCancelling());
    _schedule.Request();
}

void VehicleSession::Impl::PassFrontNode()
{
    _actions.Enqueue(_drive.GetRoute().GetNodeActions(0));
    _drive.PassFrontNode();
    _reports.ResetDistance();
}

bool VehicleSession::Impl::IsExecuting() const
{
    return !_drive.GetRoute().IsEmpty() || _order.IsCancelling() || _actions.HasOpen();
}

bool VehicleSession::Impl::TrySetActionStatus(
    std::string_view actionID,
    EActionStatus status,
    std::string resultDescription,
    Core::Now now,
    VehicleActions& out)
{
    ReportedAction* trackedOrNull = _actions.FindOrNull(actionID);
    if (trackedOrNull == nullptr || !trackedOrNull->bStarted
        || !TryChangeStatus(*trackedOrNull, status, std::move(resultDescription), out))
    {
        return false;
    }
    FinishIfStationary(out);
    Advance(out);
    Settle(now, out);
    return true;
}

bool VehicleSession::Impl::TryChangeStatus(
    ReportedAction& tracked,
    EActionStatus status,
    std::string resultDescription,
    VehicleActions& out)
{
    if (std::string fault = _reports.FindEndFault(tracked.action); status == EActionStatus::Finished && !fault.empty())
    {
        status = EActionStatus::Failed;
        resultDescription = CutForeignText(fault);
    }
    if (!_actions.TrySetStatus(tracked, status, std::move(resultDescription)))
    {
        return false;
    }
    _schedule.Request();
    if (status == EActionStatus::Failed)
    {
        OnActionFailed(tracked, out);
    }
    else if (status == EActionStatus::Paused)
    {
        // The pause may have ended before the owner reported that the action is paused.
        const bool bAsked = std::exchange(tracked.bPauseAsked, false);
        if (bAsked && !IsPaused() && !tracked.bCancelled)
        {
            out.emplace_back(ResumeAction{tracked.action.actionID});
        }
    }
    else if (status == EActionStatus::Finished)
    {
        const bool bPose = tracked.action.actionType == ActionTypes::INIT_POSITION;
        const bool bInTime = !tracked.IsInstant() || !tracked.bOvertaken;
        if (!bPose || bInTime)
        {
            _reports.Apply(tracked.action);
        }
        if (bPose && bInTime && tracked.IsInstant())
        {
            SetLastNode(GetTextParameterOrNull(tracked.action, "lastNodeId").value_or(std::string()));
        }
    }
    return true;
}

/// The owner reports that an action did not succeed. 2.x does not stop an order for it; a vehicle may, for the kinds that it
/// names.
void VehicleSession::Impl::OnActionFailed(const ReportedAction& failed, VehicleActions& out)
{
    const ActionState& state = failed.machine.GetState();
    if (failed.IsInstant())
    {
        const ActionFault fault{state.actionType + " failed: " + state.resultDescription, {}};
        _errors.AddInstantActionError(failed.action, std::nullopt, ErrorTypes::ACTION_ERROR, fault);
        return;
    }
    if (failed.bCancelled)
    {
        return;
    }
    const bool bCritical =
        std::ranges::find(_options.criticalActionTypes, failed.action.actionType) != _options.criticalActionTypes.end();
    _errors.AddOrderActionError(failed, bCritical ? EErrorLevel::Fatal : EErrorLevel::Warning);
    if (bCritical)
    {
        _order.HoldByFailure();
        _drive.Stop(out);
    }
}

void VehicleSession::Impl::Start(ReportedAction& tracked, VehicleActions& out)
{
    std::string fault = tracked.IsInstant() ? std::string() : _reports.FindFault(tracked.action, false);
    if (fault.empty())
    {
        _actions.Start(tracked, out);
    }
    else
    {
        TryChangeStatus(tracked, EActionStatus::Failed, std::move(fault), out);
    }
}

void VehicleSession::Impl::ReportUnlistedParameters(const Action& action, ETopic topic)
{
    if (_options.parameterCheck != EParameterCheck::Lenient)
    {
        return;
    }
    const std::vector<std::string> keys = FindUnlistedParameters(_options.factsheet, action);
    if (!keys.empty())
    {
        _errors.AddUnlistedParameters(action, topic, keys);
    }
}

} // namespace ACS::VDA5050
