#pragma once

#include <cstdint>
#include <string_view>

namespace ACS::Planning
{

/// Severity of an alarm.
enum class EAlarmLevel : std::uint8_t
{
    Heavy, ///< The robot cannot work.
    Light, ///< A warning; the robot continues to work.
};

/// The value of section 3 ("heavy").
[[nodiscard]] std::string_view GetText(EAlarmLevel value) noexcept;

} // namespace ACS::Planning
