#pragma once

#include <acs/core/Api.hpp>
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

/// Limits of a payload.
struct CodecLimits
{
    std::size_t payloadBytes = 4U * 1024U * 1024U; ///< Maximum size of a payload in bytes.
    std::size_t depth = 64;                        ///< Maximum nesting of objects and arrays.

    bool operator==(const CodecLimits&) const = default;
};

/// Deviations that the last Decode tolerated.
struct DecodeTolerance
{
    std::uint32_t unknownMembers = 0; ///< Members of no version, which are ignored.
    std::uint32_t nullOptionals = 0;  ///< null in an optional member, read as absent.
    std::uint32_t lenientWords = 0;   ///< An enumeration name with different upper or lower case.

    bool operator==(const DecodeTolerance&) const = default;
};

/// The sender of a message and its order.
struct MessageIdentity
{
    Header header;               ///< Without its timestamp; members of another type are empty.
    bool bHeaderIDGiven = false; ///< Whether Header::headerID was readable.
    std::string orderID;
    std::optional<std::uint32_t> orderUpdateID;

    bool operator==(const MessageIdentity&) const = default;
};

/// Converts payloads to messages and back. Reads 2.0 and 2.1, including the misspellings of their schemas
/// (allowedDeviationXy, actionName, instantActions); writes exactly one version, without members of other versions. Invalid
/// input results in an error with its JSON path. Keeps no buffers between calls, so that a codec per session is cheap. Not
/// shared between threads.
class ACS_API Vda5050Codec
{
    CodecLimits _limits;
    DecodeTolerance _tolerance;

public:
    /// A payload beyond the limits is an error of Decode.
    explicit Vda5050Codec(const CodecLimits& limits = {});

    /// TMessage is one of the six messages. Errors are Core::ECoreError with the path, expected and found.
    template <typename TMessage>
    [[nodiscard]] Core::Result<TMessage> Decode(std::string_view payload);

    /// Tolerances of the last Decode.
    [[nodiscard]] const DecodeTolerance& GetTolerance() const noexcept;

    /// The readable parts of the header and order ids, for the error report about a payload that Decode has refused. Members
    /// of the wrong type are omitted; fails only for invalid JSON.
    [[nodiscard]] Core::Result<MessageIdentity> DecodeIdentity(std::string_view payload);

    /// Replaces out by the payload. A reused out needs no further allocations. Numbers must be finite: another one is left
    /// out where the member is optional; otherwise it is written as null, and the receiver refuses the message.
    template <typename TMessage>
    void Encode(const TMessage& message, EVda5050Version version, std::string& out) const;

    /// As above, into a new string.
    template <typename TMessage>
    [[nodiscard]] std::string Encode(const TMessage& message, EVda5050Version version) const
    {
        std::string text;
        Encode(message, version, text);
        return text;
    }
};

extern template ACS_API Core::Result<OrderMessage> Vda5050Codec::Decode(std::string_view payload);
extern template ACS_API Core::Result<InstantActionsMessage> Vda5050Codec::Decode(std::string_view payload);
extern template ACS_API Core::Result<StateMessage> Vda5050Codec::Decode(std::string_view payload);
extern template ACS_API Core::Result<VisualizationMessage> Vda5050Codec::Decode(std::string_view payload);
extern template ACS_API Core::Result<ConnectionMessage> Vda5050Codec::Decode(std::string_view payload);
extern template ACS_API Core::Result<FactsheetMessage> Vda5050Codec::Decode(std::string_view payload);

extern template ACS_API void Vda5050Codec::Encode(
    const OrderMessage& message,
    EVda5050Version version,
    std::string& out) const;
extern template ACS_API void Vda5050Codec::Encode(
    const InstantActionsMessage& message,
    EVda5050Version version,
    std::string& out) const;
extern template ACS_API void Vda5050Codec::Encode(
    const StateMessage& message,
    EVda5050Version version,
    std::string& out) const;
extern template ACS_API void Vda5050Codec::Encode(
    const VisualizationMessage& message,
    EVda5050Version version,
    std::string& out) const;
extern template ACS_API void Vda5050Codec::Encode(
    const ConnectionMessage& message,
    EVda5050Version version,
    std::string& out) const;
extern template ACS_API void Vda5050Codec::Encode(
    const FactsheetMessage& message,
    EVda5050Version version,
    std::string& out) const;

} // namespace ACS::VDA5050
