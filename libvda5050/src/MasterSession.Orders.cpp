#include "OrderErrors.hpp"
#include <acs/vda5050/ActionMachine.hpp>
#include <acs/vda5050/EVda5050Error.hpp>
#include <acs/vda5050/MasterSession.hpp>
#include <acs/vda5050/OrderValidator.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <iterator>
#include <utility>

namespace ACS::VDA5050
{

namespace
{

/// By these types an error without an orderId is known as an answer to an order.
constexpr std::array ORDER_ERROR_TYPES{
    ErrorTypes::VALIDATION_ERROR,
    ErrorTypes::ORDER_ERROR,
    ErrorTypes::ORDER_UPDATE_ERROR,
    ErrorTypes::NO_ROUTE_ERROR};

bool IsRequest(std::string_view actionType)
{
    return actionType == ActionTypes::STATE_REQUEST || actionType == ActionTypes::FACTSHEET_REQUEST;
}

/// There are vehicles that take these with exactly this blocking type only.
EBlockingType ChooseBlockingType(const Action& action)
{
    if (IsRequest(action.actionType))
    {
        return EBlockingType::None;
    }
    const bool bHard = action.actionType == ActionTypes::CANCEL_ORDER || action.actionType == ActionTypes::START_PAUSE
        || action.actionType == ActionTypes::STOP_PAUSE;
    return bHard ? EBlockingType::Hard : action.blockingType;
}

Core::Result<void> CheckStructure(const OrderMessage& order)
{
    const std::vector<OrderViolation> violations = ValidateOrder(order);
    if (violations.empty())
    {
        return {};
    }
    return Core::Fail(EVda5050Error::InvalidOrder, {}, violations.front().rule, "order " + order.orderID);
}

} // namespace

Header MasterSession::MakeHeader(ETopic topic, Core::Now now)
{
    Header header = PeekHeader(topic, now);
    ++_headerIDs.at(static_cast<std::size_t>(topic));
    return header;
}

Header MasterSession::PeekHeader(ETopic topic, Core::Now now) const
{
    return Header{
        _headerIDs.at(static_cast<std::size_t>(topic)),
        now.wall,
        std::string(GetVersionText(_options.version)),
        _options.address.manufacturer,
        _options.address.serialNumber};
}

std::string MasterSession::MakeActionID(std::string_view actionType, Core::Now now)
{
    const auto milliseconds = std::chrono::duration_cast<std::chrono::milliseconds>(now.wall.time_since_epoch());
    std::string id = _options.actionIDPrefix;
    id += '-';
    id += actionType;
    id += '-' + std::to_string(milliseconds.count()) + '-' + std::to_string(++_ownActionCount);
    return id;
}

void MasterSession::PublishPayload(ETopic topic, std::string payload, MasterActions& out)
{
    ++_statistics.messagesSent;
    out.emplace_back(PublishMessage{MqttMessage{
        _topics.at(static_cast<std::size_t>(topic)),
        std::move(payload),
        _options.qos.Get(topic),
        IsRetained(topic)}});
}

void MasterSession::PublishOrder(Core::Now now, MasterActions& out)
{
    if (_link != EVehicleLink::Online)
    {
        return; // sent when it comes online
    }
    const Core::SteadyTime earliest = _lastOrderTime.value_or(now.steady) + GetOrderInterval();
    if (_lastOrderTime.has_value() && now.steady < earliest)
    {
        out.emplace_back(StartMasterTimer{EMasterTimer::ResendOrder, earliest - now.steady});
        return;
    }
    _lastOrderTime = now.steady;
    _inFlight->header = MakeHeader(ETopic::Order, now);
    PublishPayload(ETopic::Order, _codec.Encode(*_inFlight, _options.version), out);
    ++_sendCount;
    out.emplace_back(StartMasterTimer{EMasterTimer::ResendOrder, _options.resendInterval});
}

void MasterSession::ResendOrder(Core::Now now, MasterActions& out)
{
    if (!_inFlight.has_value() || _link != EVehicleLink::Online)
    {
        return;
    }
    if (_options.resendCount != 0 && _sendCount > _options.resendCount)
    {
        RejectInFlight({}, "the vehicle never showed the order", out);
        return;
    }
    const std::uint32_t sentBefore = _sendCount;
    PublishOrder(now, out);
    _statistics.ordersResent += sentBefore != 0 && _sendCount != sentBefore ? 1U : 0U;
}

void MasterSession::PublishInstantActions(std::vector<Action> actions, Core::Now now, MasterActions& out)
{
    const std::size_t most = GetMaximumInstantActions();
    while (!actions.empty())
    {
        const auto end = actions.begin() + static_cast<std::ptrdiff_t>(std::min(most, actions.size()));
        InstantActionsMessage message;
        message.header = MakeHeader(ETopic::InstantActions, now);
        message.actions.assign(std::move_iterator(actions.begin()), std::move_iterator(end));
        actions.erase(actions.begin(), end);
        PublishPayload(ETopic::InstantActions, _codec.Encode(message, _options.version), out);
    }
}

void MasterSession::ResendInstantActions(Core::Now now, MasterActions& out)
{
    if (_link != EVehicleLink::Online)
    {
        return;
    }
    std::vector<Action> actions;
    const auto isSpent = [this, &actions, &out](PendingAction& pending) {
        if (_options.resendCount != 0 && pending.sendCount > _options.resendCount)
        {
            out.emplace_back(InstantActionRejected{pending.action.actionID, {}, "the vehicle never showed the action"});
            ForgetAction(pending.action.actionID);
            return true;
        }
        ++pending.sendCount;
        actions.push_back(pending.action);
        return false;
    };
    std::vector<PendingAction> kept;
    for (PendingAction& pending : _pendingActions)
    {
        if (!isSpent(pending))
        {
            kept.push_back(std::move(pending));
        }
    }
    _pendingActions = std::move(kept);
    if (!actions.empty())
    {
        PublishInstantActions(std::move(actions), now, out);
        out.emplace_back(StartMasterTimer{EMasterTimer::ResendInstantActions, _options.resendInterval});
    }
    FollowCancel(out);
}

Core::Result<void> MasterSession::SendOrder(OrderMessage order, Core::Now now, MasterActions& out)
{
    if (_phase != EOrderPhase::None)
    {
        return Core::Fail(EVda5050Error::OrderActive, {}, "no order", _orderID);
    }
    if (!CanTakeOrder())
    {
        return Core::Fail(
            EVda5050Error::VehicleNotReady,
            {},
            "a vehicle that is online, has sent a state and drives by itself",
            _options.address.serialNumber);
    }
    Core::Result<void> check = CheckStructure(order);
    if (check)
    {
        check = FitOrder(order, now);
    }
    if (!check)
    {
        return check;
    }
    _withdrawnOrderID.clear();
    _phase = EOrderPhase::Sent;
    _orderID = order.orderID;
    _lastSentUpdateID = order.orderUpdateID;
    _bAccepted = false;
    _route.clear();
    _reachedNodes = 0;
    _errorsBeforeSend = _state->errors;
    _sendCount = 0;
    _inFlight = std::move(order);
    PublishOrder(now, out);
    return {};
}

std::pair<std::string, std::uint32_t> MasterSession::GetDecisionPoint() const
{
    std::pair<std::string, std::uint32_t> point;
    if (_inFlight.has_value())
    {
        for (const OrderNode& node : _inFlight->nodes)
        {
            point = node.bReleased ? std::pair(node.nodeID, node.sequenceID) : point;
        }
        return point;
    }
    for (const RouteNode& node : _route)
    {
        point = node.bReleased ? std::pair(node.nodeID, node.sequenceID) : point;
    }
    return point;
}

Core::Result<void> MasterSession::SendOrderUpdate(OrderMessage update, Core::Now now, MasterActions& out)
{
    if (_phase != EOrderPhase::Sent && _phase != EOrderPhase::Active)
    {
        return Core::Fail(EVda5050Error::NoOrder, {}, "an order that runs", update.orderID);
    }
    if (_queued.has_value())
    {
        return Core::Fail(EVda5050Error::UpdatePending, {}, "at most one update that waits", _orderID);
    }
    update.orderID = _orderID;
    Core::Result<void> check = CheckStructure(update);
    if (check)
    {
        check = FitOrder(update, now);
    }
    if (!check)
    {
        return check;
    }
    const auto [nodeID, sequenceID] = GetDecisionPoint();
    const OrderNode& first = update.nodes.front();
    if (first.nodeID != nodeID || first.sequenceID != sequenceID)
    {
        return Core::Fail(
            EVda5050Error::InvalidOrder,
            "nodes[0]",
            "the last released node, " + nodeID + " (" + std::to_string(sequenceID) + ")",
            first.nodeID + " (" + std::to_string(first.sequenceID) + ")");
    }
    update.orderUpdateID = ++_lastSentUpdateID;
    if (_inFlight.has_value())
    {
        _queued = std::move(update);
        return {};
    }
    _errorsBeforeSend = _state->errors;
    _sendCount = 0;
    _inFlight = std::move(update);
    PublishOrder(now, out);
    return {};
}

Core::Result<std::string> MasterSession::SendInstantAction(Action action, Core::Now now, MasterActions& out)
{
    if (_link != EVehicleLink::Online)
    {
        return Core::Fail(
            EVda5050Error::VehicleNotReady,
            {},
            "a vehicle that is online",
            _options.address.serialNumber);
    }
    if (action.actionID.empty())
    {
        action.actionID = MakeActionID(action.actionType, now);
    }
    action.blockingType = ChooseBlockingType(action);
    const Core::Result<void> fit = FitInstantAction(action);
    if (!fit)
    {
        return tl::unexpected(fit.error());
    }
    std::string actionID = action.actionID;
    if (!IsRequest(action.actionType))
    {
        _pendingActions.push_back(PendingAction{action, 1});
        _tracked.push_back(TrackedAction{action.actionID, action.actionType, true, false});
        out.emplace_back(StartMasterTimer{EMasterTimer::ResendInstantActions, _options.resendInterval});
    }
    PublishInstantActions({std::move(action)}, now, out);
    return actionID;
}

Core::Result<void> MasterSession::Cancel(Core::Now now, MasterActions& out)
{
    if (_phase == EOrderPhase::None)
    {
        return Core::Fail(EVda5050Error::NoOrder, {}, "an order that runs", {});
    }
    if (_phase == EOrderPhase::Cancelling)
    {
        return {};
    }
    Action action;
    action.actionType = ActionTypes::CANCEL_ORDER;
    Core::Result<std::string> actionID = SendInstantAction(std::move(action), now, out);
    if (!actionID)
    {
        return tl::unexpected(actionID.error());
    }
    _phase = EOrderPhase::Cancelling;
    _cancelActionID = std::move(*actionID);
    // Whether the vehicle has seen what is in flight or not: it must not come again.
    _withdrawn = std::exchange(_inFlight, std::nullopt);
    if (_sendCount == 0)
    {
        _withdrawn.reset();
    }
    _queued.reset();
    out.emplace_back(CancelMasterTimer{EMasterTimer::ResendOrder});
    return {};
}

bool MasterSession::IsPending(std::string_view actionID) const
{
    return std::ranges::any_of(_pendingActions, [actionID](const PendingAction& pending) {
        return pending.action.actionID == actionID;
    });
}

void MasterSession::SettlePendingActions(MasterActions& out)
{
    if (_pendingActions.empty())
    {
        return;
    }
    const auto isSettled = [this, &out](const PendingAction& pending) {
        const std::string& actionID = pending.action.actionID;
        if (std::ranges::find(_state->actionStates, actionID, &ActionState::actionID) != _state->actionStates.end())
        {
            return true;
        }
        const auto refused = std::ranges::find_if(_state->errors, [&actionID](const VehicleError& error) {
            const std::string* reference = FindReferenceOrNull(error, ReferenceKeys::ACTION_ID);
            return reference != nullptr && *reference == actionID;
        });
        if (refused == _state->errors.end())
        {
            return false;
        }
        out.emplace_back(InstantActionRejected{actionID, refused->errorType, refused->errorDescription});
        ForgetAction(actionID);
        return true;
    };
    std::erase_if(_pendingActions, isSettled);
    if (_pendingActions.empty())
    {
        out.emplace_back(CancelMasterTimer{EMasterTimer::ResendInstantActions});
    }
}

void MasterSession::SettleInFlight(Core::Now now, MasterActions& out)
{
    if (!_inFlight.has_value())
    {
        return;
    }
    if (_state->orderID == _inFlight->orderID && _state->orderUpdateID >= _inFlight->orderUpdateID)
    {
        AcceptInFlight(now, out);
        return;
    }
    const VehicleError* rejectionOrNull = FindRejectionOrNull();
    if (rejectionOrNull != nullptr)
    {
        RejectInFlight(rejectionOrNull->errorType, rejectionOrNull->errorDescription, out);
    }
}

void MasterSession::ExtendRoute(const OrderMessage& order)
{
    const bool bFirst = _route.empty();
    const std::uint32_t stitch = order.nodes.front().sequenceID;
    std::erase_if(_route, [stitch](const RouteNode& node) { return node.sequenceID > stitch; });
    for (std::size_t index = bFirst ? 0 : 1; index < order.nodes.size(); ++index)
    {
        const OrderNode& node = order.nodes[index];
        RouteNode& entry = _route.emplace_back(RouteNode{node.nodeID, node.sequenceID, node.bReleased, {}});
        std::ranges::transform(node.actions, std::back_inserter(entry.actionIDs), &Action::actionID);
        if (index > 0)
        {
            std::ranges::transform(
                order.edges[index - 1].actions,
                std::back_inserter(entry.actionIDs),
                &Action::actionID);
        }
    }
}

void MasterSession::AcceptInFlight(Core::Now now, MasterActions& out)
{
    ExtendRoute(*_inFlight);
    TrackOrderActions(*_inFlight);
    // A master that takes an order up again may know less of it than the vehicle has.
    _acceptedUpdateID = std::max(_inFlight->orderUpdateID, _state->orderUpdateID);
    _lastSentUpdateID = std::max(_lastSentUpdateID, _acceptedUpdateID);
    _bAccepted = true;
    _phase = EOrderPhase::Active;
    _inFlight.reset();
    out.emplace_back(CancelMasterTimer{EMasterTimer::ResendOrder});
    out.emplace_back(OrderAccepted{_orderID, _acceptedUpdateID});
    if (_queued.has_value())
    {
        _inFlight = std::exchange(_queued, std::nullopt);
        _errorsBeforeSend = _state->errors;
        _sendCount = 0;
        PublishOrder(now, out);
    }
}

/// The one in flight, and what waits for it: an update on top of a refused one has no place to begin.
void MasterSession::RejectInFlight(const std::string& errorType, const std::string& reason, MasterActions& out)
{
    out.emplace_back(CancelMasterTimer{EMasterTimer::ResendOrder});
    out.emplace_back(OrderRejected{_orderID, _inFlight->orderUpdateID, errorType, reason});
    if (_queued.has_value())
    {
        out.emplace_back(OrderRejected{_orderID, _queued->orderUpdateID, errorType, reason});
    }
    _inFlight.reset();
    _queued.reset();
    if (!_bAccepted)
    {
        EndOrder(out);
    }
}

bool MasterSession::IsRejection(const VehicleError& error) const
{
    const std::string* topicOrNull = FindReferenceOrNull(error, ReferenceKeys::TOPIC);
    if (topicOrNull != nullptr && *topicOrNull != GetTopicName(ETopic::Order))
    {
        return false;
    }
    const std::string* orderOrNull = FindReferenceOrNull(error, ReferenceKeys::ORDER_ID);
    const std::string* updateOrNull = FindReferenceOrNull(error, ReferenceKeys::ORDER_UPDATE_ID);
    // An error of before the sending may stay until an order is taken; after a resend it is an answer to that.
    const bool bOld = _sendCount < 2 && std::ranges::find(_errorsBeforeSend, error) != _errorsBeforeSend.end();
    if (orderOrNull != nullptr)
    {
        const bool bUpdate = updateOrNull == nullptr || *updateOrNull == std::to_string(_inFlight->orderUpdateID);
        return *orderOrNull == _inFlight->orderID && bUpdate && !bOld;
    }
    const bool bNew = std::ranges::find(_errorsBeforeSend, error) == _errorsBeforeSend.end();
    return bNew && std::ranges::find(ORDER_ERROR_TYPES, error.errorType) != ORDER_ERROR_TYPES.end();
}

const VehicleError* MasterSession::FindRejectionOrNull() const
{
    const auto found =
        std::ranges::find_if(_state->errors, [this](const VehicleError& error) { return IsRejection(error); });
    return found == _state->errors.end() ? nullptr : &*found;
}

void MasterSession::TellReachedNodes(MasterActions& out)
{
    const auto isReached = [this](const RouteNode& node) {
        return node.bReleased && node.sequenceID == _state->lastNodeSequenceID && node.nodeID == _state->lastNodeID
            && std::ranges::find(_state->nodeStates, node.sequenceID, &NodeState::sequenceID)
            == _state->nodeStates.end();
    };
    const auto begin = _route.begin() + static_cast<std::ptrdiff_t>(_reachedNodes);
    const auto last = std::find_if(begin, _route.end(), isReached);
    if (last == _route.end())
    {
        return;
    }
    for (auto node = begin; node != std::next(last); ++node)
    {
        out.emplace_back(NodeReached{node->nodeID, node->sequenceID});
    }
    _reachedNodes = static_cast<std::size_t>(std::distance(_route.begin(), last)) + 1;
}

bool MasterSession::IsOrderDone() const
{
    if (_inFlight.has_value() || _reachedNodes != _route.size() || !_state->nodeStates.empty()
        || !_state->edgeStates.empty())
    {
        return false;
    }
    return std::ranges::none_of(_state->actionStates, [this](const ActionState& action) {
        const bool bOfOrder = std::ranges::any_of(_route, [&action](const RouteNode& node) {
            return std::ranges::find(node.actionIDs, action.actionID) != node.actionIDs.end();
        });
        return bOfOrder && !IsTerminal(action.actionStatus);
    });
}

void MasterSession::FollowOrder(MasterActions& out)
{
    if (!_bAccepted || _phase == EOrderPhase::None)
    {
        return;
    }
    if (_state->orderID != _orderID)
    {
        out.emplace_back(OrderLost{
            _orderID,
            _state->orderID.empty() ? "the vehicle holds no order" : "the vehicle holds " + _state->orderID});
        EndOrder(out);
        return;
    }
    TellReachedNodes(out);
    if (_phase == EOrderPhase::Cancelling)
    {
        return;
    }
    if (IsOrderDone())
    {
        out.emplace_back(OrderFinished{_orderID});
        EndOrder(out);
        return;
    }
    const bool bEmpty = _state->nodeStates.empty() && _state->edgeStates.empty();
    if (bEmpty && _reachedNodes != _route.size())
    {
        // A base that is done leaves its horizon in nodeStates; nothing left means that it was dropped.
        out.emplace_back(OrderLost{_orderID, "the vehicle cleared the order"});
        EndOrder(out);
    }
}

void MasterSession::FollowCancel(MasterActions& out)
{
    if (_phase != EOrderPhase::Cancelling || IsPending(_cancelActionID) || !_state.has_value())
    {
        return;
    }
    const auto action = std::ranges::find(_state->actionStates, _cancelActionID, &ActionState::actionID);
    if (action == _state->actionStates.end())
    {
        // Settled without being shown: refused by an error, or never answered.
        EndCancel(EActionStatus::Failed, out);
    }
    else if (IsTerminal(action->actionStatus))
    {
        EndCancel(action->actionStatus, out);
    }
}

void MasterSession::EndCancel(EActionStatus status, MasterActions& out)
{
    const bool bHeld = _bAccepted && _state->orderID == _orderID;
    if (status == EActionStatus::Failed && bHeld && IsOrderDone())
    {
        out.emplace_back(OrderFinished{_orderID});
    }
    else if (status == EActionStatus::Failed && bHeld && !_state->nodeStates.empty())
    {
        out.emplace_back(CancelFailed{_orderID, "the vehicle still holds the order"});
        _phase = EOrderPhase::Active;
        _cancelActionID.clear();
        _withdrawn.reset();
        return;
    }
    else
    {
        out.emplace_back(OrderCancelled{_orderID});
    }
    _withdrawnOrderID = bHeld ? std::string() : _orderID;
    EndOrder(out);
}

void MasterSession::EndOrder(MasterActions& out)
{
    if (_inFlight.has_value())
    {
        out.emplace_back(CancelMasterTimer{EMasterTimer::ResendOrder});
    }
    EndOrderActions(out);
    _phase = EOrderPhase::None;
    _orderID.clear();
    _withdrawn.reset();
    _cancelActionID.clear();
    _inFlight.reset();
    _queued.reset();
    _route.clear();
    _reachedNodes = 0;
    _bAccepted = false;
}

} // namespace ACS::VDA5050
