#pragma once

#include <cstdint>

namespace ACS::Planning
{

/// What a check of the safe state assumes.
enum class ESafeStateScope : std::uint8_t
{
    AllMove, ///< As if every robot could move and nothing was blocked.
    AsIs,    ///< Robots that cannot move and blocks are fixed obstacles.
};

} // namespace ACS::Planning
