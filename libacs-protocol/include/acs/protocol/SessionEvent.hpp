#pragma once

#include <acs/core/Api.hpp>
#include <acs/protocol/AcsMessage.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

namespace ACS::Protocol
{

/// A connection of a server. An AcsSession has only one and always uses 0.
using ConnectionID = std::uint64_t;

/// A request of the ACS that waits for the answer of the application of an McsSession. Never used twice by a session.
using AnswerToken = std::uint64_t;

inline constexpr AnswerToken NO_ANSWER = 0; ///< The session has answered, or the command has no Ack.

/// Both sides: registration succeeded. The ACS replays its outbox, then calls ReplayDone.
struct Registered
{
    bool operator==(const Registered&) const = default;
};

/// ACS side: the MCS refused the registration. The session retries indefinitely; the operator should be informed.
struct RegistrationRefused
{
    std::string message; ///< Of the Ack; may be empty.

    bool operator==(const RegistrationRefused&) const = default;
};

/// A request of the MCS (at the ACS), or a report of the ACS (at the MCS).
struct RequestReceived
{
    AcsRequest request;            ///< Valid: the codec has checked it.
    bool bDuplicate = false;       ///< MCS side only: a report with this transactionID was delivered before.
    ConnectionID connection = 0;   ///< MCS side only: where it came from.
    AnswerToken token = NO_ANSWER; ///< MCS side only: to be passed to IMcsSession::TryAnswer unless it is NO_ANSWER.

    bool operator==(const RequestReceived&) const = default;
};

/// ACS side: a malformed request was answered with Fail and is not delivered.
struct RequestRefused
{
    std::string commandName;   ///< As sent.
    std::string transactionID; ///< This and planID are empty if unreadable.
    std::string planID;        ///< Of the payload; empty if it has none.
    std::string path;          ///< Of the invalid member, for example "payload.steps[0].action"; may be empty.
    std::string reason;        ///< The message of the Ack.

    bool operator==(const RequestRefused&) const = default;
};

/// ACS side: the MCS has answered a durable request. The answer is final, whatever its result: the caller may forget the
/// request.
struct Acked
{
    EAcsCommand command = EAcsCommand::PlanReport; ///< Of the request.
    std::string transactionID;                     ///< Of the request, even if the Ack carried another one (D-4).
    EAckResult result = EAckResult::Success;       ///< Fail: the MCS has refused the content.
    std::string message;                           ///< Of the Ack; may be empty.

    bool operator==(const Acked&) const = default;
};

/// MCS side: a request of the ACS has got no answer of the application: not within McsSessionOptions::answerTimeout, or
/// because McsSessionOptions::maximumUnanswered requests were waiting. McsSessionOptions::unansweredPolicy was applied.
struct RequestGivenUp
{
    EAcsCommand command = EAcsCommand::PlanReport; ///< Of the request.
    std::string transactionID;
    AnswerToken token = NO_ANSWER; ///< No longer valid; NO_ANSWER: the request was not delivered.

    bool operator==(const RequestGivenUp&) const = default;
};

/// MCS side: the ACS has answered a request.
struct AckReceived
{
    AcsAck ack;         ///< Its command and transactionID are those of the request.
    bool bLate = false; ///< RequestUnanswered was delivered for this request before.

    bool operator==(const AckReceived&) const = default;
};

/// Why a request has no Ack.
enum class EUnansweredReason : std::uint8_t
{
    Timeout,  ///< After all resends.
    LinkLost, ///< MCS side: the connection was lost.
    Replaced, ///< MCS side: another connection has registered.
};

/// No Ack in time. ACS side: after all resends; the caller keeps the request and sends it again after the next Registered.
/// MCS side: it is unknown whether the ACS has received the request; a late Ack is still delivered as AckReceived.
struct RequestUnanswered
{
    EAcsCommand command = EAcsCommand::PlanReport; ///< Of the request.
    std::string transactionID;
    EUnansweredReason reason = EUnansweredReason::Timeout; ///< Why no Ack will come.
    std::size_t attempts = 0;                              ///< How often the request was sent on this connection.

    bool operator==(const RequestUnanswered&) const = default;
};

/// The connection was lost or could not be opened. The ACS side reconnects by itself.
struct LinkLost
{
    std::string reason;          ///< Of the connection, for the log.
    bool bWasRegistered = false; ///< False: the connection was lost before a successful registration.

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

/// Number of enumerators of EProtocolNote.
inline constexpr std::size_t NOTE_COUNT = 13;

/// The name of the enumerator, for logs and metrics.
[[nodiscard]] ACS_API std::string_view GetText(EProtocolNote note);

/// A session has tolerated or discarded something.
struct ProtocolNoted
{
    EProtocolNote what = EProtocolNote::UnknownMember; ///< Which kind of deviation.
    std::uint32_t count = 1;                           ///< Occurrences in this text.
    std::string detail;                                ///< One sentence, may be empty.

    bool operator==(const ProtocolNoted&) const = default;
};

/// What a session delivers (Deliver). Sides and conditions are stated at each alternative.
using SessionEvent = std::variant<
    Registered,
    RegistrationRefused,
    RequestReceived,
    RequestRefused,
    Acked,
    RequestGivenUp,
    AckReceived,
    RequestUnanswered,
    LinkLost,
    WindowOpened,
    PositionDue,
    Stopped,
    ProtocolNoted>;

} // namespace ACS::Protocol
