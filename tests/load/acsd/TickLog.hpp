#pragma once

#include "StallWatch.hpp"
#include <acs/core/Now.hpp>

#include <chrono>
#include <cstddef>
#include <vector>

namespace ACS::Load
{

/// What the intervals of a periodic message were, those apart that the machine had a part in. Times in ms.
struct TickFigures
{
    std::size_t count = 0;
    double mean = 0.0;
    double longest = 0.0;
    std::size_t left = 0;      ///< Intervals of more than one and a half periods: a message was left out.
    std::size_t ofMachine = 0; ///< While the machine stood still, or right after: in none of the above.
    double meanOfAll = 0.0;    ///< Those of the machine, too.
};

/// When a periodic message came: a few thousand times, kept one by one.
class TickLog
{
    std::vector<Core::SteadyTime> _ticks;

public:
    void Note(Core::SteadyTime tick);
    void Clear();

    /// The stalls in the order of their beginning.
    [[nodiscard]] TickFigures Evaluate(std::chrono::milliseconds period, const std::vector<StallWatch::Stall>& stalls)
        const;
};

} // namespace ACS::Load
