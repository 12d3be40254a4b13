#pragma once

#include <acs/core/Api.hpp>

#include <cstdint>
#include <string_view>

namespace ACS::Planning
{

/// Severity of an alarm.
enum class EAlarmLevel : std::uint8_t
{
    Heavy, ///< Work cannot continue.
    Light, ///< A warning; work continues.
};

/// The value of section 3 ("heavy").
[[nodiscard]] ACS_API std::string_view GetText(EAlarmLevel value) noexcept;

} // namespace ACS::Planning
