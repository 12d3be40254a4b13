#pragma once

#include <cstdint>

namespace ACS::Planning
{

/// Whether a vehicle carries a load, for edges with a load restriction.
enum class ELoad : std::uint8_t
{
    Unknown, ///< Uses only edges that vehicles with and without a load may use.
    Empty,
    Loaded,
};

} // namespace ACS::Planning
