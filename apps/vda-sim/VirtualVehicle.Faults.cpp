#include "vda-sim/VirtualVehicle.hpp"

#include "vda-sim/VehicleFactsheet.hpp"
#include <acs/vda5050/Vda5050Codec.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

namespace ACS::VdaSim
{
namespace
{

using VDA5050::EErrorLevel;
using VDA5050::VehicleError;

// errorTypes that the standard does not define.
constexpr std::string_view ERROR_BLOCKED = "blockedByObstacle";
constexpr std::string_view ERROR_LOST = "localizationError";
constexpr std::string_view ERROR_EMERGENCY_STOP = "emergencyStop";
constexpr std::string_view ERROR_BATTERY_LOW = "batteryLow";

VehicleError MakeError(std::string_view type, EErrorLevel level, std::string description)
{
    VehicleError error;
    error.errorType = std::string(type);
    error.errorLevel = level;
    error.errorDescription = std::move(description);
    return error;
}

} // namespace

bool VirtualVehicle::TryInject(const Fault& fault, Core::Now now, VirtualActions& out)
{
    PassTime(now, out);
    const bool bAdded = _faults.TryAdd(fault, now.steady);
    if (_faults.WasOnline())
    {
        Settle(now, out);
    }
    return bAdded;
}

std::size_t VirtualVehicle::EndFaults(std::optional<EFaultKind> kindOrNull, Core::Now now, VirtualActions& out)
{
    PassTime(now, out);
    const std::size_t ended = _faults.End(kindOrNull, "ended by command");
    Settle(now, out);
    return ended;
}

std::size_t VirtualVehicle::Trigger(Core::Now now, VirtualActions& out)
{
    PassTime(now, out);
    const std::size_t count = _actionRunner.Trigger();
    Settle(now, out);
    return count;
}

void VirtualVehicle::ApplyFaults(Core::Now now, VirtualActions& out)
{
    // A fault may use up another one.
    for (FaultChanges changes = _faults.TakeChanges(); !changes.empty(); changes = _faults.TakeChanges())
    {
        for (const FaultChange& change : changes)
        {
            ApplyFault(change, now, out);
        }
        ReportCondition(now);
        Pump(now, out);
    }
}

void VirtualVehicle::ApplyFault(const FaultChange& change, Core::Now now, VirtualActions& out)
{
    const Fault& fault = change.fault;
    if (change.bBegun)
    {
        _logger.Info("fault begins", {{"fault", fault.text}});
    }
    else
    {
        _logger.Info("fault ended", {{"fault", fault.text}, {"reason", change.reason}});
    }
    if (fault.kind == EFaultKind::Battery && change.bBegun)
    {
        _battery.SetCharge(fault.charge);
        ReportBattery(now);
    }
    if (fault.kind == EFaultKind::Drop && change.bBegun)
    {
        _session.OnLinkDown(now, _sessionActions);
        _incoming.Clear();
        _outgoing.Clear();
        Pump(now, out);
        out.emplace_back(CutLink{fault.bWill});
    }
    if (fault.kind == EFaultKind::Drop && !change.bBegun && !_faults.GetBoard().IsActive(EFaultKind::Drop))
    {
        out.emplace_back(OpenLink{});
    }
}

/// Updates all that depends on the faults: the reported state and the brake.
void VirtualVehicle::ReportCondition(Core::Now now)
{
    *_lost = _faults.GetBoard().IsActive(EFaultKind::Lost);
    ReportPosition();
    const Fault* const mode = _faults.GetBoard().FindOrNull(EFaultKind::Mode);
    _session.OnOperatingMode(mode != nullptr ? mode->mode : VDA5050::EOperatingMode::Automatic, now, _sessionActions);
    UpdateBrake(now);
    const Fault* const stop = _faults.GetBoard().FindOrNull(EFaultKind::EmergencyStop);
    VDA5050::SafetyState safety;
    safety.emergencyStop = stop != nullptr ? stop->emergencyStop : VDA5050::EEmergencyStop::None;
    safety.bFieldViolation = _drive.IsBlocked(_faults.GetBoard());
    _session.OnSafetyState(safety, now, _sessionActions);
    _session.OnErrors(MakeErrors(), now, _sessionActions);
}

void VirtualVehicle::UpdateBrake(Core::Now now)
{
    _drive.UpdateBrake(_faults.GetBoard());
    ReportDriving(_drive.IsMoving(), now);
}

std::vector<VehicleError> VirtualVehicle::MakeErrors() const
{
    std::vector<VehicleError> errors;
    if (_drive.IsBlocked(_faults.GetBoard()))
    {
        VehicleError& error = errors.emplace_back(MakeError(
            ERROR_BLOCKED,
            EErrorLevel::Warning,
            "an obstacle blocks the vehicle; it continues when the obstacle is removed"));
        if (const VDA5050::DriveTo* const leg = _drive.GetLegOrNull(); leg != nullptr)
        {
            error.errorReferences.push_back({"edgeId", leg->edge.edgeID});
            error.errorReferences.push_back({"nodeId", leg->node.nodeID});
        }
    }
    const Fault* const stuck = _faults.GetBoard().FindOrNull(EFaultKind::Stuck);
    if (stuck != nullptr && !stuck->errorType.empty())
    {
        errors.push_back(MakeError(stuck->errorType, stuck->errorLevel, "the vehicle cannot move"));
    }
    if (_faults.GetBoard().IsActive(EFaultKind::Lost))
    {
        errors.push_back(MakeError(ERROR_LOST, EErrorLevel::Fatal, "the vehicle has lost its position"));
    }
    if (_faults.GetBoard().IsActive(EFaultKind::EmergencyStop))
    {
        errors.push_back(MakeError(ERROR_EMERGENCY_STOP, EErrorLevel::Fatal, "the emergency stop is pressed"));
    }
    if (_battery.IsLow())
    {
        errors.push_back(MakeError(
            ERROR_BATTERY_LOW,
            EErrorLevel::Warning,
            fmt::format("the charge is below {} %", Battery::LOW_CHARGE)));
    }
    std::ranges::copy(_orderErrors, std::back_inserter(errors));
    return errors;
}

/// Without a type no error is reported: the state of the action suffices.
void VirtualVehicle::AddOrderError(VehicleError error, Core::Now now)
{
    if (error.errorType.empty())
    {
        return;
    }
    constexpr std::size_t MAX_ORDER_ERRORS = 16;
    if (_orderErrors.size() >= MAX_ORDER_ERRORS)
    {
        _orderErrors.erase(_orderErrors.begin());
    }
    _orderErrors.push_back(std::move(error));
    _session.OnErrors(MakeErrors(), now, _sessionActions);
}

bool VirtualVehicle::TryRefuse(const VDA5050::MqttMessage& message, Core::Now now, VirtualActions& out)
{
    const Fault* const refusal = _faults.GetBoard().FindOrNull(EFaultKind::Refuse);
    const Core::Result<VDA5050::ParsedTopic> topic = VDA5050::ParseTopic(message.topic);
    // The session ignores a retained order.
    if (refusal == nullptr || message.bRetained || !topic.has_value() || topic->topic != VDA5050::ETopic::Order)
    {
        return false;
    }
    VDA5050::Vda5050Codec codec;
    const Core::Result<VDA5050::MessageIdentity> identity = codec.DecodeIdentity(message.payload);
    if (!identity.has_value() || identity->orderID.empty()
        || identity->header.manufacturer != _options.address.manufacturer
        || identity->header.serialNumber != _options.address.serialNumber)
    {
        return false; // the session handles it
    }
    VehicleError error = MakeError(
        refusal->errorType.empty() ? VDA5050::ErrorTypes::ORDER_ERROR : refusal->errorType,
        refusal->errorLevel,
        "the order is refused by an injected fault");
    error.errorReferences = {
        {"topic", "order"},
        {"headerId", std::to_string(identity->header.headerID)},
        {"orderId", identity->orderID},
        {"orderUpdateId", std::to_string(identity->orderUpdateID.value_or(0))}};
    LogRefusal({identity->orderID, identity->orderUpdateID.value_or(0), error.errorType, "fault"}, now);
    AddOrderError(std::move(error), now);
    _faults.Use(*refusal);
    Pump(now, out);
    return true;
}

/// Uses up a fault of the action and returns its error.
std::optional<VehicleError> VirtualVehicle::UseActionFaultOrNull(const VDA5050::Action& action, bool bAtStart)
{
    const Fault* const fault = _faults.GetBoard().FindOrNull(EFaultKind::ActionFails, [&](const Fault& candidate) {
        return candidate.bAtStart == bAtStart
            && (candidate.actionType.empty() || candidate.actionType == action.actionType)
            && (candidate.actionID.empty() || candidate.actionID == action.actionID);
    });
    if (fault == nullptr)
    {
        return std::nullopt;
    }
    VehicleError error = MakeError(
        fault->errorType,
        fault->errorLevel,
        fmt::format("{} failed by an injected fault", action.actionType));
    error.errorReferences = {{"actionId", action.actionID}};
    _faults.Use(*fault);
    return error;
}

/// The session accepts the message all the same, and does not report it.
void VirtualVehicle::LogTolerated(const VDA5050::MqttMessage& message, Core::Now now)
{
    const Core::Result<VDA5050::ParsedTopic> topic = VDA5050::ParseTopic(message.topic);
    if (message.bRetained || !topic.has_value())
    {
        return;
    }
    VDA5050::Vda5050Codec codec;
    const bool bOrder =
        topic->topic == VDA5050::ETopic::Order && codec.Decode<VDA5050::OrderMessage>(message.payload).has_value();
    const bool bInstant = topic->topic == VDA5050::ETopic::InstantActions
        && codec.Decode<VDA5050::InstantActionsMessage>(message.payload).has_value();
    const VDA5050::DecodeTolerance& tolerated = codec.GetTolerance();
    if ((bOrder || bInstant) && tolerated != VDA5050::DecodeTolerance{})
    {
        LogWarning(
            now,
            "a message deviates from the standard and is accepted",
            {{"topic", VDA5050::GetTopicName(topic->topic)},
             {"unknownMembers", std::to_string(tolerated.unknownMembers)},
             {"nullMembers", std::to_string(tolerated.nullOptionals)},
             {"enumsInWrongCase", std::to_string(tolerated.lenientWords)}});
    }
}

void VirtualVehicle::Deliver(const VDA5050::MqttMessage& message, Core::Now now, VirtualActions& out)
{
    if (!TryRefuse(message, now, out))
    {
        if (message.topic.ends_with(VDA5050::GetTopicName(VDA5050::ETopic::Order)))
        {
            UpdateDisabledMaps();
        }
        LogTolerated(message, now);
        _session.OnMessage(message.topic, message.payload, message.bRetained, now, _sessionActions);
        Pump(now, out);
    }
}

void VirtualVehicle::Send(VDA5050::MqttMessage message, Core::Now now, VirtualActions& out)
{
    std::vector<VDA5050::MqttMessage> passed;
    _outgoing.Pass(std::move(message), _faults.GetBoard(), *_random, now.steady, passed);
    LogOverflow(_outgoing.TakeOverflow(), now);
    for (VDA5050::MqttMessage& through : passed)
    {
        out.emplace_back(VDA5050::PublishMessage{std::move(through)});
    }
}

void VirtualVehicle::ReleaseMessages(Core::Now now, VirtualActions& out)
{
    std::vector<VDA5050::MqttMessage> released;
    _outgoing.Release(now.steady, released);
    for (VDA5050::MqttMessage& message : released)
    {
        out.emplace_back(VDA5050::PublishMessage{std::move(message)});
    }
    released.clear();
    _incoming.Release(now.steady, released);
    for (const VDA5050::MqttMessage& message : released)
    {
        Deliver(message, now, out);
    }
}

void VirtualVehicle::ScheduleEvents(Core::Now now, VirtualActions& out)
{
    std::optional<Core::SteadyTime> next = _faults.GetBoard().GetNextTimeOrNull();
    for (const std::optional<Core::SteadyTime>& other : {_incoming.GetNextTimeOrNull(), _outgoing.GetNextTimeOrNull()})
    {
        next = !next.has_value() || (other.has_value() && *other < *next) ? other : next;
    }
    if (next == _nextEvent)
    {
        return;
    }
    _nextEvent = next;
    if (next.has_value())
    {
        out.emplace_back(StartVirtualTimer{KEY_EVENT, std::max(*next - now.steady, Core::Duration::zero())});
    }
    else
    {
        out.emplace_back(CancelVirtualTimer{KEY_EVENT});
    }
}

} // namespace ACS::VdaSim
