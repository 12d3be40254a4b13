#include "OrderOutbox.hpp"

#include "OrderErrors.hpp"
#include "SortedIndex.hpp"
#include <acs/core/ParseNumber.hpp>

#include <algorithm>
#include <array>
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

OrderOutbox::OrderOutbox(const MasterOptions& options)
    : _options(options)
{
}

void OrderOutbox::BeginOrder(OrderNumbers numbers)
{
    _numbers = std::move(numbers);
}

void OrderOutbox::EndOrder(MasterActions& out)
{
    if (_inFlight.has_value())
    {
        out.emplace_back(CancelMasterTimer{EMasterTimer::ResendOrder});
    }
    _numbers = OrderNumbers();
    _inFlight.reset();
    _queued.reset();
    _bWithdrawn = false;
}

bool OrderOutbox::TryNumber(OrderMessage& update, bool bContinues, std::uint32_t shownID)
{
    const std::optional<std::uint32_t> updateID = _numbers.TakeOrNull(shownID);
    if (!updateID.has_value())
    {
        return false;
    }
    update.orderUpdateID = *updateID;
    if (bContinues)
    {
        _numbers.SetContinued(*updateID);
    }
    return true;
}

void OrderOutbox::Start(OrderMessage message, EEcho echo, const StateMessage& state)
{
    _inFlight = InFlight{
        std::move(message),
        echo,
        0,
        0,
        false,
        state.errors,
        state.orderID,
        state.lastNodeID,
        state.lastNodeSequenceID};
    std::ranges::sort(_inFlight->errorsBefore);
}

void OrderOutbox::Queue(OrderMessage update)
{
    _queued = std::move(update);
}

bool OrderOutbox::TryStartQueued(const StateMessage& state)
{
    if (_inFlight.has_value() || !_queued.has_value())
    {
        return false;
    }
    Start(*std::exchange(_queued, std::nullopt), EEcho::Impossible, state);
    return true;
}

void OrderOutbox::Publish(MasterTopics& topics, Core::Duration minimumInterval, Core::Now now, MasterActions& out)
{
    InFlight& sent = *_inFlight;
    const Core::SteadyTime earliest = _lastOrderTime.value_or(now.steady) + minimumInterval;
    if (_lastOrderTime.has_value() && now.steady < earliest)
    {
        const Core::Duration delay = earliest - now.steady;
        out.emplace_back(StartMasterTimer{EMasterTimer::ResendOrder, delay});
        if (sent.sendCount == 0)
        {
            out.emplace_back(OrderDelayed{sent.message.orderID, sent.message.orderUpdateID, delay});
        }
        return;
    }
    _lastOrderTime = now.steady;
    topics.Publish(ETopic::Order, sent.message, now, out);
    sent.echo = EEcho::Possible;
    if (sent.sendCount == 0)
    {
        sent.firstHeaderID = sent.message.header.headerID;
    }
    else
    {
        topics.CountResentOrder();
    }
    ++sent.sendCount;
    out.emplace_back(StartMasterTimer{EMasterTimer::ResendOrder, _options.resendInterval});
}

void OrderOutbox::OnVehicleOnline()
{
    if (_inFlight.has_value())
    {
        _inFlight->bAwaySinceSend = _inFlight->sendCount > 0;
    }
}

OrderOutbox::Answer OrderOutbox::OnState(const StateMessage& state, const ActionIndex& shown)
{
    if (!_inFlight.has_value())
    {
        return {};
    }
    if (_inFlight->echo == EEcho::Impossible)
    {
        _inFlight->errorsBefore = state.errors;
        std::ranges::sort(_inFlight->errorsBefore);
        return RenumberUnsent(state); // nothing that the vehicle shows is an answer
    }
    if (state.orderID == _inFlight->message.orderID && state.orderUpdateID >= _inFlight->message.orderUpdateID)
    {
        return {EAnswer::Shown};
    }
    const SortedIndex<VehicleError> errors(state.errors);
    std::erase_if(_inFlight->errorsBefore, [&errors](const VehicleError& error) {
        return errors.FindOrNull(error) == nullptr; // the next one like it is new
    });
    if (_bWithdrawn)
    {
        return {};
    }
    const auto isRejection = [this, &shown](const VehicleError& error) {
        return IsRejection(error, shown);
    };
    const auto rejection = std::ranges::find_if(state.errors, isRejection);
    if (rejection != state.errors.end())
    {
        return {EAnswer::Rejected, rejection->errorType, rejection->errorDescription};
    }
    if (IsUnresolved(state))
    {
        return {EAnswer::Unresolved};
    }
    _inFlight->bAwaySinceSend = false;
    return {};
}

OrderOutbox::Answer OrderOutbox::RenumberUnsent(const StateMessage& state)
{
    OrderMessage& unsent = _inFlight->message;
    if (state.orderID != unsent.orderID || state.orderUpdateID < unsent.orderUpdateID)
    {
        return {};
    }
    if (!IsAccepted())
    {
        return {EAnswer::Rejected, {}, "before the order was sent, the vehicle showed another one with its orderId"};
    }
    // With its old number it would count as accepted at once, and the vehicle would ignore it.
    const bool bRenumbered = _numbers.TryRenumber(unsent.orderUpdateID, state.orderUpdateID)
        && (!_queued.has_value() || _numbers.TryRenumber(_queued->orderUpdateID, state.orderUpdateID));
    return bRenumbered ? Answer{} : Answer{EAnswer::Rejected, {}, NO_UPDATE_ID};
}

bool OrderOutbox::IsUnresolved(const StateMessage& state) const
{
    if (IsAccepted() || _inFlight->sendCount == 0)
    {
        return false;
    }
    const std::string& orderIDBefore = _inFlight->orderIDBefore;
    const bool bForgot = state.orderID.empty() && !orderIDBefore.empty() && CanHaveDriven(state);
    return bForgot || (_inFlight->bAwaySinceSend && CanBeExecuted(orderIDBefore, state));
}

bool OrderOutbox::CanHaveDriven(const StateMessage& state) const
{
    if (state.lastNodeID != _inFlight->lastNodeIDBefore
        || state.lastNodeSequenceID != _inFlight->lastNodeSequenceIDBefore)
    {
        return true;
    }
    // After an order that ends where it begins, a vehicle that was restarted shows the same node.
    const std::vector<OrderNode>& nodes = _inFlight->message.nodes;
    const auto last = std::ranges::find(nodes.rbegin(), nodes.rend(), true, &OrderNode::bReleased);
    return state.lastNodeSequenceID == 0 && last != nodes.rend() && last->nodeID == state.lastNodeID;
}

bool OrderOutbox::IsRejection(const VehicleError& error, const ActionIndex& shown) const
{
    const std::string* topicOrNull = FindReferenceOrNull(error, ReferenceKeys::TOPIC);
    if (topicOrNull != nullptr && *topicOrNull != GetTopicName(ETopic::Order))
    {
        return false;
    }
    const std::string* orderOrNull = FindReferenceOrNull(error, ReferenceKeys::ORDER_ID);
    const std::string* updateOrNull = FindReferenceOrNull(error, ReferenceKeys::ORDER_UPDATE_ID);
    // An error of before the sending may stay until an order is taken. One that names the message itself, as a master that was
    // restarted has sent it before, is an answer after a resend.
    const bool bBefore = std::ranges::binary_search(_inFlight->errorsBefore, error);
    const bool bNamed = updateOrNull != nullptr || !IsAccepted();
    const bool bOld = bBefore && (_inFlight->sendCount < 2 || !bNamed);
    const bool bOrderType = std::ranges::find(ORDER_ERROR_TYPES, error.errorType) != ORDER_ERROR_TYPES.end();
    const bool bAnswer = topicOrNull != nullptr || bOrderType;
    const std::string* headerOrNull = FindReferenceOrNull(error, ReferenceKeys::HEADER_ID);
    const bool bSentHeader = headerOrNull != nullptr && IsSentHeader(*headerOrNull);
    const std::string* actionOrNull = FindReferenceOrNull(error, ReferenceKeys::ACTION_ID);
    const bool bShownAction = actionOrNull != nullptr && shown.FindOrNull(*actionOrNull) != nullptr;
    if (orderOrNull == nullptr)
    {
        // A header that is named must be one of ours: other clients may write to the topic, and the error is about their message.
        // While an order runs the topic alone proves nothing: a failed action or a left corridor of it may name it too.
        const bool bOfTopic = topicOrNull != nullptr && !IsAccepted() && !bShownAction;
        return !bBefore && (headerOrNull != nullptr ? bAnswer && bSentHeader : bOrderType || bOfTopic);
    }
    if (*orderOrNull != _inFlight->message.orderID || bOld)
    {
        return false;
    }
    if (updateOrNull != nullptr)
    {
        return *updateOrNull == std::to_string(_inFlight->message.orderUpdateID);
    }
    // While the order runs, the error may be about something else than the update, such as an action that failed.
    return !IsAccepted() || (bAnswer && (bSentHeader || !bShownAction));
}

bool OrderOutbox::IsSentHeader(std::string_view headerID) const
{
    const std::optional<std::uint32_t> number = Core::ParseNumberOrNull<std::uint32_t>(headerID);
    return number.has_value() && *number - _inFlight->firstHeaderID < _inFlight->sendCount;
}

OrderMessage OrderOutbox::Accept(const StateMessage& state, MasterActions& out)
{
    OrderMessage message = std::move(_inFlight->message);
    _inFlight.reset();
    // A master that resumes an order may know less of it than the vehicle has.
    const std::uint32_t shownID = std::max(message.orderUpdateID, state.orderUpdateID);
    const bool bRenumbered = !_queued.has_value() || _queued->orderUpdateID > shownID
        || _numbers.TryRenumber(_queued->orderUpdateID, shownID);
    _numbers.Accept(message.orderUpdateID);
    out.emplace_back(CancelMasterTimer{EMasterTimer::ResendOrder});
    out.emplace_back(OrderAccepted{message.orderID, shownID});
    if (!bRenumbered)
    {
        out.emplace_back(OrderRejected{message.orderID, _queued->orderUpdateID, {}, NO_UPDATE_ID});
        _queued.reset();
    }
    return message;
}

void OrderOutbox::SetAccepted(std::uint32_t updateID)
{
    _numbers.Accept(updateID);
}

void OrderOutbox::Reject(const std::string& errorType, const std::string& reason, MasterActions& out)
{
    const OrderMessage& message = _inFlight->message;
    out.emplace_back(CancelMasterTimer{EMasterTimer::ResendOrder});
    out.emplace_back(OrderRejected{message.orderID, message.orderUpdateID, errorType, reason});
    if (_queued.has_value())
    {
        out.emplace_back(OrderRejected{message.orderID, _queued->orderUpdateID, errorType, reason});
    }
    _inFlight.reset();
    _queued.reset();
}

void OrderOutbox::Withdraw(MasterActions& out)
{
    _bWithdrawn = true;
    out.emplace_back(CancelMasterTimer{EMasterTimer::ResendOrder});
}

void OrderOutbox::Restore(const StateMessage& state, MasterActions& out)
{
    _bWithdrawn = false;
    if (TryStartQueued(state) || _inFlight.has_value())
    {
        out.emplace_back(StartMasterTimer{EMasterTimer::ResendOrder, _options.resendInterval});
    }
}

bool OrderOutbox::IsEmpty() const noexcept
{
    return _bWithdrawn || (!_inFlight.has_value() && !_queued.has_value());
}

bool OrderOutbox::HasQueued() const noexcept
{
    return _queued.has_value();
}

bool OrderOutbox::CanBeExecuted(const std::string& orderIDBefore, const StateMessage& state)
{
    return orderIDBefore.empty() || state.orderID != orderIDBefore;
}

bool OrderOutbox::IsAccepted() const noexcept
{
    return _numbers.IsAccepted();
}

bool OrderOutbox::IsContinued() const
{
    return _numbers.IsContinued();
}

bool OrderOutbox::IsSpent() const noexcept
{
    return _inFlight.has_value() && _options.resendCount != 0 && _inFlight->sendCount > _options.resendCount;
}

const OrderMessage* OrderOutbox::GetInFlightOrNull() const noexcept
{
    return _inFlight.has_value() ? &_inFlight->message : nullptr;
}

const OrderMessage* OrderOutbox::GetShowableOrNull() const noexcept
{
    return _inFlight.has_value() && _inFlight->echo == EEcho::Possible ? &_inFlight->message : nullptr;
}

const OrderMessage* OrderOutbox::GetSentOrNull() const noexcept
{
    return _inFlight.has_value() && _inFlight->sendCount > 0 ? &_inFlight->message : nullptr;
}

} // namespace ACS::VDA5050
