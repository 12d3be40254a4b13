#pragma once

#include <algorithm>
#include <string_view>

namespace ACS::Core
{

/// U+0000 to U+001F and U+007F, which are invalid in identifiers and must not reach a log unescaped.
[[nodiscard]] constexpr bool IsControlCharacter(char character) noexcept
{
    constexpr unsigned FIRST_PRINTABLE = 0x20;
    constexpr unsigned DELETE_CHARACTER = 0x7F;
    const auto byte = static_cast<unsigned char>(character);
    return byte < FIRST_PRINTABLE || byte == DELETE_CHARACTER;
}

/// Whether IsControlCharacter is true of any byte. Bytes of UTF-8 sequences are none.
[[nodiscard]] constexpr bool HasControlCharacter(std::string_view text) noexcept
{
    return std::any_of(text.begin(), text.end(), IsControlCharacter);
}

} // namespace ACS::Core
