#pragma once

#include <acs/core/Now.hpp>

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::Acsctl
{

/// "42 s", "12 min", "5 h 12 min", "3 d"; a negative duration counts as 0.
[[nodiscard]] std::string MakeDurationText(std::chrono::seconds duration);

/// The duration from a time of the API to now; "-" without a time or if it cannot be read.
[[nodiscard]] std::string MakeAge(const std::optional<std::string>& timeOrNull, Core::WallTime now);

/// " for 12 min", or nothing without a time.
[[nodiscard]] std::string MakeSince(const std::optional<std::string>& timeOrNull, Core::WallTime now);

/// The time of day of a time of the API, "23:10:00.123"; the whole text if it cannot be read.
[[nodiscard]] std::string MakeTimeOfDay(std::string_view time);

} // namespace ACS::Acsctl
