#include "StreamMeter.hpp"

#include <algorithm>
#include <cmath>
#include <ratio>

namespace ACS::OpenStream
{

namespace
{

constexpr double LATE_AFTER_PERIODS = 1.5;
constexpr double MOST_SKIPPED = 50'000'000.0; ///< A step beyond a day's is no loss but another clock.
/// A controller takes a sample when it is due or later, at most a period later: it would skip it otherwise. One that is early
/// by more than this part of a period against the grid shows that the grid is late.
constexpr double EARLY_PERIODS = 1.0 / 8.0;
/// The part of a sample's delay by which the grid moves after it, because the controller's clock or period may be slower. The
/// delay then stays below 16 % of a period at 1 %, too short to look like a missing sample.
constexpr double FOLLOWED = 1.0 / 16.0;

} // namespace

void StreamMeter::Begin(std::chrono::milliseconds period)
{
    *this = {};
    _period = period;
}

void StreamMeter::Note(bool bInTime)
{
    _inTime.set(_next, bInTime);
    _next = (_next + 1) % WINDOW;
    _filled = std::min(_filled + 1, WINDOW);
}

std::uint64_t StreamMeter::CountSkipped(double ts)
{
    const double period = static_cast<double>(_period.count());
    const double steps = std::max(1.0, std::floor((ts - _due) / period + EARLY_PERIODS));
    const double delay = ts - _due - steps * period;
    if (steps < MOST_SKIPPED && delay >= 0.0)
    {
        _due = ts - delay * (1.0 - FOLLOWED);
    }
    else
    {
        _due = ts; // early, or after a step of the clock
    }
    return steps < MOST_SKIPPED ? static_cast<std::uint64_t>(steps) - 1 : 0;
}

std::uint64_t StreamMeter::Add(double ts, Core::SteadyTime receivedAt)
{
    ++_samples;
    std::uint64_t skipped = 0;
    bool bInTime = true;
    if (_lastTs.has_value())
    {
        skipped = CountSkipped(ts);
        const std::chrono::duration<double, std::milli> gap = receivedAt - _lastAt;
        _byServer.Add(ts - *_lastTs);
        _byArrival.Add(gap.count());
        bInTime = gap.count() <= static_cast<double>(_period.count()) * LATE_AFTER_PERIODS;
    }
    else
    {
        _due = ts;
    }
    _missing += skipped;
    for (std::uint64_t count = std::min<std::uint64_t>(skipped, WINDOW); count > 0; --count)
    {
        Note(false);
    }
    // What is behind a hole is not late itself: the hole was counted.
    Note(bInTime || skipped > 0);
    _lastTs = ts;
    _lastAt = receivedAt;
    return skipped;
}

StreamQuality StreamMeter::GetQuality() const
{
    StreamQuality quality;
    quality.samples = _samples;
    quality.missing = _missing;
    quality.byServer = _byServer.GetStatistics();
    quality.byArrival = _byArrival.GetStatistics();
    quality.inTime = _filled == 0 ? 1.0 : static_cast<double>(_inTime.count()) / static_cast<double>(_filled);
    return quality;
}

} // namespace ACS::OpenStream
