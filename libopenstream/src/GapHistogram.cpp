#include "GapHistogram.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace ACS::OpenStream
{

namespace
{

constexpr double MICROSECONDS = 1000.0;
constexpr unsigned CLASS_BITS = 4;

/// Each number below sixteen has its own class; for larger ones the four bits after the highest one select it.
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

GapStatistics GapHistogram::GetStatistics() const
{
    if (_count == 0)
    {
        return {};
    }
    constexpr double HALF = 0.5;
    constexpr double HUNDREDTH = 0.99;
    constexpr double THOUSANDTH = 0.999;
    return GapStatistics{
        _count,
        _sum / static_cast<double>(_count),
        GetPercentile(HALF),
        GetPercentile(HUNDREDTH),
        GetPercentile(THOUSANDTH),
        _largest};
}

} // namespace ACS::OpenStream
