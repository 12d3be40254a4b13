#include <acs/core/Backoff.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace ACS::Core
{

namespace
{

using Milliseconds = std::chrono::milliseconds;

BackoffOptions PullIntoRange(BackoffOptions options)
{
    constexpr Milliseconds LONGEST = std::chrono::hours(24);
    options.initial = std::clamp(options.initial, Milliseconds(1), LONGEST);
    options.maximum = std::clamp(options.maximum, options.initial, LONGEST);
    options.factor = options.factor >= 1.0 ? options.factor : 1.0; // also for NaN
    options.jitter = options.jitter >= 0.0 ? std::min(options.jitter, 1.0) : 0.0;
    return options;
}

/// From 0 up to, but without, 1: the 53 upper bits are what a double holds exactly.
double GetFraction(IRandom& random)
{
    return std::ldexp(static_cast<double>(random.GetNext() >> 11U), -53);
}

Milliseconds Scale(Milliseconds delay, double factor)
{
    return Milliseconds(std::llround(static_cast<double>(delay.count()) * factor));
}

} // namespace

Backoff::Backoff(const BackoffOptions& options)
    : _options(PullIntoRange(options)),
      _next(_options.initial)
{
}

std::chrono::milliseconds Backoff::GetNextDelay(IRandom& random)
{
    const Milliseconds delay = Scale(_next, 1.0 - _options.jitter * GetFraction(random));
    const bool bReachesMaximum =
        static_cast<double>(_next.count()) * _options.factor >= static_cast<double>(_options.maximum.count());
    _next = bReachesMaximum ? _options.maximum : Scale(_next, _options.factor);
    return std::max(delay, Milliseconds(1));
}

void Backoff::Reset() noexcept
{
    _next = _options.initial;
}

} // namespace ACS::Core
