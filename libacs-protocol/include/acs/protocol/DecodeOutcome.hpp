#pragma once

#include <acs/core/Result.hpp>
#include <acs/core/Timestamp.hpp>
#include <acs/protocol/AcsMessage.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace ACS::Protocol
{

/// What the codec put up with in one text: counted, so that a peer's habits show.
struct DecodeNotes
{
    std::uint32_t unknownMembers = 0;
    std::uint32_t nullOptionals = 0;  ///< Null where the member should have been left out.
    std::uint32_t lenientWords = 0;   ///< Commands and enumeration words in another case.
    std::uint32_t lenientNumbers = 0; ///< Numbers written as strings.
    std::uint32_t badTimestamps = 0;  ///< Missing or unreadable; read as the epoch.

    bool operator==(const DecodeNotes&) const = default;
};

/// Why a text is no message, and all of its envelope that could be read nevertheless, so that it can be answered.
struct DecodeFailure
{
    Core::Error error;
    std::string commandName; ///< As sent, the Ack suffix included; empty: there was none, no answer possible.
    std::optional<EAcsCommand> command;       ///< Nullopt: a command that the protocol does not have.
    std::string transactionID;                ///< May be empty.
    std::optional<Core::Timestamp> timestamp; ///< Nullopt: missing or unreadable.
    std::string planID;                       ///< Of the payload, like the next two; may be empty.
    std::string robotID;
    std::string jobID;
    bool bAck = false; ///< It was a response: never answered.
};

struct DecodeOutcome
{
    tl::expected<AcsMessage, DecodeFailure> message;
    DecodeNotes notes;
    bool bLegacyName = false; ///< A RequestAcsPlans that called itself RequestAcsStatus: answer under that name (D-5).
};

} // namespace ACS::Protocol
