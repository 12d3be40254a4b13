#include "MasterSession.Impl.hpp"

#include <acs/vda5050/ActionMachine.hpp>

#include <algorithm>
#include <iterator>
#include <utility>

namespace ACS::VDA5050
{

MasterSession::Impl::Impl(MasterOptions options)
    : _options(std::move(options))
{
}

void MasterSession::Impl::OnLinkUp(Core::Now /*now*/, MasterActions& /*out*/)
{
    _vehicle.OnLinkUp();
}

void MasterSession::Impl::OnLinkDown(Core::Now /*now*/, MasterActions& out)
{
    _vehicle.OnLinkDown(out);
}

void MasterSession::Impl::OnMessage(
    std::string_view topic,
    std::string_view payload,
    bool bRetained,
    Core::Now now,
    MasterActions& out)
{
    const std::optional<ETopic> recognized =
        _vehicle.IsLinkUp() ? _topics.RecognizeOrNull(topic, bRetained) : std::nullopt;
    if (!recognized.has_value())
    {
        return;
    }
    switch (*recognized)
    {
        case ETopic::State:
            OnState(payload, now, out);
            break;
        case ETopic::Visualization:
            OnVisualization(payload, out);
            break;
        case ETopic::Connection:
            OnConnection(payload, bRetained, now, out);
            break;
        case ETopic::Factsheet:
            if (std::optional<FactsheetMessage> factsheet =
                    _topics.ReadOrNull<FactsheetMessage>(ETopic::Factsheet, payload, out))
            {
                _rules.OnFactsheet(std::move(*factsheet), out);
            }
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
            PublishOrder(now, out);
            break;
        case EMasterTimer::ResendInstantActions:
            ResendInstantActions(now, out);
            break;
        case EMasterTimer::Silence:
            _vehicle.CheckSilence(_rules.GetAllowedSilence(), now, out);
            break;
        default:
            break;
    }
}

void MasterSession::Impl::OnConnection(std::string_view payload, bool bRetained, Core::Now now, MasterActions& out)
{
    const std::optional<ConnectionMessage> message =
        _topics.ReadOrNull<ConnectionMessage>(ETopic::Connection, payload, out);
    if (!message.has_value())
    {
        return;
    }
    const bool bRestarted = !bRetained && _vehicle.WasRestarted(message->header);
    _vehicle.SetConnectionHeader(message->header);
    switch (message->connectionState)
    {
        case EConnectionState::Online:
            _vehicle.OnRestartedNumbers();
            if (!_vehicle.IsOnline() || bRestarted)
            {
                OnVehicleOnline(now, out);
            }
            break;
        case EConnectionState::Offline:
            _vehicle.OnGone(EVehicleLink::Offline, out);
            break;
        case EConnectionState::ConnectionBroken:
            _vehicle.OnGone(EVehicleLink::Broken, out);
            break;
        default:
            break;
    }
}

void MasterSession::Impl::OnVehicleOnline(Core::Now now, MasterActions& out)
{
    _vehicle.OnOnline(_rules.GetAllowedSilence(), now, out);
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
    PublishInstantActions(std::move(requests), now, out);
    _outbox.OnVehicleOnline();
    ResendInstantActions(now, out);
}

void MasterSession::Impl::OnState(std::string_view payload, Core::Now now, MasterActions& out)
{
    std::optional<StateMessage> state = _topics.ReadOrNull<StateMessage>(ETopic::State, payload, out);
    if (!state.has_value())
    {
        return;
    }
    const bool bStale = _vehicle.IsStale(*state);
    _topics.CountState(bStale);
    if (bStale)
    {
        return;
    }
    if (_vehicle.GetLink() == EVehicleLink::Unknown || _vehicle.GetLink() == EVehicleLink::Broken)
    {
        // It lives, whatever became of its connection message; and the will of a connection that it had before, under
        // another client id, may come after the ONLINE of the present one.
        OnVehicleOnline(now, out);
    }
    const bool bFirst = !_vehicle.HasStateSinceOnline();
    const bool bWasLed = _vehicle.IsUnderMasterControl();
    const std::optional<StateMessage> previous =
        _vehicle.ReplaceStateOrNull(std::move(*state), _rules.GetAllowedSilence(), now, out);
    const StateMessage& present = *_vehicle.GetStateOrNull();
    const ActionIndex shown(present.actionStates);
    SettleInFlight(shown, out);
    _vehicle.ReportDifferences(previous, shown, out);
    RemoveTracked(_pendingActions.OnState(present, shown, _cancelActionID, out));
    _actions.Update(shown, out);
    UpdateOrder(out);
    UpdateCancel(out);
    const bool bStarted = GetOrderPhase() == EOrderPhase::Active && _outbox.TryStartQueued(present);
    CancelReappeared(now, out);
    const bool bBecameLed = !bWasLed && _vehicle.IsUnderMasterControl();
    if (bFirst || bStarted || bBecameLed)
    {
        PublishOrder(now, out); // once: each resend weakens what a later error proves
    }
    if (bBecameLed)
    {
        ResendInstantActions(now, out);
    }
}

void MasterSession::Impl::OnVisualization(std::string_view payload, MasterActions& out)
{
    const std::optional<VisualizationMessage> message =
        _topics.ReadOrNull<VisualizationMessage>(ETopic::Visualization, payload, out);
    if (message.has_value() && message->agvPosition.has_value())
    {
        out.emplace_back(PositionReceived{*message->agvPosition, message->velocity});
    }
}

std::vector<ReservedElement> MasterSession::Impl::ListReserved() const
{
    std::vector<ReservedElement> reserved;
    if (const StateMessage* const state = _vehicle.GetStateOrNull())
    {
        if (!state->lastNodeID.empty())
        {
            reserved.push_back(ReservedElement{state->lastNodeID, state->lastNodeSequenceID, false, true});
        }
        for (const NodeState& node : state->nodeStates)
        {
            if (node.bReleased)
            {
                reserved.push_back(ReservedElement{node.nodeID, node.sequenceID, false, true});
            }
        }
        for (const EdgeState& edge : state->edgeStates)
        {
            if (edge.bReleased)
            {
                reserved.push_back(ReservedElement{edge.edgeID, edge.sequenceID, true, true});
            }
        }
        std::ranges::stable_sort(reserved, {}, &ReservedElement::sequenceID);
    }
    const OrderMessage* const open = _outbox.GetSentOrNull();
    if (open == nullptr)
    {
        return reserved;
    }
    std::vector<ReservedElement> sent;
    const auto add = [&reserved, &sent](const std::string& elementID, std::uint32_t sequenceID, bool bEdge) {
        const ReservedElement element{elementID, sequenceID, bEdge, true};
        if (std::ranges::find(reserved, element) == reserved.end())
        {
            sent.push_back(ReservedElement{elementID, sequenceID, bEdge, false});
        }
    };
    for (const OrderNode& node : open->nodes)
    {
        if (node.bReleased)
        {
            add(node.nodeID, node.sequenceID, false);
        }
    }
    for (const OrderEdge& edge : open->edges)
    {
        if (edge.bReleased)
        {
            add(edge.edgeID, edge.sequenceID, true);
        }
    }
    std::ranges::stable_sort(sent, {}, &ReservedElement::sequenceID);
    std::ranges::move(sent, std::back_inserter(reserved));
    return reserved;
}

EOrderPhase MasterSession::Impl::GetOrderPhase() const noexcept
{
    if (_orderID.empty())
    {
        return EOrderPhase::None;
    }
    if (!_cancelActionID.empty())
    {
        return EOrderPhase::Cancelling;
    }
    return _outbox.IsAccepted() ? EOrderPhase::Active : EOrderPhase::Sent;
}

const std::string& MasterSession::Impl::GetOrderID() const noexcept
{
    return _orderID;
}

bool MasterSession::Impl::CanTakeOrder() const
{
    return _orderID.empty() && _vehicle.IsReady() && _vehicle.IsUnderMasterControl() && !_vehicle.IsBusy();
}

const MasterTopics& MasterSession::Impl::GetTopics() const noexcept
{
    return _topics;
}

const FactsheetRules& MasterSession::Impl::GetRules() const noexcept
{
    return _rules;
}

const VehicleView& MasterSession::Impl::GetVehicle() const noexcept
{
    return _vehicle;
}

const MasterOptions& MasterSession::Impl::GetOptions() const noexcept
{
    return _options;
}

} // namespace ACS::VDA5050
