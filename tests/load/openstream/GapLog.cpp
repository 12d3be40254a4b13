#include "GapLog.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace ACS::Load
{

namespace
{

constexpr std::chrono::nanoseconds BUCKET{100};
constexpr std::size_t BUCKETS = 5'000;
constexpr std::chrono::seconds LONGEST_STALL{1}; ///< Longer stalls do not occur on a machine in use.

double ToMilliseconds(Core::Duration duration)
{
    return std::chrono::duration<double, std::milli>(duration).count();
}

/// Whether the machine stalled in the gap or just before it, so that this gap compensates for the previous one.
bool WasStalled(
    const std::vector<StallWatch::Stall>& stalls,
    Core::SteadyTime begin,
    Core::SteadyTime end,
    Core::Duration period)
{
    auto stall = std::ranges::lower_bound(stalls, begin - LONGEST_STALL, {}, &StallWatch::Stall::begin);
    for (; stall != stalls.end() && stall->begin < end; ++stall)
    {
        if (stall->end + period > begin)
        {
            return true;
        }
    }
    return false;
}

/// Quantile of the values in the buckets and of the ordered list after them.
double GetPercentile(
    const std::vector<std::uint64_t>& buckets,
    std::uint64_t inBuckets,
    const std::vector<double>& ordered,
    double share)
{
    const auto wanted = static_cast<std::uint64_t>(share * static_cast<double>(inBuckets + ordered.size()));
    if (wanted >= inBuckets)
    {
        return ordered.empty() ? 0.0 : ordered[std::min(wanted - inBuckets, ordered.size() - 1)];
    }
    std::uint64_t seen = 0;
    std::size_t index = 0;
    while (seen + buckets[index] <= wanted)
    {
        seen += buckets[index++];
    }
    return ToMilliseconds(BUCKET * (index + 1));
}

} // namespace

GapLog::GapLog(std::chrono::milliseconds period)
    : _period(period),
      _deviations(BUCKETS)
{
}

void GapLog::Note(Core::SteadyTime previous, Core::SteadyTime arrival)
{
    const Core::Duration gap = arrival - previous;
    const auto bucket = static_cast<std::size_t>(std::chrono::abs(gap - _period) / BUCKET);
    if (bucket >= BUCKETS)
    {
        _farOff.push_back(Gap{previous, arrival});
        return;
    }
    ++_deviations[bucket];
    ++_count;
    _sum += gap;
    _largest = std::max(_largest, gap);
}

std::uint64_t GapLog::GetListBytes() const noexcept
{
    return _farOff.size() * sizeof(Gap);
}

GapMetrics GapLog::Evaluate(const std::vector<StallWatch::Stall>& stalls) const
{
    GapMetrics metrics;
    std::vector<double> farOff;
    Core::Duration sum = _sum;
    Core::Duration largest = _largest;
    for (const Gap& gap : _farOff)
    {
        if (WasStalled(stalls, gap.begin, gap.end, _period))
        {
            ++metrics.ofMachine;
            continue;
        }
        const Core::Duration length = gap.end - gap.begin;
        sum += length;
        largest = std::max(largest, length);
        farOff.push_back(std::abs(ToMilliseconds(length - _period)));
        metrics.beyondTwo += length > 2 * _period ? 1U : 0U;
    }
    std::ranges::sort(farOff);
    metrics.count = _count + farOff.size();
    if (metrics.count == 0)
    {
        return metrics;
    }
    metrics.mean = ToMilliseconds(sum) / static_cast<double>(metrics.count);
    metrics.p50 = GetPercentile(_deviations, _count, farOff, 0.5);
    metrics.p99 = GetPercentile(_deviations, _count, farOff, 0.99);
    metrics.p999 = GetPercentile(_deviations, _count, farOff, 0.999);
    metrics.largest = ToMilliseconds(largest);
    return metrics;
}

} // namespace ACS::Load
