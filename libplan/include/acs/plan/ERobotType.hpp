#pragma once

#include <cstdint>
#include <string_view>

namespace ACS::Planning
{

/// What a robot is for.
enum class ERobotType : std::uint8_t
{
    LR, ///< Logistics robot: cassettes.
    CR, ///< Control robot: trays and memory, has an arm.
};

/// The word of section 3 ("LR").
[[nodiscard]] std::string_view GetText(ERobotType value) noexcept;

} // namespace ACS::Planning
