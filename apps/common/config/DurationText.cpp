#include "common/config/DurationText.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cstdint>

namespace ACS::Apps
{

namespace
{

struct Unit
{
    std::string_view name;
    std::int64_t milliseconds;
};

/// Largest unit first.
constexpr std::array<Unit, 4> UNITS{{{"h", 3'600'000}, {"m", 60'000}, {"s", 1'000}, {"ms", 1}}};
constexpr std::chrono::milliseconds MAX_DURATION = std::chrono::hours(24 * 366);

} // namespace

Core::Result<std::chrono::milliseconds> ParseDuration(std::string_view text)
{
    std::uint32_t count = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
    if (error == std::errc())
    {
        const std::string_view name = text.substr(static_cast<std::size_t>(end - text.data()));
        for (const Unit& unit : UNITS)
        {
            const std::chrono::milliseconds duration(count * unit.milliseconds);
            if (unit.name == name && duration <= MAX_DURATION)
            {
                return duration;
            }
        }
    }
    return Core::Fail(Core::ECoreError::OutOfRange, {}, std::string(DURATION_FORM), fmt::format("'{}'", text));
}

std::string MakeDurationText(std::chrono::milliseconds duration)
{
    for (const Unit& unit : UNITS)
    {
        if (duration.count() != 0 && duration.count() % unit.milliseconds == 0)
        {
            return fmt::format("{}{}", duration.count() / unit.milliseconds, unit.name);
        }
    }
    return "0ms";
}

} // namespace ACS::Apps
