#pragma once

#include <cstdint>
#include <string_view>

namespace ACS::Planning
{

/// How bad an alarm is.
enum class EAlarmLevel : std::uint8_t
{
    Heavy, ///< Work cannot go on.
    Light, ///< A warning.
};

/// The word of section 3 ("heavy").
[[nodiscard]] std::string_view GetText(EAlarmLevel value) noexcept;

} // namespace ACS::Planning
