#pragma once

#include <acs/core/Now.hpp>
#include <acs/protocol/AcsMessage.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace ACS::AcsSim
{

/// The answer that a request of the ACS must have.
enum class EExpectedAnswer : std::uint8_t
{
    Success,
    Any,              ///< The specification leaves it open, for example for a report about an unknown plan.
    FailPayload,      ///< Its payload is undefined.
    FailCommand,      ///< Its command is unknown.
    SuccessConnected, ///< AcsCommStateUpdate: its answer begins the time without plans if it is false.
};

/// A request of the ACS, and what has become of it.
struct SentRequest
{
    std::string command;
    EExpectedAnswer expected = EExpectedAnswer::Success;
    bool bConnected = true; ///< Of AcsCommStateUpdate.
    std::size_t sends = 0;  ///< On this connection, like the next.
    std::size_t acks = 0;
    std::uint64_t order = 0;      ///< Of the last sending.
    std::uint64_t connection = 0; ///< Of the last sending.
    bool bReconnected = false;    ///< Sent on more than one connection.
    bool bOpen = false;           ///< It waits for its Ack on this connection.
    bool bOverdue = false;        ///< Reported as unanswered.
    Core::SteadyTime deadline;
    std::optional<Protocol::EAckResult> result; ///< Of the first Ack.
};

/// A plan of the MCS.
struct ReceivedPlan
{
    std::string transactionID; ///< Of the last ExecutionPlan.
    std::optional<Protocol::EAckResult> answer;
};

} // namespace ACS::AcsSim
