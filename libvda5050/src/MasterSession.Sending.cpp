#include "ActionIndex.hpp"
#include "MasterSession.Impl.hpp"
#include <acs/vda5050/ActionMachine.hpp>
#include <acs/vda5050/EVda5050Error.hpp>
#include <acs/vda5050/OrderValidator.hpp>

#include <algorithm>
#include <limits>
#include <utility>

namespace ACS::VDA5050
{

namespace
{

Core::Result<void> CheckStructure(const OrderMessage& order)
{
    const std::vector<OrderViolation> violations = ValidateOrder(order);
    if (violations.empty())
    {
        return {};
    }
    return Core::Fail(EVda5050Error::InvalidOrder, {}, violations.front().rule, "order " + order.orderID);
}

/// An update begins at the node at which the base before it ends.
Core::Result<void> CheckBegin(const OrderMessage& update, const std::pair<std::string, std::uint32_t>& decisionPoint)
{
    const auto& [nodeID, sequenceID] = decisionPoint;
    const OrderNode& first = update.nodes.front();
    if (first.nodeID == nodeID && first.sequenceID == sequenceID)
    {
        return {};
    }
    return Core::Fail(
        EVda5050Error::InvalidOrder,
        "nodes[0]",
        "the last released node, " + nodeID + " (" + std::to_string(sequenceID) + ")",
        first.nodeID + " (" + std::to_string(first.sequenceID) + ")");
}

std::pair<std::string, std::uint32_t> FindDecisionPoint(const OrderMessage& order)
{
    std::pair<std::string, std::uint32_t> point;
    for (const OrderNode& node : order.nodes)
    {
        point = node.bReleased ? std::pair(node.nodeID, node.sequenceID) : point;
    }
    return point;
}

/// One order, whose messages follow each other.
Core::Result<void> CheckRecord(const std::vector<OrderMessage>& messages)
{
    if (messages.empty())
    {
        return Core::Fail(EVda5050Error::InvalidOrder, {}, "a message of the order at least", "none");
    }
    for (std::size_t index = 0; index < messages.size(); ++index)
    {
        const OrderMessage& message = messages[index];
        Core::Result<void> check = CheckStructure(message);
        if (check && index > 0)
        {
            const OrderMessage& before = messages[index - 1];
            if (message.orderID != before.orderID || message.orderUpdateID <= before.orderUpdateID)
            {
                return Core::Fail(
                    EVda5050Error::InvalidOrder,
                    {},
                    "updates of one order, each with a higher orderUpdateId",
                    message.orderID + " " + std::to_string(message.orderUpdateID));
            }
            check = CheckBegin(message, FindDecisionPoint(before));
        }
        if (!check)
        {
            return check;
        }
    }
    return {};
}

bool HasHorizon(const OrderMessage& order)
{
    return std::ranges::any_of(order.nodes, [](const OrderNode& node) { return !node.bReleased; });
}

} // namespace

Header MasterSession::Impl::MakeHeader(ETopic topic, Core::Now now)
{
    Header header = PeekHeader(topic, now);
    ++_headerIDs.at(static_cast<std::size_t>(topic));
    return header;
}

Header MasterSession::Impl::PeekHeader(ETopic topic, Core::Now now) const
{
    return Header{
        _headerIDs.at(static_cast<std::size_t>(topic)),
        now.wall,
        std::string(GetVersionText(_options.version)),
        _options.address.manufacturer,
        _options.address.serialNumber};
}

void MasterSession::Impl::PublishPayload(ETopic topic, std::string payload, MasterActions& out)
{
    ++_statistics.messagesSent;
    out.emplace_back(PublishMessage{MqttMessage{
        _topics.at(static_cast<std::size_t>(topic)),
        std::move(payload),
        _options.qos.Get(topic),
        IsRetained(topic)}});
}

void MasterSession::Impl::PublishOrder(Core::Now now, MasterActions& out)
{
    if (_link != EVehicleLink::Online || !IsUnderMasterControl())
    {
        return; // sent when it comes online, and back to a mode that takes orders
    }
    const Core::SteadyTime earliest = _lastOrderTime.value_or(now.steady) + GetOrderInterval();
    if (_lastOrderTime.has_value() && now.steady < earliest)
    {
        const Core::Duration delay = earliest - now.steady;
        out.emplace_back(StartMasterTimer{EMasterTimer::ResendOrder, delay});
        if (_sendCount == 0)
        {
            out.emplace_back(OrderDelayed{_inFlight->orderID, _inFlight->orderUpdateID, delay});
        }
        return;
    }
    _lastOrderTime = now.steady;
    _inFlight->header = MakeHeader(ETopic::Order, now);
    PublishPayload(ETopic::Order, _codec.Encode(*_inFlight, _options.version), out);
    _echo = EEcho::Possible;
    _firstHeaderID = _sendCount == 0 ? _inFlight->header.headerID : _firstHeaderID;
    ++_sendCount;
    out.emplace_back(StartMasterTimer{EMasterTimer::ResendOrder, _options.resendInterval});
}

void MasterSession::Impl::ResendOrder(Core::Now now, MasterActions& out)
{
    if (!_inFlight.has_value() || _link != EVehicleLink::Online || !IsUnderMasterControl())
    {
        return;
    }
    if (_options.resendCount != 0 && _sendCount > _options.resendCount)
    {
        RejectInFlight({}, "the vehicle never showed the order", out);
        return;
    }
    const std::uint32_t sentBefore = _sendCount;
    PublishOrder(now, out);
    _statistics.ordersResent += sentBefore != 0 && _sendCount != sentBefore ? 1U : 0U;
}

void MasterSession::Impl::BeginOrder(std::string orderID, std::uint32_t lastUpdateID)
{
    std::erase_if(_withdrawnOrders, [&orderID](const WithdrawnOrder& order) { return order.orderID == orderID; });
    _phase = EOrderPhase::Sent;
    _orderID = std::move(orderID);
    _lastSentUpdateID = lastUpdateID;
    _bAccepted = false;
    _route.clear();
    _reachedNodes = 0;
    _continuedUpdateIDs.clear();
}

Core::Result<bool> MasterSession::Impl::Prepare(OrderMessage& order, Core::Now now) const
{
    SetZoneSet(order);
    Core::Result<void> check = CheckStructure(order);
    if (!check)
    {
        return tl::unexpected(std::move(check.error()));
    }
    const bool bContinues = HasHorizon(order);
    if (bContinues && _bHorizonOmitted)
    {
        std::erase_if(order.nodes, [](const OrderNode& node) { return !node.bReleased; });
        std::erase_if(order.edges, [](const OrderEdge& edge) { return !edge.bReleased; });
    }
    check = FitOrder(order, now);
    if (!check)
    {
        return tl::unexpected(std::move(check.error()));
    }
    return bContinues;
}

void MasterSession::Impl::NoteContinuation(std::uint32_t orderUpdateID, bool bContinues)
{
    if (bContinues)
    {
        _continuedUpdateIDs.push_back(orderUpdateID);
    }
}

void MasterSession::Impl::SetHorizonOmitted(bool bOmitted) noexcept
{
    _bHorizonOmitted = bOmitted;
}

std::optional<std::uint32_t> MasterSession::Impl::TakeUpdateIDOrNull()
{
    const std::uint32_t shownID = _state.has_value() && _state->orderID == _orderID ? _state->orderUpdateID : 0;
    const std::uint32_t lastID = std::max(_lastSentUpdateID, shownID);
    if (lastID == std::numeric_limits<std::uint32_t>::max())
    {
        return std::nullopt;
    }
    _lastSentUpdateID = lastID + 1;
    return _lastSentUpdateID;
}

void MasterSession::Impl::StartWaitingForEcho(OrderMessage order, EEcho echo, Core::Now now, MasterActions& out)
{
    _errorsBeforeSend = _state->errors;
    std::ranges::sort(_errorsBeforeSend);
    _orderIDBeforeSend = _state->orderID;
    _bAwaySinceSend = false;
    _echo = echo;
    _sendCount = 0;
    _inFlight = std::move(order);
    PublishOrder(now, out);
}

void MasterSession::Impl::SetZoneSet(OrderMessage& order) const
{
    if (order.zoneSetID.empty())
    {
        order.zoneSetID = _options.zoneSetID;
    }
}

Core::Result<void> MasterSession::Impl::SendOrder(OrderMessage order, Core::Now now, MasterActions& out)
{
    if (_phase != EOrderPhase::None)
    {
        return Core::Fail(EVda5050Error::OrderActive, {}, "no order", _orderID);
    }
    if (IsReady() && IsUnderMasterControl() && _state->orderID == order.orderID)
    {
        return Core::Fail(
            EVda5050Error::InvalidOrder,
            "orderId",
            "an id that the vehicle does not show, or else ResumeOrder",
            order.orderID);
    }
    if (IsReady() && IsUnderMasterControl() && IsBusy())
    {
        return Core::Fail(EVda5050Error::OrderActive, {}, "no order", _state->orderID);
    }
    if (!CanTakeOrder())
    {
        return Core::Fail(
            EVda5050Error::VehicleNotReady,
            {},
            "a vehicle that is online, has sent a state and drives by itself",
            _options.address.serialNumber);
    }
    const Core::Result<bool> prepared = Prepare(order, now);
    if (!prepared)
    {
        return tl::unexpected(prepared.error());
    }
    BeginOrder(order.orderID, order.orderUpdateID);
    NoteContinuation(order.orderUpdateID, *prepared);
    StartWaitingForEcho(std::move(order), EEcho::Impossible, now, out);
    return {};
}

std::pair<std::string, std::uint32_t> MasterSession::Impl::GetDecisionPoint() const
{
    if (_inFlight.has_value())
    {
        return FindDecisionPoint(*_inFlight);
    }
    std::pair<std::string, std::uint32_t> point;
    for (const RouteNode& node : _route)
    {
        point = node.bReleased ? std::pair(node.nodeID, node.sequenceID) : point;
    }
    return point;
}

Core::Result<void> MasterSession::Impl::SendOrderUpdate(OrderMessage update, Core::Now now, MasterActions& out)
{
    if (_phase != EOrderPhase::Sent && _phase != EOrderPhase::Active)
    {
        return Core::Fail(EVda5050Error::NoOrder, {}, "an order that runs", update.orderID);
    }
    if (_queued.has_value())
    {
        return Core::Fail(EVda5050Error::UpdatePending, {}, "at most one update that waits", _orderID);
    }
    update.orderID = _orderID;
    const Core::Result<bool> prepared = Prepare(update, now);
    if (!prepared)
    {
        return tl::unexpected(prepared.error());
    }
    Core::Result<void> check = CheckBegin(update, GetDecisionPoint());
    if (!check)
    {
        return check;
    }
    const std::optional<std::uint32_t> updateID = TakeUpdateIDOrNull();
    if (!updateID.has_value())
    {
        return Core::Fail(
            EVda5050Error::InvalidOrder,
            "orderUpdateId",
            "a new order: the last orderUpdateId of this one was used",
            _orderID);
    }
    update.orderUpdateID = *updateID;
    NoteContinuation(update.orderUpdateID, *prepared);
    if (_inFlight.has_value())
    {
        _queued = std::move(update);
        return {};
    }
    StartWaitingForEcho(std::move(update), EEcho::Impossible, now, out);
    return {};
}

Core::Result<void> MasterSession::Impl::ResumeOrder(OrderRecord record, Core::Now now, MasterActions& out)
{
    if (_phase != EOrderPhase::None)
    {
        return Core::Fail(EVda5050Error::OrderActive, {}, "no order", _orderID);
    }
    std::vector<OrderMessage>& messages = record.messages;
    Core::Result<void> check = CheckRecord(messages);
    if (!check)
    {
        return check;
    }
    const std::string orderID = messages.front().orderID;
    const bool bShown = IsReady() && _state->orderID == orderID;
    // Whose order was lost needs not be able to take another.
    if (bShown || record.acceptedUpdateID.has_value() ? !IsReady() : !CanTakeOrder())
    {
        return Core::Fail(
            EVda5050Error::VehicleNotReady,
            {},
            "a vehicle that is online, has sent a state and, for what it has not shown, drives by itself",
            _options.address.serialNumber);
    }
    if (!bShown && record.acceptedUpdateID.has_value())
    {
        out.emplace_back(OrderLost{orderID, "the vehicle does not hold it any more"});
        return {};
    }
    const auto open = std::ranges::find_if(messages, [this, bShown](const OrderMessage& message) {
        return !bShown || message.orderUpdateID > _state->orderUpdateID;
    });
    constexpr std::ptrdiff_t MOST_OPEN = 2; // one in flight, one that waits for its echo
    if (messages.end() - open > MOST_OPEN)
    {
        return Core::Fail(EVda5050Error::InvalidOrder, {}, "two messages at most that were not shown", orderID);
    }
    std::vector<std::uint32_t> continuedUpdateIDs;
    for (auto message = messages.begin(); message != messages.end(); ++message)
    {
        const Core::Result<bool> prepared =
            message < open ? Core::Result<bool>(HasHorizon(*message)) : Prepare(*message, now);
        if (!prepared)
        {
            return tl::unexpected(prepared.error());
        }
        if (*prepared)
        {
            continuedUpdateIDs.push_back(message->orderUpdateID);
        }
    }
    BeginOrder(orderID, messages.back().orderUpdateID);
    _continuedUpdateIDs = std::move(continuedUpdateIDs);
    for (auto message = messages.begin(); message != open; ++message)
    {
        AddToRoute(*message);
    }
    if (_bAccepted)
    {
        _acceptedUpdateID = _state->orderUpdateID;
        _lastSentUpdateID = std::max(_lastSentUpdateID, _acceptedUpdateID);
        out.emplace_back(OrderAccepted{orderID, _acceptedUpdateID});
    }
    if (messages.end() - open == MOST_OPEN)
    {
        _queued = std::move(messages.back());
    }
    if (open != messages.end())
    {
        StartWaitingForEcho(std::move(*open), EEcho::Possible, now, out);
    }
    UpdateActions(ActionIndex(_state->actionStates), out);
    UpdateOrder(out);
    return {};
}

} // namespace ACS::VDA5050
