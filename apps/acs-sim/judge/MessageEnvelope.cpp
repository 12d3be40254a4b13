#include "judge/MessageEnvelope.hpp"

#include <acs/core/Result.hpp>
#include <acs/json/EnumNames.hpp>

namespace ACS::AcsSim
{

namespace
{

constexpr std::string_view ACK = "Ack";

std::string ReadText(const Json::Value& object, std::string_view name, MessageEnvelope& envelope)
{
    const Json::Value* const valueOrNull = Json::FindFirstOrNull(object, name);
    if (valueOrNull != nullptr && valueOrNull->IsString())
    {
        return {valueOrNull->GetString(), valueOrNull->GetStringLength()};
    }
    envelope.missing += (envelope.missing.empty() ? "" : ", ") + std::string(name);
    return {};
}

} // namespace

bool MessageEnvelope::IsAck() const
{
    return command.size() > ACK.size()
        && Json::IsEqualIgnoringCase(std::string_view(command).substr(command.size() - ACK.size()), ACK);
}

std::string MessageEnvelope::GetRequestCommand() const
{
    return IsAck() ? command.substr(0, command.size() - ACK.size()) : command;
}

bool MessageEnvelope::IsAckOf(std::string_view requestCommand) const
{
    return IsAck() && Json::IsEqualIgnoringCase(GetRequestCommand(), requestCommand);
}

bool MessageEnvelope::IsExactAckOf(std::string_view requestCommand) const
{
    return IsAckOf(requestCommand) && command.starts_with(requestCommand) && command.ends_with(ACK);
}

std::optional<MessageEnvelope> ReadEnvelopeOrNull(Json::JsonDocument& document, std::string_view text)
{
    const Core::Result<const Json::Value*> parsed = document.Parse(text, {});
    if (!parsed.has_value() || !(*parsed)->IsObject())
    {
        return std::nullopt;
    }
    const Json::Value& object = **parsed;
    MessageEnvelope envelope;
    envelope.command = ReadText(object, "command", envelope);
    envelope.transactionID = ReadText(object, "transactionId", envelope);
    static_cast<void>(ReadText(object, "timestamp", envelope));
    if (envelope.IsAck())
    {
        envelope.result = ReadText(object, "result", envelope);
        return envelope; // Message and payload only "if needed".
    }
    const Json::Value* const payloadOrNull = Json::FindFirstOrNull(object, "payload");
    if (payloadOrNull == nullptr || !payloadOrNull->IsObject())
    {
        envelope.missing += envelope.missing.empty() ? "payload" : ", payload";
    }
    return envelope;
}

} // namespace ACS::AcsSim
