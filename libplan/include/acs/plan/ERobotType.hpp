#pragma once

#include <acs/core/Api.hpp>

#include <cstdint>
#include <string_view>

namespace ACS::Planning
{

/// The type of a robot.
enum class ERobotType : std::uint8_t
{
    LR, ///< Logistics robot: moves cassettes.
    CR, ///< Control robot: a base with an arm, for trays and memories.
};

/// The value of section 3 ("LR").
[[nodiscard]] ACS_API std::string_view GetText(ERobotType value) noexcept;

} // namespace ACS::Planning
