#include "MasterOwner.hpp"

#include "FuzzCheck.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/vda5050/ActionMachine.hpp>

#include <algorithm>
#include <utility>

// What the session does and reports.

namespace ACS::Fuzz
{

using namespace VDA5050; // NOLINT(google-build-using-namespace)

void MasterOwner::Execute(ECall call)
{
    _call = call;
    for (const MasterAction& action : std::exchange(_out, {}))
    {
        Do(action);
    }
    if (_call == ECall::State)
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
    _call = ECall::State;
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
    if (_call == ECall::Resume)
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
    if (last == _order->messages.rend())
    {
        return true;
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

} // namespace ACS::Fuzz
