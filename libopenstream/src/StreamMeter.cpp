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

std::uint64_t StreamMeter::Add(double ts, Core::SteadyTime receivedAt)
{
    ++_samples;
    std::uint64_t skipped = 0;
    bool bInTime = true;
    if (_lastTs.has_value())
    {
        const double period = static_cast<double>(_period.count());
        const double steps = std::round((ts - *_lastTs) / period);
        skipped = steps > 1.0 && steps < MOST_SKIPPED ? static_cast<std::uint64_t>(steps) - 1 : 0;
        const std::chrono::duration<double, std::milli> gap = receivedAt - _lastAt;
        _byServer.Add(ts - *_lastTs);
        _byArrival.Add(gap.count());
        bInTime = gap.count() <= period * LATE_AFTER_PERIODS;
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
