#include "ActionFault.hpp"
#include "OrderErrors.hpp"
#include "OrderGeometry.hpp"
#include "VehicleSession.Impl.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace ACS::VDA5050
{

namespace
{

bool IsBlockingDriving(const Action& action)
{
    return action.blockingType != EBlockingType::None;
}

bool HasBlocking(std::span<const Action> actions)
{
    return std::ranges::any_of(actions, IsBlockingDriving);
}

} // namespace

bool VehicleSession::Impl::TryReachNode(NodeArrival arrival, Core::Now now, VehicleActions& out)
{
    if (_route.IsEmpty() || !_bEdgeEntered || _route.GetNodeSequenceID(0) != arrival.sequenceID)
    {
        return false;
    }
    if (arrival.bStationary)
    {
        _bDriving = false;
        _bHalting = false;
        _bLegActive = false; // an action that fails here has no drive to stop
    }
    LeaveEdge(std::move(arrival.edgeActions), out);
    // Without nodes a cancelled order would look like a completed one.
    _bEndReached = !_cancelActionIDs.empty() && _route.GetSize() == 1;
    if (!_bEndReached)
    {
        PassFrontNode();
    }
    FinishPauseIfStationary();
    FinishCancelIfStationary(out);
    Advance(out);
    Settle(now, out);
    return true;
}

void VehicleSession::Impl::OnDrivingChanged(bool bDriving, Core::Now now, VehicleActions& out)
{
    const bool bHalted = _bHalting && !bDriving;
    if (bDriving == _bDriving && !bHalted)
    {
        return;
    }
    // A stop may end without a change of driving, if the vehicle had not started to move. paused is reported only now.
    _bStateDue = true;
    _bDriving = bDriving;
    _bHalting = _bHalting && bDriving;
    FinishPauseIfStationary();
    FinishCancelIfStationary(out);
    Settle(now, out);
}

bool VehicleSession::Impl::TrySetTrajectory(
    std::uint32_t edgeSequenceID,
    Trajectory trajectory,
    Core::Now now,
    VehicleActions& out)
{
    if (!FindTrajectoryFault(trajectory).empty() || !_route.TrySetTrajectory(edgeSequenceID, std::move(trajectory)))
    {
        return false;
    }
    _bStateDue = true;
    Settle(now, out);
    return true;
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
    FinishCancelIfStationary(out);
    Advance(out);
    Settle(now, out);
    return true;
}

void VehicleSession::Impl::AddActions(
    const std::vector<Action>& actions,
    EActionScope scope,
    const std::string& elementID,
    std::uint32_t sequenceID)
{
    for (const Action& action : actions)
    {
        ActionState state{action.actionID, action.actionType, action.actionDescription, EActionStatus::Waiting, {}};
        _actions.Add(ReportedAction{action, ActionMachine(std::move(state)), scope, elementID, sequenceID});
        ReportUnlistedParameters(action, ETopic::Order);
    }
}

void VehicleSession::Impl::ReportUnlistedParameters(const Action& action, ETopic topic)
{
    if (_options.parameterCheck != EParameterCheck::Lenient)
    {
        return;
    }
    const std::vector<std::string> keys = FindUnlistedParameters(_options.factsheet, action);
    if (keys.empty())
    {
        return;
    }
    VehicleError report;
    report.errorType = ErrorTypes::UNLISTED_PARAMETER;
    report.errorDescription = "parameters of " + action.actionType + " that the factsheet does not list have no effect";
    AddReference(report, ReferenceKeys::TOPIC, GetTopicName(topic));
    AddReference(report, ReferenceKeys::ACTION_ID, action.actionID);
    for (const std::string& key : keys)
    {
        AddReference(report, ReferenceKeys::PARAMETER, key);
    }
    AddSessionError(
        std::move(report),
        topic == ETopic::Order ? EErrorLifetime::UntilOrder : EErrorLifetime::UntilInstantAction);
}

void VehicleSession::Impl::Enqueue(std::span<const Action> actions)
{
    std::ranges::transform(actions, std::back_inserter(_actionQueue), &Action::actionID);
}

bool VehicleSession::Impl::TryChangeStatus(
    ReportedAction& tracked,
    EActionStatus status,
    std::string resultDescription,
    VehicleActions& out)
{
    if (!_actions.TrySetStatus(tracked, status, std::move(resultDescription)))
    {
        return false;
    }
    _bStateDue = true;
    if (status == EActionStatus::Finished)
    {
        ApplyOwnEffect(tracked.action, tracked.scope);
    }
    else if (status == EActionStatus::Failed)
    {
        OnActionFailed(tracked, out);
    }
    return true;
}

void VehicleSession::Impl::SetStatus(std::string_view actionID, EActionStatus status, const std::string& result)
{
    ReportedAction* trackedOrNull = _actions.FindOrNull(actionID);
    if (trackedOrNull != nullptr && _actions.TrySetStatus(*trackedOrNull, status, result))
    {
        _bStateDue = true;
    }
}

/// One that cannot succeed, by what the session knows itself, fails instead.
void VehicleSession::Impl::Start(ReportedAction& tracked, VehicleActions& out)
{
    std::string fault = tracked.IsInstant() ? std::string() : FindOwnFault(tracked.action, tracked.scope);
    if (!fault.empty())
    {
        static_cast<void>(TryChangeStatus(tracked, EActionStatus::Failed, std::move(fault), out));
        return;
    }
    _actions.MarkStarted(tracked);
    out.emplace_back(StartAction{tracked.action, tracked.scope, tracked.elementID, tracked.sequenceID});
}

void VehicleSession::Impl::Advance(VehicleActions& out)
{
    if (!IsPaused() && CanMoveByItself())
    {
        if (_cancelActionIDs.empty())
        {
            StartQueuedActions(out);
            ContinueDriving(out);
        }
        else
        {
            DriveLastLeg(out);
        }
    }
    // Its last action may end while the vehicle is held.
    FinishOrderIfDone(out);
}

/// 6.11: None and Soft run beside each other; Hard waits for all of them and holds up all that follow.
void VehicleSession::Impl::StartQueuedActions(VehicleActions& out)
{
    while (!_actionQueue.empty() && !_bHeldByFailure)
    {
        ReportedAction* nextOrNull = _actions.FindOrNull(_actionQueue.front());
        if (nextOrNull == nullptr || nextOrNull->bStarted || nextOrNull->machine.GetStatus() != EActionStatus::Waiting)
        {
            _actionQueue.pop_front();
            continue;
        }
        const bool bHard = nextOrNull->action.blockingType == EBlockingType::Hard;
        if (_actions.CountRunningHard() > 0 || (bHard && _actions.CountRunning() > 0))
        {
            return;
        }
        _actionQueue.pop_front();
        Start(*nextOrNull, out);
    }
}

bool VehicleSession::Impl::CanDrive() const
{
    return _actionQueue.empty() && _actions.CountRunningBlocking() == 0;
}

bool VehicleSession::Impl::NeedsStopAtFront() const
{
    return _route.CountReleased() < 2 || HasBlocking(_route.GetNodeActions(0)) || HasBlocking(_route.GetEdgeActions(1));
}

void VehicleSession::Impl::ContinueDriving(VehicleActions& out)
{
    if (_route.CountReleased() == 0 || _bHeldByFailure || _corridorError.has_value())
    {
        return;
    }
    if (_bLegActive)
    {
        if (NeedsStopAtFront() != _bLegStops)
        {
            DriveToFront(!_bLegStops, out);
        }
        return;
    }
    if (!CanDrive())
    {
        return;
    }
    if (!_bEdgeEntered)
    {
        // Entered only now: while an action held the vehicle at the node, the edge's actions stayed Waiting.
        _bEdgeEntered = true;
        Enqueue(_route.GetEdgeActions(0));
        StartQueuedActions(out);
        if (!CanDrive())
        {
            return;
        }
    }
    DriveToFront(NeedsStopAtFront(), out);
}

void VehicleSession::Impl::DriveToFront(bool bStopAtNode, VehicleActions& out)
{
    _bLegActive = true;
    _bLegBegun = true;
    _bLegStops = bStopAtNode;
    _bHalting = false;
    std::optional<NextLeg> next;
    if (!bStopAtNode)
    {
        next = NextLeg{_route.GetEdge(1), _route.GetNode(1)};
    }
    out.emplace_back(DriveTo{_route.GetEdge(0), _route.GetNode(0), bStopAtNode, std::move(next)});
}

/// 6.6.3: a cancelled vehicle that is bound to nodes still has one to reach.
void VehicleSession::Impl::DriveLastLeg(VehicleActions& out)
{
    const bool bTold = _bLegActive && _bLegStops;
    if (_bLastLeg && !_bEndReached && !bTold && !_corridorError.has_value())
    {
        DriveToFront(true, out);
    }
}

/// 6.11: the edge's actions end with the edge. The state that no longer shows the edge shows their ends.
void VehicleSession::Impl::LeaveEdge(std::vector<EdgeActionEnd> ends, VehicleActions& out)
{
    for (const Action& action : _route.GetEdgeActions(0))
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
        static_cast<void>(TryChangeStatus(*trackedOrNull, EActionStatus::Failed, "its edge was left", out));
    }
    _bEdgeEntered = false;
    _bLegActive = false;
    _bLegBegun = false;
    _corridorError.reset();
    _bStateDue = true;
}

void VehicleSession::Impl::PassFrontNode()
{
    _lastNodeID = _route.GetNodeID(0);
    _lastNodeSequenceID = _route.GetNodeSequenceID(0);
    _distanceSinceLastNode.reset();
    Enqueue(_route.GetNodeActions(0));
    _route.DropFront();
}

/// An action of the next edge, which may not outlive it in the state.
bool VehicleSession::Impl::HasRunningEdgeAction() const
{
    return std::ranges::any_of(_actions, [this](const ReportedAction& tracked) {
        return tracked.scope == EActionScope::Edge && tracked.sequenceID == _route.GetEdgeSequenceID(0)
            && !tracked.IsEnded();
    });
}

bool VehicleSession::Impl::IsExecuting() const
{
    return !_route.IsEmpty() || !_cancelActionIDs.empty() || _actions.CountOpen() > 0;
}

void VehicleSession::Impl::FinishOrderIfDone(VehicleActions& out)
{
    if (_bOrderRunning && !IsExecuting())
    {
        _bOrderRunning = false;
        out.emplace_back(OrderCompleted{_orderID});
    }
}

bool VehicleSession::Impl::NeedsNewBase() const
{
    const std::size_t released = _route.CountReleased();
    return released < _route.GetSize() && released <= _options.lowBaseNodes && _cancelActionIDs.empty();
}

} // namespace ACS::VDA5050
