#include "MasterSession.Impl.hpp"

#include "ActionIndex.hpp"
#include <acs/vda5050/ActionMachine.hpp>
#include <acs/vda5050/EVda5050Error.hpp>

#include <algorithm>
#include <utility>

namespace ACS::VDA5050
{

MasterSession::Impl::Impl(MasterOptions options)
    : _options(std::move(options)),
      _factsheet(_options.factsheet)
{
    for (std::size_t index = 0; index < TOPIC_COUNT; ++index)
    {
        _topics.at(index) = BuildTopic(_options.address, static_cast<ETopic>(index));
    }
}

std::vector<MqttSubscription> MasterSession::Impl::GetSubscriptions() const
{
    std::vector<MqttSubscription> subscriptions;
    for (const ETopic topic : {ETopic::State, ETopic::Visualization, ETopic::Connection, ETopic::Factsheet})
    {
        subscriptions.push_back(MqttSubscription{_topics.at(static_cast<std::size_t>(topic)), _options.qos.Get(topic)});
    }
    return subscriptions;
}

void MasterSession::Impl::OnLinkUp(Core::Now /*now*/, MasterActions& /*out*/)
{
    _bLinkUp = true;
}

void MasterSession::Impl::OnLinkDown(Core::Now /*now*/, MasterActions& out)
{
    _bLinkUp = false;
    _bStateFresh = false;
    _link = EVehicleLink::Unknown;
    for (const EMasterTimer timer :
         {EMasterTimer::ResendOrder, EMasterTimer::ResendInstantActions, EMasterTimer::Silence})
    {
        out.emplace_back(CancelMasterTimer{timer});
    }
}

void MasterSession::Impl::OnMessage(
    std::string_view topic,
    std::string_view payload,
    bool bRetained,
    Core::Now now,
    MasterActions& out)
{
    const auto* const found = std::ranges::find(_topics, topic);
    if (found == _topics.end() || !_bLinkUp)
    {
        return;
    }
    const auto said = static_cast<ETopic>(found - _topics.begin());
    if (bRetained && !IsRetained(said))
    {
        // A topic that must not be retained: its age is unknown, so it proves neither life nor progress of an order.
        ++_statistics.retainedIgnored;
        return;
    }
    switch (said)
    {
        case ETopic::State:
            OnState(payload, now, out);
            break;
        case ETopic::Visualization:
            OnVisualization(payload, out);
            break;
        case ETopic::Connection:
            OnConnection(payload, now, out);
            break;
        case ETopic::Factsheet:
            OnFactsheet(payload, out);
            break;
        case ETopic::Order:
        case ETopic::InstantActions:
        default:
            break; // what masters send
    }
}

void MasterSession::Impl::OnTimer(EMasterTimer timer, Core::Now now, MasterActions& out)
{
    switch (timer)
    {
        case EMasterTimer::ResendOrder:
            ResendOrder(now, out);
            break;
        case EMasterTimer::ResendInstantActions:
            ResendInstantActions(now, out);
            break;
        case EMasterTimer::Silence:
            CheckSilence(now, out);
            break;
        default:
            break;
    }
}

void MasterSession::Impl::Refuse(ETopic topic, Core::Error error, MasterActions& out)
{
    ++_statistics.messagesRefused;
    _statistics.lastRefusal = std::string(GetTopicName(topic)) + ": " + Core::Describe(error);
    out.emplace_back(MessageRefused{topic, std::move(error)});
}

/// An empty version is accepted, like empty names: the topic has both.
bool MasterSession::Impl::IsForeign(ETopic topic, const Header& header, MasterActions& out)
{
    if (std::optional<Core::Error> foreign = FindForeignNameOrNull(header, _options.address))
    {
        Refuse(topic, std::move(*foreign), out);
        return true;
    }
    if (!header.version.empty())
    {
        constexpr std::size_t LONGEST_VERSION = 32;
        _statistics.lastVersion = header.version.substr(0, LONGEST_VERSION);
    }
    if (!header.version.empty() && !ReadVersionOrNull(header.version).has_value())
    {
        Refuse(
            topic,
            Core::Error{make_error_code(EVda5050Error::UnsupportedVersion), "version", "2.x", header.version},
            out);
        return true;
    }
    return false;
}

void MasterSession::Impl::OnConnection(std::string_view payload, Core::Now now, MasterActions& out)
{
    const Core::Result<ConnectionMessage> message = _codec.Decode<ConnectionMessage>(payload);
    if (!message)
    {
        Refuse(ETopic::Connection, message.error(), out);
        return;
    }
    if (IsForeign(ETopic::Connection, message->header, out))
    {
        return;
    }
    switch (message->connectionState)
    {
        case EConnectionState::Online:
            _bNumbersKnown = false;
            if (_link != EVehicleLink::Online)
            {
                OnVehicleOnline(now, out);
            }
            break;
        case EConnectionState::Offline:
            OnVehicleGone(EVehicleLink::Offline, out);
            break;
        case EConnectionState::ConnectionBroken:
            OnVehicleGone(EVehicleLink::Broken, out);
            break;
        default:
            break;
    }
}

void MasterSession::Impl::OnVehicleOnline(Core::Now now, MasterActions& out)
{
    _link = EVehicleLink::Online;
    _bSilent = false;
    _bStateFresh = false;
    _lastStateTime = now.steady;
    out.emplace_back(VehicleOnline{});
    out.emplace_back(StartMasterTimer{EMasterTimer::Silence, GetAllowedSilence()});
    std::vector<Action> requests;
    const auto ask = [this, now, &requests](std::string_view actionType) {
        Action& action = requests.emplace_back();
        action.actionType = actionType;
        action.actionID = MakeActionID(actionType, now);
    };
    if (_options.bStateRequested)
    {
        ask(ActionTypes::STATE_REQUEST);
    }
    if (_options.bFactsheetRequested)
    {
        ask(ActionTypes::FACTSHEET_REQUEST);
    }
    if (!requests.empty())
    {
        PublishInstantActions(std::move(requests), now, out);
    }
    _bAwaySinceSend = _inFlight.has_value() && _sendCount > 0;
    if (!_bAwaySinceSend || _bAccepted)
    {
        ResendOrder(now, out);
    }
    ResendInstantActions(now, out);
}

void MasterSession::Impl::OnVehicleGone(EVehicleLink link, MasterActions& out)
{
    if (_link == link)
    {
        return; // a repeated retained message, or a will after it was read once
    }
    _link = link;
    _bStateFresh = false;
    for (const EMasterTimer timer :
         {EMasterTimer::ResendOrder, EMasterTimer::ResendInstantActions, EMasterTimer::Silence})
    {
        out.emplace_back(CancelMasterTimer{timer});
    }
    if (link == EVehicleLink::Broken)
    {
        out.emplace_back(VehicleBroken{});
    }
    else
    {
        out.emplace_back(VehicleOffline{});
    }
}

/// The timer is not moved at each state: it looks back when it ends, and waits for the rest.
void MasterSession::Impl::CheckSilence(Core::Now now, MasterActions& out)
{
    if (_link != EVehicleLink::Online || _bSilent)
    {
        return;
    }
    const Core::Duration allowed = GetAllowedSilence();
    const Core::Duration age = now.steady - _lastStateTime;
    if (age < allowed)
    {
        out.emplace_back(StartMasterTimer{EMasterTimer::Silence, allowed - age});
        return;
    }
    _bSilent = true;
    out.emplace_back(VehicleSilent{age});
}

/// Both must be older: clocks are set. After a restart both may be, and its ONLINE comes first.
bool MasterSession::Impl::IsStale(const StateMessage& state) const
{
    return _bNumbersKnown && _state.has_value() && state.header.headerID < _state->header.headerID
        && state.header.timestamp < _state->header.timestamp;
}

void MasterSession::Impl::OnState(std::string_view payload, Core::Now now, MasterActions& out)
{
    Core::Result<StateMessage> state = _codec.Decode<StateMessage>(payload);
    if (!state)
    {
        Refuse(ETopic::State, state.error(), out);
        return;
    }
    if (IsForeign(ETopic::State, state->header, out))
    {
        return;
    }
    if (IsStale(*state))
    {
        ++_statistics.statesIgnored;
        return;
    }
    ++_statistics.statesReceived;
    if (_link == EVehicleLink::Unknown || _link == EVehicleLink::Broken)
    {
        // It lives, whatever became of its connection message; and the will of a connection that it had before, under
        // another client id, may come after the ONLINE of the present one.
        OnVehicleOnline(now, out);
    }
    _lastStateTime = now.steady;
    _bStateFresh = true;
    _bNumbersKnown = true;
    const bool bWasLed = IsUnderMasterControl();
    if (_bSilent && _link == EVehicleLink::Online)
    {
        _bSilent = false;
        out.emplace_back(StartMasterTimer{EMasterTimer::Silence, GetAllowedSilence()});
    }
    const std::optional<StateMessage> previous = std::exchange(_state, std::move(*state));
    out.emplace_back(StateReceived{});
    if (_state->agvPosition.has_value())
    {
        out.emplace_back(PositionReceived{*_state->agvPosition, _state->velocity});
    }
    SettleInFlight(now, out);
    const ActionIndex shown(_state->actionStates);
    ReportDifferences(previous, shown, out);
    SettlePendingActions(shown, out);
    UpdateActions(shown, out);
    UpdateOrder(out);
    UpdateCancel(out);
    SendQueued(now, out);
    CancelReappeared(now, out);
    if (!bWasLed && IsUnderMasterControl())
    {
        ResendOrder(now, out);
        ResendInstantActions(now, out);
    }
}

void MasterSession::Impl::OnVisualization(std::string_view payload, MasterActions& out)
{
    const Core::Result<VisualizationMessage> message = _codec.Decode<VisualizationMessage>(payload);
    if (!message)
    {
        Refuse(ETopic::Visualization, message.error(), out);
        return;
    }
    if (IsForeign(ETopic::Visualization, message->header, out))
    {
        return;
    }
    if (message->agvPosition.has_value())
    {
        out.emplace_back(PositionReceived{*message->agvPosition, message->velocity});
    }
}

void MasterSession::Impl::OnFactsheet(std::string_view payload, MasterActions& out)
{
    Core::Result<FactsheetMessage> message = _codec.Decode<FactsheetMessage>(payload);
    if (!message)
    {
        Refuse(ETopic::Factsheet, message.error(), out);
        return;
    }
    if (IsForeign(ETopic::Factsheet, message->header, out))
    {
        return;
    }
    _factsheet = std::move(*message);
    out.emplace_back(FactsheetReceived{});
}

/// Of a repeated action or error, only the first is reported: otherwise each state would report a change again.
void MasterSession::Impl::ReportDifferences(
    const std::optional<StateMessage>& previousOrNull,
    const ActionIndex& shown,
    MasterActions& out) const
{
    const StateMessage none;
    const StateMessage& before = previousOrNull.has_value() ? *previousOrNull : none;
    const ActionIndex actionsBefore(before.actionStates);
    for (const ActionState& action : _state->actionStates)
    {
        const ActionState* const known = actionsBefore.FindOrNull(action.actionID);
        const bool bSame = known != nullptr && known->actionStatus == action.actionStatus
            && known->resultDescription == action.resultDescription;
        if (!bSame && shown.FindOrNull(action.actionID) == &action)
        {
            out.emplace_back(
                ActionChanged{action.actionID, action.actionType, action.actionStatus, action.resultDescription});
        }
    }
    const SortedIndex<VehicleError> errorsBefore(before.errors);
    const SortedIndex<VehicleError> errorsNow(_state->errors);
    const auto report = [&out](const auto& errors, const auto& own, const auto& other, bool bActive) {
        for (const VehicleError& error : errors)
        {
            if (other.FindOrNull(error) == nullptr && own.FindOrNull(error) == &error)
            {
                out.emplace_back(VehicleErrorChanged{error, bActive});
            }
        }
    };
    report(_state->errors, errorsNow, errorsBefore, true);
    report(before.errors, errorsBefore, errorsNow, false);
}

EVehicleLink MasterSession::Impl::GetLink() const noexcept
{
    return _link;
}

EOrderPhase MasterSession::Impl::GetOrderPhase() const noexcept
{
    return _phase;
}

const std::string& MasterSession::Impl::GetOrderID() const noexcept
{
    return _orderID;
}

bool MasterSession::Impl::IsReady() const
{
    return _link == EVehicleLink::Online && _bStateFresh && !_bSilent;
}

bool MasterSession::Impl::CanTakeOrder() const
{
    return IsReady() && _phase == EOrderPhase::None && IsUnderMasterControl() && !IsBusy();
}

bool MasterSession::Impl::IsBusy() const
{
    return _state.has_value() && !(_state->nodeStates.empty() && _state->edgeStates.empty());
}

bool MasterSession::Impl::IsUnderMasterControl() const
{
    return !_state.has_value() || IsLedByMaster(_state->operatingMode);
}

const StateMessage* MasterSession::Impl::GetStateOrNull() const noexcept
{
    return _state.has_value() ? &*_state : nullptr;
}

const FactsheetMessage* MasterSession::Impl::GetFactsheetOrNull() const noexcept
{
    return _factsheet.has_value() ? &*_factsheet : nullptr;
}

const MasterStatistics& MasterSession::Impl::GetStatistics() const noexcept
{
    return _statistics;
}

const MasterOptions& MasterSession::Impl::GetOptions() const noexcept
{
    return _options;
}

} // namespace ACS::VDA5050
