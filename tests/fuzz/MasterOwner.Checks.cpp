#include "MasterOwner.hpp"

#include "FuzzCheck.hpp"
#include <acs/vda5050/OrderValidator.hpp>

#include <algorithm>

// What must hold of a message, and after each call.

namespace ACS::Fuzz
{

using namespace VDA5050; // NOLINT(google-build-using-namespace)

void MasterOwner::CheckPublished(const MqttMessage& message)
{
    ++_sent;
    Require(_bLinkUp && _link == EVehicleLink::Online, "nothing is published to a vehicle that is away");
    std::uint32_t headerID = 0;
    if (message.topic == BuildTopic(_options.address, ETopic::Order))
    {
        const Core::Result<OrderMessage> order = _codec.Decode<OrderMessage>(message.payload);
        Require(order.has_value() && _codec.GetTolerance() == DecodeTolerance{}, "an order can be decoded strictly");
        headerID = order->header.headerID;
        CheckOrderMessage(*order);
    }
    else
    {
        Require(message.topic == BuildTopic(_options.address, ETopic::InstantActions), "a master has two topics");
        const Core::Result<InstantActionsMessage> actions = _codec.Decode<InstantActionsMessage>(message.payload);
        Require(actions.has_value() && _codec.GetTolerance() == DecodeTolerance{}, "actions can be decoded strictly");
        headerID = actions->header.headerID;
        Require(!actions->actions.empty(), "a message has an action");
        for (const Action& action : actions->actions)
        {
            CheckInstant(action);
        }
    }
    const auto [known, bFirst] = _headerIDs.try_emplace(message.topic, headerID);
    Require(bFirst || headerID == known->second + 1, "headerId rises by one on each topic");
    known->second = headerID;
    _underWay.push_back(message);
}

void MasterOwner::CheckOrderMessage(const OrderMessage& message)
{
    Require(_bLed, "no order is sent in a mode without master control");
    Require(ValidateOrder(message).empty(), "an order is valid");
    Require(_order.has_value() && message.orderID == _order->orderID, "only the order that runs is sent");
    Require(!_order->bCancelling, "nothing of an order is sent after its cancel");
    const auto given = std::ranges::find(_order->messages, EAnswer::Open, &Given::answer);
    Require(given != _order->messages.end(), "a message is not sent after its answer");
    const std::string& mark = given->message.nodes.front().nodeDescription;
    Require(message.nodes.front().nodeDescription == mark, "one message without an answer is sent at a time, in order");
    if (given->sent == ESent::Yes)
    {
        OrderMessage again = message;
        again.header = given->message.header;
        Require(again == given->message, "a message is sent again as it was");
        return;
    }
    std::size_t base = 0;
    for (const Given& other : _order->messages)
    {
        if (other.sent == ESent::Yes)
        {
            Require(message.orderUpdateID > other.message.orderUpdateID, "orderUpdateId rises");
        }
        if (other.answer == EAnswer::Accepted)
        {
            base = other.message.nodes.front().sequenceID / 2;
            base += static_cast<std::size_t>(std::ranges::count(other.message.nodes, true, &OrderNode::bReleased)) - 1;
        }
    }
    // What it has shown before may have been a transient error.
    const StateMessage* const state = _session.GetStateOrNull();
    Require(
        state == nullptr || state->orderID != message.orderID || message.orderUpdateID > state->orderUpdateID,
        "an update is later than what the vehicle shows");
    Require(message.nodes.front().sequenceID == 2 * base, "an update begins where the base ends");
    Require(message.nodes.size() <= given->message.nodes.size(), "only the horizon is shortened");
    for (std::size_t index = 0; index < given->message.nodes.size(); ++index)
    {
        const OrderNode& node = given->message.nodes[index];
        Require(index < message.nodes.size() || !node.bReleased, "only the horizon is shortened");
        Require(index >= message.nodes.size() || message.nodes[index] == node, "a node is sent as it was given");
    }
    given->message = message;
    given->given.orderUpdateID = message.orderUpdateID;
    given->sent = ESent::Yes;
}

void MasterOwner::CheckInstant(const Action& action)
{
    Require(_bLed || IsRequest(action.actionType), "no action is sent in a mode without master control");
    if (IsRequest(action.actionType))
    {
        return;
    }
    const auto [known, bNew] = _instants.try_emplace(action.actionID, EInstant::Pending);
    Require(known->second == EInstant::Pending, "an action is not sent after its answer");
    if (bNew)
    {
        Require(action.actionType == ActionTypes::CANCEL_ORDER, "the session itself sends only cancelOrder");
        if (_order.has_value())
        {
            _order->cancelActionID = action.actionID;
        }
        _open[action.actionID] = OpenAction{};
    }
}

void MasterOwner::CheckShown() const
{
    const StateMessage& state = *_session.GetStateOrNull();
    std::set<std::string> seen;
    for (const ActionState& action : state.actionStates)
    {
        const auto known = _statuses.find(action.actionID);
        const bool bFirst = seen.insert(action.actionID).second;
        Require(known != _statuses.end(), "each action of the state was reported");
        Require(!bFirst || known->second == action.actionStatus, "each status of the state was reported");
    }
    Require(
        _errors == std::set<VehicleError>(state.errors.begin(), state.errors.end()),
        "the errors of the state were reported");
}

void MasterOwner::CheckState() const
{
    Require(_session.GetLink() == _link, "each change of the vehicle's link is reported");
    const EOrderPhase phase = _session.GetOrderPhase();
    Require((phase != EOrderPhase::None) == _order.has_value(), "an order runs until its outcome was reported");
    Require(_session.GetOrderID() == (_order.has_value() ? _order->orderID : std::string()), "the order has its id");
    Require(!_order.has_value() || (phase == EOrderPhase::Cancelling) == _order->bCancelling, "a cancel is its phase");
    const bool bOrderAction = std::ranges::any_of(_open, [](const auto& entry) { return entry.second.bOfOrder; });
    Require(_order.has_value() || !bOrderAction, "each action of an order has an outcome at its end");
    const MasterStatistics& statistics = _session.GetStatistics();
    Require(statistics.messagesSent == _sent, "each message is counted");
    Require(statistics.statesReceived == _states, "each state is counted");
    Require(statistics.messagesRefused == _refused, "each refused message is counted");
    constexpr std::size_t LONGEST_VERSION = 32;
    constexpr std::size_t LONGEST_REFUSAL = 1024;
    Require(statistics.lastVersion.size() <= LONGEST_VERSION, "the version is bounded");
    Require(statistics.lastRefusal.size() <= LONGEST_REFUSAL, "the reason of a refusal is bounded");
    Require(!_session.CanTakeOrder() || (_session.IsReady() && !_order.has_value()), "a vehicle takes one order");
    Require(!_session.IsReady() || (_link == EVehicleLink::Online && !_bSilent), "a vehicle that is away is not ready");
}

void MasterOwner::CheckReserved() const
{
    const std::vector<ReservedElement> reserved = _session.ListReserved();
    const auto isReserved = [&reserved](const std::string& elementID, std::uint32_t sequenceID, bool bEdge) {
        return std::ranges::any_of(reserved, [&](const ReservedElement& element) {
            return element.elementID == elementID && element.sequenceID == sequenceID && element.bEdge == bEdge;
        });
    };
    std::size_t limit = 1;
    if (const StateMessage* const state = _session.GetStateOrNull(); state != nullptr)
    {
        limit += state->nodeStates.size() + state->edgeStates.size();
        for (const NodeState& node : state->nodeStates)
        {
            Require(!node.bReleased || isReserved(node.nodeID, node.sequenceID, false), "a shown node is reserved");
        }
        for (const EdgeState& edge : state->edgeStates)
        {
            Require(!edge.bReleased || isReserved(edge.edgeID, edge.sequenceID, true), "a shown edge is reserved");
        }
    }
    for (std::size_t index = 0; _order.has_value() && index < _order->messages.size(); ++index)
    {
        const Given& given = _order->messages[index];
        const bool bUnderWay = given.answer == EAnswer::Open || given.answer == EAnswer::Withdrawn;
        if (given.sent != ESent::Yes || !bUnderWay)
        {
            continue;
        }
        limit += given.message.nodes.size() + given.message.edges.size();
        for (const OrderNode& node : given.message.nodes)
        {
            Require(!node.bReleased || isReserved(node.nodeID, node.sequenceID, false), "a sent node is reserved");
        }
        for (const OrderEdge& edge : given.message.edges)
        {
            Require(!edge.bReleased || isReserved(edge.edgeID, edge.sequenceID, true), "a sent edge is reserved");
        }
    }
    Require(reserved.size() <= limit, "only what the vehicle may use is reserved");
}

void MasterOwner::CheckTimers() const
{
    const auto isRunning = [this](EMasterTimer timer) {
        return _deadlines.at(static_cast<std::size_t>(timer)).has_value();
    };
    Require(
        _link != EVehicleLink::Online || _bSilent || isRunning(EMasterTimer::Silence),
        "the silence of a vehicle that is online is noticed");
    if (!_session.IsReady() || !_bLed)
    {
        return;
    }
    const bool bOrderWaits = _order.has_value() && !_order->bCancelling && CountOpen(*_order) != 0;
    Require(!bOrderWaits || isRunning(EMasterTimer::ResendOrder), "an order without an answer is sent again");
    const bool bActionWaits =
        std::ranges::any_of(_instants, [](const auto& entry) { return entry.second == EInstant::Pending; });
    Require(
        !bActionWaits || isRunning(EMasterTimer::ResendInstantActions),
        "an action without an answer is sent again");
}

} // namespace ACS::Fuzz
