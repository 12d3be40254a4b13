#include "view/AgeText.hpp"

#include <acs/core/Result.hpp>
#include <acs/core/Timestamp.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace ACS::Acsctl
{

namespace
{

using namespace std::chrono_literals;

constexpr auto MINUTES_UP_TO = 60min;
constexpr auto HOURS_UP_TO = 48h;
constexpr long long HOURS_OF_DAY = 24;

std::optional<std::chrono::seconds> ReadAgeOrNull(const std::optional<std::string>& timeOrNull, Core::WallTime now)
{
    if (!timeOrNull.has_value())
    {
        return std::nullopt;
    }
    const Core::Result<Core::Timestamp> read = Core::ParseTimestamp(*timeOrNull);
    if (!read.has_value())
    {
        return std::nullopt;
    }
    return std::chrono::duration_cast<std::chrono::seconds>(now - read->time);
}

} // namespace

std::string MakeDurationText(std::chrono::seconds duration)
{
    const std::chrono::seconds positive = std::max(duration, std::chrono::seconds(0));
    const auto minutes = std::chrono::duration_cast<std::chrono::minutes>(positive);
    const auto hours = std::chrono::duration_cast<std::chrono::hours>(positive);
    if (minutes < 1min)
    {
        return fmt::format("{} s", positive.count());
    }
    if (minutes < MINUTES_UP_TO)
    {
        return fmt::format("{} min", minutes.count());
    }
    if (hours < HOURS_UP_TO)
    {
        return fmt::format("{} h {} min", hours.count(), (minutes - hours).count());
    }
    return fmt::format("{} d", hours.count() / HOURS_OF_DAY);
}

std::string MakeAge(const std::optional<std::string>& timeOrNull, Core::WallTime now)
{
    const std::optional<std::chrono::seconds> age = ReadAgeOrNull(timeOrNull, now);
    return age.has_value() ? MakeDurationText(*age) : "-";
}

std::string MakeSince(const std::optional<std::string>& timeOrNull, Core::WallTime now)
{
    const std::optional<std::chrono::seconds> age = ReadAgeOrNull(timeOrNull, now);
    return age.has_value() ? " for " + MakeDurationText(*age) : std::string();
}

std::string MakeTimeOfDay(std::string_view time)
{
    constexpr std::size_t DATE = 11; // 2026-11-27T
    if (!Core::ParseTimestamp(time).has_value() || time.size() <= DATE)
    {
        return std::string(time);
    }
    const std::size_t end = time.find_first_of("Zz+-", DATE);
    return std::string(time.substr(DATE, end == std::string_view::npos ? end : end - DATE));
}

} // namespace ACS::Acsctl
