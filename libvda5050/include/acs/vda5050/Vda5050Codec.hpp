#pragma once

#include <acs/core/Result.hpp>
#include <acs/vda5050/ConnectionMessage.hpp>
#include <acs/vda5050/EVda5050Version.hpp>
#include <acs/vda5050/FactsheetMessage.hpp>
#include <acs/vda5050/InstantActionsMessage.hpp>
#include <acs/vda5050/OrderMessage.hpp>
#include <acs/vda5050/StateMessage.hpp>
#include <acs/vda5050/VisualizationMessage.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::VDA5050
{

/// One place for what a payload may be at most.
struct CodecLimits
{
    std::size_t payloadBytes = 4U * 1024U * 1024U;
    std::size_t depth = 64;

    bool operator==(const CodecLimits&) const = default;
};

/// What the last Decode tolerated.
struct DecodeTolerance
{
    std::uint32_t unknownMembers = 0;
    std::uint32_t nullOptionals = 0; ///< null in an optional member is read as absent.
    std::uint32_t lenientWords = 0;  ///< An enumeration in other letter case.

    bool operator==(const DecodeTolerance&) const = default;
};

/// Whose a message is, and which order it belongs to.
struct MessageIdentity
{
    Header header; ///< Without its timestamp; empty where a member is missing or of another type.
    bool bHeaderIDGiven = false;
    std::string orderID;
    std::optional<std::uint32_t> orderUpdateID;

    bool operator==(const MessageIdentity&) const = default;
};

/// Turns payloads into messages and back. Reads 2.0 and 2.1 and what their schemas misspell (allowedDeviationXy,
/// actionName, instantActions); writes one version strictly: members that it does not know are left out.
/// Total: bad input is an error value with its JSON path. Holds no buffers between calls, so that hundreds of sessions
/// with a codec each cost nothing; one thread at a time.
class Vda5050Codec
{
    CodecLimits _limits;
    DecodeTolerance _tolerance;

public:
    explicit Vda5050Codec(const CodecLimits& limits = {});

    /// TMessage is one of the six messages. Errors are Core::ECoreError with the path, expected and found.
    template <typename TMessage>
    [[nodiscard]] Core::Result<TMessage> Decode(std::string_view payload);

    /// Tolerances of the last Decode.
    [[nodiscard]] const DecodeTolerance& GetTolerance() const noexcept;

    /// What names a message, as far as it can be read: for the error report about a payload that Decode refused. A member
    /// of the wrong type is left out; an error is only what is no JSON.
    [[nodiscard]] Core::Result<MessageIdentity> DecodeIdentity(std::string_view payload);

    /// Replaces out by the payload; out is reused by the caller, so that writing allocates nothing once it has grown.
    template <typename TMessage>
    void Encode(const TMessage& message, EVda5050Version version, std::string& out) const;

    template <typename TMessage>
    [[nodiscard]] std::string Encode(const TMessage& message, EVda5050Version version) const
    {
        std::string text;
        Encode(message, version, text);
        return text;
    }
};

extern template Core::Result<OrderMessage> Vda5050Codec::Decode(std::string_view payload);
extern template Core::Result<InstantActionsMessage> Vda5050Codec::Decode(std::string_view payload);
extern template Core::Result<StateMessage> Vda5050Codec::Decode(std::string_view payload);
extern template Core::Result<VisualizationMessage> Vda5050Codec::Decode(std::string_view payload);
extern template Core::Result<ConnectionMessage> Vda5050Codec::Decode(std::string_view payload);
extern template Core::Result<FactsheetMessage> Vda5050Codec::Decode(std::string_view payload);

extern template void Vda5050Codec::Encode(const OrderMessage& message, EVda5050Version version, std::string& out) const;
extern template void Vda5050Codec::Encode(
    const InstantActionsMessage& message,
    EVda5050Version version,
    std::string& out) const;
extern template void Vda5050Codec::Encode(const StateMessage& message, EVda5050Version version, std::string& out) const;
extern template void Vda5050Codec::Encode(
    const VisualizationMessage& message,
    EVda5050Version version,
    std::string& out) const;
extern template void Vda5050Codec::Encode(const ConnectionMessage& message, EVda5050Version version, std::string& out)
    const;
extern template void Vda5050Codec::Encode(const FactsheetMessage& message, EVda5050Version version, std::string& out)
    const;

} // namespace ACS::VDA5050
