#include "OrderErrors.hpp"
#include "StateRoom.hpp"
#include "VehicleSession.Impl.hpp"
#include <acs/vda5050/EVda5050Error.hpp>

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

namespace ACS::VDA5050
{

namespace
{

/// Errors about orders and instant actions live until an order is taken; a peer that never gets one right must not fill
/// the state.
constexpr std::size_t MAXIMUM_SESSION_ERRORS = 16;

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

std::vector<MqttSubscription> VehicleSession::Impl::GetSubscriptions() const
{
    std::vector<MqttSubscription> subscriptions;
    for (const ETopic topic : {ETopic::Order, ETopic::InstantActions})
    {
        subscriptions.push_back(MqttSubscription{_topics.at(static_cast<std::size_t>(topic)), _options.qos.Get(topic)});
    }
    return subscriptions;
}

void VehicleSession::Impl::OnMessage(
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
    if (bRetained || payload.empty())
    {
        // An order of yesterday, replayed by the broker to a vehicle that has restarted; or a master that removes it there.
        out.emplace_back(MessageIgnored{
            bOrder ? ETopic::Order : ETopic::InstantActions,
            Core::Error{
                make_error_code(EVda5050Error::InvalidOrder),
                {},
                "a message sent now",
                bRetained ? "a retained one" : "an empty one, which removes a retained one"}});
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

bool VehicleSession::Impl::IsForeign(ETopic topic, const Header& header, VehicleActions& out) const
{
    std::optional<Core::Error> foreign = FindForeignNameOrNull(header, _options.address);
    if (foreign.has_value())
    {
        out.emplace_back(MessageIgnored{topic, std::move(*foreign)});
    }
    return foreign.has_value();
}

void VehicleSession::Impl::AddSessionError(VehicleError error, EErrorLifetime lifetime)
{
    error.errorDescription.resize(CutForeignText(error.errorDescription).size());
    std::erase_if(_sessionErrors, [&error](const SessionError& known) { return IsSameReport(error, known.error); });
    if (_sessionErrors.size() >= MAXIMUM_SESSION_ERRORS)
    {
        _sessionErrors.erase(_sessionErrors.begin());
    }
    _sessionErrors.push_back(SessionError{std::move(error), lifetime, false});
    _bStateDue = true;
}

void VehicleSession::Impl::RefusePayload(
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
    if (identity && identity->bHeaderIDGiven)
    {
        AddReference(report, ReferenceKeys::HEADER_ID, std::to_string(identity->header.headerID));
    }
    if (identity && topic == ETopic::Order)
    {
        // What could not be read is not made up: a master would take it for the refusal of another message.
        if (!identity->orderID.empty())
        {
            AddReference(report, ReferenceKeys::ORDER_ID, identity->orderID);
        }
        if (identity->orderUpdateID.has_value())
        {
            AddReference(report, ReferenceKeys::ORDER_UPDATE_ID, std::to_string(*identity->orderUpdateID));
        }
    }
    AddSessionError(
        std::move(report),
        topic == ETopic::Order ? EErrorLifetime::UntilOrder : EErrorLifetime::UntilInstantAction);
    out.emplace_back(MessageIgnored{topic, error});
}

bool VehicleSession::Impl::ShouldAccept(ETopic topic, const Header& header, VehicleActions& out)
{
    if (IsForeign(topic, header, out))
    {
        return false;
    }
    if (ReadVersionOrNull(header.version).has_value())
    {
        return true;
    }
    VehicleError report;
    report.errorType = ErrorTypes::VALIDATION_ERROR;
    report.errorDescription = "protocol version 2.x expected, found " + header.version;
    AddReference(report, ReferenceKeys::TOPIC, std::string(GetTopicName(topic)));
    AddReference(report, ReferenceKeys::HEADER_ID, std::to_string(header.headerID));
    AddSessionError(
        std::move(report),
        topic == ETopic::Order ? EErrorLifetime::UntilOrder : EErrorLifetime::UntilInstantAction);
    out.emplace_back(MessageIgnored{
        topic,
        Core::Error{make_error_code(EVda5050Error::UnsupportedVersion), "version", "2.x", header.version}});
    return false;
}

void VehicleSession::Impl::OnOrder(std::string_view payload, VehicleActions& out)
{
    Core::Result<OrderMessage> order = _codec.Decode<OrderMessage>(payload);
    if (!order)
    {
        RefusePayload(ETopic::Order, payload, order.error(), out);
        return;
    }
    if (!ShouldAccept(ETopic::Order, order->header, out))
    {
        return;
    }
    OrderContext context = MakeContext();
    context.payloadBytes = payload.size();
    OrderJudgement judgement = JudgeOrder(*order, context);
    switch (judgement.verdict)
    {
        case EOrderVerdict::NewOrder:
            AcceptOrder(std::move(*order), out);
            break;
        case EOrderVerdict::Update:
            AcceptUpdate(std::move(*order), out);
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

OrderContext VehicleSession::Impl::MakeContext() const
{
    OrderContext context;
    context.heldOrderID = _orderID;
    context.heldOrderUpdateID = _orderUpdateID;
    context.bExecuting = IsExecuting();
    context.bCancelling = !_cancelActionIDs.empty();
    context.operatingMode = _operatingMode;
    context.decisionNodeID = _lastNodeID;
    context.decisionSequenceID = _lastNodeSequenceID;
    const std::size_t released = _route.CountReleased();
    if (released > 0)
    {
        context.decisionNodeID = _route.GetNodeID(released - 1);
        context.decisionSequenceID = _route.GetNodeSequenceID(released - 1);
    }
    context.lastNodeID = _lastNodeID;
    context.position = _position;
    context.defaultDeviationXY = _options.defaultDeviationXY;
    context.mapIDs = _options.mapIDs;
    if (_maps.has_value())
    {
        context.bMapsKnown = true;
        std::ranges::transform(*_maps, std::back_inserter(context.mapIDs), &MapState::mapID);
    }
    context.zoneSetIDs = _options.zoneSetIDs;
    context.factsheet = &_options.factsheet;
    context.parameterCheck = _options.parameterCheck;
    context.bCleared = _bCleared;
    context.orderCheck = _options.orderCheck;
    context.keptNodes = released;
    context.keptBytes = _route.GetReleasedBytes();
    const std::uint32_t baseEnd =
        released == _route.GetSize() ? std::numeric_limits<std::uint32_t>::max() : _route.GetEdgeSequenceID(released);
    for (const ReportedAction& tracked : _actions)
    {
        const bool bInstant = tracked.IsInstant();
        // An end that no state has shown yet makes no way.
        const bool bInstantStays = bInstant && !(tracked.IsEnded() && tracked.bShown);
        // What has ended may be of a route that was cancelled and had the same sequenceIds.
        const bool bOfBase = !bInstant && (tracked.sequenceID < baseEnd || tracked.IsEnded());
        if (bInstantStays)
        {
            context.instantActionIDs.push_back(tracked.action.actionID);
        }
        if (bInstant || bOfBase)
        {
            context.actionIDs.push_back(tracked.action.actionID);
        }
        context.keptActions += bOfBase || bInstantStays ? 1U : 0U;
        context.keptBytes += bOfBase ? MeasureActionState(tracked.machine.GetState()) : 0;
    }
    return context;
}

void VehicleSession::Impl::RefuseOrder(const OrderMessage& order, OrderJudgement judgement, VehicleActions& out)
{
    const OrderViolation& first = judgement.violations.front();
    out.emplace_back(OrderRefused{order.orderID, order.orderUpdateID, first.error.errorType, first.rule});
    for (OrderViolation& violation : judgement.violations)
    {
        AddSessionError(
            std::move(violation.error),
            judgement.bUntilMode ? EErrorLifetime::UntilMode : EErrorLifetime::UntilOrder);
    }
}

void VehicleSession::Impl::AcceptOrder(OrderMessage order, VehicleActions& out)
{
    // The master has to see the end of each instant action, and each error.
    _actions.EraseIf(
        [](const ReportedAction& tracked) { return !tracked.IsInstant() || (tracked.IsEnded() && tracked.bShown); });
    _evicted.clear();
    std::erase_if(_sessionErrors, [](const SessionError& known) { return known.bShown; });
    DiscardRoute();
    _bCleared = false;
    _bOrderRunning = true;
    _orderID = order.orderID;
    _orderUpdateID = order.orderUpdateID;
    _zoneSetID = order.zoneSetID;
    _bStateDue = true;
    out.emplace_back(OrderTaken{_orderID, _orderUpdateID, false});
    // The vehicle is on the first node: it is reached on acceptance and never in nodeStates.
    const OrderNode first = order.nodes.front();
    _lastNodeID = first.nodeID;
    _lastNodeSequenceID = first.sequenceID;
    AddActions(first.actions, EActionScope::Node, first.nodeID, first.sequenceID);
    AppendElements(std::move(order));
    Enqueue(first.actions);
    Advance(out);
}

void VehicleSession::Impl::AcceptUpdate(OrderMessage order, VehicleActions& out)
{
    std::erase_if(_sessionErrors, [](const SessionError& known) { return known.bShown; });
    DropHorizon();
    _bCleared = false;
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
    const std::size_t stated = _options.factsheet.protocolLimits.maxArrayLengths.stateActionStates.value_or(0);
    while (stated != 0 && _actions.GetSize() > stated && TryEvict())
    {
    }
    Advance(out);
}

/// All but the first node, which the vehicle knows already.
void VehicleSession::Impl::AppendElements(OrderMessage order)
{
    for (std::size_t index = 0; index < order.edges.size(); ++index)
    {
        const OrderEdge& edge = order.edges[index];
        const OrderNode& node = order.nodes[index + 1];
        AddActions(edge.actions, EActionScope::Edge, edge.edgeID, edge.sequenceID);
        AddActions(node.actions, EActionScope::Node, node.nodeID, node.sequenceID);
    }
    _route.Append(std::move(order));
}

void VehicleSession::Impl::DropHorizon()
{
    const std::size_t kept = _route.CountReleased();
    if (kept == _route.GetSize())
    {
        return;
    }
    const std::uint32_t firstDropped = _route.GetEdgeSequenceID(kept);
    _route.Cut(kept);
    // Gone from the report: an id that comes back with the update would else have to leave a terminal status.
    _actions.EraseIf([firstDropped](const ReportedAction& tracked) {
        return !tracked.IsInstant() && !tracked.IsEnded() && tracked.sequenceID >= firstDropped;
    });
}

} // namespace ACS::VDA5050
