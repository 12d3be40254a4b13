#pragma once

#include "LineOutbox.hpp"
#include <acs/core/Now.hpp>
#include <acs/openstream/ClientSessionActions.hpp>
#include <acs/openstream/OpenStreamRequests.hpp>

#include <cstddef>
#include <cstdint>

namespace ACS::OpenStream
{

/// What a ClientSession sends: how far the command in flight is, and when a request that must not leave late has to have
/// left. → Send.
class ClientOutput
{
    LineOutbox _outbox;
    std::uint64_t _commandStart = 0;                        ///< Position before the last command.
    std::uint64_t _commandMark = 0;                         ///< Position after it.
    bool _bControl = false;                                 ///< The last command is a CONTROL.
    std::uint64_t _stopMark = 0;                            ///< Position after the last STOP control.
    Core::SteadyTime _stopDue = Core::SteadyTime::max();    ///< Its deadline.
    Core::SteadyTime _waitingDue = Core::SteadyTime::max(); ///< Deadline of the requests in the outbox.
    Core::SteadyTime _sendingDue = Core::SteadyTime::max(); ///< Likewise of those in flight.

public:
    /// Unsent bytes above which it is full.
    explicit ClientOutput(std::size_t maximumBytes);

    /// For a new connection.
    void Reset();

    /// A command that the session follows: WasCommandTaken and WasCommandSent are about the last one.
    void SendCommand(const OpenStreamRequest& request, ClientActions& out);

    /// A request that must have left until the deadline.
    void SendUntil(const OpenStreamRequest& request, Core::SteadyTime deadline, ClientActions& out);

    /// Drops all CONTROLs that wait, and sends STOP control before everything else that waits. False: one waits already, and
    /// is not repeated: a socket that does not take it would fill the outbox.
    [[nodiscard]] bool TrySendStopControl(Core::SteadyTime deadline, ClientActions& out);

    /// False if no write was in flight.
    [[nodiscard]] bool TryCompleteSend();

    /// Gives everything that waits to the socket, unless a write is in flight.
    void Flush(ClientActions& out);

    [[nodiscard]] bool IsFull() const noexcept;

    /// Whether the last command was given to the socket. What was not taken has no answer: a server that does not read could
    /// otherwise fill the outbox.
    [[nodiscard]] bool WasCommandTaken() const noexcept;
    [[nodiscard]] bool WasCommandSent() const noexcept;

    /// When the first of the requests with a deadline has to have left; max: none waits.
    [[nodiscard]] Core::SteadyTime GetDeadline() const noexcept;
};

} // namespace ACS::OpenStream
