#include "TickLog.hpp"

#include <algorithm>

namespace ACS::Load
{

namespace
{

using Milliseconds = std::chrono::duration<double, std::milli>;

/// Whether the machine stalled in the interval or in the period before it: the interval after a late tick is short.
bool WasStalled(
    const std::vector<StallWatch::Stall>& stalls,
    Core::SteadyTime begin,
    Core::SteadyTime end,
    Core::Duration period)
{
    return std::ranges::any_of(stalls, [begin, end, period](const StallWatch::Stall& stall) {
        return stall.begin < end && stall.end + period > begin;
    });
}

} // namespace

void TickLog::Note(Core::SteadyTime tick)
{
    _ticks.push_back(tick);
}

void TickLog::Clear()
{
    _ticks.clear();
}

TickMetrics TickLog::Evaluate(std::chrono::milliseconds period, const std::vector<StallWatch::Stall>& stalls) const
{
    TickMetrics metrics;
    Core::Duration sum{};
    Core::Duration longest{};
    for (std::size_t i = 1; i < _ticks.size(); ++i)
    {
        const Core::Duration interval = _ticks[i] - _ticks[i - 1];
        if (WasStalled(stalls, _ticks[i - 1], _ticks[i], period))
        {
            ++metrics.ofMachine;
            continue;
        }
        ++metrics.count;
        sum += interval;
        longest = std::max(longest, interval);
        metrics.left += 2 * interval > 3 * period ? 1U : 0U;
    }
    metrics.mean = metrics.count == 0 ? 0.0 : Milliseconds(sum).count() / static_cast<double>(metrics.count);
    metrics.longest = Milliseconds(longest).count();
    if (_ticks.size() > 1)
    {
        metrics.meanOfAll =
            Milliseconds(_ticks.back() - _ticks.front()).count() / static_cast<double>(_ticks.size() - 1);
    }
    return metrics;
}

} // namespace ACS::Load
