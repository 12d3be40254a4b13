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

/// Which answer a message gets that cannot be read.
enum class ERefusal : std::uint8_t
{
    None,       ///< No command, an Ack, or a command that has none: it is counted, that is all.
    Failed,     ///< A command of the other side's: Fail, and what is wrong with it.
    Unsupported ///< Any other command: Fail, "unsupported command".
};

/// What both sessions do alike when they put out actions: counting what they note, and knowing which timers run.
class SessionOutput
{
    std::array<bool, TIMER_COUNT> _running{};

public:
    SessionStatistics statistics;

    void Note(EProtocolNote what, std::string detail, SessionActions& out, std::uint32_t count = 1);
    void NoteAll(const DecodeNotes& notes, SessionActions& out);

    /// Counts a message that cannot be read, and says how it is answered by a side that takes such commands from the
    /// MCS, or from the ACS.
    [[nodiscard]] ERefusal NoteFailure(const DecodeFailure& failure, bool bTakesFromMcs, SessionActions& out);

    void Start(ESessionTimer timer, std::chrono::milliseconds delay, SessionActions& out);
    /// Nothing where it does not run.
    void Cancel(ESessionTimer timer, SessionActions& out);
    void CancelAll(SessionActions& out);
    /// Whether it was running; it is not any more.
    [[nodiscard]] bool TryExpire(ESessionTimer timer);
    [[nodiscard]] bool IsRunning(ESessionTimer timer) const;
};

/// The present as the wire shows it.
[[nodiscard]] Core::Timestamp MakeTimestamp(Core::Now now, std::chrono::minutes offset);

/// The sentence of a refusal: what is wrong with the message.
[[nodiscard]] std::string MakeRefusal(const DecodeFailure& failure);

/// An empty payload for a refusal, with the plan's id where the command has one.
[[nodiscard]] AckPayload MakeRefusalPayload(const DecodeFailure& failure);

inline constexpr std::string_view UNSUPPORTED = "unsupported command";

} // namespace ACS::Protocol::Detail
