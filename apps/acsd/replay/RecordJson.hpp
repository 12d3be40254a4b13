#pragma once

#include <acs/core/Result.hpp>
#include <acs/json/JsonDecoder.hpp>
#include <acs/json/JsonEncoder.hpp>

#include <limits>
#include <string>
#include <string_view>
#include <utility>

namespace ACS::Acsd
{

/// The JSON text of a struct with a field table.
template <typename TValue>
[[nodiscard]] std::string EncodeRecord(const TValue& value)
{
    std::string text;
    Json::JsonWriter writer(text);
    Json::Encode(value, writer);
    return text;
}

/// Reads what EncodeRecord wrote, however long it is. Accepts any text.
template <typename TValue>
[[nodiscard]] Core::Result<TValue> DecodeRecord(std::string_view text)
{
    constexpr std::size_t ANY = std::numeric_limits<std::size_t>::max();
    Json::JsonDocument document;
    Json::ParseLimits limits;
    limits.bytes = ANY;
    limits.values = ANY;
    const Core::Result<const Json::Value*> root = document.Parse(text, limits);
    if (!root.has_value())
    {
        return tl::unexpected(root.error());
    }
    Json::DecodeOptions options;
    options.maximumString = ANY;
    options.maximumArray = ANY;
    Json::DecodeContext context(options);
    TValue value;
    if (!Json::TryDecode(**root, value, {}, context))
    {
        return tl::unexpected(context.TakeError());
    }
    return value;
}

} // namespace ACS::Acsd
