#include "OrderErrors.hpp"
#include <acs/vda5050/EVda5050Error.hpp>
#include <acs/vda5050/VehicleSession.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace ACS::VDA5050
{

namespace
{

/// Errors about orders and instant actions live until an order is taken; a peer that never gets one right must not fill
/// the state.
constexpr std::size_t MAXIMUM_SESSION_ERRORS = 16;
/// Ended instant actions live until a new order; a peer that only asks for states must not fill the state.
constexpr std::size_t MAXIMUM_INSTANT_ACTIONS = 128;

bool IsFinite(const AgvPosition& position)
{
    return std::isfinite(position.x) && std::isfinite(position.y) && std::isfinite(position.theta);
}

bool IsSameReport(const VehicleError& left, const VehicleError& right)
{
    const auto isSameReference = [&right](const ErrorReference& reference) {
        const std::string* other = FindReferenceOrNull(right, reference.referenceKey);
        return reference.referenceKey == ReferenceKeys::HEADER_ID
            || (other != nullptr && *other == reference.referenceValue);
    };
    return left.errorType == right.errorType && left.errorDescription == right.errorDescription
        && std::ranges::all_of(left.errorReferences, isSameReference);
}

} // namespace

VehicleSession::VehicleSession(VehicleOptions options)
    : _options(std::move(options)),
      _lastNodeID(_options.initialNodeID)
{
    for (std::size_t index = 0; index < TOPIC_COUNT; ++index)
    {
        _topics.at(index) = BuildTopic(_options.address, static_cast<ETopic>(index));
    }
}

std::vector<MqttSubscription> VehicleSession::GetSubscriptions() const
{
    std::vector<MqttSubscription> subscriptions;
    for (const ETopic topic : {ETopic::Order, ETopic::InstantActions})
    {
        subscriptions.push_back(MqttSubscription{_topics.at(static_cast<std::size_t>(topic)), _options.qos.Get(topic)});
    }
    return subscriptions;
}

void VehicleSession::OnMessage(
    std::string_view topic,
    std::string_view payload,
    bool bRetained,
    Core::Now now,
    VehicleActions& out)
{
    const bool bOrder = topic == _topics.at(static_cast<std::size_t>(ETopic::Order));
    if (!bOrder && topic != _topics.at(static_cast<std::size_t>(ETopic::InstantActions)))
    {
        return;
    }
    if (bRetained)
    {
        // An order of yesterday, replayed by the broker to a vehicle that has restarted.
        out.emplace_back(MessageIgnored{
            bOrder ? ETopic::Order : ETopic::InstantActions,
            Core::Error{make_error_code(EVda5050Error::InvalidOrder), {}, "a message sent now", "a retained one"}});
        return;
    }
    if (bOrder)
    {
        OnOrder(payload, out);
    }
    else
    {
        OnInstantActions(payload, now, out);
    }
    Settle(now, out);
}

bool VehicleSession::IsForeign(ETopic topic, const Header& header, VehicleActions& out) const
{
    // Empty names are tolerated: there are masters that leave them out, and the topic has said it already.
    const auto isOther = [](const std::string& said, const std::string& own) {
        return !said.empty() && said != own;
    };
    if (!isOther(header.manufacturer, _options.address.manufacturer)
        && !isOther(header.serialNumber, _options.address.serialNumber))
    {
        return false;
    }
    out.emplace_back(MessageIgnored{
        topic,
        Core::Error{
            make_error_code(EVda5050Error::InvalidTopic),
            "serialNumber",
            _options.address.manufacturer + "/" + _options.address.serialNumber,
            header.manufacturer + "/" + header.serialNumber}});
    return true;
}

void VehicleSession::AddSessionError(VehicleError error)
{
    std::erase_if(_sessionErrors, [&error](const VehicleError& known) { return IsSameReport(error, known); });
    if (_sessionErrors.size() >= MAXIMUM_SESSION_ERRORS)
    {
        _sessionErrors.erase(_sessionErrors.begin());
    }
    _sessionErrors.push_back(std::move(error));
    _bStateDue = true;
}

void VehicleSession::RefusePayload(
    ETopic topic,
    std::string_view payload,
    const Core::Error& error,
    VehicleActions& out)
{
    const Core::Result<MessageIdentity> identity = _codec.DecodeIdentity(payload);
    if (identity && IsForeign(topic, identity->header, out))
    {
        return;
    }
    VehicleError report;
    report.errorType = ErrorTypes::VALIDATION_ERROR;
    report.errorDescription = Core::Describe(error);
    AddReference(report, ReferenceKeys::TOPIC, std::string(GetTopicName(topic)));
    if (identity)
    {
        AddReference(report, ReferenceKeys::HEADER_ID, std::to_string(identity->header.headerID));
    }
    if (identity && topic == ETopic::Order)
    {
        AddReference(report, ReferenceKeys::ORDER_ID, identity->orderID);
        AddReference(report, ReferenceKeys::ORDER_UPDATE_ID, std::to_string(identity->orderUpdateID.value_or(0)));
    }
    AddSessionError(std::move(report));
    out.emplace_back(MessageIgnored{topic, error});
}

void VehicleSession::RefuseVersion(ETopic topic, const Header& header, VehicleActions& out)
{
    VehicleError report;
    report.errorType = ErrorTypes::VALIDATION_ERROR;
    report.errorDescription = "protocol version 2.x expected, found " + header.version;
    AddReference(report, ReferenceKeys::TOPIC, std::string(GetTopicName(topic)));
    AddReference(report, ReferenceKeys::HEADER_ID, std::to_string(header.headerID));
    AddSessionError(std::move(report));
    out.emplace_back(MessageIgnored{
        topic,
        Core::Error{make_error_code(EVda5050Error::UnsupportedVersion), "version", "2.x", header.version}});
}

void VehicleSession::OnOrder(std::string_view payload, VehicleActions& out)
{
    Core::Result<OrderMessage> order = _codec.Decode<OrderMessage>(payload);
    if (!order)
    {
        RefusePayload(ETopic::Order, payload, order.error(), out);
        return;
    }
    if (IsForeign(ETopic::Order, order->header, out))
    {
        return;
    }
    if (!ReadVersionOrNull(order->header.version).has_value())
    {
        RefuseVersion(ETopic::Order, order->header, out);
        return;
    }
    OrderJudgement judgement = JudgeOrder(*order, MakeContext());
    switch (judgement.verdict)
    {
        case EOrderVerdict::NewOrder:
            TakeNewOrder(std::move(*order), out);
            break;
        case EOrderVerdict::Update:
            TakeUpdate(std::move(*order), out);
            break;
        case EOrderVerdict::Reject:
            RefuseOrder(*order, std::move(judgement), out);
            break;
        case EOrderVerdict::Discard:
        default:
            // The master did not see the echo: show it again.
            _bStateDue = true;
            break;
    }
}

void VehicleSession::RefuseOrder(const OrderMessage& order, OrderJudgement judgement, VehicleActions& out)
{
    const OrderViolation& first = judgement.violations.front();
    out.emplace_back(OrderRefused{order.orderID, order.orderUpdateID, first.error.errorType, first.rule});
    for (OrderViolation& violation : judgement.violations)
    {
        AddSessionError(std::move(violation.error));
    }
}

void VehicleSession::OnInstantActions(std::string_view payload, Core::Now now, VehicleActions& out)
{
    const Core::Result<InstantActionsMessage> message = _codec.Decode<InstantActionsMessage>(payload);
    if (!message)
    {
        RefusePayload(ETopic::InstantActions, payload, message.error(), out);
        return;
    }
    if (IsForeign(ETopic::InstantActions, message->header, out))
    {
        return;
    }
    if (!ReadVersionOrNull(message->header.version).has_value())
    {
        RefuseVersion(ETopic::InstantActions, message->header, out);
        return;
    }
    for (const Action& action : message->actions)
    {
        OnInstantAction(action, message->header, now, out);
    }
    FinishPauseIfStanding();
    FinishCancelIfStanding(out);
    Advance(out);
}

void VehicleSession::OnInstantAction(const Action& action, const Header& header, Core::Now now, VehicleActions& out)
{
    _bStateDue = true;
    if (action.actionID.empty())
    {
        VehicleError error;
        error.errorType = ErrorTypes::VALIDATION_ERROR;
        error.errorDescription = "an instant action has no actionId";
        AddReference(error, ReferenceKeys::TOPIC, std::string(GetTopicName(ETopic::InstantActions)));
        AddReference(error, ReferenceKeys::HEADER_ID, std::to_string(header.headerID));
        AddSessionError(std::move(error));
        return;
    }
    // A repeated id is the same action, sent again by a master that has not seen it in a state.
    if (FindActionOrNull(action.actionID) != nullptr)
    {
        return;
    }
    const bool bRequest =
        action.actionType == ActionTypes::STATE_REQUEST || action.actionType == ActionTypes::FACTSHEET_REQUEST;
    if (_operatingMode == EOperatingMode::Manual && !bRequest)
    {
        FailInstantAction(
            action,
            header,
            ErrorTypes::INSTANT_ACTION_ERROR,
            "in manual mode the vehicle takes no instant actions");
        return;
    }
    PerformOwnInstantAction(action, header, now, out);
}

void VehicleSession::PerformOwnInstantAction(
    const Action& action,
    const Header& header,
    Core::Now now,
    VehicleActions& out)
{
    if (action.actionType == ActionTypes::STATE_REQUEST)
    {
        AddInstantAction(action, EActionStatus::Finished);
    }
    else if (action.actionType == ActionTypes::FACTSHEET_REQUEST)
    {
        PublishFactsheet(now, out);
        AddInstantAction(action, EActionStatus::Finished);
    }
    else if (action.actionType == ActionTypes::CANCEL_ORDER)
    {
        StartCancel(action, header, out);
    }
    else if (action.actionType == ActionTypes::START_PAUSE)
    {
        StartPause(action, out);
    }
    else if (action.actionType == ActionTypes::STOP_PAUSE)
    {
        StopPause(action, out);
    }
    else if (CanPerform(_options.factsheet, action.actionType, EActionScope::Instant))
    {
        AddInstantAction(action, EActionStatus::Waiting);
        Start(_actions.back(), out);
    }
    else
    {
        FailInstantAction(
            action,
            header,
            ErrorTypes::INSTANT_ACTION_ERROR,
            "the vehicle cannot perform " + action.actionType + " as an instant action");
    }
}

void VehicleSession::AddInstantAction(const Action& action, EActionStatus status, const std::string& result)
{
    const auto isEnded = [](const TrackedAction& tracked) {
        return tracked.scope == EActionScope::Instant && IsTerminal(tracked.machine.GetStatus());
    };
    if (static_cast<std::size_t>(std::ranges::count_if(_actions, isEnded)) >= MAXIMUM_INSTANT_ACTIONS)
    {
        _actions.erase(std::ranges::find_if(_actions, isEnded));
    }
    ActionState state{action.actionID, action.actionType, action.actionDescription, status, result};
    _actions.push_back(TrackedAction{action, ActionMachine(std::move(state)), EActionScope::Instant, {}, 0, false});
}

void VehicleSession::FailInstantAction(
    const Action& action,
    const Header& header,
    std::string_view errorType,
    const std::string& reason)
{
    AddInstantAction(action, EActionStatus::Failed, reason);
    VehicleError error;
    error.errorType = errorType;
    error.errorDescription = reason;
    AddReference(error, ReferenceKeys::TOPIC, std::string(GetTopicName(ETopic::InstantActions)));
    AddReference(error, ReferenceKeys::HEADER_ID, std::to_string(header.headerID));
    AddReference(error, ReferenceKeys::ACTION_ID, action.actionID);
    AddSessionError(std::move(error));
}

bool VehicleSession::TryReachNode(std::uint32_t sequenceID, Core::Now now, VehicleActions& out)
{
    if (_nodes.empty() || !_bEdgeEntered || _nodes.front().sequenceID != sequenceID)
    {
        return false;
    }
    ReachFront(out);
    FinishCancelIfStanding(out);
    Advance(out);
    Settle(now, out);
    return true;
}

void VehicleSession::OnPosition(
    const AgvPosition& position,
    const Velocity& velocity,
    std::optional<double> distanceSinceLastNode)
{
    if (IsFinite(position))
    {
        _position = position;
        _velocity = velocity;
        _distanceSinceLastNode = distanceSinceLastNode;
    }
}

void VehicleSession::OnDrivingChanged(bool bDriving, Core::Now now, VehicleActions& out)
{
    if (bDriving == _bDriving)
    {
        return;
    }
    _bDriving = bDriving;
    _bStateDue = true;
    FinishPauseIfStanding();
    FinishCancelIfStanding(out);
    Settle(now, out);
}

bool VehicleSession::TrySetActionStatus(
    std::string_view actionID,
    EActionStatus status,
    std::string resultDescription,
    Core::Now now,
    VehicleActions& out)
{
    TrackedAction* trackedOrNull = FindActionOrNull(actionID);
    if (trackedOrNull == nullptr || !trackedOrNull->machine.TrySet(status, std::move(resultDescription)))
    {
        return false;
    }
    _bStateDue = true;
    FinishCancelIfStanding(out);
    Advance(out);
    Settle(now, out);
    return true;
}

void VehicleSession::OnBattery(const BatteryState& battery, Core::Now now, VehicleActions& out)
{
    _bStateDue = _bStateDue || battery.bCharging != _battery.bCharging;
    _battery = battery;
    Settle(now, out);
}

void VehicleSession::OnLoads(std::optional<std::vector<Load>> loads, Core::Now now, VehicleActions& out)
{
    _bStateDue = _bStateDue || loads != _loads;
    _loads = std::move(loads);
    Settle(now, out);
}

void VehicleSession::OnMaps(std::optional<std::vector<MapState>> maps, Core::Now now, VehicleActions& out)
{
    _bStateDue = _bStateDue || maps != _maps;
    _maps = std::move(maps);
    Settle(now, out);
}

void VehicleSession::OnErrors(std::vector<VehicleError> errors, Core::Now now, VehicleActions& out)
{
    _bStateDue = _bStateDue || errors != _ownerErrors;
    _ownerErrors = std::move(errors);
    Settle(now, out);
}

void VehicleSession::OnInformation(std::vector<Information> information)
{
    _information = std::move(information);
}

void VehicleSession::OnSafetyState(const SafetyState& safety, Core::Now now, VehicleActions& out)
{
    _bStateDue = _bStateDue || safety != _safety;
    _safety = safety;
    Settle(now, out);
}

void VehicleSession::OnOperatingMode(EOperatingMode mode, Core::Now now, VehicleActions& out)
{
    if (mode == _operatingMode)
    {
        return;
    }
    const bool bManual = mode == EOperatingMode::Manual || _operatingMode == EOperatingMode::Manual;
    _operatingMode = mode;
    _bStateDue = true;
    if (!CanMoveByItself())
    {
        StopMoving(out);
    }
    if (bManual && IsExecuting())
    {
        StopOrderActions(out);
        for (TrackedAction& tracked : _actions)
        {
            if (tracked.scope != EActionScope::Instant && !IsTerminal(tracked.machine.GetStatus()))
            {
                static_cast<void>(tracked.machine.TrySet(EActionStatus::Failed, "the operating mode changed"));
            }
        }
        ClearOrder(out);
    }
    Advance(out);
    Settle(now, out);
}

StateMessage VehicleSession::GetState() const
{
    return BuildState();
}

bool VehicleSession::IsPaused() const noexcept
{
    return _bPaused;
}

bool VehicleSession::IsOrderRunning() const noexcept
{
    return _bOrderRunning;
}

} // namespace ACS::VDA5050
