#pragma once

#include <acs/protocol/EAckResult.hpp>
#include <acs/protocol/EAcsCommand.hpp>
#include <acs/protocol/SessionEvent.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace ACS::Protocol
{

/// Counters of one command since the session was created, over all connections.
struct CommandCounters
{
    std::uint64_t sent = 0;         ///< Requests, including resends.
    std::uint64_t received = 0;     ///< Requests, including repeated ones.
    std::uint64_t duplicates = 0;   ///< Received requests whose transaction was known.
    std::uint64_t acknowledged = 0; ///< Received requests that were answered, with any result.
    std::uint64_t refused = 0;      ///< Received requests that were answered with Fail.
    std::uint64_t answered = 0;     ///< Sent requests that were acknowledged.

    /// Counts the answer to a received request.
    void CountAnswer(EAckResult result)
    {
        ++acknowledged;
        refused += result == EAckResult::Fail ? 1U : 0U;
    }

    bool operator==(const CommandCounters&) const = default;
};

/// Counters of a session since it was created, over all connections.
struct SessionStatistics
{
    std::array<CommandCounters, COMMAND_COUNT> commands{}; ///< By EAcsCommand; see Of.
    std::array<std::uint64_t, NOTE_COUNT> notes{};         ///< By EProtocolNote; see CountOf.
    std::uint64_t connects = 0;                            ///< Opened connections.
    std::uint64_t registrations = 0;                       ///< Successful ones.
    /// ACS side: connections that were lost or could not be opened. MCS side: registered ones that were lost or replaced.
    std::uint64_t linkLosses = 0;
    std::uint64_t positionTicksMissed =
        0; ///< ACS side: PositionDue events that were skipped because OnTimer was called too late.

    /// The counters of one command, for the session to change.
    [[nodiscard]] CommandCounters& Of(EAcsCommand command)
    {
        return commands[static_cast<std::size_t>(command)];
    }

    /// The counters of one command.
    [[nodiscard]] const CommandCounters& Of(EAcsCommand command) const
    {
        return commands[static_cast<std::size_t>(command)];
    }

    /// How often the deviation was noted.
    [[nodiscard]] std::uint64_t CountOf(EProtocolNote note) const
    {
        return notes[static_cast<std::size_t>(note)];
    }
};

} // namespace ACS::Protocol
