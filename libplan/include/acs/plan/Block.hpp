#pragma once

#include <acs/core/Now.hpp>
#include <acs/plan/EBlockKind.hpp>

#include <cstddef>
#include <string>

namespace ACS::Planning
{

/// Maximum number of blocks.
inline constexpr std::size_t MAXIMUM_BLOCKS = 1'000;

/// Maximum length of Block::reason in bytes.
inline constexpr std::size_t MAXIMUM_REASON_LENGTH = 200;

/// A part of the map that an operator has closed (BlockPlace).
struct Block
{
    EBlockKind kind = EBlockKind::Node; ///< What id names.
    std::string id;                     ///< nodeID, edgeID or stationID.
    std::string reason;                 ///< Of the operator; may be empty.
    Core::WallTime since;               ///< When it was blocked.

    bool operator==(const Block&) const = default;
};

} // namespace ACS::Planning
