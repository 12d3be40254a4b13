#pragma once

#include <cstddef>
#include <string_view>

namespace ACS::VdaSim
{

/// Truncates a peer's text for a log line: at most 200 bytes, whole UTF-8 characters.
[[nodiscard]] inline std::string_view CutForLog(std::string_view text)
{
    constexpr std::size_t MOST = 200;
    constexpr unsigned CONTINUATION_MASK = 0xC0;
    constexpr unsigned CONTINUATION = 0x80;
    std::size_t size = text.size();
    if (size > MOST)
    {
        size = MOST;
        while (size > 0 && (static_cast<unsigned char>(text[size]) & CONTINUATION_MASK) == CONTINUATION)
        {
            --size;
        }
    }
    return text.substr(0, size);
}

} // namespace ACS::VdaSim
