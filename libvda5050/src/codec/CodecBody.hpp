#pragma once

#include <acs/json/JsonDecoder.hpp>
#include <acs/json/JsonDocument.hpp>
#include <acs/json/JsonEncoder.hpp>
#include <acs/vda5050/Vda5050Codec.hpp>

#include <cassert>
#include <string>
#include <string_view>

namespace ACS::VDA5050
{

struct Vda5050Codec::Scratch
{
    Json::JsonDocument document;
};

/// What WrittenIn takes: a version of the protocol is a dialect.
namespace Dialects
{
inline constexpr Json::DialectFlags VERSION_200 = 1U << 0U;
inline constexpr Json::DialectFlags VERSION_210 = 1U << 1U;
} // namespace Dialects

[[nodiscard]] constexpr Json::DialectFlags GetDialect(EVda5050Version version)
{
    switch (version)
    {
        case EVda5050Version::Version200:
            return Dialects::VERSION_200;
        case EVda5050Version::Version210:
            return Dialects::VERSION_210;
        default:
            assert(false && "a version has no dialect");
            return Json::ALL_DIALECTS;
    }
}

template <typename TMessage>
Core::Result<TMessage> Vda5050Codec::Decode(std::string_view payload)
{
    _tolerance = {};
    const Core::Result<const Json::Value*> root =
        _scratch->document.Parse(payload, Json::ParseLimits{_limits.payloadBytes, _limits.depth});
    if (!root)
    {
        return tl::unexpected(root.error());
    }
    Json::DecodeContext context;
    Core::Result<TMessage> message;
    if (!Json::TryDecode(**root, *message, {}, context))
    {
        return tl::unexpected(context.TakeError());
    }
    const Json::DecodeNotes& notes = context.GetNotes();
    _tolerance = DecodeTolerance{notes.unknownMembers, notes.nullOptionals, notes.lenientWords};
    return message;
}

template <typename TMessage>
void Vda5050Codec::Encode(const TMessage& message, EVda5050Version version, std::string& out) const
{
    out.clear();
    Json::JsonWriter writer(out, GetDialect(version));
    Json::Encode(message, writer);
}

} // namespace ACS::VDA5050
