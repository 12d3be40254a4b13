#include <acs/openstream/StreamMeter.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <ratio>

namespace ACS::OpenStream
{

namespace
{

constexpr double MICROSECONDS = 1000.0;
constexpr unsigned CLASS_BITS = 4;
constexpr double LATE_AFTER_PERIODS = 1.5;
constexpr double MOST_SKIPPED = 50'000'000.0; ///< A step beyond a day's is no loss but another clock.

/// Below sixteen each number has its own class; above, the four bits behind the highest one tell.
std::size_t GetClass(std::uint64_t microseconds)
{
    constexpr std::uint64_t FIRST = 1U << CLASS_BITS;
    if (microseconds < FIRST)
    {
        return microseconds;
    }
    const auto shift = static_cast<unsigned>(std::bit_width(microseconds)) - CLASS_BITS - 1;
    return (std::size_t{shift} << CLASS_BITS) + (microseconds >> shift);
}

/// The largest number of the class.
std::uint64_t GetUpperBound(std::size_t index)
{
    constexpr std::size_t FIRST = 1U << CLASS_BITS;
    if (index < 2 * FIRST)
    {
        return index;
    }
    const std::size_t shift = (index >> CLASS_BITS) - 1;
    const std::uint64_t lower = ((index & (FIRST - 1)) + FIRST) << shift;
    return lower + (std::uint64_t{1} << shift) - 1;
}

} // namespace

void GapHistogram::Add(double milliseconds)
{
    if (!(milliseconds >= 0.0))
    {
        return;
    }
    constexpr double LONGEST = 1e12;
    const auto microseconds = static_cast<std::uint64_t>(std::llround(std::min(milliseconds * MICROSECONDS, LONGEST)));
    ++_counts.at(std::min(GetClass(microseconds), _counts.size() - 1));
    ++_count;
    _sum += milliseconds;
    _largest = std::max(_largest, milliseconds);
}

void GapHistogram::Clear()
{
    *this = {};
}

double GapHistogram::GetPercentile(double share) const
{
    const auto rank = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(_count)));
    std::uint64_t seen = 0;
    for (std::size_t index = 0; index < _counts.size(); ++index)
    {
        seen += _counts.at(index);
        if (seen >= rank)
        {
            return std::min(static_cast<double>(GetUpperBound(index)) / MICROSECONDS, _largest);
        }
    }
    return _largest;
}

GapFigures GapHistogram::GetFigures() const
{
    if (_count == 0)
    {
        return {};
    }
    constexpr double HALF = 0.5;
    constexpr double HUNDREDTH = 0.99;
    constexpr double THOUSANDTH = 0.999;
    return GapFigures{
        _count,
        _sum / static_cast<double>(_count),
        GetPercentile(HALF),
        GetPercentile(HUNDREDTH),
        GetPercentile(THOUSANDTH),
        _largest};
}

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
    quality.byServer = _byServer.GetFigures();
    quality.byArrival = _byArrival.GetFigures();
    quality.inTime = _filled == 0 ? 1.0 : static_cast<double>(_inTime.count()) / static_cast<double>(_filled);
    return quality;
}

} // namespace ACS::OpenStream
