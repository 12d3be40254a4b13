#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace ACS::Core
{

/// Bytes of a text that a peer sent in a log line or an alarm.
inline constexpr std::size_t MOST_SHOWN = 200;

/// The text, at most this number of bytes of it: whole UTF-8 characters, followed by "..." where the rest is left out.
[[nodiscard]] inline std::string ShortenText(std::string_view text, std::size_t most)
{
    constexpr unsigned CONTINUATION_MASK = 0xC0;
    constexpr unsigned CONTINUATION = 0x80;
    if (text.size() <= most)
    {
        return std::string(text);
    }
    std::size_t size = most;
    while (size > 0 && (static_cast<unsigned char>(text[size]) & CONTINUATION_MASK) == CONTINUATION)
    {
        --size;
    }
    return std::string(text.substr(0, size)) + "...";
}

/// Likewise, at most MOST_SHOWN bytes.
[[nodiscard]] inline std::string ShortenText(std::string_view text)
{
    return ShortenText(text, MOST_SHOWN);
}

} // namespace ACS::Core
