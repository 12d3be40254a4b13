#pragma once

#include <acs/core/Result.hpp>
#include <acs/json/JsonDecoder.hpp>
#include <acs/json/JsonEncoder.hpp>

#include <limits>
#include <string>
#include <string_view>

namespace ACS::Json
{

/// The JSON text of a value, for a store or a recording.
template <typename TValue>
[[nodiscard]] std::string EncodeText(const TValue& value)
{
    std::string text;
    JsonWriter writer(text);
    Encode(value, writer);
    return text;
}

/// Reads what EncodeText wrote. Without limits: lengths are limited where the values are accepted. Accepts any text.
template <typename TValue>
[[nodiscard]] Core::Result<TValue> DecodeText(std::string_view text)
{
    constexpr std::size_t ANY = std::numeric_limits<std::size_t>::max();
    JsonDocument document;
    ParseLimits limits;
    limits.bytes = ANY;
    limits.values = ANY;
    const Core::Result<const Value*> root = document.Parse(text, limits);
    if (!root.has_value())
    {
        return tl::unexpected(root.error());
    }
    DecodeOptions options;
    options.maximumString = ANY;
    options.maximumArray = ANY;
    DecodeContext context(options);
    TValue value;
    if (!TryDecode(**root, value, {}, context))
    {
        return tl::unexpected(context.TakeError());
    }
    return value;
}

} // namespace ACS::Json
