#include "MasterOwner.hpp"

#include "FuzzCheck.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

// The orders that the owner gives.

namespace ACS::Fuzz
{

using namespace VDA5050; // NOLINT(google-build-using-namespace)

namespace
{

constexpr std::size_t LONGEST_ROUTE = 24;

/// What a vehicle does not show of the horizon has not been sent to it.
void EraseUnsentHorizon(OrderMessage& message, const StateMessage& state)
{
    for (std::size_t index = 1; index < message.nodes.size(); ++index)
    {
        const OrderNode& node = message.nodes[index];
        const bool bShown = std::ranges::count(state.nodeStates, node.sequenceID, &NodeState::sequenceID) != 0;
        if (!node.bReleased && !bShown)
        {
            message.nodes.resize(index);
            message.edges.resize(index - 1);
        }
    }
}

} // namespace

std::vector<Action> MasterOwner::MakeActions(Choices& choices)
{
    std::vector<Action> actions;
    for (std::uint32_t left = choices.Take(4) == 1 ? 1 + choices.Take(2) : 0; left > 0; --left)
    {
        Action& action = actions.emplace_back();
        action.actionType = choices.Take(2) == 0 ? ActionTypes::PICK : ActionTypes::DROP;
        action.actionID = "a" + std::to_string(++_actionCount);
        action.blockingType = EBlockingType::Hard;
    }
    return actions;
}

void MasterOwner::ExtendRoute(Order& order, std::size_t nodes, Choices& choices)
{
    for (std::size_t left = nodes; left > 0; --left)
    {
        const std::size_t index = order.nodes.size();
        OrderNode node;
        node.nodeID = "n" + std::to_string(index);
        node.sequenceID = static_cast<std::uint32_t>(2 * index);
        node.actions = MakeActions(choices);
        if (index > 0)
        {
            OrderEdge edge;
            edge.edgeID = "e" + std::to_string(index);
            edge.sequenceID = node.sequenceID - 1;
            edge.startNodeID = order.nodes.back().nodeID;
            edge.endNodeID = node.nodeID;
            edge.actions = MakeActions(choices);
            order.edges.push_back(std::move(edge));
        }
        order.nodes.push_back(std::move(node));
    }
}

/// The nodes from first to end, of which released are the base of the whole route. The description of its first node is its mark.
OrderMessage MasterOwner::Cut(const Order& order, std::size_t first, std::size_t released, std::size_t end)
{
    OrderMessage message;
    message.orderID = order.orderID;
    for (std::size_t index = first; index < end; ++index)
    {
        OrderNode& node = message.nodes.emplace_back(order.nodes.at(index));
        node.bReleased = index < released;
        if (index > first)
        {
            OrderEdge& edge = message.edges.emplace_back(order.edges.at(index - 1));
            edge.bReleased = node.bReleased;
        }
    }
    message.nodes.front().nodeDescription = "m" + std::to_string(++_messageCount);
    return message;
}

std::size_t MasterOwner::CountOpen(const Order& order)
{
    return static_cast<std::size_t>(std::ranges::count(order.messages, EAnswer::Open, &Given::answer));
}

std::vector<MasterOwner::Given>::iterator MasterOwner::FindUnanswered()
{
    return std::ranges::find_if(_order->messages, [](const Given& given) {
        return given.answer == EAnswer::Open || given.answer == EAnswer::Withdrawn;
    });
}

/// The index of the last released node of the route.
std::size_t MasterOwner::FindDecisionPoint(const Order& order)
{
    std::size_t decisionPoint = 0;
    for (const Given& given : order.messages)
    {
        if (given.answer == EAnswer::Open || given.answer == EAnswer::Accepted)
        {
            for (const OrderNode& node : given.message.nodes)
            {
                decisionPoint = node.bReleased ? node.sequenceID / 2 : decisionPoint;
            }
        }
    }
    return decisionPoint;
}

void MasterOwner::SendOrder(Choices& choices)
{
    Order order;
    order.orderID = "o" + std::to_string(choices.Take(16) == 1 ? _orderCount : ++_orderCount);
    ExtendRoute(order, 1 + choices.Take(6), choices);
    const StateMessage* const state = _session.GetStateOrNull();
    if (state != nullptr && !state->lastNodeID.empty())
    {
        order.nodes.front().nodeID = state->lastNodeID;
        if (!order.edges.empty())
        {
            order.edges.front().startNodeID = state->lastNodeID;
        }
    }
    const std::size_t count = order.nodes.size();
    const std::size_t released = 1 + choices.Take(static_cast<std::uint32_t>(count));
    const std::size_t end = released + choices.Take(static_cast<std::uint32_t>(count - released + 1));
    OrderMessage message = Cut(order, 0, released, end);
    message.orderUpdateID = choices.Take(4) == 1 ? choices.Take(3) : 0;
    const bool bValid = choices.Take(16) != 1;
    if (!bValid)
    {
        message.nodes.back().sequenceID += 1;
    }
    const bool bPossible = _session.CanTakeOrder() && state->orderID != order.orderID;
    const bool bFits = _session.CheckOrder(message, _now).has_value();
    const Core::Result<void> sent = _session.SendOrder(message, _now, _out);
    if (!sent)
    {
        Require(_out.empty(), "an order that is refused has no effect");
        Require(!bPossible || !bValid || !bFits, "a vehicle that can take an order gets it");
        return;
    }
    Require(bPossible && bValid && !_order.has_value(), "an order is sent only to a vehicle that can take it");
    _stored.reset();
    order.orderIDBefore = state->orderID;
    order.messages.push_back(Given{message, message, end > released, ESent::No, EAnswer::Open});
    _order = std::move(order);
    Execute();
}

void MasterOwner::SendUpdate(Choices& choices)
{
    if (!_order.has_value() || _order->bReappeared)
    {
        const Core::Result<void> sent = _session.SendOrderUpdate(OrderMessage{}, _now, _out);
        Require(!sent && _out.empty(), "an update without nodes or order is refused, without effect");
        return;
    }
    Order& order = *_order;
    if (order.nodes.size() < LONGEST_ROUTE && choices.Take(2) == 0)
    {
        ExtendRoute(order, choices.Take(4), choices);
    }
    const std::size_t first = FindDecisionPoint(order);
    const auto left = static_cast<std::uint32_t>(order.nodes.size() - first);
    const std::size_t released = first + 1 + choices.Take(left);
    const std::size_t end = released + choices.Take(static_cast<std::uint32_t>(order.nodes.size() - released + 1));
    const OrderMessage message = Cut(order, first, released, end);
    const std::size_t open = CountOpen(order);
    const bool bFits = _session.CheckOrder(message, _now).has_value();
    const Core::Result<void> sent = _session.SendOrderUpdate(message, _now, _out);
    if (!sent)
    {
        Require(_out.empty(), "an update that is refused has no effect");
        const bool bNumbersLeft = sent.error().path != "orderUpdateId";
        Require(open == 2 || order.bCancelling || !bFits || !bNumbersLeft, "an update of an order that runs is sent");
        return;
    }
    Require(open < 2 && !order.bCancelling, "at most one update waits");
    order.messages.push_back(Given{message, message, end > released, ESent::No, EAnswer::Open});
    Execute();
}

void MasterOwner::Resume()
{
    if (!_stored.has_value() || _order.has_value())
    {
        return;
    }
    std::erase_if(_stored->messages, [](const Given& given) {
        return given.answer != EAnswer::Open && given.answer != EAnswer::Accepted;
    });
    OrderRecord record;
    record.acceptedUpdateID = _stored->acceptedUpdateID;
    for (Given& given : _stored->messages)
    {
        if (given.sent == ESent::No && !record.messages.empty())
        {
            given.given.orderUpdateID = record.messages.back().orderUpdateID + 1;
        }
        record.messages.push_back(given.given);
    }
    if (_orderCount % 2 == 0)
    {
        record.orderIDBefore = _stored->orderIDBefore;
    }
    const Core::Result<void> resumed = _session.ResumeOrder(record, _now, _out);
    if (!resumed)
    {
        Require(_out.empty(), "an order that cannot be resumed has no effect");
        return;
    }
    const StateMessage* const state = _session.GetStateOrNull();
    Require(state != nullptr, "an order is resumed where the state is known");
    Order order = std::move(*_stored);
    _stored.reset();
    order.reachedSequenceID.reset();
    bool bFirst = true;
    bool bFirstOpen = true;
    const auto isShown = [state, &order](const Given& given) {
        return state->orderID == order.orderID && state->orderUpdateID >= given.given.orderUpdateID;
    };
    const std::ptrdiff_t shown = std::ranges::count_if(order.messages, isShown);
    for (Given& given : order.messages)
    {
        const bool bShown = isShown(given);
        given.message = given.given;
        given.answer = bShown ? EAnswer::Accepted : EAnswer::Open;
        given.sent = ESent::Yes;
        if (bShown)
        {
            if (&given == &order.messages.at(static_cast<std::size_t>(shown) - 1))
            {
                EraseUnsentHorizon(given.message, *state);
            }
            Track(given.message, std::exchange(bFirst, false));
        }
        else
        {
            given.sent = std::exchange(bFirstOpen, false) ? ESent::Perhaps : ESent::No;
        }
    }
    _order = std::move(order);
    ResolveShown();
    Execute(ECall::Resume);
}

} // namespace ACS::Fuzz
