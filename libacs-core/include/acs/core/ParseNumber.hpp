#pragma once

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

namespace ACS::Core
{

/// Reads the whole text as a number, in the notation of std::from_chars: decimal, without blanks and without a plus sign.
/// nullopt if the text is anything else, or if TNumber cannot represent the number. A floating-point TNumber also accepts
/// infinity and not-a-number.
template <typename TNumber>
[[nodiscard]] std::optional<TNumber> ParseNumberOrNull(std::string_view text)
{
    TNumber number{};
    const char* const last = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data(), last, number);
    return error == std::errc() && end == last ? std::optional(number) : std::nullopt;
}

} // namespace ACS::Core
