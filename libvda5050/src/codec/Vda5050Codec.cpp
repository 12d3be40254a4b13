#include "CodecBody.hpp"

namespace ACS::VDA5050
{

namespace
{

template <typename TValue>
std::optional<TValue> ReadMemberOrNull(const Json::Value& object, std::string_view name)
{
    const Json::Value* const valueOrNull = Json::FindFirstOrNull(object, name);
    Json::DecodeContext context;
    TValue value{};
    if (valueOrNull == nullptr || !Json::TryDecode(*valueOrNull, value, {}, context))
    {
        return std::nullopt;
    }
    return value;
}

std::string ReadText(const Json::Value& object, std::string_view name)
{
    return ReadMemberOrNull<std::string>(object, name).value_or(std::string());
}

} // namespace

Vda5050Codec::Vda5050Codec(const CodecLimits& limits)
    : _limits(limits)
{
}

const DecodeTolerance& Vda5050Codec::GetTolerance() const noexcept
{
    return _tolerance;
}

Core::Result<MessageIdentity> Vda5050Codec::DecodeIdentity(std::string_view payload)
{
    Json::JsonDocument document;
    const Core::Result<const Json::Value*> root =
        document.Parse(payload, Json::ParseLimits{_limits.payloadBytes, _limits.depth});
    if (!root)
    {
        return tl::unexpected(root.error());
    }
    // Each by itself: the valid members of an invalid message identify it.
    const std::optional<std::uint32_t> headerID = ReadMemberOrNull<std::uint32_t>(**root, "headerId");
    MessageIdentity identity;
    identity.bHeaderIDGiven = headerID.has_value();
    identity.header.headerID = headerID.value_or(0);
    identity.header.version = ReadText(**root, "version");
    identity.header.manufacturer = ReadText(**root, "manufacturer");
    identity.header.serialNumber = ReadText(**root, "serialNumber");
    identity.orderID = ReadText(**root, "orderId");
    identity.orderUpdateID = ReadMemberOrNull<std::uint32_t>(**root, "orderUpdateId");
    return identity;
}

} // namespace ACS::VDA5050
