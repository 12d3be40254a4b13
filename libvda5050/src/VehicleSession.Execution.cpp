#include "OrderErrors.hpp"
#include <acs/vda5050/VehicleSession.hpp>

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

bool HasBlocking(const std::vector<Action>& actions)
{
    return std::ranges::any_of(actions, IsBlockingDriving);
}

} // namespace

OrderContext VehicleSession::MakeContext() const
{
    OrderContext context;
    context.heldOrderID = _orderID;
    context.heldOrderUpdateID = _orderUpdateID;
    context.bExecuting = IsExecuting();
    context.bCancelling = !_cancelActionIDs.empty();
    context.operatingMode = _operatingMode;
    context.decisionNodeID = _lastNodeID;
    context.decisionSequenceID = _lastNodeSequenceID;
    const auto lastReleased =
        std::find_if(_nodes.rbegin(), _nodes.rend(), [](const OrderNode& node) { return node.bReleased; });
    if (lastReleased != _nodes.rend())
    {
        context.decisionNodeID = lastReleased->nodeID;
        context.decisionSequenceID = lastReleased->sequenceID;
    }
    context.lastNodeID = _lastNodeID;
    context.position = _position;
    context.defaultDeviationXY = _options.defaultDeviationXY;
    context.mapIDs = _options.mapIDs;
    context.factsheet = &_options.factsheet;
    return context;
}

void VehicleSession::TakeNewOrder(OrderMessage order, VehicleActions& out)
{
    std::erase_if(_actions, [](const TrackedAction& tracked) {
        return tracked.scope != EActionScope::Instant || IsTerminal(tracked.machine.GetStatus());
    });
    _sessionErrors.clear();
    _actionQueue.clear();
    _nodes.clear();
    _edges.clear();
    _bEdgeEntered = false;
    _bOrderRunning = true;
    _orderID = order.orderID;
    _orderUpdateID = order.orderUpdateID;
    _zoneSetID = order.zoneSetID;
    _bStateDue = true;
    out.emplace_back(OrderTaken{_orderID, _orderUpdateID, false});
    // The first node is where the vehicle stands: reached with the acceptance, never in nodeStates.
    const OrderNode first = order.nodes.front();
    _lastNodeID = first.nodeID;
    _lastNodeSequenceID = first.sequenceID;
    AddActions(first.actions, EActionScope::Node, first.nodeID, first.sequenceID);
    AppendElements(std::move(order));
    Enqueue(first.actions);
    Advance(out);
}

void VehicleSession::TakeUpdate(OrderMessage order, VehicleActions& out)
{
    _sessionErrors.clear();
    DropHorizon();
    _bOrderRunning = true;
    _orderUpdateID = order.orderUpdateID;
    if (!order.zoneSetID.empty())
    {
        _zoneSetID = order.zoneSetID;
    }
    _bStateDue = true;
    out.emplace_back(OrderTaken{_orderID, _orderUpdateID, true});
    // The stitching node keeps the contents that it came with first.
    AppendElements(std::move(order));
    Advance(out);
}

/// All but the first node, which the vehicle knows already.
void VehicleSession::AppendElements(OrderMessage order)
{
    for (std::size_t index = 0; index < order.edges.size(); ++index)
    {
        OrderEdge& edge = order.edges[index];
        OrderNode& node = order.nodes[index + 1];
        AddActions(edge.actions, EActionScope::Edge, edge.edgeID, edge.sequenceID);
        AddActions(node.actions, EActionScope::Node, node.nodeID, node.sequenceID);
        _edges.push_back(std::move(edge));
        _nodes.push_back(std::move(node));
    }
}

void VehicleSession::DropHorizon()
{
    const auto firstUnreleased = std::ranges::find(_nodes, false, &OrderNode::bReleased);
    const auto kept = std::distance(_nodes.begin(), firstUnreleased);
    std::vector<std::uint32_t> dropped;
    for (auto node = firstUnreleased; node != _nodes.end(); ++node)
    {
        dropped.push_back(node->sequenceID);
        dropped.push_back(node->sequenceID - 1); // its edge
    }
    _nodes.erase(firstUnreleased, _nodes.end());
    _edges.erase(_edges.begin() + kept, _edges.end());
    // Gone from the report: an id that comes back with the update would else have to leave a terminal status.
    std::erase_if(_actions, [&dropped](const TrackedAction& tracked) {
        return tracked.scope != EActionScope::Instant
            && std::ranges::find(dropped, tracked.sequenceID) != dropped.end();
    });
}

void VehicleSession::AddActions(
    const std::vector<Action>& actions,
    EActionScope scope,
    const std::string& elementID,
    std::uint32_t sequenceID)
{
    for (const Action& action : actions)
    {
        ActionState state{action.actionID, action.actionType, action.actionDescription, EActionStatus::Waiting, {}};
        _actions.push_back(TrackedAction{action, ActionMachine(std::move(state)), scope, elementID, sequenceID, false});
    }
}

void VehicleSession::Enqueue(const std::vector<Action>& actions)
{
    std::ranges::transform(actions, std::back_inserter(_actionQueue), &Action::actionID);
}

VehicleSession::TrackedAction* VehicleSession::FindActionOrNull(std::string_view actionID)
{
    const auto found = std::ranges::find_if(_actions, [actionID](const TrackedAction& tracked) {
        return tracked.action.actionID == actionID;
    });
    return found == _actions.end() ? nullptr : &*found;
}

void VehicleSession::SetStatus(std::string_view actionID, EActionStatus status, const std::string& result)
{
    TrackedAction* trackedOrNull = FindActionOrNull(actionID);
    if (trackedOrNull != nullptr && trackedOrNull->machine.TrySet(status, result))
    {
        _bStateDue = true;
    }
}

void VehicleSession::Start(TrackedAction& tracked, VehicleActions& out)
{
    tracked.bStarted = true;
    out.emplace_back(StartAction{tracked.action, tracked.scope, tracked.elementID, tracked.sequenceID});
}

bool VehicleSession::CanMoveByItself() const
{
    return _operatingMode == EOperatingMode::Automatic || _operatingMode == EOperatingMode::SemiAutomatic;
}

void VehicleSession::Advance(VehicleActions& out)
{
    if (_bPaused || !_cancelActionIDs.empty() || !CanMoveByItself())
    {
        return;
    }
    StartQueuedActions(out);
    DriveOn(out);
    FinishOrderIfDone(out);
}

/// 6.11: None and Soft run beside each other; Hard waits for all of them and holds up all that follow.
void VehicleSession::StartQueuedActions(VehicleActions& out)
{
    while (!_actionQueue.empty())
    {
        TrackedAction* nextOrNull = FindActionOrNull(_actionQueue.front());
        if (nextOrNull == nullptr || nextOrNull->bStarted || nextOrNull->machine.GetStatus() != EActionStatus::Waiting)
        {
            _actionQueue.pop_front();
            continue;
        }
        const bool bHard = nextOrNull->action.blockingType == EBlockingType::Hard;
        const bool bHeldUp = std::ranges::any_of(_actions, [bHard](const TrackedAction& other) {
            const bool bRuns =
                other.scope != EActionScope::Instant && other.bStarted && !IsTerminal(other.machine.GetStatus());
            return bRuns && (bHard || other.action.blockingType == EBlockingType::Hard);
        });
        if (bHeldUp)
        {
            return;
        }
        _actionQueue.pop_front();
        Start(*nextOrNull, out);
    }
}

bool VehicleSession::CanDrive() const
{
    return _actionQueue.empty() && std::ranges::none_of(_actions, [](const TrackedAction& tracked) {
               return tracked.scope != EActionScope::Instant && tracked.bStarted
                   && !IsTerminal(tracked.machine.GetStatus()) && IsBlockingDriving(tracked.action);
           });
}

bool VehicleSession::NeedsStopAtFront() const
{
    return _nodes.size() < 2 || !_nodes[1].bReleased || HasBlocking(_nodes[0].actions)
        || HasBlocking(_edges[1].actions);
}

void VehicleSession::DriveOn(VehicleActions& out)
{
    if (_nodes.empty() || !_nodes.front().bReleased)
    {
        return;
    }
    if (_bLegActive)
    {
        if (NeedsStopAtFront() != _bLegStops)
        {
            _bLegStops = !_bLegStops;
            out.emplace_back(DriveTo{_edges.front(), _nodes.front(), _bLegStops});
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
        Enqueue(_edges.front().actions);
        StartQueuedActions(out);
        if (!CanDrive())
        {
            return;
        }
    }
    _bLegActive = true;
    _bLegStops = NeedsStopAtFront();
    out.emplace_back(DriveTo{_edges.front(), _nodes.front(), _bLegStops});
}

/// 6.10.2: what one traversal changes belongs to one state.
void VehicleSession::ReachFront(VehicleActions& out)
{
    const OrderNode node = std::move(_nodes.front());
    _nodes.pop_front();
    if (!_edges.empty())
    {
        const std::uint32_t edgeSequenceID = _edges.front().sequenceID;
        _edges.pop_front();
        for (TrackedAction& tracked : _actions)
        {
            const bool bOfEdge = tracked.scope == EActionScope::Edge && tracked.sequenceID == edgeSequenceID;
            if (!bOfEdge || IsTerminal(tracked.machine.GetStatus()))
            {
                continue;
            }
            if (tracked.bStarted)
            {
                out.emplace_back(StopAction{tracked.action.actionID, true});
            }
            else
            {
                static_cast<void>(tracked.machine.TrySet(EActionStatus::Failed, "its edge was left"));
            }
        }
    }
    _lastNodeID = node.nodeID;
    _lastNodeSequenceID = node.sequenceID;
    _distanceSinceLastNode.reset();
    _bEdgeEntered = false;
    _bLegActive = false;
    _bStateDue = true;
    Enqueue(node.actions);
}

bool VehicleSession::IsExecuting() const
{
    return !_nodes.empty() || !_cancelActionIDs.empty()
        || std::ranges::any_of(_actions, [](const TrackedAction& tracked) {
               return tracked.scope != EActionScope::Instant && !IsTerminal(tracked.machine.GetStatus());
           });
}

void VehicleSession::FinishOrderIfDone(VehicleActions& out)
{
    if (_bOrderRunning && !IsExecuting())
    {
        _bOrderRunning = false;
        out.emplace_back(OrderCompleted{_orderID});
    }
}

bool VehicleSession::NeedsNewBase() const
{
    const auto released = static_cast<std::size_t>(std::ranges::count(_nodes, true, &OrderNode::bReleased));
    return released < _nodes.size() && released <= _options.lowBaseNodes && _cancelActionIDs.empty();
}

void VehicleSession::StopMoving(VehicleActions& out)
{
    if (_bLegActive)
    {
        _bLegActive = false;
        out.emplace_back(StopDriving{});
    }
}

void VehicleSession::StartPause(const Action& action, VehicleActions& out)
{
    AddInstantAction(action, EActionStatus::Running);
    _pauseActionIDs.push_back(action.actionID);
    if (_bPaused)
    {
        return;
    }
    _bPaused = true;
    StopMoving(out);
    for (const TrackedAction& tracked : _actions)
    {
        const bool bRuns = tracked.scope != EActionScope::Instant && tracked.bStarted;
        if (bRuns && !IsTerminal(tracked.machine.GetStatus()))
        {
            out.emplace_back(PauseAction{tracked.action.actionID});
        }
    }
}

void VehicleSession::FinishPauseIfStanding()
{
    if (_bDriving)
    {
        return;
    }
    for (const std::string& actionID : std::exchange(_pauseActionIDs, {}))
    {
        SetStatus(actionID, EActionStatus::Finished);
    }
}

void VehicleSession::StopPause(const Action& action, VehicleActions& out)
{
    for (const std::string& actionID : std::exchange(_pauseActionIDs, {}))
    {
        SetStatus(actionID, EActionStatus::Failed, "stopPause came first");
    }
    _bPaused = false;
    AddInstantAction(action, EActionStatus::Finished);
    for (const TrackedAction& tracked : _actions)
    {
        if (tracked.machine.GetStatus() == EActionStatus::Paused)
        {
            out.emplace_back(ResumeAction{tracked.action.actionID});
        }
    }
}

void VehicleSession::StartCancel(const Action& action, const Header& header, VehicleActions& out)
{
    if (!IsExecuting())
    {
        FailInstantAction(action, header, ErrorTypes::NO_ORDER_TO_CANCEL, "there is no order to cancel");
        return;
    }
    const bool bFirst = _cancelActionIDs.empty();
    AddInstantAction(action, EActionStatus::Running);
    _cancelActionIDs.push_back(action.actionID);
    if (!bFirst)
    {
        return;
    }
    StopOrderActions(out);
    if (_options.bStopsBetweenNodes || !_bLegActive)
    {
        StopMoving(out);
        return;
    }
    // Bound to nodes: drives on to the next one, whose actions have failed already.
    if (!_bLegStops)
    {
        _bLegStops = true;
        out.emplace_back(DriveTo{_edges.front(), _nodes.front(), true});
    }
    _nodes.erase(_nodes.begin() + 1, _nodes.end());
    _nodes.front().actions.clear();
    _edges.clear();
}

/// Those that wait have failed; those that run are told to stop.
void VehicleSession::StopOrderActions(VehicleActions& out)
{
    _actionQueue.clear();
    for (TrackedAction& tracked : _actions)
    {
        const EActionStatus status = tracked.machine.GetStatus();
        if (tracked.scope == EActionScope::Instant || IsTerminal(status))
        {
            continue;
        }
        if (tracked.bStarted)
        {
            out.emplace_back(StopAction{tracked.action.actionID, false});
        }
        if (!tracked.bStarted || status == EActionStatus::Paused)
        {
            static_cast<void>(tracked.machine.TrySet(EActionStatus::Failed, "the order was cancelled"));
        }
    }
}

void VehicleSession::FinishCancelIfStanding(VehicleActions& out)
{
    const bool bRuns = std::ranges::any_of(_actions, [](const TrackedAction& tracked) {
        return tracked.scope != EActionScope::Instant && !IsTerminal(tracked.machine.GetStatus());
    });
    if (!_cancelActionIDs.empty() && !_bDriving && !_bLegActive && !bRuns)
    {
        ClearOrder(out);
    }
}

void VehicleSession::ClearOrder(VehicleActions& out)
{
    _nodes.clear();
    _edges.clear();
    _actionQueue.clear();
    _bEdgeEntered = false;
    _bLegActive = false;
    _bOrderRunning = false;
    _bStateDue = true;
    for (const std::string& actionID : std::exchange(_cancelActionIDs, {}))
    {
        SetStatus(actionID, EActionStatus::Finished);
    }
    out.emplace_back(OrderCleared{_orderID});
}

} // namespace ACS::VDA5050
