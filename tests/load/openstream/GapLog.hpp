#pragma once

#include "StallWatch.hpp"
#include <acs/core/Now.hpp>

#include <chrono>
#include <cstdint>
#include <deque>
#include <vector>

namespace ACS::Load
{

/// Gaps between the arrivals of a periodic line; those with a stall of the machine are counted separately. Times in ms.
struct GapMetrics
{
    std::uint64_t count = 0;
    double mean = 0.0; ///< Of the gaps; the next three are of |gap - period|.
    double p50 = 0.0;
    double p99 = 0.0;
    double p999 = 0.0;
    double largest = 0.0;
    std::uint64_t beyondTwo = 0; ///< Gaps of more than two periods.
    std::uint64_t ofMachine = 0; ///< Gaps of any length with or right after a stall of the machine: not included above.
};

/// Collects the gaps of any number of connections in fixed memory, if few of them are far off the period.
class GapLog
{
    struct Gap
    {
        Core::SteadyTime begin;
        Core::SteadyTime end;
    };

    Core::Duration _period;
    std::vector<std::uint64_t> _deviations; ///< Number of gaps by their distance from the period, in buckets.
    /// Gaps beyond the buckets, stored individually. Never moved in memory, which would fragment the heap.
    std::deque<Gap> _farOff;
    std::uint64_t _count = 0; ///< Of those in buckets, as the next two.
    Core::Duration _sum{};
    Core::Duration _largest{};

public:
    explicit GapLog(std::chrono::milliseconds period);

    void Note(Core::SteadyTime previous, Core::SteadyTime arrival);

    /// Bytes of the gaps that are stored individually: they grow on a busy machine and are excluded from the measurement.
    [[nodiscard]] std::uint64_t GetListBytes() const noexcept;

    /// The stalls in the order of their beginning.
    [[nodiscard]] GapMetrics Evaluate(const std::vector<StallWatch::Stall>& stalls) const;
};

} // namespace ACS::Load
