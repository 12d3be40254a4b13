#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/Result.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::Core
{

/// Any JSON value as compact text, for values that a protocol passes through (the result of a GET, the value of an action
/// parameter). Valid JSON by construction.
class ACS_API JsonText
{
    std::string _text = "null";

    explicit JsonText(std::string text);

public:
    /// null
    JsonText() = default;

    /// A JSON string. Invalid UTF-8 becomes U+FFFD.
    [[nodiscard]] static JsonText FromString(std::string_view value);
    /// A JSON number with this value; null if the value is not finite.
    [[nodiscard]] static JsonText FromNumber(double value);
    /// A JSON number without a fraction.
    [[nodiscard]] static JsonText FromInteger(std::int64_t value);
    /// true or false
    [[nodiscard]] static JsonText FromBoolean(bool bValue);

    /// Appends the text of FromString. All JSON strings are written here.
    static void AppendString(std::string_view value, std::string& out);

    /// Whether JSON can carry this text unchanged: well-formed UTF-8 without lone surrogates.
    [[nodiscard]] static bool IsUtf8(std::string_view text) noexcept;

    /// A text that is known to be JSON, for example a part of a message that a codec has parsed. Not checked: use a codec
    /// for texts from outside.
    [[nodiscard]] static JsonText FromTrusted(std::string text);

    /// Valid JSON in UTF-8 without blanks between its parts, unless FromTrusted had others.
    [[nodiscard]] const std::string& GetText() const noexcept;

    /// Moves the text out with its buffer; the value becomes null.
    [[nodiscard]] std::string TakeText();

    /// The text of a JSON string without quotes and escapes, with lone surrogates replaced by U+FFFD; nullopt if this is not a
    /// string.
    [[nodiscard]] std::optional<std::string> GetStringOrNull() const;
    /// The value of a JSON number; nullopt if this is not a number.
    [[nodiscard]] std::optional<double> GetNumberOrNull() const;
    /// true or false; nullopt if this is neither.
    [[nodiscard]] std::optional<bool> GetBooleanOrNull() const;

    bool operator==(const JsonText&) const = default;
};

} // namespace ACS::Core
