#pragma once

#include "StallWatch.hpp"
#include <acs/core/Now.hpp>

#include <chrono>
#include <cstdint>
#include <deque>
#include <vector>

namespace ACS::Load
{

/// What the gaps between the arrivals of a periodic thing were, those apart that the machine had a part in. Times in ms.
struct GapFigures
{
    std::uint64_t count = 0;
    double mean = 0.0; ///< Of the gaps; the next three are of |gap - period|.
    double p50 = 0.0;
    double p99 = 0.0;
    double p999 = 0.0;
    double largest = 0.0;
    std::uint64_t beyondTwo = 0; ///< Gaps of more than two periods.
    std::uint64_t ofMachine =
        0; ///< Gaps, of any length, while the machine stood still or right after: in none of the above.
};

/// Collects the gaps of any number of connections in a fixed room, as long as few of them are far off the period.
class GapLog
{
    struct Gap
    {
        Core::SteadyTime begin;
        Core::SteadyTime end;
    };

    Core::Duration _period;
    std::vector<std::uint64_t> _deviations; ///< How many gaps missed the period by so many buckets.
    /// By more than what the buckets hold: one by one. Never moved in memory, which would leave holes of their size.
    std::deque<Gap> _farOff;
    std::uint64_t _count = 0; ///< Of those in buckets, as the next two.
    Core::Duration _sum{};
    Core::Duration _largest{};

public:
    explicit GapLog(std::chrono::milliseconds period);

    void Note(Core::SteadyTime previous, Core::SteadyTime arrival);

    /// Bytes of the gaps that are kept one by one: they grow with a busy machine, and are no business of what is measured.
    [[nodiscard]] std::uint64_t GetListBytes() const noexcept;

    /// The stalls in the order of their beginning.
    [[nodiscard]] GapFigures Evaluate(const std::vector<StallWatch::Stall>& stalls) const;
};

} // namespace ACS::Load
