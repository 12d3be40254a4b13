#pragma once

#include <acs/core/Now.hpp>

#include <chrono>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

namespace ACS::VdaSim
{

/// As much of a text from outside as a log line repeats; no character is cut in two.
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

/// For warnings of one kind, of which a peer may cause any number: lets the first of each span of time through.
class WarningLimiter
{
    std::optional<Core::SteadyTime> _begin;
    std::uint32_t _passed = 0;
    std::uint64_t _heldBack = 0;

public:
    static constexpr std::uint32_t MOST = 5;
    static constexpr Core::Duration SPAN = std::chrono::seconds(10);

    /// Absent: do not write this one. Else how many were not written since the last one.
    [[nodiscard]] std::optional<std::uint64_t> PassOrNull(Core::SteadyTime now)
    {
        if (!_begin.has_value() || now - *_begin >= SPAN)
        {
            _begin = now;
            _passed = 0;
        }
        if (_passed >= MOST)
        {
            ++_heldBack;
            return std::nullopt;
        }
        ++_passed;
        return std::exchange(_heldBack, 0);
    }
};

} // namespace ACS::VdaSim
