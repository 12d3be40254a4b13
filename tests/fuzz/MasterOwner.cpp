#include "MasterOwner.hpp"

#include "FuzzCheck.hpp"

#include <algorithm>
#include <utility>

namespace ACS::Fuzz
{

using namespace VDA5050; // NOLINT(google-build-using-namespace)

namespace
{

constexpr int ROUNDS_TO_FINISH = 60;
constexpr int ROUNDS_TO_CANCEL = 60;
constexpr std::chrono::milliseconds ROUND{100};

} // namespace

MasterOwner::MasterOwner(MasterOptions options)
    : _options(std::move(options)),
      _session(_options)
{
}

bool MasterOwner::IsRequest(std::string_view actionType)
{
    return actionType == ActionTypes::STATE_REQUEST || actionType == ActionTypes::FACTSHEET_REQUEST;
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
