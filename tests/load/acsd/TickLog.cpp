#include "TickLog.hpp"

#include <algorithm>

namespace ACS::Load
{

namespace
{

using Milliseconds = std::chrono::duration<double, std::milli>;

/// Whether the machine stood still in between, or in the period before: the interval after a late tick is short.
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

TickFigures TickLog::Evaluate(std::chrono::milliseconds period, const std::vector<StallWatch::Stall>& stalls) const
{
    TickFigures figures;
    Core::Duration sum{};
    Core::Duration longest{};
    for (std::size_t i = 1; i < _ticks.size(); ++i)
    {
        const Core::Duration interval = _ticks[i] - _ticks[i - 1];
        if (WasStalled(stalls, _ticks[i - 1], _ticks[i], period))
        {
            ++figures.ofMachine;
            continue;
        }
        ++figures.count;
        sum += interval;
        longest = std::max(longest, interval);
        figures.left += 2 * interval > 3 * period ? 1U : 0U;
    }
    figures.mean = figures.count == 0 ? 0.0 : Milliseconds(sum).count() / static_cast<double>(figures.count);
    figures.longest = Milliseconds(longest).count();
    if (_ticks.size() > 1)
    {
        figures.meanOfAll =
            Milliseconds(_ticks.back() - _ticks.front()).count() / static_cast<double>(_ticks.size() - 1);
    }
    return figures;
}

} // namespace ACS::Load
