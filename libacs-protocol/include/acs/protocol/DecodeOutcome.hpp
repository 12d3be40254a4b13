#pragma once

#include <acs/core/Result.hpp>
#include <acs/core/Timestamp.hpp>
#include <acs/protocol/AcsMessage.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace ACS::Protocol
{

/// Deviations that the codec tolerated in one text.
struct DecodeNotes
{
    std::uint32_t unknownMembers = 0; ///< Members that the protocol does not define, which are ignored.
    std::uint32_t nullOptionals = 0;  ///< Null instead of an absent member.
    std::uint32_t lenientWords = 0;   ///< Command and enumeration names with different upper or lower case.
    std::uint32_t lenientNumbers = 0; ///< Numbers written as strings.
    std::uint32_t badTimestamps = 0;  ///< Missing or unreadable; read as the epoch.

    bool operator==(const DecodeNotes&) const = default;
};

/// Why a text is not a valid message, and the readable parts of its envelope, which an answer needs.
struct DecodeFailure
{
    Core::Error error;                  ///< What is invalid, with its JSON path.
    std::string commandName;            ///< As sent, including the Ack suffix; empty: none, an answer is impossible.
    std::optional<EAcsCommand> command; ///< Nullopt: not a command of the protocol.
    std::string transactionID;          ///< May be empty.
    std::optional<Core::Timestamp> timestamp; ///< Nullopt: missing or unreadable.
    std::string planID;                       ///< Of the payload, like the next two; may be empty.
    std::string robotID;                      ///< As sent; may be empty.
    std::string jobID;                        ///< As sent; may be empty.
    bool bAck = false;                        ///< A response, which is never answered.
};

/// The result of AcsCodec::Decode.
struct DecodeOutcome
{
    tl::expected<AcsMessage, DecodeFailure> message; ///< The message, or why the text is not one.
    DecodeNotes notes;                               ///< What was tolerated, also before a failure.
    bool bLegacyName = false; ///< A RequestAcsPlans named RequestAcsStatus: answer under that name (D-5).
};

} // namespace ACS::Protocol
