#pragma once

#include "StallWatch.hpp"
#include <acs/core/Now.hpp>

#include <chrono>
#include <cstddef>
#include <vector>

namespace ACS::Load
{

/// Intervals of a periodic message; those with a stall of the machine are counted separately. Times in ms.
struct TickMetrics
{
    std::size_t count = 0;
    double mean = 0.0;
    double longest = 0.0;
    std::size_t left = 0;      ///< Intervals of more than one and a half periods: a message is missing.
    std::size_t ofMachine = 0; ///< With or right after a stall of the machine: not included above.
    double meanOfAll = 0.0;    ///< Those with a stall included.
};

/// Arrival times of a periodic message: a few thousand, stored individually.
class TickLog
{
    std::vector<Core::SteadyTime> _ticks;

public:
    void Note(Core::SteadyTime tick);
    void Clear();

    /// The stalls in the order of their beginning.
    [[nodiscard]] TickMetrics Evaluate(std::chrono::milliseconds period, const std::vector<StallWatch::Stall>& stalls)
        const;
};

} // namespace ACS::Load
