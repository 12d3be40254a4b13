#include "CodecBody.hpp"
#include "CommonFields.hpp"

namespace ACS::VDA5050
{

namespace
{

/// As much of a header as there is.
struct PartialHeader
{
    Header header;
};

} // namespace

} // namespace ACS::VDA5050

namespace ACS::Json
{

template <>
struct JsonFields<VDA5050::PartialHeader>
{
    using Type = VDA5050::PartialHeader;
    static constexpr auto FIELDS = std::make_tuple(
        DefaultedInHeader<Type>("headerId", &VDA5050::Header::headerID),
        DefaultedInHeader<Type>("version", &VDA5050::Header::version),
        DefaultedInHeader<Type>("manufacturer", &VDA5050::Header::manufacturer),
        DefaultedInHeader<Type>("serialNumber", &VDA5050::Header::serialNumber));
};

} // namespace ACS::Json

namespace ACS::VDA5050
{

Vda5050Codec::Vda5050Codec(const CodecLimits& limits)
    : _scratch(std::make_unique<Scratch>()),
      _limits(limits)
{
}

Vda5050Codec::Vda5050Codec(Vda5050Codec&& other) noexcept = default;
Vda5050Codec& Vda5050Codec::operator=(Vda5050Codec&& other) noexcept = default;
Vda5050Codec::~Vda5050Codec() = default;

const DecodeTolerance& Vda5050Codec::GetTolerance() const noexcept
{
    return _tolerance;
}

Core::Result<Header> Vda5050Codec::DecodeHeader(std::string_view payload)
{
    const Core::Result<const Json::Value*> root =
        _scratch->document.Parse(payload, Json::ParseLimits{_limits.payloadBytes, _limits.depth});
    if (!root)
    {
        return tl::unexpected(root.error());
    }
    Json::DecodeContext context;
    PartialHeader partial;
    if (!Json::TryDecode(**root, partial, {}, context))
    {
        return tl::unexpected(context.TakeError());
    }
    return std::move(partial.header);
}

} // namespace ACS::VDA5050
