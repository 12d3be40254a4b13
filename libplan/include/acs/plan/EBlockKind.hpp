#pragma once

#include <acs/core/Api.hpp>

#include <cstdint>
#include <string_view>

namespace ACS::Planning
{

/// What a block closes.
enum class EBlockKind : std::uint8_t
{
    Node,    ///< No drive enters the node.
    Edge,    ///< No drive uses the edge; the edge in the other direction is another one.
    Station, ///< No drive to the station begins. Drives to other stations may pass its docks.
};

/// "node"
[[nodiscard]] ACS_API std::string_view GetText(EBlockKind value) noexcept;

} // namespace ACS::Planning
