#include "VehicleOwner.hpp"

#include "FuzzCheck.hpp"
#include <acs/vda5050/ActionMachine.hpp>
#include <acs/vda5050/Topic.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace ACS::Fuzz
{

namespace
{

using namespace VDA5050; // NOLINT(google-build-using-namespace)

constexpr int MAXIMUM_STEPS = 400; ///< To the end of the longest order that the target builds.

constexpr std::uint32_t UNLIMITED = std::numeric_limits<std::uint32_t>::max();

/// A measured value; sometimes that of a broken sensor.
double Measure(Choices& choices)
{
    const std::uint32_t value = choices.Take(8);
    return value == 7 ? std::numeric_limits<double>::quiet_NaN() : value;
}

} // namespace

VehicleOwner::VehicleOwner(VehicleOptions options)
    : _limits(options.factsheet.protocolLimits.maxArrayLengths),
      _minimumInterval(options.minimumStateInterval),
      _session(std::move(options))
{
    _session.OnLinkUp(_now, _out);
    Obey();
}

StateMessage VehicleOwner::GetState() const
{
    return _session.GetState();
}

void VehicleOwner::PassTime(std::uint32_t milliseconds)
{
    _now.steady += std::chrono::milliseconds(milliseconds);
    _now.wall += std::chrono::milliseconds(milliseconds);
}

void VehicleOwner::Receive(ETopic topic, std::string_view payload, bool bRetained)
{
    _session.OnMessage(BuildTopic(VehicleAddress{"uagv", "ACS", "LR01"}, topic), payload, bRetained, _now, _out);
    Obey();
}

void VehicleOwner::SendInstant(std::string_view actionType, const std::string& actionID)
{
    InstantActionsMessage message;
    message.header = Header{0, _now.wall, "2.1.0", "ACS", "LR01"};
    Action& action = message.actions.emplace_back();
    action.actionType = actionType;
    action.actionID = actionID;
    Receive(ETopic::InstantActions, _codec.Encode(message, EVda5050Version::Version210), false);
}

void VehicleOwner::ReachNode()
{
    if (_leg.has_value())
    {
        const DriveTo leg = *std::exchange(_leg, std::nullopt);
        static_cast<void>(_session.TryReachNode({leg.node.sequenceID, leg.bStopAtNode}, _now, _out));
        Obey();
    }
}

void VehicleOwner::SetStatus(Choices& choices)
{
    const auto status = static_cast<EActionStatus>(choices.Take(6));
    std::string actionID = "a" + std::to_string(choices.Take(8));
    if (!_running.empty() && choices.Take(4) != 0)
    {
        actionID = std::next(_running.begin(), choices.Take(static_cast<std::uint32_t>(_running.size())))->first;
    }
    const bool bTaken = _session.TrySetActionStatus(actionID, status, "result", _now, _out);
    Require(!bTaken || _running.contains(actionID), "the owner sets the status of started actions only");
    if (bTaken && IsTerminal(status))
    {
        _running.erase(actionID);
    }
    Obey();
}

void VehicleOwner::Happen(Choices& choices)
{
    constexpr std::uint32_t KINDS = 12;
    switch (choices.Take(KINDS))
    {
        case 0:
            ReachNode();
            return;
        case 1:
            ReachWithoutCommand(choices);
            break;
        case 2:
            _session.OnDrivingChanged(choices.Take(2) == 0, _now, _out);
            break;
        case 3:
            _session.OnOperatingMode(static_cast<EOperatingMode>(choices.Take(5)), _now, _out);
            break;
        case 4:
        {
            const bool bPaused = choices.Take(2) == 0;
            _session.OnHardwarePause(bPaused, choices.Take(2) == 0, _now, _out);
            break;
        }
        case 5:
        {
            AgvPosition position;
            position.bPositionInitialized = choices.Take(8) != 0;
            position.x = Measure(choices);
            position.mapID = "floor";
            _session.OnPosition(position, Velocity{Measure(choices), {}, {}});
            break;
        }
        case 6:
            _session.OnTimer(static_cast<EVehicleTimer>(choices.Take(3)), _now, _out);
            break;
        case 7:
            _bLinked = !_bLinked;
            if (_bLinked)
            {
                _session.OnLinkUp(_now, _out);
            }
            else
            {
                _session.OnLinkDown(_now, _out);
            }
            break;
        case 8:
        {
            const auto status = choices.Take(2) == 0 ? EMapStatus::Enabled : EMapStatus::Disabled;
            _session.OnMaps(std::vector{MapState{"floor", "1", status, {}}}, _now, _out);
            break;
        }
        case 9:
            LeaveCorridor(choices.Take(2) == 0);
            return;
        case 10:
            Sense(choices);
            break;
        default:
            static_cast<void>(_session.TrySetLastNode("n" + std::to_string(choices.Take(4)), _now, _out));
            break;
    }
    Obey();
}

/// Reaches the next node or any other without a command to drive there.
void VehicleOwner::ReachWithoutCommand(Choices& choices)
{
    const std::vector<NodeState> nodes = _session.GetState().nodeStates;
    const std::uint32_t any = choices.Take(16);
    const bool bNext = any > 7 && !nodes.empty();
    static_cast<void>(_session.TryReachNode({bNext ? nodes.front().sequenceID : any, any % 2 == 0}, _now, _out));
}

void VehicleOwner::LeaveCorridor(bool bOutside)
{
    const std::vector<EdgeState> edges = _session.GetState().edgeStates;
    if (_session.TrySetOutsideCorridor(bOutside, _now, _out))
    {
        _outsideEdge = bOutside && !edges.empty() ? std::optional(edges.front().sequenceID) : std::nullopt;
    }
    Obey();
}

void VehicleOwner::Sense(Choices& choices)
{
    BatteryState battery;
    battery.batteryCharge = Measure(choices);
    battery.reach = Measure(choices);
    battery.bCharging = choices.Take(2) == 0;
    _session.OnBattery(battery, _now, _out);
    Load load;
    load.weight = Measure(choices);
    _session.OnLoads(std::vector(choices.Take(3), load), _now, _out);
    VehicleError error;
    error.errorLevel = choices.Take(2) == 0 ? EErrorLevel::Warning : EErrorLevel::Fatal;
    _session.OnErrors(std::vector(choices.Take(5), error), _now, _out);
    const Trajectory line{1, {0.0, 0.0, 1.0, 1.0}, {ControlPoint{}, ControlPoint{1.0, Measure(choices), {}}}};
    static_cast<void>(_session.TrySetTrajectory(choices.Take(8), line, _now, _out));
}

bool VehicleOwner::IsBlocked() const
{
    return std::ranges::any_of(_running, [](const auto& entry) {
        const StartAction& start = entry.second.start;
        return start.scope != EActionScope::Instant && start.action.blockingType != EBlockingType::None;
    });
}

void VehicleOwner::WatchStart(const StartAction& start)
{
    const bool bHard = start.action.blockingType == EBlockingType::Hard;
    if (start.scope != EActionScope::Instant)
    {
        for (const auto& [actionID, other] : _running)
        {
            const bool bBeside = other.start.scope == EActionScope::Instant
                || (!bHard && other.start.action.blockingType != EBlockingType::Hard);
            Require(bBeside, "HARD runs alone");
        }
    }
    const std::vector<EdgeState> edges = _session.GetState().edgeStates;
    Require(
        start.scope != EActionScope::Edge || (!edges.empty() && edges.front().sequenceID == start.sequenceID),
        "an action of an edge begins on its edge");
    const bool bNew = _running.emplace(start.action.actionID, Running{start, false}).second;
    Require(bNew, "an action is started once");
}

void VehicleOwner::WatchDrive(const DriveTo& drive) const
{
    Require(!IsBlocked(), "no drive while a SOFT or HARD action runs");
    Require(drive.node.bReleased && drive.edge.bReleased, "no drive into the horizon");
    Require(_bOrderRuns, "no drive without an order");
    Require(drive.edge.sequenceID != _outsideEdge, "no drive outside of a corridor");
}

std::uint32_t VehicleOwner::ReadHeaderID(const MqttMessage& message)
{
    // Most of what is sent is states, so a state is decoded once, completely.
    if (message.topic.ends_with("/state"))
    {
        const Core::Result<StateMessage> state = _codec.Decode<StateMessage>(message.payload);
        Require(state.has_value(), "a state can be decoded");
        Require(
            !_stateTime.has_value() || _now.steady - *_stateTime >= _minimumInterval,
            "the minimum interval is kept");
        _stateTime = _now.steady;
        return state->header.headerID;
    }
    const Core::Result<MessageIdentity> identity = _codec.DecodeIdentity(message.payload);
    Require(identity.has_value(), "a published message can be decoded");
    return identity->header.headerID;
}

void VehicleOwner::WatchPublished(const MqttMessage& message)
{
    const std::uint32_t headerID = ReadHeaderID(message);
    const auto [known, bFirst] = _headerIDs.try_emplace(message.topic, headerID);
    Require(bFirst || headerID == known->second + 1, "headerId rises by one on each topic");
    known->second = headerID;
}

void VehicleOwner::WatchTaken(const OrderTaken& taken)
{
    if (taken.bUpdate)
    {
        Require(taken.orderID == _orderID, "an update belongs to the present order");
    }
    else
    {
        Require(!_bOrderRuns, "never two orders");
        _lastSequenceID = 0;
        std::erase_if(_statuses, [](const auto& entry) { return IsTerminal(entry.second); });
    }
    _orderID = taken.orderID;
    _bOrderRuns = true;
}

void VehicleOwner::Watch(const VehicleAction& action)
{
    if (const auto* publish = std::get_if<PublishMessage>(&action))
    {
        WatchPublished(publish->message);
    }
    else if (const auto* taken = std::get_if<OrderTaken>(&action))
    {
        WatchTaken(*taken);
    }
    else if (std::holds_alternative<OrderCompleted>(action) || std::holds_alternative<OrderCleared>(action))
    {
        _bOrderRuns = false;
        _leg.reset();
        _outsideEdge.reset();
    }
    else if (const auto* drive = std::get_if<DriveTo>(&action))
    {
        WatchDrive(*drive);
        _leg = *drive;
    }
    else if (const auto* start = std::get_if<StartAction>(&action))
    {
        WatchStart(*start);
    }
    else if (const auto* stop = std::get_if<StopAction>(&action); stop != nullptr && stop->bEdgeEnded)
    {
        _running.erase(stop->actionID);
    }
}

void VehicleOwner::Obey()
{
    for (const VehicleAction& action : std::exchange(_out, {}))
    {
        Watch(action);
    }
    WatchState();
}

void VehicleOwner::WatchRoute(const StateMessage& state)
{
    std::uint32_t last = state.lastNodeSequenceID;
    for (const NodeState& node : state.nodeStates)
    {
        Require(node.sequenceID > last, "the remaining nodes have rising sequence ids");
        last = node.sequenceID;
    }
    Require(state.edgeStates.size() <= state.nodeStates.size(), "no edge without its node");
    for (std::size_t index = 0; index < state.edgeStates.size(); ++index)
    {
        Require(
            state.edgeStates[index].sequenceID + 1 == state.nodeStates[index].sequenceID,
            "each edge leads to its node");
    }
    if (_bOrderRuns)
    {
        Require(state.orderID == _orderID, "the accepted order is the one in the state");
        Require(state.lastNodeSequenceID >= _lastSequenceID, "lastNodeSequenceId rises");
        _lastSequenceID = state.lastNodeSequenceID;
    }
    else
    {
        Require(state.nodeStates.empty() && state.edgeStates.empty(), "an order that has ended has no remaining nodes");
    }
}

void VehicleOwner::WatchActions(const StateMessage& state)
{
    std::map<std::string, EActionStatus> statuses;
    for (const ActionState& action : state.actionStates)
    {
        Require(statuses.emplace(action.actionID, action.actionStatus).second, "an actionId is shown once");
        const auto known = _statuses.find(action.actionID);
        const bool bLeft =
            known != _statuses.end() && IsTerminal(known->second) && action.actionStatus != known->second;
        Require(!bLeft, "FINISHED and FAILED are final");
    }
    for (const auto& [actionID, status] : _statuses)
    {
        const bool bShown = !IsTerminal(status) || statuses.contains(actionID);
        Require(bShown || _limits.stateActionStates.has_value(), "an ended action is listed until a new order");
    }
    _statuses = std::move(statuses);
    // The owner has stopped the actions that the session has failed.
    std::erase_if(_running, [this](const auto& entry) {
        const auto known = _statuses.find(entry.first);
        return known == _statuses.end() || IsTerminal(known->second);
    });
    for (const auto& entry : _running)
    {
        const StartAction& start = entry.second.start;
        const bool bShown =
            std::ranges::find(state.edgeStates, start.sequenceID, &EdgeState::sequenceID) != state.edgeStates.end();
        Require(start.scope != EActionScope::Edge || bShown, "an edge action ends with its edge");
    }
}

void VehicleOwner::WatchBounds(const StateMessage& state) const
{
    Require(state.nodeStates.size() <= _limits.stateNodeStates.value_or(UNLIMITED), "no more nodeStates than stated");
    Require(state.errors.size() <= _limits.stateErrors.value_or(UNLIMITED), "no more errors than stated");
    const bool bPosition = !state.agvPosition.has_value() || std::isfinite(state.agvPosition->x);
    const bool bBattery =
        std::isfinite(state.batteryState.batteryCharge) && std::isfinite(state.batteryState.reach.value_or(0.0));
    const bool bLoads = std::ranges::all_of(state.loads.value_or(std::vector<Load>()), [](const Load& load) {
        return std::isfinite(load.weight.value_or(0.0));
    });
    Require(bPosition && bBattery && bLoads, "a published value is a number");
}

void VehicleOwner::WatchState()
{
    const StateMessage state = _session.GetState();
    WatchRoute(state);
    WatchActions(state);
    WatchBounds(state);
    Require(_session.IsOrderRunning() == _bOrderRuns, "the owner is notified when an order begins and ends");
}

/// Reaches nodes and finishes actions until nothing is left.
void VehicleOwner::Finish()
{
    for (int step = 0; step < MAXIMUM_STEPS; ++step)
    {
        ReachNode();
        _session.OnDrivingChanged(false, _now, _out);
        Obey();
        const std::map<std::string, Running> running = _running;
        for (const auto& entry : running)
        {
            static_cast<void>(_session.TrySetActionStatus(entry.first, EActionStatus::Running, {}, _now, _out));
            if (_session.TrySetActionStatus(entry.first, EActionStatus::Finished, {}, _now, _out))
            {
                _running.erase(entry.first);
            }
            Obey();
        }
        if (!_leg.has_value() && _running.empty())
        {
            return;
        }
    }
    Require(false, "a vehicle without new input ends its order");
}

void VehicleOwner::End()
{
    _session.OnOperatingMode(EOperatingMode::Automatic, _now, _out);
    Obey();
    _session.OnHardwarePause(false, false, _now, _out);
    Obey();
    LeaveCorridor(false);
    SendInstant(ActionTypes::STOP_PAUSE, "end-pause");
    Finish();
    if (_bOrderRuns)
    {
        SendInstant(ActionTypes::CANCEL_ORDER, "end-cancel");
        Finish();
    }
    const StateMessage state = _session.GetState();
    const bool bAllEnded = std::ranges::all_of(state.actionStates, [](const ActionState& action) {
        return IsTerminal(action.actionStatus);
    });
    Require(bAllEnded, "every action ends");
    Require(!_bOrderRuns && state.nodeStates.empty(), "every order ends");
}

} // namespace ACS::Fuzz
