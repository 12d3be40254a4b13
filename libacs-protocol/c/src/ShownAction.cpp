#include "ShownAction.hpp"

#include "Arguments.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/protocol/AcsCodec.hpp>

#include <cstdint>
#include <string_view>
#include <variant>

namespace ACS::CInterface
{

namespace
{

// NOLINTNEXTLINE(google-build-using-namespace): the types below are those of one namespace
using namespace Protocol;

static_assert(TIMER_COUNT == 6 && static_cast<int>(ESessionTimer::Registration) == ACS_TIMER_REGISTRATION);
static_assert(static_cast<int>(ESessionTimer::Ack) == ACS_TIMER_ACK);
static_assert(static_cast<int>(ESessionTimer::Reconnect) == ACS_TIMER_RECONNECT);
static_assert(static_cast<int>(ESessionTimer::Position) == ACS_TIMER_POSITION);
static_assert(static_cast<int>(ESessionTimer::Shutdown) == ACS_TIMER_SHUTDOWN);
static_assert(static_cast<int>(ESessionTimer::Answer) == ACS_TIMER_ANSWER);
static_assert(static_cast<int>(EUnansweredReason::Timeout) == ACS_UNANSWERED_TIMEOUT);
static_assert(static_cast<int>(EUnansweredReason::LinkLost) == ACS_UNANSWERED_LINK_LOST);
static_assert(static_cast<int>(EUnansweredReason::Replaced) == ACS_UNANSWERED_REPLACED);

std::int32_t ShowResult(EAckResult result)
{
    return result == EAckResult::Success ? ACS_RESULT_SUCCESS : ACS_RESULT_FAIL;
}

void ShowRequest(EAcsCommand command, std::string_view transactionID, acs_action& out)
{
    out.command = ShowText(GetText(command));
    out.transaction_id = ShowText(transactionID);
}

void ShowEvent(const Registered& /*event*/, acs_action& out)
{
    out.event = ACS_EVENT_REGISTERED;
}

void ShowEvent(const RegistrationRefused& event, acs_action& out)
{
    out.event = ACS_EVENT_REGISTRATION_REFUSED;
    out.message = ShowText(event.message);
}

void ShowEvent(const RequestReceived& event, acs_action& out)
{
    out.event = ACS_EVENT_REQUEST_RECEIVED;
    ShowRequest(GetCommand(event.request), event.request.transactionID, out);
    out.connection = event.connection;
    out.token = event.token;
    out.flag = event.bDuplicate ? 1 : 0;
}

void ShowEvent(const RequestRefused& event, acs_action& out)
{
    out.event = ACS_EVENT_REQUEST_REFUSED;
    out.command = ShowText(event.commandName);
    out.transaction_id = ShowText(event.transactionID);
    out.path = ShowText(event.path);
    out.message = ShowText(event.reason);
}

void ShowEvent(const Acked& event, acs_action& out)
{
    out.event = ACS_EVENT_ACKED;
    ShowRequest(event.command, event.transactionID, out);
    out.result = ShowResult(event.result);
    out.message = ShowText(event.message);
}

void ShowEvent(const RequestGivenUp& event, acs_action& out)
{
    out.event = ACS_EVENT_REQUEST_ABANDONED;
    ShowRequest(event.command, event.transactionID, out);
    out.token = event.token;
}

void ShowEvent(const AckReceived& event, acs_action& out)
{
    out.event = ACS_EVENT_ACK_RECEIVED;
    ShowRequest(event.ack.command, event.ack.transactionID, out);
    out.result = ShowResult(event.ack.result);
    out.message = ShowText(event.ack.message);
    out.flag = event.bLate ? 1 : 0;
}

void ShowEvent(const RequestUnanswered& event, acs_action& out)
{
    out.event = ACS_EVENT_REQUEST_UNANSWERED;
    ShowRequest(event.command, event.transactionID, out);
    out.reason = static_cast<std::int32_t>(event.reason);
    out.count = event.attempts;
}

void ShowEvent(const LinkLost& event, acs_action& out)
{
    out.event = ACS_EVENT_LINK_LOST;
    out.message = ShowText(event.reason);
    out.flag = event.bWasRegistered ? 1 : 0;
}

void ShowEvent(const WindowOpened& /*event*/, acs_action& out)
{
    out.event = ACS_EVENT_WINDOW_OPENED;
}

void ShowEvent(const PositionDue& /*event*/, acs_action& out)
{
    out.event = ACS_EVENT_POSITION_DUE;
}

void ShowEvent(const Stopped& /*event*/, acs_action& out)
{
    out.event = ACS_EVENT_STOPPED;
}

void ShowEvent(const ProtocolNoted& event, acs_action& out)
{
    out.event = ACS_EVENT_NOTED;
    out.text = ShowText(GetText(event.what));
    out.count = event.count;
    out.message = ShowText(event.detail);
}

} // namespace

std::string EncodeDelivered(const SessionAction& action)
{
    std::string text;
    const auto* const deliverOrNull = std::get_if<Deliver>(&action);
    if (deliverOrNull == nullptr)
    {
        return text;
    }
    if (const auto* const receivedOrNull = std::get_if<RequestReceived>(&deliverOrNull->event))
    {
        AcsCodec::EncodeRequest(receivedOrNull->request, text);
    }
    else if (const auto* const ackOrNull = std::get_if<AckReceived>(&deliverOrNull->event))
    {
        AcsCodec::EncodeAck(ackOrNull->ack, text);
    }
    return text;
}

void ShowAction(const SessionAction& action, const std::string& delivered, acs_action& out)
{
    const std::uint32_t size = out.struct_size;
    out = {};
    out.struct_size = size;
    for (acs_text* text : {&out.text, &out.command, &out.transaction_id, &out.path, &out.message})
    {
        *text = ShowText({});
    }
    std::visit(
        Core::Overloaded{
            [&out](const SendText& send) {
                out.type = ACS_ACTION_SEND_TEXT;
                out.connection = send.connection;
                out.text = ShowText(send.text);
                out.flag = send.bDroppable ? 1 : 0;
            },
            [&out](const Connect&) { out.type = ACS_ACTION_CONNECT; },
            [&out](const Close& close) {
                out.type = ACS_ACTION_CLOSE;
                out.connection = close.connection;
                out.close_code = close.code;
                out.message = ShowText(close.reason);
            },
            [&out](const StartTimer& start) {
                out.type = ACS_ACTION_START_TIMER;
                out.timer = static_cast<std::int32_t>(start.timer);
                out.delay_ms = start.delay.count();
            },
            [&out](const CancelTimer& cancel) {
                out.type = ACS_ACTION_CANCEL_TIMER;
                out.timer = static_cast<std::int32_t>(cancel.timer);
            },
            [&out, &delivered](const Deliver& deliver) {
                out.type = ACS_ACTION_EVENT;
                out.text = ShowText(delivered);
                std::visit([&out](const auto& event) { ShowEvent(event, out); }, deliver.event);
            }},
        action);
}

} // namespace ACS::CInterface
