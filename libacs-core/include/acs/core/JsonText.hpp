#pragma once

#include <acs/core/Result.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::Core
{

/// Any JSON value, kept as its compact text: what a protocol carries without looking inside (the result of a GET, the
/// value of an action parameter). Valid JSON by construction.
class JsonText
{
    std::string _text = "null";

    explicit JsonText(std::string text);

public:
    /// null
    JsonText() = default;

    /// A JSON string (what is no UTF-8 becomes U+FFFD), a number (null where it is not finite), a boolean: made, not parsed.
    [[nodiscard]] static JsonText FromString(std::string_view value);
    [[nodiscard]] static JsonText FromNumber(double value);
    [[nodiscard]] static JsonText FromInteger(std::int64_t value);
    [[nodiscard]] static JsonText FromBoolean(bool bValue);

    /// Appends what FromString makes: the one place that writes JSON strings.
    static void AppendString(std::string_view value, std::string& out);

    /// Whether JSON may carry this text as it is: well-formed UTF-8, without halves of surrogate pairs.
    [[nodiscard]] static bool IsUtf8(std::string_view text) noexcept;

    /// Text that is known to be JSON, such as what a codec of this SDK cut out of a parsed message. Not checked:
    /// text from outside goes through the parser of ACS::Json.
    [[nodiscard]] static JsonText FromTrusted(std::string text);

    [[nodiscard]] const std::string& GetText() const noexcept;

    /// Gives the text away, with its room on the heap; what is left is null.
    [[nodiscard]] std::string TakeText();

    /// The text of a JSON string without quotes and escapes, half a surrogate pair replaced by U+FFFD; nullopt where
    /// this is no string.
    [[nodiscard]] std::optional<std::string> GetStringOrNull() const;
    [[nodiscard]] std::optional<double> GetNumberOrNull() const;
    [[nodiscard]] std::optional<bool> GetBooleanOrNull() const;

    bool operator==(const JsonText&) const = default;
};

} // namespace ACS::Core
