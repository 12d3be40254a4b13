#include "ActionIndex.hpp"
#include "MasterSession.Impl.hpp"
#include "OrderErrors.hpp"
#include <acs/vda5050/ActionMachine.hpp>

#include <algorithm>
#include <array>
#include <charconv>
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

constexpr const char* NO_UPDATE_ID = "no orderUpdateId is left for an update: the vehicle shows the last one";

} // namespace

bool MasterSession::Impl::IsPending(std::string_view actionID) const
{
    return std::ranges::any_of(_pendingActions, [actionID](const PendingAction& pending) {
        return pending.action.actionID == actionID;
    });
}

bool MasterSession::Impl::IsTracked(std::string_view actionID) const
{
    return std::ranges::find(_tracked, actionID, &TrackedAction::actionID) != _tracked.end();
}

bool MasterSession::Impl::IsCancelLate(const PendingAction& pending) const
{
    if (pending.action.actionType != ActionTypes::CANCEL_ORDER || pending.action.actionID == _cancelActionID)
    {
        return false;
    }
    const bool bActs = std::ranges::any_of(_state->actionStates, [](const ActionState& action) {
        return !IsTerminal(action.actionStatus);
    });
    return _state->orderID != pending.orderID || (_state->nodeStates.empty() && _state->edgeStates.empty() && !bActs);
}

void MasterSession::Impl::SettlePendingActions(const ActionIndex& shown, MasterActions& out)
{
    if (_pendingActions.empty())
    {
        return;
    }
    const auto isSettled = [this, &shown, &out](const PendingAction& pending) {
        const std::string& actionID = pending.action.actionID;
        if (shown.FindOrNull(actionID) != nullptr)
        {
            return true;
        }
        const auto refused = std::ranges::find_if(_state->errors, [&actionID](const VehicleError& error) {
            const std::string* reference = FindReferenceOrNull(error, ReferenceKeys::ACTION_ID);
            return reference != nullptr && *reference == actionID;
        });
        if (refused == _state->errors.end() && IsCancelLate(pending))
        {
            out.emplace_back(InstantActionRejected{actionID, {}, "the order has ended before it was cancelled"});
            RemoveTrackedAction(actionID);
            return true;
        }
        if (refused == _state->errors.end())
        {
            return false;
        }
        out.emplace_back(InstantActionRejected{actionID, refused->errorType, refused->errorDescription});
        RemoveTrackedAction(actionID);
        return true;
    };
    std::erase_if(_pendingActions, isSettled);
    if (_pendingActions.empty())
    {
        out.emplace_back(CancelMasterTimer{EMasterTimer::ResendInstantActions});
    }
}

void MasterSession::Impl::SettleInFlight(Core::Now now, MasterActions& out)
{
    if (!_inFlight.has_value())
    {
        return;
    }
    if (_echo == EEcho::Impossible)
    {
        RenumberUnsent(out);
        return; // nothing that the vehicle shows is an answer
    }
    if (_state->orderID == _inFlight->orderID && _state->orderUpdateID >= _inFlight->orderUpdateID)
    {
        AcceptInFlight(out);
        return;
    }
    const VehicleError* rejectionOrNull = FindRejectionOrNull();
    if (rejectionOrNull != nullptr)
    {
        RejectInFlight(rejectionOrNull->errorType, rejectionOrNull->errorDescription, out);
        return;
    }
    if (IsInFlightDoubtful())
    {
        DropInFlight(out);
    }
    else if (std::exchange(_bAwaySinceSend, false) && !_bAccepted)
    {
        ResendOrder(now, out);
    }
}

void MasterSession::Impl::RenumberUnsent(MasterActions& out)
{
    if (_state->orderID != _inFlight->orderID || _state->orderUpdateID < _inFlight->orderUpdateID)
    {
        return;
    }
    if (!_bAccepted)
    {
        RejectInFlight({}, "before the order was sent, the vehicle showed another one with its orderId", out);
    }
    else if (!TryRenumber(*_inFlight) || (_queued.has_value() && !TryRenumber(*_queued)))
    {
        RejectInFlight({}, NO_UPDATE_ID, out);
    }
}

/// With its old number it would count as accepted at once, and the vehicle would ignore it.
bool MasterSession::Impl::TryRenumber(OrderMessage& update)
{
    const std::optional<std::uint32_t> updateID = TakeUpdateIDOrNull();
    if (updateID.has_value())
    {
        std::ranges::replace(_continuedUpdateIDs, update.orderUpdateID, *updateID);
        update.orderUpdateID = *updateID;
    }
    return updateID.has_value();
}

bool MasterSession::Impl::IsInFlightDoubtful() const
{
    if (_bAccepted || _sendCount == 0)
    {
        return false;
    }
    const bool bForgot = _state->orderID.empty() && !_orderIDBeforeSend.empty();
    const bool bUnknown = _orderIDBeforeSend.empty() || _state->orderID != _orderIDBeforeSend;
    return bForgot || (_bAwaySinceSend && bUnknown);
}

void MasterSession::Impl::DropInFlight(MasterActions& out)
{
    Withdraw(&*_inFlight, true);
    out.emplace_back(OrderLost{
        _orderID,
        "the vehicle was restarted, or not connected, after the order was sent, and may have executed it"});
    EndOrder(out);
}

void MasterSession::Impl::ExtendRoute(const OrderMessage& order)
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

void MasterSession::Impl::AddToRoute(const OrderMessage& order)
{
    ExtendRoute(order);
    TrackOrderActions(order);
    _bAccepted = true;
    _phase = EOrderPhase::Active;
}

void MasterSession::Impl::AcceptInFlight(MasterActions& out)
{
    AddToRoute(*_inFlight);
    // A master that takes an order up again may know less of it than the vehicle has.
    _acceptedUpdateID = std::max(_inFlight->orderUpdateID, _state->orderUpdateID);
    _lastSentUpdateID = std::max(_lastSentUpdateID, _acceptedUpdateID);
    const bool bRenumbered =
        !_queued.has_value() || _queued->orderUpdateID > _acceptedUpdateID || TryRenumber(*_queued);
    std::erase_if(_continuedUpdateIDs, [this](std::uint32_t updateID) { return updateID < _acceptedUpdateID; });
    _inFlight.reset();
    out.emplace_back(CancelMasterTimer{EMasterTimer::ResendOrder});
    out.emplace_back(OrderAccepted{_orderID, _acceptedUpdateID});
    if (!bRenumbered)
    {
        out.emplace_back(OrderRejected{_orderID, _queued->orderUpdateID, {}, NO_UPDATE_ID});
        _queued.reset();
    }
}

void MasterSession::Impl::SendQueued(Core::Now now, MasterActions& out)
{
    if (_phase == EOrderPhase::Active && !_inFlight.has_value() && _queued.has_value())
    {
        StartWaitingForEcho(*std::exchange(_queued, std::nullopt), EEcho::Impossible, now, out);
    }
}

/// The one in flight, and what waits for it: an update on top of a refused one has no place to begin.
void MasterSession::Impl::RejectInFlight(const std::string& errorType, const std::string& reason, MasterActions& out)
{
    out.emplace_back(CancelMasterTimer{EMasterTimer::ResendOrder});
    out.emplace_back(OrderRejected{_orderID, _inFlight->orderUpdateID, errorType, reason});
    if (_queued.has_value())
    {
        out.emplace_back(OrderRejected{_orderID, _queued->orderUpdateID, errorType, reason});
    }
    if (!_bAccepted && _echo == EEcho::Possible)
    {
        Withdraw(&*_inFlight, true);
    }
    _inFlight.reset();
    _queued.reset();
    if (!_bAccepted)
    {
        EndOrder(out);
    }
}

bool MasterSession::Impl::IsSentHeader(std::string_view headerID) const
{
    std::uint32_t number = 0;
    const char* const end = headerID.data() + headerID.size();
    const auto [rest, error] = std::from_chars(headerID.data(), end, number);
    return error == std::errc() && rest == end && number - _firstHeaderID < _sendCount;
}

bool MasterSession::Impl::IsRejection(const VehicleError& error) const
{
    const std::string* topicOrNull = FindReferenceOrNull(error, ReferenceKeys::TOPIC);
    if (topicOrNull != nullptr && *topicOrNull != GetTopicName(ETopic::Order))
    {
        return false;
    }
    const std::string* orderOrNull = FindReferenceOrNull(error, ReferenceKeys::ORDER_ID);
    const std::string* updateOrNull = FindReferenceOrNull(error, ReferenceKeys::ORDER_UPDATE_ID);
    // An error of before the sending may stay until an order is taken; after a resend it is an answer to that.
    const bool bBefore = std::ranges::binary_search(_errorsBeforeSend, error);
    const bool bOld = _sendCount < 2 && bBefore;
    const bool bAnswer =
        topicOrNull != nullptr || std::ranges::find(ORDER_ERROR_TYPES, error.errorType) != ORDER_ERROR_TYPES.end();
    if (orderOrNull == nullptr)
    {
        // Where a header is named it must be of ours: others may write to the topic, and their junk is no word about us.
        const std::string* headerOrNull = FindReferenceOrNull(error, ReferenceKeys::HEADER_ID);
        return !bBefore && bAnswer && (headerOrNull == nullptr || IsSentHeader(*headerOrNull));
    }
    if (*orderOrNull != _inFlight->orderID || bOld)
    {
        return false;
    }
    if (updateOrNull != nullptr)
    {
        return *updateOrNull == std::to_string(_inFlight->orderUpdateID);
    }
    // Of an order that runs it may be any trouble, such as an action that failed, and no word about the update.
    return bAnswer || !_bAccepted;
}

const VehicleError* MasterSession::Impl::FindRejectionOrNull() const
{
    const auto found =
        std::ranges::find_if(_state->errors, [this](const VehicleError& error) { return IsRejection(error); });
    return found == _state->errors.end() ? nullptr : &*found;
}

void MasterSession::Impl::ReportReachedNodes(MasterActions& out)
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

bool MasterSession::Impl::IsOrderDone() const
{
    const bool bContinues = std::ranges::count(_continuedUpdateIDs, _acceptedUpdateID) > 0;
    if (bContinues || _inFlight.has_value() || _queued.has_value() || _reachedNodes != _route.size()
        || !_state->nodeStates.empty() || !_state->edgeStates.empty())
    {
        return false;
    }
    // UpdateActions has dropped what has ended.
    return std::ranges::none_of(_tracked, [](const TrackedAction& tracked) {
        return !tracked.bInstant && tracked.bShown;
    });
}

void MasterSession::Impl::UpdateOrder(MasterActions& out)
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
    ReportReachedNodes(out);
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
        if (_inFlight.has_value() && _echo == EEcho::Possible)
        {
            Withdraw(&*_inFlight, false);
        }
        out.emplace_back(OrderLost{_orderID, "the vehicle cleared the order"});
        EndOrder(out);
    }
}

void MasterSession::Impl::EndOrder(MasterActions& out)
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
