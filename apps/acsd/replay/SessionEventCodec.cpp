#include "replay/SessionEventCodec.hpp"

#include "replay/FindMember.hpp"
#include <acs/core/ECoreError.hpp>
#include <acs/core/JsonText.hpp>
#include <acs/core/Overloaded.hpp>
#include <acs/json/TextCodec.hpp>
#include <acs/protocol/AcsCodec.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>

namespace ACS::Acsd
{

namespace
{

/// An event of any kind: what a kind does not have is absent.
struct SessionText
{
    std::string event;
    std::optional<Core::JsonText> request;
    std::string command;
    std::string transactionID;
    std::string result;
    std::string message;
    std::optional<bool> bWasRegistered;
    std::optional<std::uint64_t> attempts;
};

constexpr std::string_view SESSION_REGISTERED = "Registered";
constexpr std::string_view SESSION_REQUEST = "RequestReceived";
constexpr std::string_view SESSION_ACKED = "Acked";
constexpr std::string_view SESSION_UNANSWERED = "RequestUnanswered";
constexpr std::string_view SESSION_LOST = "LinkLost";
constexpr std::string_view SESSION_WINDOW = "WindowOpened";
constexpr std::string_view SESSION_POSITION = "PositionDue";
constexpr std::string_view SESSION_STOPPED = "Stopped";
constexpr std::string_view SESSION_NOTED = "ProtocolNoted"; ///< And others of which acsd only writes a line to the log.

} // namespace

} // namespace ACS::Acsd

namespace ACS::Json
{

template <>
struct JsonFields<Acsd::SessionText>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("event", &Acsd::SessionText::event),
        Optional("request", &Acsd::SessionText::request),
        Optional("command", &Acsd::SessionText::command),
        Optional("transactionId", &Acsd::SessionText::transactionID),
        Optional("result", &Acsd::SessionText::result),
        Optional("message", &Acsd::SessionText::message),
        Optional("wasRegistered", &Acsd::SessionText::bWasRegistered),
        Optional("attempts", &Acsd::SessionText::attempts));
};

} // namespace ACS::Json

namespace ACS::Acsd
{

namespace
{

SessionText MakeSessionText(std::string_view event)
{
    SessionText text;
    text.event = event;
    return text;
}

SessionText MakeEventText(const Protocol::SessionEvent& event)
{
    return std::visit(
        Core::Overloaded{
            [](const Protocol::Registered&) { return MakeSessionText(SESSION_REGISTERED); },
            [](const Protocol::RequestReceived& received) {
                SessionText text = MakeSessionText(SESSION_REQUEST);
                std::string request;
                Protocol::AcsCodec::EncodeRequest(received.request, request);
                text.request = Core::JsonText::FromTrusted(std::move(request));
                return text;
            },
            [](const Protocol::Acked& acked) {
                SessionText text = MakeSessionText(SESSION_ACKED);
                text.command = GetText(acked.command);
                text.transactionID = acked.transactionID;
                text.result = GetText(acked.result);
                text.message = acked.message;
                return text;
            },
            [](const Protocol::RequestUnanswered& unanswered) {
                SessionText text = MakeSessionText(SESSION_UNANSWERED);
                text.command = GetText(unanswered.command);
                text.transactionID = unanswered.transactionID;
                text.attempts = unanswered.attempts;
                return text;
            },
            [](const Protocol::LinkLost& lost) {
                SessionText text = MakeSessionText(SESSION_LOST);
                text.message = lost.reason;
                text.bWasRegistered = lost.bWasRegistered;
                return text;
            },
            [](const Protocol::WindowOpened&) { return MakeSessionText(SESSION_WINDOW); },
            [](const Protocol::PositionDue&) { return MakeSessionText(SESSION_POSITION); },
            [](const Protocol::Stopped&) { return MakeSessionText(SESSION_STOPPED); },
            [](const auto& /*for the log*/) {
                return MakeSessionText(SESSION_NOTED);
            }},
        event);
}

Core::Result<Protocol::EAcsCommand> ReadAcsCommand(const std::string& text)
{
    for (std::size_t index = 0; index < Protocol::COMMAND_COUNT; ++index)
    {
        const auto command = static_cast<Protocol::EAcsCommand>(index);
        if (text == GetText(command))
        {
            return command;
        }
    }
    return Core::Fail(Core::ECoreError::UnknownWord, "command", "a command of MCS-ACS", Core::QuoteForError(text));
}

Core::Result<Protocol::SessionEvent> MakeRequestEvent(const std::optional<Core::JsonText>& text)
{
    constexpr std::size_t ANY = std::numeric_limits<std::size_t>::max();
    Protocol::CodecOptions options;
    options.maximumBytes = ANY;
    options.maximumString = ANY;
    options.maximumArray = ANY;
    options.bLocationsChecked = false; // what the session delivered was checked with its own options
    Protocol::DecodeOutcome outcome =
        Protocol::AcsCodec(options).Decode(text.has_value() ? text->GetText() : std::string());
    if (!outcome.message.has_value())
    {
        return tl::unexpected(std::move(outcome.message.error().error));
    }
    auto* const requestOrNull = std::get_if<Protocol::AcsRequest>(&*outcome.message);
    if (requestOrNull == nullptr)
    {
        return Core::Fail(Core::ECoreError::WrongType, "request", "a request", "an Ack");
    }
    return Protocol::RequestReceived{std::move(*requestOrNull)};
}

Core::Result<Protocol::SessionEvent> MakeSessionEvent(SessionText text)
{
    if (text.event == SESSION_REQUEST)
    {
        return MakeRequestEvent(text.request);
    }
    if (text.event == SESSION_ACKED)
    {
        const bool bSuccess = text.result == GetText(Protocol::EAckResult::Success);
        return ReadAcsCommand(text.command).map([&](Protocol::EAcsCommand command) -> Protocol::SessionEvent {
            return Protocol::Acked{
                command,
                std::move(text.transactionID),
                bSuccess ? Protocol::EAckResult::Success : Protocol::EAckResult::Fail,
                std::move(text.message)};
        });
    }
    if (text.event == SESSION_UNANSWERED)
    {
        return ReadAcsCommand(text.command).map([&](Protocol::EAcsCommand command) -> Protocol::SessionEvent {
            Protocol::RequestUnanswered unanswered;
            unanswered.command = command;
            unanswered.transactionID = std::move(text.transactionID);
            unanswered.attempts = text.attempts.value_or(0);
            return unanswered;
        });
    }
    if (text.event == SESSION_LOST)
    {
        return Protocol::LinkLost{std::move(text.message), text.bWasRegistered.value_or(false)};
    }
    if (text.event == SESSION_REGISTERED)
    {
        return Protocol::Registered{};
    }
    if (text.event == SESSION_WINDOW)
    {
        return Protocol::WindowOpened{};
    }
    if (text.event == SESSION_POSITION)
    {
        return Protocol::PositionDue{};
    }
    if (text.event == SESSION_STOPPED)
    {
        return Protocol::Stopped{};
    }
    if (text.event == SESSION_NOTED)
    {
        return Protocol::ProtocolNoted{};
    }
    return Core::Fail(Core::ECoreError::UnknownWord, "event", "an event of a session", Core::QuoteForError(text.event));
}

} // namespace

std::string EncodeSessionEvent(const Protocol::SessionEvent& event)
{
    return Json::EncodeText(MakeEventText(event));
}

Core::Result<Protocol::SessionEvent> DecodeSessionEvent(std::string_view text)
{
    return Json::DecodeText<SessionText>(text).and_then(
        [](SessionText&& read) { return MakeSessionEvent(std::move(read)); });
}

std::string FindTransactionID(const Protocol::SessionEvent& event)
{
    const auto* const receivedOrNull = std::get_if<Protocol::RequestReceived>(&event);
    return receivedOrNull == nullptr ? FindMember(event, TRANSACTION_ID) : receivedOrNull->request.transactionID;
}

std::string FindPlanID(const Protocol::SessionEvent& event)
{
    const auto* const receivedOrNull = std::get_if<Protocol::RequestReceived>(&event);
    return receivedOrNull == nullptr ? std::string() : FindPlanID(receivedOrNull->request.payload);
}

std::string FindPlanID(const Protocol::AcsPayload& payload)
{
    return FindMember(payload, PLAN_ID);
}

std::string FindRobotID(const Protocol::AcsPayload& payload)
{
    return FindMember(payload, ROBOT_ID);
}

} // namespace ACS::Acsd
