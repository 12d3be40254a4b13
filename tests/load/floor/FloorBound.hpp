#pragma once

#include "Floor.hpp"

#include <cstddef>
#include <vector>

namespace ACS::Testing
{

/// What no control can exceed for these transports.
struct FloorBound
{
    double fleetPerHour =
        0; ///< Transports: each vehicle works without a pause, on shortest routes, and never drives empty.
    /// Transports: the node that has the most to do is never free. A transport occupies each node that it cannot drive around: while a
    /// vehicle drives onto it, works on it and leaves it.
    double nodePerHour = 0;

    [[nodiscard]] double GetPerHour() const noexcept;
};

[[nodiscard]] FloorBound FindBound(const Floor& floor, const std::vector<Demand>& demands, std::size_t vehicles);

} // namespace ACS::Testing
