#pragma once

#include <acs/protocol/AcsMessage.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

namespace ACS::Protocol
{

/// Both sides: registration succeeded. The ACS replays its outbox, then calls ReplayDone.
struct Registered
{
    bool operator==(const Registered&) const = default;
};

/// ACS side: the MCS refused the registration. The session retries indefinitely; the operator should be informed.
struct RegistrationRefused
{
    std::string message;

    bool operator==(const RegistrationRefused&) const = default;
};

/// A request of the MCS (at the ACS), or a report of the ACS (at the MCS).
struct RequestReceived
{
    AcsRequest request;
    bool bDuplicate = false; ///< MCS side only: a report with this transactionID was received before.

    bool operator==(const RequestReceived&) const = default;
};

/// ACS side: a malformed request was answered with Fail and is not delivered.
struct RequestRefused
{
    std::string commandName;   ///< As sent.
    std::string transactionID; ///< This and planID are empty if unreadable.
    std::string planID;
    std::string path;   ///< Of the invalid member, for example "payload.steps[0].action"; may be empty.
    std::string reason; ///< The message of the Ack.

    bool operator==(const RequestRefused&) const = default;
};

/// ACS side: the MCS has answered a durable request. The answer is final, whatever its result: the caller may forget the
/// request.
struct Acked
{
    EAcsCommand command = EAcsCommand::PlanReport;
    std::string transactionID; ///< Of the request, even if the Ack carried another one (D-4).
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

/// No Ack in time. ACS side: after all resends; the caller keeps the request and sends it again after the next Registered.
/// MCS side: after the ack timeout, or because the link was lost; a late Ack is still delivered as AckReceived.
struct RequestUnanswered
{
    EAcsCommand command = EAcsCommand::PlanReport;
    std::string transactionID;

    bool operator==(const RequestUnanswered&) const = default;
};

/// The connection was lost or could not be opened. The ACS side reconnects by itself.
struct LinkLost
{
    std::string reason;
    bool bWasRegistered = false;

    bool operator==(const LinkLost&) const = default;
};

/// ACS side: the window has room again after TrySendDurable returned false.
struct WindowOpened
{
    bool operator==(const WindowOpened&) const = default;
};

/// ACS side: SendPosition is due. Delivered only after the states that follow ReplayDone, until the link is lost.
struct PositionDue
{
    bool operator==(const PositionDue&) const = default;
};

/// ACS side: Stop is complete; no events follow until Start.
struct Stopped
{
    bool operator==(const Stopped&) const = default;
};

/// A deviation that a session tolerated or discarded. For logs and metrics; requires no action.
enum class EProtocolNote : std::uint8_t
{
    UnknownMember,          ///< Ignored.
    NullOptional,           ///< Read as absent.
    LenientWord,            ///< A name with different upper or lower case.
    LenientNumber,          ///< A number in a string.
    BadTimestamp,           ///< Missing or unreadable.
    Undecodable,            ///< Not a valid message: discarded, or refused if its command was readable.
    UnknownCommand,         ///< Refused: undefined, or not a command for this side.
    AckMismatched,          ///< An Ack with a foreign transactionId, matched by its command (D-4).
    AckUnexpected,          ///< An Ack without a pending request.
    AckFailed,              ///< The other side refused a status.
    DuplicateRequest,       ///< Answered from the cache.
    BeforeRegistered,       ///< Received before registration and ignored.
    RegistrationUnanswered, ///< The session reconnects.
};

inline constexpr std::size_t NOTE_COUNT = 13;

[[nodiscard]] std::string_view GetText(EProtocolNote note);

struct ProtocolNoted
{
    EProtocolNote what = EProtocolNote::UnknownMember;
    std::uint32_t count = 1; ///< Occurrences in this text.
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
