#pragma once

#include <acs/core/Result.hpp>

#include <chrono>
#include <string>
#include <string_view>

namespace ACS::Apps
{

/// What ParseDuration expects, for errors.
inline constexpr std::string_view DURATION_FORM = "a duration such as '200ms', '5s', '2m' or '1h'";

/// A whole number and its unit: "200ms", "5s", "2m" (minutes), "1h"; at most a year.
[[nodiscard]] Core::Result<std::chrono::milliseconds> ParseDuration(std::string_view text);

/// The duration in the largest unit that shows it exactly.
[[nodiscard]] std::string MakeDurationText(std::chrono::milliseconds duration);

} // namespace ACS::Apps
