#pragma once

#include <acs/json/JsonDocument.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace ACS::AcsSim
{

/// The members that every message has, as they were sent (section 6.1). Members that are absent or of another type are empty.
struct MessageEnvelope
{
    std::string command;
    std::string transactionID;
    std::string result;  ///< Of an Ack.
    std::string missing; ///< The names of the members that are absent or of another type, separated by ", ".

    /// In any case, as the codec decodes it.
    [[nodiscard]] bool IsAck() const;
    /// Without Ack.
    [[nodiscard]] std::string GetRequestCommand() const;
    /// In any case.
    [[nodiscard]] bool IsAckOf(std::string_view requestCommand) const;
    /// As section 6.1 has it.
    [[nodiscard]] bool IsExactAckOf(std::string_view requestCommand) const;
};

/// Nullopt: the text is not one JSON object.
[[nodiscard]] std::optional<MessageEnvelope> ReadEnvelopeOrNull(Json::JsonDocument& document, std::string_view text);

} // namespace ACS::AcsSim
