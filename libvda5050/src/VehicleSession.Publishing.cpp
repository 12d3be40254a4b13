#include "StateBounds.hpp"
#include "StateRoom.hpp"
#include "VehicleSession.Impl.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace ACS::VDA5050
{

Header VehicleSession::Impl::MakeHeader(ETopic topic, Core::Now now)
{
    return Header{
        _headerIDs.at(static_cast<std::size_t>(topic))++,
        now.wall,
        std::string(GetVersionText(_options.version)),
        _options.address.manufacturer,
        _options.address.serialNumber};
}

template <typename TMessage>
MqttMessage VehicleSession::Impl::MakeMessage(ETopic topic, const TMessage& message)
{
    constexpr std::size_t SLACK = 64; // numbers have more digits at one time than at another
    const auto index = static_cast<std::size_t>(topic);
    MqttMessage made{_topics.at(index), {}, _options.qos.Get(topic), IsRetained(topic)};
    made.payload.reserve(_payloadBytes.at(index) + SLACK);
    _codec.Encode(message, _options.version, made.payload);
    _payloadBytes.at(index) = made.payload.size();
    return made;
}

MqttWill VehicleSession::Impl::MakeWill(Core::Now now)
{
    ConnectionMessage message;
    message.header = MakeHeader(ETopic::Connection, now);
    message.connectionState = EConnectionState::ConnectionBroken;
    return MqttWill{MakeMessage(ETopic::Connection, message)};
}

void VehicleSession::Impl::OnLinkUp(Core::Now now, VehicleActions& out)
{
    _bLinkUp = true;
    PublishConnection(EConnectionState::Online, now, out);
    PublishFactsheet(now, out);
    _bStateDue = true;
    Settle(now, out);
    if (_options.visualizationInterval.count() > 0)
    {
        out.emplace_back(StartVehicleTimer{EVehicleTimer::Visualization, _options.visualizationInterval});
    }
}

void VehicleSession::Impl::OnLinkDown(Core::Now /*now*/, VehicleActions& out)
{
    _bLinkUp = false;
    _bMinimumTimerRuns = false;
    for (const EVehicleTimer timer :
         {EVehicleTimer::MinimumStateInterval, EVehicleTimer::MaximumStateInterval, EVehicleTimer::Visualization})
    {
        out.emplace_back(CancelVehicleTimer{timer});
    }
}

void VehicleSession::Impl::Leave(Core::Now now, VehicleActions& out)
{
    if (_bLinkUp)
    {
        PublishConnection(EConnectionState::Offline, now, out);
        OnLinkDown(now, out);
    }
}

void VehicleSession::Impl::OnTimer(EVehicleTimer timer, Core::Now now, VehicleActions& out)
{
    if (!_bLinkUp)
    {
        return;
    }
    switch (timer)
    {
        case EVehicleTimer::MinimumStateInterval:
            _bMinimumTimerRuns = false;
            Settle(now, out);
            break;
        case EVehicleTimer::MaximumStateInterval:
            _bStateDue = true;
            Settle(now, out);
            break;
        case EVehicleTimer::Visualization:
            PublishVisualization(now, out);
            out.emplace_back(StartVehicleTimer{EVehicleTimer::Visualization, _options.visualizationInterval});
            break;
        default:
            break;
    }
}

void VehicleSession::Impl::Settle(Core::Now now, VehicleActions& out)
{
    if (!_bStateDue || !_bLinkUp)
    {
        return;
    }
    const Core::SteadyTime due =
        _lastStateTime.has_value() ? *_lastStateTime + _options.minimumStateInterval : now.steady;
    if (now.steady >= due)
    {
        PublishState(now, out);
        return;
    }
    if (!_bMinimumTimerRuns)
    {
        _bMinimumTimerRuns = true;
        out.emplace_back(StartVehicleTimer{EVehicleTimer::MinimumStateInterval, due - now.steady});
    }
}

StateMessage VehicleSession::Impl::GetState() const
{
    StateMessage state;
    state.header.manufacturer = _options.address.manufacturer;
    state.header.serialNumber = _options.address.serialNumber;
    state.maps = _maps;
    state.orderID = _orderID;
    state.orderUpdateID = _orderUpdateID;
    state.zoneSetID = _zoneSetID;
    state.lastNodeID = _lastNodeID;
    state.lastNodeSequenceID = _lastNodeSequenceID;
    state.nodeStates.reserve(_route.GetSize());
    for (std::size_t index = 0; index < _route.GetSize(); ++index)
    {
        state.nodeStates.push_back(_route.GetNodeState(index));
    }
    // 6.6.3: a cancelled vehicle on its way to the next node shows that node alone, once the edge's actions have ended.
    const std::size_t shownEdges = _bLastLeg && !HasRunningEdgeAction() ? 0 : _route.GetSize();
    state.edgeStates.reserve(shownEdges);
    for (std::size_t index = 0; index < shownEdges; ++index)
    {
        state.edgeStates.push_back(_route.GetEdgeState(index));
    }
    state.agvPosition = _position;
    state.velocity = _velocity;
    state.loads = _loads;
    state.bDriving = _bDriving;
    state.bPaused = IsPaused() && IsStationary();
    state.bNewBaseRequest = NeedsNewBase();
    state.distanceSinceLastNode = _distanceSinceLastNode;
    state.actionStates.reserve(_actions.GetSize());
    for (const ReportedAction& tracked : _actions)
    {
        state.actionStates.push_back(tracked.machine.GetState());
    }
    state.batteryState = _battery;
    state.operatingMode = _operatingMode;
    state.errors = _ownerErrors;
    std::ranges::transform(_sessionErrors, std::back_inserter(state.errors), &SessionError::error);
    state.information = _information;
    if (_corridorError.has_value())
    {
        state.errors.push_back(*_corridorError);
    }
    state.safetyState = _safety;
    FitState(state, _options.factsheet.protocolLimits.maxArrayLengths);
    return state;
}

void VehicleSession::Impl::PublishState(Core::Now now, VehicleActions& out)
{
    if (!_bLinkUp)
    {
        return;
    }
    StateMessage state = GetState();
    state.header = MakeHeader(ETopic::State, now);
    MqttMessage message = MakeMessage(ETopic::State, state);
    if (message.payload.size() > CodecLimits{}.payloadBytes)
    {
        DropTextsForPeople(state);
        message = MakeMessage(ETopic::State, state);
    }
    out.emplace_back(PublishMessage{std::move(message)});
    for (ReportedAction& tracked : _actions)
    {
        tracked.bShown = tracked.IsEnded();
    }
    for (SessionError& known : _sessionErrors)
    {
        known.bShown = true;
    }
    if (_bMinimumTimerRuns)
    {
        _bMinimumTimerRuns = false;
        out.emplace_back(CancelVehicleTimer{EVehicleTimer::MinimumStateInterval});
    }
    _bStateDue = false;
    _lastStateTime = now.steady;
    out.emplace_back(StartVehicleTimer{EVehicleTimer::MaximumStateInterval, _options.maximumStateInterval});
}

void VehicleSession::Impl::PublishFactsheet(Core::Now now, VehicleActions& out)
{
    if (!_bLinkUp)
    {
        return;
    }
    _options.factsheet.header = MakeHeader(ETopic::Factsheet, now);
    out.emplace_back(PublishMessage{MakeMessage(ETopic::Factsheet, _options.factsheet)});
}

void VehicleSession::Impl::PublishVisualization(Core::Now now, VehicleActions& out)
{
    if (!_position.has_value())
    {
        return;
    }
    VisualizationMessage message;
    message.header = MakeHeader(ETopic::Visualization, now);
    message.agvPosition = _position;
    message.velocity = _velocity;
    out.emplace_back(PublishMessage{MakeMessage(ETopic::Visualization, message)});
}

void VehicleSession::Impl::PublishConnection(EConnectionState state, Core::Now now, VehicleActions& out)
{
    ConnectionMessage message;
    message.header = MakeHeader(ETopic::Connection, now);
    message.connectionState = state;
    out.emplace_back(PublishMessage{MakeMessage(ETopic::Connection, message)});
}

} // namespace ACS::VDA5050
