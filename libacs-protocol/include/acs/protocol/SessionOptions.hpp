#pragma once

#include <acs/core/Backoff.hpp>
#include <acs/protocol/CodecOptions.hpp>
#include <acs/protocol/EAcsCommand.hpp>
#include <acs/protocol/EUnansweredPolicy.hpp>

#include <bitset>
#include <chrono>
#include <cstddef>

namespace ACS::Protocol
{

/// Times and limits of an AcsSession. The document leaves them open.
struct SessionOptions
{
    std::chrono::milliseconds ackTimeout{5'000}; ///< Maximum time to wait for an Ack, that of Registration included.
    std::size_t ackRetries = 3;                  ///< Resends of one message per connection.
    std::size_t ackDeadAfter = 5; ///< Consecutive messages without an Ack after which the connection is renewed.
    std::size_t window = 16;      ///< Maximum number of messages without an Ack; at least 1.
    /// Whether an Ack with an unknown transactionID is matched to the oldest message of its command (D-4).
    bool bAcksMatchedByCommand = true;
    std::chrono::milliseconds positionInterval{200}; ///< Interval of PositionDue; 0 disables it.
    std::chrono::milliseconds answerMemory{600'000}; ///< How long an Ack is kept for repeated requests.
    std::size_t answerCount = 1024;                  ///< Maximum number of Acks that are kept.
    std::size_t answerBytes = 4U * 1024U * 1024U;    ///< Maximum size of all Acks that are kept.
    std::chrono::milliseconds shutdownGrace{2'000};  ///< Maximum time that Stop waits for its last Ack.
    Core::BackoffOptions reconnect{};                ///< 0.5 s to 10 s.
    CodecOptions codec{};                            ///< Its siteOffset also applies to the timestamps that are sent.
};

/// Times and limits of an McsSession.
struct McsSessionOptions
{
    std::chrono::milliseconds ackTimeout{5'000}; ///< Maximum time to wait for an Ack.
    /// Resends of one request per connection, each after ackTimeout, with the same text. Only for an ACS that recognises a
    /// repeated request: another one may refuse the repeated plan as a duplicate.
    std::size_t ackRetries = 0;
    std::size_t maximumPending = 1024;            ///< Maximum number of requests without an Ack.
    std::size_t duplicateMemory = 4'096;          ///< Transactions remembered with their answers, for repeated reports.
    std::size_t answerBytes = 4U * 1024U * 1024U; ///< Maximum size of the messages of these answers.
    /// The commands, by EAcsCommand, whose Ack is the answer of the application (IMcsSession::TryAnswer). The session
    /// answers the others at once with Success. Commands of the MCS and RobotPositionUpdate have no effect here.
    std::bitset<COMMAND_COUNT> answeredByApplication;
    std::chrono::milliseconds answerTimeout{10'000}; ///< Maximum time of the application to answer.
    std::size_t maximumUnanswered = 256;             ///< Maximum number of reports that wait for the application.
    EUnansweredPolicy unansweredPolicy = EUnansweredPolicy::Fail; ///< For reports; a Registration always gets Fail.
    std::chrono::milliseconds registrationTimeout{10'000}; ///< A connection without Registration is closed (1008).
    bool bPlansWithheld = true;  ///< Send no ExecutionPlan while the ACS reports isConnected=false (section 6.21).
    bool bSecondRefused = false; ///< Refuse a second client (403, 1008) instead of replacing the first.
    CodecOptions codec{};        ///< Its siteOffset also applies to the timestamps that are sent.
};

} // namespace ACS::Protocol
