#pragma once

#include <charconv>
#include <string_view>
#include <system_error>

/// Reads a decimal number; false if the text is anything else, or the number too large for its type.
template <typename TNumber>
[[nodiscard]] bool TryRead(std::string_view text, TNumber& number)
{
    const char* const end = text.data() + text.size(); // NOLINT(*-pointer-arithmetic): from_chars works with pointers
    const auto [rest, error] = std::from_chars(text.data(), end, number);
    return error == std::errc() && rest == end;
}
