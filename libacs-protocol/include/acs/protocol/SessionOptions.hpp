#pragma once

#include <acs/core/Backoff.hpp>
#include <acs/protocol/CodecOptions.hpp>

#include <chrono>
#include <cstddef>

namespace ACS::Protocol
{

/// Times and limits of an AcsSession; the defaults are those of section 9 of the specification.
struct SessionOptions
{
    std::chrono::milliseconds ackTimeout{5'000}; ///< `mcs.ack_timeout`, for the Ack of Registration too.
    std::size_t ackRetries = 3;                  ///< `mcs.ack_retries`: resends of one message per connection.
    std::size_t ackDeadAfter = 5;                ///< `mcs.ack_dead_after`: given up in a row, then a new link.
    std::size_t window = 16;                     ///< `mcs.window`: messages that wait for their Ack; at least 1.
    bool bAcksMatchedByCommand =
        true; ///< `mcs.ack_match`: an Ack with a foreign id answers the oldest of its command (D-4).
    std::chrono::milliseconds positionInterval{200}; ///< `position.interval_ms`; zero: no PositionDue.
    std::chrono::milliseconds answerMemory{600'000}; ///< How long an Ack is kept for a repeated request.
    std::size_t answerCount = 1024;                  ///< And how many at most,
    std::size_t answerBytes = 4U * 1024U * 1024U;    ///< and how many bytes of Acks together.
    std::chrono::milliseconds shutdownGrace{2'000};  ///< Stop waits so long for its last Ack.
    Core::BackoffOptions reconnect{};                ///< 0.5 s to 10 s.
    CodecOptions codec{};                            ///< Its siteOffset is also that of the timestamps sent.
};

/// Times and limits of an McsSession.
struct McsSessionOptions
{
    std::chrono::milliseconds ackTimeout{5'000}; ///< Then RequestUnanswered is delivered; an MCS does not resend.
    std::size_t maximumPending = 1024;           ///< Requests that wait for their Ack.
    std::size_t duplicateMemory = 4'096;         ///< Transactions remembered, to tell repeated reports.
    std::chrono::milliseconds registrationTimeout{10'000}; ///< A connection without Registration is closed (1008).
    bool bPlansWithheld = true;  ///< Send no ExecutionPlan while the ACS has said isConnected=false (section 6.21).
    bool bSecondRefused = false; ///< Refuse a second client (403, 1008) while one is there; else replace.
    /// Habits of the public MCS (section 12), off by default. Of a text longer than this its last chunk of this size is
    /// read, as if it were all of it; 0: every text is read whole.
    std::size_t finalChunkBytes = 0;
    bool bErrorsUnanswered = false; ///< What cannot be read gets no Ack.
    bool bPositionsUnknown = false; ///< RobotPositionUpdate is noted as an unknown command, not delivered.
    bool bNullResults = false;      ///< Requests bear `"result":null,"message":null`.
    CodecOptions codec{};
};

} // namespace ACS::Protocol
