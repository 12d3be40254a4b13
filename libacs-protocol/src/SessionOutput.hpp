#pragma once

#include <acs/core/Now.hpp>
#include <acs/core/Timestamp.hpp>
#include <acs/protocol/DecodeOutcome.hpp>
#include <acs/protocol/SessionAction.hpp>
#include <acs/protocol/SessionStatistics.hpp>

#include <array>
#include <chrono>
#include <cstdint>
#include <string>

namespace ACS::Protocol::Detail
{

/// The answer to an unreadable message.
enum class ERefusal : std::uint8_t
{
    None,       ///< None, only counted: no command, an Ack, or a command without Ack.
    Failed,     ///< A command of the other side: Fail with the error.
    Unsupported ///< Any other command: Fail, "unsupported command".
};

/// The common part of both sessions: statistics and notes, and the running timers.
class SessionOutput
{
    std::array<bool, TIMER_COUNT> _running{};

public:
    SessionStatistics statistics;

    void Note(EProtocolNote what, std::string detail, SessionActions& out, std::uint32_t count = 1);
    void NoteAll(const DecodeNotes& notes, SessionActions& out);

    /// Counts an unreadable message, and returns the answer of a side that accepts the commands of the MCS, or of the ACS.
    [[nodiscard]] ERefusal NoteFailure(const DecodeFailure& failure, bool bTakesFromMCS, SessionActions& out);

    void Start(ESessionTimer timer, std::chrono::milliseconds delay, SessionActions& out);
    /// No effect if the timer is not running.
    void Cancel(ESessionTimer timer, SessionActions& out);
    void CancelAll(SessionActions& out);
    /// Whether the timer was running; it is stopped.
    [[nodiscard]] bool TryExpire(ESessionTimer timer);
    [[nodiscard]] bool IsRunning(ESessionTimer timer) const;
};

/// The current time in the format of messages.
[[nodiscard]] Core::Timestamp MakeTimestamp(Core::Now now, std::chrono::minutes offset);

/// The message of a refusal: what is wrong.
[[nodiscard]] std::string MakeRefusal(const DecodeFailure& failure);

/// An empty payload for a refusal, with the planID if the command has one.
[[nodiscard]] AckPayload MakeRefusalPayload(const DecodeFailure& failure);

inline constexpr std::string_view UNSUPPORTED = "unsupported command";

} // namespace ACS::Protocol::Detail
