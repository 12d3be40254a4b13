#include "CodecBody.hpp"
#include "CommonFields.hpp"

namespace ACS::Json
{

template <>
struct JsonFields<VDA5050::MessageIdentity>
{
    using Type = VDA5050::MessageIdentity;
    static constexpr auto FIELDS = std::make_tuple(
        DefaultedInHeader<Type>("headerId", &VDA5050::Header::headerID),
        DefaultedInHeader<Type>("version", &VDA5050::Header::version),
        DefaultedInHeader<Type>("manufacturer", &VDA5050::Header::manufacturer),
        DefaultedInHeader<Type>("serialNumber", &VDA5050::Header::serialNumber),
        Optional("orderId", &Type::orderID),
        Optional("orderUpdateId", &Type::orderUpdateID));
};

} // namespace ACS::Json

namespace ACS::VDA5050
{

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
    Json::DecodeContext context;
    MessageIdentity identity;
    if (!Json::TryDecode(**root, identity, {}, context))
    {
        return tl::unexpected(context.TakeError());
    }
    return identity;
}

} // namespace ACS::VDA5050
