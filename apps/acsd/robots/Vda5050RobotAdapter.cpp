#include "robots/Vda5050RobotAdapter.hpp"

#include <acs/core/Overloaded.hpp>

#include <fmt/format.h>

#include <utility>
#include <variant>

namespace ACS::Acsd
{

namespace
{

using Planning::AdapterActions;
using Planning::RaiseEvent;

VDA5050::OrderNode MakeNode(const Planning::RouteNode& from)
{
    VDA5050::OrderNode node;
    node.nodeID = from.nodeID;
    VDA5050::NodePosition& position = node.nodePosition.emplace();
    position.x = from.x;
    position.y = from.y;
    position.theta = from.theta;
    position.mapID = from.mapID;
    position.allowedDeviationXY = from.allowedDeviation;
    return node;
}

VDA5050::OrderEdge MakeEdge(const Planning::RouteEdge& from)
{
    VDA5050::OrderEdge edge;
    edge.edgeID = from.edgeID;
    edge.startNodeID = from.startNodeID;
    edge.endNodeID = from.endNodeID;
    edge.maxSpeed = from.maxSpeed;
    edge.maxRotationSpeed = from.maxRotationSpeed;
    edge.orientation = from.orientation;
    if (from.orientationType == "GLOBAL")
    {
        edge.orientationType = VDA5050::EOrientationType::Global;
    }
    edge.bRotationAllowed = from.bRotationAllowed;
    edge.length = from.length;
    return edge;
}

} // namespace

Vda5050RobotAdapter::Vda5050RobotAdapter(
    VDA5050::MasterOptions options,
    JobMethods methods,
    RobotOutputs& outputs,
    std::chrono::milliseconds loadTimeout)
    : _bFactsheetAwaited(options.bFactsheetRequested),
      _session(std::move(options)),
      _methods(std::move(methods)),
      _jobCheck(std::make_shared<const VehicleJobCheck>(_methods, nullptr, _bFactsheetAwaited)),
      _outputs(outputs),
      _loadTimeout(loadTimeout)
{
}

void Vda5050RobotAdapter::Handle(const Planning::RobotCommand& command, Core::Now now, AdapterActions& out)
{
    std::visit(
        Core::Overloaded{
            [&](const Planning::Drive& drive) { StartDrive(drive, now, out); },
            [&](const Planning::ExtendDrive& extension) {
                if (_route.has_value() && _route->GetOrderID() == extension.driveID)
                {
                    _wantedReleased = extension.releasedCount;
                    SendPendingUpdate(now, out);
                }
            },
            [&](const Planning::CancelDrive& cancel) { CancelOrder(cancel.driveID, now, out); },
            [&](const Planning::StartJob& job) { StartJob(job, now, out); },
            [&](const Planning::RecoverJob& recover) {
                _deferredJob.reset();
                _recovery = recover;
                FindJob(now, out);
            },
            [&](const Planning::CancelJob& cancel) {
                if (_deferredJob.has_value() && cancel.jobID == _deferredJob->jobID)
                {
                    _deferredJob.reset();
                    out.emplace_back(
                        RaiseEvent{Planning::JobFailed{cancel.jobID, "cancelled before the vehicle had it"}});
                }
                else if (_job.has_value() && cancel.jobID == _job->jobID)
                {
                    CancelOrder(_job->commandID, now, out);
                }
            },
            [&](const Planning::Pause&) { SendInstantAction(VDA5050::ActionTypes::START_PAUSE, now); },
            [&](const Planning::Resume&) { SendInstantAction(VDA5050::ActionTypes::STOP_PAUSE, now); },
            [&](const Planning::StartCharging&) { SendInstantAction(VDA5050::ActionTypes::START_CHARGING, now); },
            [&](const Planning::StopCharging&) {
                SendInstantAction(VDA5050::ActionTypes::STOP_CHARGING, now);
            }},
        command);
    Drain(now, out);
}

void Vda5050RobotAdapter::OnTimer(Planning::AdapterTimerID timer, Core::Now now, AdapterActions& out)
{
    if (timer == LOAD_TIMER)
    {
        OnLoadTimeout(out);
        return;
    }
    if (timer == FACTSHEET_TIMER)
    {
        OnFactsheet(now, out);
        Drain(now, out);
        return;
    }
    _session.OnTimer(static_cast<VDA5050::EMasterTimer>(timer), now, _sessionActions);
    Drain(now, out);
}

std::optional<std::string> Vda5050RobotAdapter::GetRejectionReasonOrNull(std::string_view action) const
{
    const JobMethod* const methodOrNull = _methods.FindMethodOrNull(action);
    if (methodOrNull == nullptr || methodOrNull->vehicleAction.empty())
    {
        return fmt::format("the vehicle has no action for {}", action);
    }
    return std::nullopt;
}

std::vector<VDA5050::MqttSubscription> Vda5050RobotAdapter::GetSubscriptions() const
{
    return _session.GetSubscriptions();
}

void Vda5050RobotAdapter::OnLinkUp(Core::Now now, AdapterActions& out)
{
    _session.OnLinkUp(now, _sessionActions);
    Drain(now, out);
}

void Vda5050RobotAdapter::OnLinkDown(Core::Now now, AdapterActions& out)
{
    _session.OnLinkDown(now, _sessionActions);
    Drain(now, out);
    SetOnline(false, out);
}

void Vda5050RobotAdapter::OnMqttMessage(const VDA5050::MqttMessage& message, Core::Now now, AdapterActions& out)
{
    _session.OnMessage(message, now, _sessionActions);
    Drain(now, out);
}

const VDA5050::MasterSession& Vda5050RobotAdapter::GetSession() const noexcept
{
    return _session;
}

void Vda5050RobotAdapter::StartDrive(const Planning::Drive& drive, Core::Now now, AdapterActions& out)
{
    std::vector<VDA5050::OrderNode> nodes;
    std::vector<VDA5050::OrderEdge> edges;
    for (const Planning::RouteNode& node : drive.route.nodes)
    {
        nodes.push_back(MakeNode(node));
    }
    for (const Planning::RouteEdge& edge : drive.route.edges)
    {
        edges.push_back(MakeEdge(edge));
    }
    Core::Result<VDA5050::OrderBuilder> builder =
        VDA5050::OrderBuilder::Create(drive.driveID, std::move(nodes), std::move(edges));
    if (!builder)
    {
        out.emplace_back(RaiseEvent{Planning::DriveRejected{drive.driveID, Core::Describe(builder.error())}});
        return;
    }
    Core::Result<VDA5050::OrderMessage> order = builder->MakeOrder(drive.releasedCount);
    if (!order)
    {
        out.emplace_back(RaiseEvent{Planning::DriveRejected{drive.driveID, Core::Describe(order.error())}});
        return;
    }
    _route = std::move(*builder);
    _wantedReleased = drive.releasedCount;
    _lastPassedNodeID.clear();
    _bUpdateUnderWay = true;
    _lastUpdate.reset();
    _lossReason.reset();
    _pendingOrder = PendingOrder{std::move(*order)};
    SendPendingOrder(now, out);
}

void Vda5050RobotAdapter::CancelOrder(std::string_view id, Core::Now now, AdapterActions& out)
{
    if (_pendingOrder.has_value() && _pendingOrder->order.orderID == id)
    {
        // The vehicle never saw it.
        const std::string orderID = std::exchange(_pendingOrder, std::nullopt)->order.orderID;
        RefuseOrder(orderID, "cancelled before the vehicle had it", out);
        return;
    }
    if (_session.GetOrderID() == id)
    {
        // Where it cannot be cancelled now, its end is told as if it had not been asked for.
        static_cast<void>(_session.Cancel(now, _sessionActions));
    }
}

void Vda5050RobotAdapter::SendInstantAction(std::string_view actionType, Core::Now now)
{
    VDA5050::Action action;
    action.actionType = actionType;
    // A vehicle that is away shows by its state that it did not pause; the engine watches that with its own time.
    static_cast<void>(_session.SendInstantAction(std::move(action), now, _sessionActions));
}

void Vda5050RobotAdapter::SendPendingOrder(Core::Now now, AdapterActions& out)
{
    if (!_pendingOrder.has_value() || !_session.CanTakeOrder() || IsOccupied(*_session.GetStateOrNull()))
    {
        return;
    }
    VDA5050::OrderMessage order = std::exchange(_pendingOrder, std::nullopt)->order;
    const std::string orderID = order.orderID;
    const Core::Result<void> sent = _session.SendOrder(std::move(order), now, _sessionActions);
    if (!sent)
    {
        RefuseOrder(orderID, Core::Describe(sent.error()), out);
    }
}

void Vda5050RobotAdapter::SendPendingUpdate(Core::Now now, AdapterActions& out)
{
    // While it is being cancelled nothing is added to it: that may fail, and then it goes on.
    const bool bCancelling = _session.GetOrderPhase() == VDA5050::EOrderPhase::Cancelling;
    if (!_route.has_value() || _bUpdateUnderWay || _lossReason.has_value() || bCancelling
        || _wantedReleased <= _route->GetReleasedNodes())
    {
        return;
    }
    Core::Result<VDA5050::OrderMessage> update = _route->MakeUpdate(_wantedReleased);
    if (!update)
    {
        GiveDriveUp(Core::Describe(update.error()), now, out);
        return;
    }
    _lastUpdate = *update;
    const Core::Result<void> sent = _session.SendOrderUpdate(std::move(*update), now, _sessionActions);
    if (!sent)
    {
        GiveDriveUp(Core::Describe(sent.error()), now, out);
        return;
    }
    _bUpdateUnderWay = true;
}

void Vda5050RobotAdapter::GiveDriveUp(const std::string& reason, Core::Now now, AdapterActions& out)
{
    const std::string orderID = _route->GetOrderID();
    const bool bHeld = _session.GetOrderID() == orderID && _session.Cancel(now, _sessionActions).has_value();
    if (bHeld)
    {
        _lossReason = reason;
        return;
    }
    RefuseOrder(orderID, reason, out);
}

void Vda5050RobotAdapter::RefuseOrder(const std::string& orderID, const std::string& reason, AdapterActions& out)
{
    if (_route.has_value() && _route->GetOrderID() == orderID)
    {
        _route.reset();
        _lossReason.reset();
        out.emplace_back(RaiseEvent{Planning::DriveRejected{orderID, reason}});
    }
    else if (_job.has_value() && _job->commandID == orderID)
    {
        out.emplace_back(RaiseEvent{Planning::JobFailed{std::exchange(_job, std::nullopt)->jobID, reason}});
    }
}

void Vda5050RobotAdapter::Drain(Core::Now now, AdapterActions& out)
{
    // What is told may make the session say more, so the list is taken before it is walked.
    while (!_sessionActions.empty())
    {
        const VDA5050::MasterActions actions = std::exchange(_sessionActions, {});
        for (const VDA5050::MasterAction& action : actions)
        {
            Take(action, now, out);
        }
        SendPendingUpdate(now, out);
        SendPendingOrder(now, out);
    }
}

void Vda5050RobotAdapter::Take(const VDA5050::MasterAction& action, Core::Now now, AdapterActions& out)
{
    std::visit(
        Core::Overloaded{
            [&](const VDA5050::PublishMessage& publish) { _outputs.messages.push_back(publish.message); },
            [&](const VDA5050::StartMasterTimer& start) {
                out.emplace_back(
                    Planning::StartAdapterTimer{static_cast<Planning::AdapterTimerID>(start.timer), start.delay});
            },
            [&](const VDA5050::CancelMasterTimer& cancel) {
                out.emplace_back(Planning::CancelAdapterTimer{static_cast<Planning::AdapterTimerID>(cancel.timer)});
            },
            [&](const VDA5050::StateReceived&) { TakeState(now, out); },
            [&](const VDA5050::PositionReceived& received) { TakePosition(received, out); },
            [&](const VDA5050::FactsheetReceived&) {
                out.emplace_back(Planning::CancelAdapterTimer{FACTSHEET_TIMER});
                OnFactsheet(now, out);
            },
            [&](const VDA5050::VehicleOnline&) { _foreignOrderID.clear(); },
            [&](const VDA5050::VehicleOffline&) { SetOnline(false, out); },
            [&](const VDA5050::VehicleBroken&) { SetOnline(false, out); },
            [&](const VDA5050::VehicleSilent&) { SetOnline(false, out); },
            [&](const VDA5050::OrderAccepted&) {
                _bUpdateUnderWay = false;
                _lastUpdate.reset();
            },
            [&](const VDA5050::OrderRejected& rejected) { TakeRejected(rejected, now, out); },
            [&](const VDA5050::OrderLost& lost) {
                RefuseOrder(lost.orderID, "the vehicle lost the order: " + lost.reason, out);
            },
            [&](const VDA5050::NodeReached& reached) {
                if (_route.has_value())
                {
                    _lastPassedNodeID = reached.nodeID;
                    out.emplace_back(RaiseEvent{Planning::NodePassed{_route->GetOrderID(), reached.nodeID}});
                }
            },
            [&](const VDA5050::ActionChanged& changed) { TakeAction(changed, out); },
            [&](const VDA5050::OrderFinished& finished) { TakeFinished(finished.orderID, out); },
            [&](const VDA5050::OrderCancelled& cancelled) { TakeCancelled(cancelled.orderID, out); },
            [&](const VDA5050::CancelFailed&) { TakeCancelFailed(now, out); },
            [](const auto&) {
            }},
        action);
}

void Vda5050RobotAdapter::TakeRejected(const VDA5050::OrderRejected& rejected, Core::Now now, AdapterActions& out)
{
    const std::string reason = "the vehicle refuses the order: " + rejected.reason;
    const bool bOfDrive = _route.has_value() && _route->GetOrderID() == rejected.orderID;
    if (!bOfDrive || rejected.orderUpdateID == 0)
    {
        RefuseOrder(rejected.orderID, reason, out);
    }
    else if (!_lossReason.has_value())
    {
        // An update: the vehicle still drives along what it accepted before.
        GiveDriveUp(reason, now, out);
    }
}

void Vda5050RobotAdapter::TakeCancelled(const std::string& orderID, AdapterActions& out)
{
    if (const std::optional<std::string> reason = std::exchange(_lossReason, std::nullopt))
    {
        RefuseOrder(orderID, *reason, out);
        return;
    }
    if (_route.has_value() && _route->GetOrderID() == orderID)
    {
        _route.reset();
        out.emplace_back(RaiseEvent{Planning::DriveCancelled{orderID, _lastPassedNodeID}});
    }
    RefuseOrder(orderID, "cancelled", out);
}

/// The vehicle goes on. What was under way to it when the cancelling began was withdrawn and is sent again.
void Vda5050RobotAdapter::TakeCancelFailed(Core::Now now, AdapterActions& out)
{
    const std::optional<std::string> reason = std::exchange(_lossReason, std::nullopt);
    if (!_route.has_value())
    {
        return;
    }
    if (reason.has_value())
    {
        RefuseOrder(_route->GetOrderID(), *reason, out);
        return;
    }
    if (!_lastUpdate.has_value())
    {
        return;
    }
    const Core::Result<void> sent = _session.SendOrderUpdate(*_lastUpdate, now, _sessionActions);
    if (!sent)
    {
        RefuseOrder(_route->GetOrderID(), Core::Describe(sent.error()), out);
    }
}

void Vda5050RobotAdapter::TakeFinished(const std::string& orderID, AdapterActions& out)
{
    if (_route.has_value() && _route->GetOrderID() == orderID)
    {
        _route.reset();
        _lossReason.reset();
        out.emplace_back(RaiseEvent{Planning::Arrived{orderID}});
    }
    RefuseOrder(orderID, "the order ended without a word of the action", out);
}

void Vda5050RobotAdapter::SetOnline(bool bOnline, AdapterActions& out)
{
    if (std::exchange(_bOnline, bOnline) == bOnline)
    {
        return;
    }
    if (bOnline)
    {
        UpdateJobCheck(out); // before the engine gives it a plan
    }
    if (_bFactsheetAwaited && bOnline)
    {
        out.emplace_back(Planning::StartAdapterTimer{FACTSHEET_TIMER, FACTSHEET_TIMEOUT});
    }
    else if (_bFactsheetAwaited)
    {
        out.emplace_back(Planning::CancelAdapterTimer{FACTSHEET_TIMER});
    }
    out.emplace_back(RaiseEvent{Planning::LinkChanged{bOnline}});
}

void Vda5050RobotAdapter::OnFactsheet(Core::Now now, AdapterActions& out)
{
    const bool bAwaited = std::exchange(_bFactsheetAwaited, false);
    if (bAwaited || !_jobCheck->IsFor(_session.GetFactsheetOrNull()))
    {
        UpdateJobCheck(out);
    }
    if (_deferredJob.has_value())
    {
        StartJob(*std::exchange(_deferredJob, std::nullopt), now, out);
    }
}

void Vda5050RobotAdapter::UpdateJobCheck(AdapterActions& out)
{
    _jobCheck = std::make_shared<const VehicleJobCheck>(_methods, _session.GetFactsheetOrNull(), _bFactsheetAwaited);
    out.emplace_back(RaiseEvent{Planning::JobCheckChanged{_jobCheck}});
}

} // namespace ACS::Acsd
