#include "MasterSession.Impl.hpp"
#include <acs/vda5050/EVda5050Error.hpp>
#include <acs/vda5050/OrderValidator.hpp>

#include <algorithm>
#include <cstddef>
#include <iterator>
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

/// The horizon may have been sent shortened, or not at all: what the vehicle does not show of it is no part of the route.
void EraseUnsentHorizon(OrderMessage& order, const StateMessage& state)
{
    const auto isUnsent = [&state](const OrderNode& node) {
        return !node.bReleased
            && std::ranges::find(state.nodeStates, node.sequenceID, &NodeState::sequenceID) == state.nodeStates.end();
    };
    const auto first = std::ranges::find_if(order.nodes, isUnsent);
    if (first != order.nodes.end())
    {
        order.edges.resize(static_cast<std::size_t>(first - order.nodes.begin()) - 1);
        order.nodes.erase(first, order.nodes.end());
    }
}

} // namespace

void MasterSession::Impl::PublishOrder(Core::Now now, MasterActions& out)
{
    if (_outbox.GetInFlightOrNull() == nullptr || !_cancelActionID.empty() || !_vehicle.CanReceive()
        || !_vehicle.HasStateSinceOnline())
    {
        // Sent with the first state, as a restarted vehicle would take an update for a new order, and in a mode that takes orders.
        return;
    }
    if (_outbox.IsSpent())
    {
        RejectInFlight({}, "the vehicle never showed the order", out);
        return;
    }
    _outbox.Publish(_topics, _rules.GetOrderInterval(), now, out);
}

void MasterSession::Impl::BeginOrder(std::string orderID, OrderNumbers numbers)
{
    _withdrawnOrders.Remove(orderID);
    _orderID = std::move(orderID);
    _outbox.BeginOrder(std::move(numbers));
    _route.Clear();
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

void MasterSession::Impl::SetHorizonOmitted(bool bOmitted) noexcept
{
    _bHorizonOmitted = bOmitted;
}

void MasterSession::Impl::SetZoneSet(OrderMessage& order) const
{
    if (order.zoneSetID.empty())
    {
        order.zoneSetID = _options.zoneSetID;
    }
}

Core::Result<void> MasterSession::Impl::FitOrder(OrderMessage& order, Core::Now now) const
{
    const EOrderPhase phase = GetOrderPhase();
    const bool bUpdate = order.orderID == _orderID && (phase == EOrderPhase::Sent || phase == EOrderPhase::Active);
    const StateMessage* const state =
        bUpdate && _vehicle.IsShowingOrder(_orderID) ? _vehicle.GetStateOrNull() : nullptr;
    return _rules.FitOrder(order, state, _topics, now);
}

Core::Result<void> MasterSession::Impl::SendOrder(OrderMessage order, Core::Now now, MasterActions& out)
{
    if (!_orderID.empty())
    {
        return Core::Fail(EVda5050Error::OrderActive, {}, "no order", _orderID);
    }
    const bool bReady = _vehicle.IsReady() && _vehicle.IsUnderMasterControl();
    if (bReady && _vehicle.IsShowingOrder(order.orderID))
    {
        return Core::Fail(
            EVda5050Error::InvalidOrder,
            "orderId",
            "an id that the vehicle does not show, or else ResumeOrder",
            order.orderID);
    }
    if (bReady && _vehicle.IsBusy())
    {
        return Core::Fail(EVda5050Error::OrderActive, {}, "no order", _vehicle.GetStateOrNull()->orderID);
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
    std::vector<std::uint32_t> continuedIDs;
    if (*prepared)
    {
        continuedIDs.push_back(order.orderUpdateID);
    }
    BeginOrder(order.orderID, OrderNumbers(order.orderUpdateID, std::move(continuedIDs)));
    _outbox.Start(std::move(order), OrderOutbox::EEcho::Impossible, *_vehicle.GetStateOrNull());
    PublishOrder(now, out);
    return {};
}

std::pair<std::string, std::uint32_t> MasterSession::Impl::GetDecisionPoint() const
{
    const OrderMessage* const inFlight = _outbox.GetInFlightOrNull();
    return inFlight != nullptr ? FindDecisionPoint(*inFlight) : _route.GetDecisionPoint();
}

Core::Result<void> MasterSession::Impl::SendOrderUpdate(OrderMessage update, Core::Now now, MasterActions& out)
{
    if (_orderID.empty() || !_cancelActionID.empty())
    {
        return Core::Fail(EVda5050Error::NoOrder, {}, "an order that runs", update.orderID);
    }
    if (_outbox.HasQueued())
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
    if (!_outbox.TryNumber(update, *prepared, GetShownUpdateID()))
    {
        return Core::Fail(
            EVda5050Error::InvalidOrder,
            "orderUpdateId",
            "a new order: the last orderUpdateId of this one was used",
            _orderID);
    }
    _outbox.Queue(std::move(update));
    if (_outbox.TryStartQueued(*_vehicle.GetStateOrNull()))
    {
        PublishOrder(now, out);
    }
    return {};
}

bool MasterSession::Impl::IsRecordLost(const OrderRecord& record) const
{
    if (record.acceptedUpdateID.has_value())
    {
        return true;
    }
    const std::optional<std::string>& orderIDBefore = record.orderIDBefore;
    return orderIDBefore.has_value() && OrderOutbox::CanBeExecuted(*orderIDBefore, *_vehicle.GetStateOrNull());
}

void MasterSession::Impl::ReportRecordLost(const OrderRecord& record, MasterActions& out)
{
    const std::vector<OrderMessage>& messages = record.messages;
    const bool bAccepted = record.acceptedUpdateID.has_value();
    // Only the first message that was not accepted can have been sent.
    const auto sent = std::ranges::find_if(messages, [&record](const OrderMessage& message) {
        return !record.acceptedUpdateID.has_value() || message.orderUpdateID > *record.acceptedUpdateID;
    });
    if (sent != messages.end())
    {
        _withdrawnOrders.Add(sent->orderID, &*sent, !bAccepted);
    }
    out.emplace_back(OrderLost{
        messages.front().orderID,
        bAccepted ? "the vehicle does not hold it any more"
                  : "the vehicle may have been restarted since the order was given, and may have executed it"});
}

Core::Result<void> MasterSession::Impl::ResumeOrder(OrderRecord record, Core::Now now, MasterActions& out)
{
    if (!_orderID.empty())
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
    const bool bShown = _vehicle.IsReady() && _vehicle.IsShowingOrder(orderID);
    const bool bLost = _vehicle.IsReady() && !bShown && IsRecordLost(record);
    if (!bShown && !bLost && !CanTakeOrder())
    {
        return Core::Fail(
            EVda5050Error::VehicleNotReady,
            {},
            "a vehicle that is online, has sent a state and, for what it has not shown, drives by itself",
            _options.address.serialNumber);
    }
    if (bLost)
    {
        ReportRecordLost(record, out);
        return {};
    }
    const StateMessage& state = *_vehicle.GetStateOrNull();
    const auto open = std::ranges::find_if(messages, [&state, bShown](const OrderMessage& message) {
        return !bShown || message.orderUpdateID > state.orderUpdateID;
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
    if (open != messages.begin())
    {
        EraseUnsentHorizon(*std::prev(open), state);
    }
    BeginOrder(orderID, OrderNumbers(messages.back().orderUpdateID, std::move(continuedUpdateIDs)));
    for (auto message = messages.begin(); message != open; ++message)
    {
        AddToRoute(*message, message != messages.begin());
    }
    if (open != messages.begin())
    {
        _outbox.SetAccepted(std::prev(open)->orderUpdateID);
        out.emplace_back(OrderAccepted{orderID, state.orderUpdateID});
    }
    if (messages.end() - open == MOST_OPEN)
    {
        _outbox.Queue(std::move(messages.back()));
    }
    if (open != messages.end())
    {
        _outbox.Start(std::move(*open), OrderOutbox::EEcho::Possible, state);
    }
    _actions.Update(ActionIndex(state.actionStates), out);
    UpdateOrder(out);
    PublishOrder(now, out);
    return {};
}

} // namespace ACS::VDA5050
