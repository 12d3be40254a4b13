#pragma once

#include <acs/protocol/EAckResult.hpp>
#include <acs/protocol/EAcsCommand.hpp>
#include <acs/protocol/SessionEvent.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace ACS::Protocol
{

/// What happened with one command since the session was made, over all connections.
struct CommandCounters
{
    std::uint64_t sent = 0;         ///< Requests, resends included.
    std::uint64_t received = 0;     ///< Requests, repeated ones included.
    std::uint64_t duplicates = 0;   ///< Requests received whose transaction had come before.
    std::uint64_t acknowledged = 0; ///< Requests of the other side that were answered, with either result.
    std::uint64_t refused = 0;      ///< Of these with Fail.
    std::uint64_t answered = 0;     ///< Own requests for which an Ack came.

    /// A request of the other side is answered.
    void CountAnswer(EAckResult result)
    {
        ++acknowledged;
        refused += result == EAckResult::Fail ? 1U : 0U;
    }

    bool operator==(const CommandCounters&) const = default;
};

struct SessionStatistics
{
    std::array<CommandCounters, COMMAND_COUNT> commands{};
    std::array<std::uint64_t, NOTE_COUNT> notes{};
    std::uint64_t connects = 0;      ///< Connections that were opened.
    std::uint64_t registrations = 0; ///< That succeeded.
    std::uint64_t linkLosses = 0;
    std::uint64_t positionTicksMissed = 0; ///< ACS side: of PositionDue, because the session was called too late.

    [[nodiscard]] CommandCounters& Of(EAcsCommand command)
    {
        return commands[static_cast<std::size_t>(command)];
    }

    [[nodiscard]] const CommandCounters& Of(EAcsCommand command) const
    {
        return commands[static_cast<std::size_t>(command)];
    }

    [[nodiscard]] std::uint64_t CountOf(EProtocolNote note) const
    {
        return notes[static_cast<std::size_t>(note)];
    }
};

} // namespace ACS::Protocol
