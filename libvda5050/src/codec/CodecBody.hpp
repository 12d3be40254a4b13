#pragma once

#include <acs/json/JsonDecoder.hpp>
#include <acs/json/JsonDocument.hpp>
#include <acs/json/JsonEncoder.hpp>
#include <acs/vda5050/Vda5050Codec.hpp>

#include <cassert>
#include <concepts>
#include <string>
#include <string_view>

namespace ACS::VDA5050
{

/// What WrittenIn takes: a version of the protocol is a dialect, and has another one for visualization, whose schemas know
/// less of a position than those of state.
namespace Dialects
{
inline constexpr Json::DialectFlags VERSION_200 = 1U << 0U;
inline constexpr Json::DialectFlags VERSION_210 = 1U << 1U;
inline constexpr Json::DialectFlags VISUALIZATION_200 = 1U << 4U;
inline constexpr Json::DialectFlags VISUALIZATION_210 = 1U << 5U;
inline constexpr Json::DialectFlags OUTSIDE_VISUALIZATION = VERSION_200 | VERSION_210;
} // namespace Dialects

template <typename TMessage>
[[nodiscard]] constexpr Json::DialectFlags GetDialect(EVda5050Version version)
{
    constexpr bool B_VISUALIZATION = std::same_as<TMessage, VisualizationMessage>;
    switch (version)
    {
        case EVda5050Version::Version200:
            return B_VISUALIZATION ? Dialects::VISUALIZATION_200 : Dialects::VERSION_200;
        case EVda5050Version::Version210:
            return B_VISUALIZATION ? Dialects::VISUALIZATION_210 : Dialects::VERSION_210;
        default:
            assert(false && "a version has no dialect");
            return Json::ALL_DIALECTS;
    }
}

template <typename TMessage>
Core::Result<TMessage> Vda5050Codec::Decode(std::string_view payload)
{
    _tolerance = {};
    Json::JsonDocument document;
    const Core::Result<const Json::Value*> root =
        document.Parse(payload, Json::ParseLimits{_limits.payloadBytes, _limits.depth});
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
    Json::JsonWriter writer(out, GetDialect<TMessage>(version));
    Json::Encode(message, writer);
}

} // namespace ACS::VDA5050
