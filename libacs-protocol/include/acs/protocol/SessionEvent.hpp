#pragma once

#include <acs/protocol/AcsMessage.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

namespace ACS::Protocol
{

/// Both sides: registration succeeded. The ACS replays its outbox now and then calls ReplayDone.
struct Registered
{
    bool operator==(const Registered&) const = default;
};

/// ACS side: the MCS refused; the session tries again for ever, but somebody should know.
struct RegistrationRefused
{
    std::string message;

    bool operator==(const RegistrationRefused&) const = default;
};

/// The other side asks (of the ACS) or reports (to the MCS).
struct RequestReceived
{
    AcsRequest request;
    bool bDuplicate = false; ///< MCS side only: a report with this transaction came before. The ACS side never repeats.

    bool operator==(const RequestReceived&) const = default;
};

/// ACS side: a request that could not be read was answered with Fail; it goes no further.
struct RequestRefused
{
    std::string commandName;   ///< As sent.
    std::string transactionID; ///< This and the next: empty where it could not be read.
    std::string planID;
    std::string path;   ///< Of the member that is wrong: "payload.steps[0].action"; may be empty.
    std::string reason; ///< The message of the Ack.

    bool operator==(const RequestRefused&) const = default;
};

/// ACS side: the MCS has answered a durable request. Whatever the result, it is final: the caller may forget it.
struct Acked
{
    EAcsCommand command = EAcsCommand::PlanReport;
    std::string transactionID; ///< That of the request, even if the Ack bore another one (D-4).
    EAckResult result = EAckResult::Success;
    std::string message;

    bool operator==(const Acked&) const = default;
};

/// MCS side: the ACS has answered a request.
struct AckReceived
{
    AcsAck ack;

    bool operator==(const AckReceived&) const = default;
};

/// No Ack in time. ACS side: after all resends; the caller keeps the request and feeds it again after the next
/// Registered. MCS side: after the ack timeout, or because the link was lost; an Ack that comes late is delivered as
/// AckReceived all the same.
struct RequestUnanswered
{
    EAcsCommand command = EAcsCommand::PlanReport;
    std::string transactionID;

    bool operator==(const RequestUnanswered&) const = default;
};

/// The connection is gone, or could not be made. The ACS side connects again by itself.
struct LinkLost
{
    std::string reason;
    bool bWasRegistered = false;

    bool operator==(const LinkLost&) const = default;
};

/// ACS side: there is room again after TrySendDurable had returned false.
struct WindowOpened
{
    bool operator==(const WindowOpened&) const = default;
};

/// ACS side: time for SendPosition; comes only between the states that follow ReplayDone and the loss of the link.
struct PositionDue
{
    bool operator==(const PositionDue&) const = default;
};

/// ACS side: Stop has ended; nothing follows until Start.
struct Stopped
{
    bool operator==(const Stopped&) const = default;
};

/// What a session put up with or threw away. For logs and metrics; nothing is to be done.
enum class EProtocolNote : std::uint8_t
{
    UnknownMember,          ///< Ignored.
    NullOptional,           ///< Read as absent.
    LenientWord,            ///< A word in another case.
    LenientNumber,          ///< A number in a string.
    BadTimestamp,           ///< Missing or unreadable.
    Undecodable,            ///< No message: thrown away, or refused where it had a command.
    UnknownCommand,         ///< Refused: undefined, or not for this side.
    AckMismatched,          ///< An Ack with a foreign transactionId, matched by its command (D-4).
    AckUnexpected,          ///< An Ack that nothing waits for.
    AckFailed,              ///< The other side refused a status.
    DuplicateRequest,       ///< Answered from memory.
    BeforeRegistered,       ///< Came before registration: ignored.
    RegistrationUnanswered, ///< The connection is closed and made anew.
};

inline constexpr std::size_t NOTE_COUNT = 13;

[[nodiscard]] std::string_view GetText(EProtocolNote note);

struct ProtocolNoted
{
    EProtocolNote what = EProtocolNote::UnknownMember;
    std::uint32_t count = 1; ///< How often in this one text.
    std::string detail;      ///< One sentence, may be empty.

    bool operator==(const ProtocolNoted&) const = default;
};

using SessionEvent = std::variant<
    Registered,
    RegistrationRefused,
    RequestReceived,
    RequestRefused,
    Acked,
    AckReceived,
    RequestUnanswered,
    LinkLost,
    WindowOpened,
    PositionDue,
    Stopped,
    ProtocolNoted>;

} // namespace ACS::Protocol
