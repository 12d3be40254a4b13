#include "robots/Vda5050RobotAdapter.hpp"

#include "robots/VehicleCompatibility.hpp"
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

} // namespace

Vda5050RobotAdapter::Vda5050RobotAdapter(
    VDA5050::MasterOptions options,
    JobMethods methods,
    RobotOutputs& outputs,
    std::chrono::milliseconds loadTimeout,
    std::shared_ptr<DriveCheck> drives,
    const std::vector<NeededMap>& maps)
    : _bFactsheetAwaited(options.bFactsheetRequested && !options.factsheet.has_value()),
      _session(std::move(options)),
      _methods(std::move(methods)),
      _drives(std::move(drives)),
      _jobCheck(std::make_shared<const VehicleJobCheck>(_methods, _session.GetFactsheetOrNull(), _bFactsheetAwaited)),
      _outputs(outputs),
      _loadTimeout(loadTimeout),
      _maps(_drives->GetMap(), maps),
      _operatorActions(InstantActionCheck(_methods, _session.GetOptions().version), outputs)
{
}

void Vda5050RobotAdapter::Handle(const Planning::RobotCommand& command, Core::Now now, AdapterActions& out)
{
    const auto sendAction = [&](std::string_view actionType) {
        _commandedActions.Send(actionType, _session, now, _sessionActions);
    };
    std::visit(
        Core::Overloaded{
            [&](const Planning::Drive& drive) { StartDrive(drive, now, out); },
            [&](const Planning::ExtendDrive& extension) { ExtendDrive(extension, now, out); },
            [&](const Planning::CancelDrive& cancel) { CancelOrder(cancel.driveID, now, out); },
            [&](const Planning::StartJob& job) { StartJob(job, now, out); },
            [&](const Planning::RecoverJob& recover) {
                DropLoadCheck(out);
                _job.Recover(recover);
                RecoverJob(now, out);
            },
            [&](const Planning::CancelJob& cancel) { CancelJob(cancel.jobID, now, out); },
            [&](const Planning::Pause&) { sendAction(VDA5050::ActionTypes::START_PAUSE); },
            [&](const Planning::Resume&) { sendAction(VDA5050::ActionTypes::STOP_PAUSE); },
            [&](const Planning::StartCharging&) { sendAction(VDA5050::ActionTypes::START_CHARGING); },
            [&](const Planning::StopCharging&) {
                sendAction(VDA5050::ActionTypes::STOP_CHARGING);
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
    if (timer == OperatorActions::TIMER)
    {
        _operatorActions.OnTimer(_session, now, out);
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
    SetOnline(false, now, out);
    Drain(now, out);
}

void Vda5050RobotAdapter::OnMqttMessage(const VDA5050::MqttMessage& message, Core::Now now, AdapterActions& out)
{
    _session.OnMessage(message, now, _sessionActions);
    Drain(now, out);
}

tl::expected<std::string, RobotActionRefusal> Vda5050RobotAdapter::RequestAction(
    const RobotActionRequest& request,
    Core::Now now,
    AdapterActions& out)
{
    tl::expected<std::string, RobotActionRefusal> sent =
        _operatorActions.Send(request, _session, now, _sessionActions, out);
    Drain(now, out);
    return sent;
}

const VDA5050::MasterSession& Vda5050RobotAdapter::GetSession() const noexcept
{
    return _session;
}

bool Vda5050RobotAdapter::IsFactsheetAwaited() const noexcept
{
    return _bFactsheetAwaited;
}

void Vda5050RobotAdapter::StartDrive(const Planning::Drive& drive, Core::Now now, AdapterActions& out)
{
    if (IsDrive(_session.GetOrderID()))
    {
        _nextDrive = drive; // only the end of the repetition shows which actions of the node are left
        return;
    }
    const bool bCorridors = _session.GetOptions().version != VDA5050::EVda5050Version::Version200;
    Core::Result<VehicleDrive> made =
        VehicleDrive::Create(drive, {_repetition.ListStartActions(drive.route), bCorridors});
    if (!made)
    {
        ReportDriveRejected(drive.driveID, Core::Describe(made.error()), out);
        return;
    }
    Core::Result<VDA5050::OrderMessage> order = made->MakeOrder(
        [this, now](const VDA5050::OrderMessage& message) { return _session.CheckOrder(message, now); });
    if (!order)
    {
        ReportDriveRejected(drive.driveID, Core::Describe(order.error()), out);
        return;
    }
    _drive = std::move(*made);
    _pendingOrder = std::move(*order);
    SendPendingOrder(now, out);
}

void Vda5050RobotAdapter::CancelOrder(std::string_view id, Core::Now now, AdapterActions& out)
{
    const std::string reason = "cancelled before it was sent to the vehicle";
    if (_nextDrive.has_value() && _nextDrive->driveID == id)
    {
        ReportDriveRejected(std::exchange(_nextDrive, std::nullopt)->driveID, reason, out);
        return;
    }
    if (IsPending(id))
    {
        RejectOrder(std::string(id), reason, out);
        return;
    }
    if (_session.GetOrderID() == id)
    {
        // If it cannot be cancelled now, its end is reported as if no cancellation had been requested.
        static_cast<void>(_session.Cancel(now, _sessionActions));
    }
}

void Vda5050RobotAdapter::SendPendingOrder(Core::Now now, AdapterActions& out)
{
    if (!_pendingOrder.has_value() || !_session.CanTakeOrder() || IsOccupied())
    {
        return;
    }
    VDA5050::OrderMessage order = *std::exchange(_pendingOrder, std::nullopt);
    const std::string orderID = order.orderID;
    const Core::Result<void> sent = _session.SendOrder(std::move(order), now, _sessionActions);
    if (!sent && IsJob(orderID))
    {
        out.emplace_back(RaiseEvent{Planning::JobRejected{_job.TakeRunning().jobID, Core::Describe(sent.error())}});
    }
    else if (!sent)
    {
        RejectOrder(orderID, Core::Describe(sent.error()), out);
    }
}

void Vda5050RobotAdapter::SendPendingUpdate(Core::Now now, AdapterActions& out)
{
    // Nothing is added to an order that is being cancelled: cancelling may fail, and the order then continues.
    const bool bCancelling = _session.GetOrderPhase() == VDA5050::EOrderPhase::Cancelling;
    if (!_drive.has_value() || IsPending(_drive->GetOrderID()) || bCancelling || !_drive->IsUpdateDue())
    {
        return;
    }
    Core::Result<VDA5050::OrderMessage> update = _drive->MakeUpdate(
        [this, now](const VDA5050::OrderMessage& message) { return _session.CheckOrder(message, now); });
    if (!update && _drive->HasNodesAhead() && update.error().path.starts_with("max"))
    {
        return; // there is room when the vehicle has passed some of them
    }
    if (!update)
    {
        AbandonDrive(Core::Describe(update.error()), now, out);
        return;
    }
    const Core::Result<void> sent = _session.SendOrderUpdate(std::move(*update), now, _sessionActions);
    if (!sent)
    {
        AbandonDrive(Core::Describe(sent.error()), now, out);
        return;
    }
    _drive->OnUpdateSent();
}

void Vda5050RobotAdapter::AbandonDrive(const std::string& reason, Core::Now now, AdapterActions& out)
{
    if (!IsDrive(_session.GetOrderID()))
    {
        RejectOrder(std::string(_drive->GetOrderID()), reason, out);
        return;
    }
    _drive->Abandon(reason);
    CancelAbandoned(now);
}

bool Vda5050RobotAdapter::IsDrive(std::string_view orderID) const
{
    return _drive.has_value() && _drive->GetOrderID() == orderID;
}

bool Vda5050RobotAdapter::IsJob(std::string_view orderID) const
{
    const Planning::StartJob* const jobOrNull = _job.GetRunningOrNull();
    return jobOrNull != nullptr && jobOrNull->commandID == orderID;
}

bool Vda5050RobotAdapter::IsPending(std::string_view orderID) const
{
    return _pendingOrder.has_value() && _pendingOrder->orderID == orderID;
}

void Vda5050RobotAdapter::RejectOrder(const std::string& orderID, const std::string& reason, AdapterActions& out)
{
    if (IsPending(orderID))
    {
        _pendingOrder.reset();
    }
    if (IsDrive(orderID))
    {
        static_cast<void>(TakeDrive());
        ReportDriveRejected(orderID, reason, out);
    }
    else if (IsJob(orderID))
    {
        out.emplace_back(RaiseEvent{Planning::JobFailed{_job.TakeRunning().jobID, reason}});
    }
}

void Vda5050RobotAdapter::Drain(Core::Now now, AdapterActions& out)
{
    // Handling an action may add more of them.
    while (!_sessionActions.empty())
    {
        const VDA5050::MasterActions actions = std::exchange(_sessionActions, {});
        for (const VDA5050::MasterAction& action : actions)
        {
            HandleAction(action, now, out);
        }
        CancelAbandoned(now);
        if (!_drive.has_value() && _nextDrive.has_value())
        {
            StartDrive(*std::exchange(_nextDrive, std::nullopt), now, out);
        }
        SendPendingUpdate(now, out);
        SendPendingOrder(now, out);
    }
}

void Vda5050RobotAdapter::HandleAction(const VDA5050::MasterAction& action, Core::Now now, AdapterActions& out)
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
            [&](const VDA5050::StateReceived&) { OnState(now, out); },
            [&](const VDA5050::PositionReceived& received) { OnPosition(received, out); },
            [&](const VDA5050::FactsheetReceived&) {
                out.emplace_back(Planning::CancelAdapterTimer{FACTSHEET_TIMER});
                OnFactsheet(now, out);
            },
            [&](const VDA5050::VehicleOnline&) {
                _foreignOrder.OnConnected();
                _maps.OnConnected();
            },
            [&](const VDA5050::InstantActionRejected& rejected) {
                _maps.TryEnd(rejected.actionID, "rejected: " + rejected.reason);
            },
            [&](const VDA5050::ActionLost& lost) { _maps.TryEnd(lost.actionID, lost.reason); },
            [&](const VDA5050::VehicleOffline&) { SetOnline(false, now, out); },
            [&](const VDA5050::VehicleBroken&) { SetOnline(false, now, out); },
            [&](const VDA5050::VehicleSilent&) { SetOnline(false, now, out); },
            [&](const VDA5050::OrderAccepted& accepted) {
                if (IsDrive(accepted.orderID))
                {
                    _drive->OnConfirmed();
                }
            },
            [&](const VDA5050::OrderRejected& rejected) { OnRejected(rejected, now, out); },
            [&](const VDA5050::OrderLost& lost) { OnLost(lost, out); },
            [&](const VDA5050::NodeReached& reached) { OnNodeReached(reached, out); },
            [&](const VDA5050::ActionChanged& changed) {
                if (_maps.TryApply(changed))
                {
                    OnState(now, out); // the next request, and its errors; the next state may be 30 s away
                }
                OnDriveAction(changed, now, out);
                OnActionChanged(changed, out);
            },
            [&](const VDA5050::OrderFinished& finished) { OnFinished(finished.orderID, now, out); },
            [&](const VDA5050::OrderCancelled& cancelled) { OnCancelled(cancelled.orderID, now, out); },
            [&](const VDA5050::CancelFailed& failed) {
                if (IsDrive(failed.orderID))
                {
                    _drive->OnCancelRefused(now);
                }
            },
            [](const auto&) {
            }},
        action);
}

void Vda5050RobotAdapter::OnNodeReached(const VDA5050::NodeReached& reached, AdapterActions& out)
{
    if (_drive.has_value() && !IsPending(_drive->GetOrderID()))
    {
        _drive->OnNodePassed(reached.nodeID);
        out.emplace_back(RaiseEvent{Planning::NodePassed{_drive->GetOrderID(), reached.nodeID}});
    }
}

void Vda5050RobotAdapter::OnRejected(const VDA5050::OrderRejected& rejected, Core::Now now, AdapterActions& out)
{
    const std::string_view separator = rejected.errorType.empty() || rejected.reason.empty() ? "" : ": ";
    const std::string reason =
        fmt::format("the vehicle rejected the order: {}{}{}", rejected.errorType, separator, rejected.reason);
    if (IsJob(rejected.orderID))
    {
        out.emplace_back(RaiseEvent{Planning::JobRejected{_job.TakeRunning().jobID, reason}});
    }
    else if (!IsDrive(rejected.orderID))
    {
        RejectOrder(rejected.orderID, reason, out);
    }
    else if (rejected.orderUpdateID == 0)
    {
        OnDriveRejected(reason, out);
    }
    else if (!_drive->GetAbandonReasonOrNull().has_value() && !_drive->TryShortenUpdate())
    {
        // The vehicle still drives along the route that it accepted before.
        AbandonDrive(reason, now, out);
    }
}

void Vda5050RobotAdapter::OnDriveRejected(const std::string& reason, AdapterActions& out)
{
    if (_drive->HasHorizon())
    {
        // Some vehicles accept no horizon, which a factsheet cannot state: the next order is the other kind.
        _bHorizonOmitted = !_bHorizonOmitted;
        _session.SetHorizonOmitted(_bHorizonOmitted);
    }
    RejectOrder(std::string(_drive->GetOrderID()), reason, out);
}

void Vda5050RobotAdapter::OnLost(const VDA5050::OrderLost& lost, AdapterActions& out)
{
    const std::string reason = "the vehicle lost the order: " + lost.reason;
    if (IsJob(lost.orderID))
    {
        InterruptJob(reason, out);
    }
    else
    {
        RejectOrder(lost.orderID, reason, out);
    }
}

void Vda5050RobotAdapter::OnCancelled(const std::string& orderID, Core::Now now, AdapterActions& out)
{
    if (IsJob(orderID) && _job.IsWithdrawn())
    {
        out.emplace_back(
            RaiseEvent{Planning::JobRejected{_job.TakeRunning().jobID, "the vehicle executes another order"}});
        return;
    }
    if (!IsDrive(orderID))
    {
        RejectOrder(orderID, "cancelled", out);
        return;
    }
    const VehicleDrive drive = TakeDrive();
    if (const std::optional<std::string>& reason = drive.GetAbandonReasonOrNull(); reason.has_value())
    {
        ReportDriveRejected(orderID, *reason, out);
        return;
    }
    if (const auto deferredOrNull = _job.TakeDeferredOrNull(); deferredOrNull.has_value())
    {
        ContinueJob(*deferredOrNull, now, out); // commanded after the cancellation of a repetition
        return;
    }
    out.emplace_back(RaiseEvent{Planning::DriveCancelled{orderID, drive.GetLastPassedNodeID()}});
}

void Vda5050RobotAdapter::OnFinished(const std::string& orderID, Core::Now now, AdapterActions& out)
{
    if (IsDrive(orderID))
    {
        OnDriveFinished(orderID, now, out);
    }
    else if (IsJob(orderID))
    {
        InterruptJob("the order ended without an end of its action", out);
    }
}

void Vda5050RobotAdapter::OnFactsheet(Core::Now now, AdapterActions& out)
{
    UpdateCompatibility(now, out); // first: the job check lets the engine give the vehicle a plan
    const bool bAwaited = std::exchange(_bFactsheetAwaited, false);
    if (bAwaited || !_jobCheck->IsFor(_session.GetFactsheetOrNull()))
    {
        UpdateJobCheck(out);
    }
    if (IsRepeating())
    {
        return;
    }
    if (const auto deferredOrNull = _job.TakeDeferredOrNull(); deferredOrNull.has_value())
    {
        ContinueJob(*deferredOrNull, now, out);
    }
}

void Vda5050RobotAdapter::UpdateJobCheck(AdapterActions& out)
{
    _jobCheck = std::make_shared<const VehicleJobCheck>(_methods, _session.GetFactsheetOrNull(), _bFactsheetAwaited);
    out.emplace_back(RaiseEvent{Planning::JobCheckChanged{_jobCheck}});
}

void Vda5050RobotAdapter::UpdateCompatibility(Core::Now now, AdapterActions& out)
{
    std::string incompatibility = FindIncompatibility(_session, *_drives, _methods, now);
    if (_incompatibility != incompatibility)
    {
        _incompatibility = incompatibility;
        out.emplace_back(RaiseEvent{Planning::CompatibilityChanged{std::move(incompatibility)}});
    }
}

} // namespace ACS::Acsd
