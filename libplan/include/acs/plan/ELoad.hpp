#pragma once

#include <cstdint>

namespace ACS::Planning
{

/// Whether a vehicle carries a load, for edges with a load restriction.
enum class ELoad : std::uint8_t
{
    Unknown, ///< Uses only edges that vehicles with and without a load may use.
    Empty,   ///< Uses edges that vehicles without a load may use.
    Loaded,  ///< Uses edges that vehicles with a load may use.
};

} // namespace ACS::Planning
