#include "MasterOwner.hpp"

#include "FuzzCheck.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/vda5050/ActionMachine.hpp>
#include <acs/vda5050/EVda5050Error.hpp>
#include <acs/vda5050/OrderValidator.hpp>

#include <algorithm>
#include <utility>

namespace ACS::Fuzz
{

using namespace VDA5050; // NOLINT(google-build-using-namespace)

namespace
{

constexpr std::size_t LONGEST_ROUTE = 24;
constexpr int ROUNDS_TO_FINISH = 60;
constexpr int ROUNDS_TO_CANCEL = 60;
constexpr std::chrono::milliseconds ROUND{100};

bool IsRequest(std::string_view actionType)
{
    return actionType == ActionTypes::STATE_REQUEST || actionType == ActionTypes::FACTSHEET_REQUEST;
}

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

MasterOwner::MasterOwner(MasterOptions options)
    : _options(std::move(options)),
      _session(_options)
{
}

VehicleModel& MasterOwner::GetVehicle() noexcept
{
    return _vehicle;
}

StateMessage MasterOwner::MakeState()
{
    return _vehicle.MakeState(_now);
}

std::size_t MasterOwner::MeasureState() const
{
    const StateMessage* const state = _session.GetStateOrNull();
    return state == nullptr ? 0 : state->actionStates.size() + state->errors.size();
}

void MasterOwner::PassTime(std::chrono::milliseconds span)
{
    const Core::SteadyTime end = _now.steady + span;
    while (true)
    {
        Core::SteadyTime next = end;
        for (const auto& deadline : _deadlines)
        {
            next = deadline.has_value() ? std::min(next, *deadline) : next;
        }
        const Core::Duration step = std::max(next - _now.steady, Core::Duration::zero());
        _now.steady += step;
        _now.wall += std::chrono::duration_cast<Core::WallTime::duration>(step);
        const bool bLast = _now.steady == end;
        for (std::size_t index = 0; index < TIMER_COUNT; ++index)
        {
            if (_deadlines.at(index).has_value() && *_deadlines.at(index) <= _now.steady)
            {
                _deadlines.at(index).reset();
                _session.OnTimer(static_cast<EMasterTimer>(index), _now, _out);
                Execute();
            }
        }
        if (bLast)
        {
            return;
        }
    }
}

void MasterOwner::ChangeLink(bool bUp)
{
    if (_bLinkUp == bUp)
    {
        return;
    }
    _bLinkUp = bUp;
    if (bUp)
    {
        _session.OnLinkUp(_now, _out);
    }
    else
    {
        _link = EVehicleLink::Unknown;
        _session.OnLinkDown(_now, _out);
    }
    Execute();
    const bool bTimer = std::ranges::any_of(_deadlines, [](const auto& deadline) { return deadline.has_value(); });
    Require(bUp || !bTimer, "no timer runs without a link");
}

void MasterOwner::ReportConnection(EConnectionState state)
{
    ConnectionMessage message;
    message.header = Header{0, _now.wall, "2.0.0", "ACS", "LR01"};
    message.connectionState = state;
    Receive(ETopic::Connection, _codec.Encode(message, EVda5050Version::Version200), true);
}

void MasterOwner::Receive(ETopic topic, const std::string& payload, bool bRetained)
{
    std::size_t limit = 64 + MeasureState() + 2 * _open.size() + 2 * _instants.size();
    for (std::size_t index = 0; _order.has_value() && index < _order->messages.size(); ++index)
    {
        const OrderMessage& message = _order->messages[index].message;
        limit += 2 * message.nodes.size();
        for (const OrderNode& node : message.nodes)
        {
            limit += 2 * node.actions.size();
        }
    }
    _session.OnMessage(MqttMessage{BuildTopic(_options.address, topic), payload, 0, bRetained}, _now, _out);
    limit += MeasureState();
    Require(_out.size() <= limit, "the actions of a call are bounded");
    Execute();
}

void MasterOwner::Transport(bool bLost)
{
    if (_underWay.empty())
    {
        return;
    }
    const MqttMessage message = std::move(_underWay.front());
    _underWay.pop_front();
    if (bLost)
    {
        return;
    }
    if (message.topic.ends_with("/order"))
    {
        _vehicle.Receive(*_codec.Decode<OrderMessage>(message.payload));
    }
    else
    {
        _vehicle.Receive(*_codec.Decode<InstantActionsMessage>(message.payload));
    }
}

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

void MasterOwner::SendInstant(Choices& choices)
{
    static constexpr std::array TYPES{
        ActionTypes::PICK,
        ActionTypes::START_PAUSE,
        ActionTypes::STOP_PAUSE,
        ActionTypes::STATE_REQUEST,
        ActionTypes::CANCEL_ORDER,
        ActionTypes::START_CHARGING};
    Action action;
    action.actionType = TYPES.at(choices.Take(TYPES.size()));
    action.actionID = choices.Take(2) == 0 ? std::string() : "i" + std::to_string(choices.Take(8));
    const Core::Result<std::string> actionID = _session.SendInstantAction(action, _now, _out);
    if (!actionID)
    {
        Require(_out.empty(), "an action that is refused has no effect");
        return;
    }
    Require(!actionID->empty(), "an action has an id");
    if (!IsRequest(action.actionType))
    {
        Require(!_open.contains(*actionID), "an id is used by one action at a time");
        const StateMessage* const state = _session.GetStateOrNull();
        const auto isSame = [&actionID](const ActionState& shown) {
            return shown.actionID == *actionID;
        };
        const bool bShown = state != nullptr && std::ranges::any_of(state->actionStates, isSame);
        _instants[*actionID] = bShown ? EInstant::Shown : EInstant::Pending;
        _open[*actionID] = OpenAction{};
        ResolveShown();
    }
    Execute();
}

void MasterOwner::Cancel()
{
    const Core::Result<void> cancelled = _session.Cancel(_now, _out);
    if (!cancelled)
    {
        Require(_out.empty(), "a cancel that is refused has no effect");
        return;
    }
    Require(_order.has_value(), "only an order is cancelled");
    _order->bCancelling = true;
    for (Given& given : _order->messages)
    {
        given.answer = given.answer == EAnswer::Open ? EAnswer::Withdrawn : given.answer;
    }
    Execute();
}

void MasterOwner::SetHorizonOmitted(bool bOmitted)
{
    _session.SetHorizonOmitted(bOmitted);
}

void MasterOwner::RestartMaster()
{
    _session = MasterSession(_options);
    if (_order.has_value() && !_order->bReappeared && !_order->bCancelling)
    {
        _stored = std::move(_order);
    }
    _order.reset();
    _deadlines = {};
    _headerIDs.clear();
    _withdrawn.clear();
    _instants.clear();
    _open.clear();
    _statuses.clear();
    _errors.clear();
    _link = EVehicleLink::Unknown;
    _states = 0;
    _refused = 0;
    _sent = 0;
    _bLinkUp = false;
    _bLed = true;
    _bSilent = false;
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
    for (Given& given : order.messages)
    {
        const bool bShown = state->orderID == order.orderID && state->orderUpdateID >= given.given.orderUpdateID;
        given.message = given.given;
        given.answer = bShown ? EAnswer::Accepted : EAnswer::Open;
        given.sent = ESent::Yes;
        if (bShown)
        {
            if (given.message.orderUpdateID == state->orderUpdateID)
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
    _bResuming = true;
    Execute();
    _bResuming = false;
}

void MasterOwner::Execute()
{
    _bStateSeen = false;
    for (const MasterAction& action : std::exchange(_out, {}))
    {
        Do(action);
    }
    if (_bStateSeen)
    {
        CheckShown();
    }
    CheckState();
    CheckReserved();
    CheckTimers();
}

void MasterOwner::Do(const MasterAction& action)
{
    std::visit(
        Core::Overloaded{
            [this](const PublishMessage& publish) { CheckPublished(publish.message); },
            [this](const StartMasterTimer& start) {
                Require(start.delay > Core::Duration::zero(), "a timer ends in the future");
                _deadlines.at(static_cast<std::size_t>(start.timer)) = _now.steady + start.delay;
            },
            [this](const CancelMasterTimer& cancel) { _deadlines.at(static_cast<std::size_t>(cancel.timer)).reset(); },
            [this](const VehicleOnline& /*event*/) {
                Require(_link != EVehicleLink::Online, "a vehicle comes online once");
                _link = EVehicleLink::Online;
                _bSilent = false;
            },
            [this](const VehicleOffline& /*event*/) { _link = EVehicleLink::Offline; },
            [this](const VehicleBroken& /*event*/) { _link = EVehicleLink::Broken; },
            [this](const VehicleSilent& silent) {
                Require(!_bSilent && _link == EVehicleLink::Online, "a silent vehicle is reported once");
                Require(silent.age >= _options.stateInterval, "a vehicle is silent after its time");
                _bSilent = true;
            },
            [this](const StateReceived& /*event*/) { OnState(); },
            [](const FactsheetReceived& /*event*/) {},
            [](const PositionReceived& /*event*/) {},
            [this](const OrderAccepted& event) { On(event); },
            [this](const OrderRejected& event) { On(event); },
            [this](const OrderDelayed& event) {
                Require(_order.has_value() && event.orderID == _order->orderID, "an order that runs is delayed");
            },
            [this](const NodeReached& event) { On(event); },
            [this](const ActionChanged& event) { _statuses[event.actionID] = event.status; },
            [this](const ActionLost& event) { On(event); },
            [this](const InstantActionRejected& event) { On(event); },
            [this](const OrderFinished& event) { FinishOrder(event.orderID); },
            [this](const OrderCancelled& event) {
                Require(_order.has_value() && _order->bCancelling, "only an order that is cancelled ends so");
                _withdrawn.insert(event.orderID);
                EndOrder(event.orderID);
            },
            [this](const OrderReappeared& event) { On(event); },
            [this](const CancelFailed& event) {
                Require(_order.has_value() && _order->orderID == event.orderID, "the cancel was of this order");
                Require(_order->bCancelling, "a cancel fails once");
                _order->bCancelling = false;
                for (Given& given : _order->messages)
                {
                    given.answer = given.answer == EAnswer::Withdrawn ? EAnswer::Open : given.answer;
                }
            },
            [this](const OrderLost& event) {
                _withdrawn.insert(event.orderID);
                EndOrder(event.orderID);
            },
            [this](const VehicleErrorChanged& event) { On(event); },
            [this](const MessageRefused& /*event*/) {
                ++_refused;
            }},
        action);
}

void MasterOwner::OnState()
{
    ++_states;
    _bStateSeen = true;
    const StateMessage& state = *_session.GetStateOrNull();
    _bLed = IsLedByMaster(state.operatingMode);
    _bSilent = _bSilent && _link != EVehicleLink::Online;
    for (const ActionState& action : state.actionStates)
    {
        const auto found = _instants.find(action.actionID);
        if (found != _instants.end() && found->second == EInstant::Pending)
        {
            found->second = EInstant::Shown;
        }
    }
    ResolveShown();
}

/// Actions that the state shows as ended have their outcome.
void MasterOwner::ResolveShown()
{
    const StateMessage* const state = _session.GetStateOrNull();
    if (state == nullptr)
    {
        return;
    }
    std::set<std::string> seen;
    for (const ActionState& action : state->actionStates)
    {
        if (seen.insert(action.actionID).second && IsTerminal(action.actionStatus))
        {
            _open.erase(action.actionID);
        }
    }
}

void MasterOwner::Track(const OrderMessage& message, bool bFirst)
{
    const std::uint32_t stitch = message.nodes.front().sequenceID;
    std::erase_if(_open, [stitch](const auto& entry) {
        return entry.second.bOfOrder && entry.second.sequenceID > stitch;
    });
    const auto add = [this](const std::vector<Action>& actions, std::uint32_t sequenceID) {
        for (const Action& action : actions)
        {
            _open[action.actionID] = OpenAction{true, sequenceID};
        }
    };
    for (std::size_t index = bFirst ? 0 : 1; index < message.nodes.size(); ++index)
    {
        add(message.nodes[index].actions, message.nodes[index].sequenceID);
    }
    for (const OrderEdge& edge : message.edges)
    {
        add(edge.actions, edge.sequenceID);
    }
}

void MasterOwner::On(const OrderAccepted& event)
{
    Require(_order.has_value() && _order->orderID == event.orderID, "an order that was sent is accepted");
    const auto isAccepted = [](const Given& given) {
        return given.answer == EAnswer::Accepted;
    };
    const bool bFirst = std::ranges::none_of(_order->messages, isAccepted);
    if (_bResuming)
    {
        Require(!bFirst, "an order that is resumed is accepted where the vehicle shows a message of it");
        _order->acceptedUpdateID = event.orderUpdateID;
        return;
    }
    const auto given = FindUnanswered();
    Require(
        given != _order->messages.end() && given->sent != ESent::No,
        "a message is accepted once, after it was sent");
    Require(given->message.orderUpdateID <= event.orderUpdateID, "the vehicle has shown what is accepted");
    Require(
        !_order->acceptedUpdateID.has_value() || event.orderUpdateID > *_order->acceptedUpdateID,
        "each acceptance is of a later message");
    given->answer = EAnswer::Accepted;
    Track(given->message, bFirst);
    ResolveShown();
    _order->acceptedUpdateID = event.orderUpdateID;
}

void MasterOwner::On(const OrderRejected& event)
{
    Require(_order.has_value() && _order->orderID == event.orderID, "an order that was sent is rejected");
    const auto given = FindUnanswered();
    Require(given != _order->messages.end(), "a message has one answer");
    Require(
        given->sent != ESent::Yes || given->message.orderUpdateID == event.orderUpdateID,
        "the message without an answer is rejected");
    given->answer = EAnswer::Rejected;
    if (!_order->acceptedUpdateID.has_value() && CountOpen(*_order) == 0)
    {
        _withdrawn.insert(event.orderID);
        EndOrder(event.orderID);
    }
}

void MasterOwner::On(const OrderReappeared& event)
{
    Require(!_order.has_value(), "an order reappears while none runs");
    Require(_withdrawn.contains(event.orderID), "only an order that ended before it was shown reappears");
    Order order;
    order.orderID = event.orderID;
    order.bReappeared = true;
    order.bCancelling = true;
    _order = std::move(order);
}

void MasterOwner::On(const NodeReached& event)
{
    Require(_order.has_value(), "a node of an order is reached");
    const std::uint32_t expected = _order->reachedSequenceID.has_value() ? *_order->reachedSequenceID + 2 : 0;
    Require(event.sequenceID == expected, "nodes are reached once, in order");
    const bool bKnown = std::ranges::any_of(_order->messages, [&event](const Given& given) {
        return given.answer == EAnswer::Accepted
            && std::ranges::any_of(given.message.nodes, [&event](const OrderNode& node) {
                   return node.bReleased && node.sequenceID == event.sequenceID && node.nodeID == event.nodeID;
               });
    });
    Require(bKnown, "a node of the base is reached");
    _order->reachedSequenceID = event.sequenceID;
}

void MasterOwner::On(const ActionLost& event)
{
    Require(_open.erase(event.actionID) == 1, "an action has one outcome");
}

void MasterOwner::On(const InstantActionRejected& event)
{
    const auto found = _instants.find(event.actionID);
    Require(found != _instants.end() && found->second == EInstant::Pending, "an action that waits is rejected, once");
    found->second = EInstant::Rejected;
    _open.erase(event.actionID);
}

void MasterOwner::On(const VehicleErrorChanged& event)
{
    const bool bNews = event.bActive ? _errors.insert(event.error).second : _errors.erase(event.error) == 1;
    Require(bNews, "each change of an error is reported once");
}

bool MasterOwner::IsLastNodeReached() const
{
    const auto last = std::ranges::find_if(_order->messages.rbegin(), _order->messages.rend(), [](const Given& given) {
        return given.answer == EAnswer::Accepted;
    });
    if (last == _order->messages.rend() || last->message.orderUpdateID != _order->acceptedUpdateID)
    {
        return true; // the vehicle claims an update that was not sent
    }
    return !last->bContinues && _order->reachedSequenceID == last->message.nodes.back().sequenceID;
}

void MasterOwner::FinishOrder(const std::string& orderID)
{
    Require(_order.has_value(), "an order that runs finishes");
    Require(_order->bReappeared || CountOpen(*_order) == 0, "an order does not finish while a message has no answer");
    Require(_order->bReappeared || IsLastNodeReached(), "an order finishes at the last node of its route");
    ++_finishedOrders;
    if (FindUnanswered() != _order->messages.end())
    {
        _withdrawn.insert(orderID);
    }
    EndOrder(orderID);
}

void MasterOwner::EndOrder(const std::string& orderID)
{
    Require(_order.has_value() && _order->orderID == orderID, "an order has one outcome");
    const auto cancel = _instants.find(_order->cancelActionID);
    if (cancel != _instants.end() && cancel->second == EInstant::Pending)
    {
        cancel->second = EInstant::Rejected; // the order was lost before: sent again, the cancel would end the next one
        _open.erase(cancel->first);
    }
    _order.reset();
}

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
    Require(
        !_order->acceptedUpdateID.has_value() || message.orderUpdateID > *_order->acceptedUpdateID,
        "an update is later than what the vehicle has shown");
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

/// A round of a vehicle and a broker that work.
void MasterOwner::Work()
{
    while (!_underWay.empty())
    {
        Transport(false);
    }
    _vehicle.Drive();
    for (std::size_t turn = 0; turn < 4; ++turn)
    {
        _vehicle.AdvanceAction(turn, false);
    }
    Receive(ETopic::State, _codec.Encode(MakeState(), EVda5050Version::Version200), false);
    PassTime(ROUND);
}

void MasterOwner::End()
{
    Choices zeros(nullptr, 0);
    _underWay.clear();
    ChangeLink(true);
    _vehicle.SetMode(EOperatingMode::Automatic);
    _vehicle.ClearErrors();
    ReportConnection(EConnectionState::Online);
    SetHorizonOmitted(false);
    for (int round = 0; round < ROUNDS_TO_CANCEL + ROUNDS_TO_FINISH; ++round)
    {
        Work();
        const bool bHeld = !_order.has_value() && _vehicle.IsBusy();
        if (_order.has_value() && round == ROUNDS_TO_CANCEL)
        {
            Cancel();
            Require(!_order.has_value() || _order->bCancelling, "an order of a vehicle that is ready can be cancelled");
        }
        else if (bHeld && round % 10 == 9)
        {
            Action action;
            action.actionType = ActionTypes::CANCEL_ORDER;
            Require(_session.SendInstantAction(action, _now, _out).has_value(), "any order can be cancelled");
            Execute();
        }
        else if (!_order.has_value() && !bHeld && _underWay.empty() && _open.empty() && _session.CanTakeOrder())
        {
            break;
        }
    }
    Require(!_order.has_value(), "every order ends");
    Require(_open.empty(), "every action ends");
    Require(_session.CanTakeOrder(), "a vehicle that works can take an order");
    const std::size_t finished = _finishedOrders;
    SendOrder(zeros);
    for (int round = 0; round < ROUNDS_TO_FINISH && _order.has_value(); ++round)
    {
        Work();
    }
    Require(_finishedOrders == finished + 1, "an order of a vehicle that works finishes");
}

} // namespace ACS::Fuzz
