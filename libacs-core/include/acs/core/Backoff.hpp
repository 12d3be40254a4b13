#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/IRandom.hpp>

#include <chrono>

namespace ACS::Core
{

/// Delays between attempts. Values out of range are clamped.
struct BackoffOptions
{
    std::chrono::milliseconds initial{500};    ///< Before the second attempt; 1 ms to 1 day.
    std::chrono::milliseconds maximum{10'000}; ///< Upper limit; initial to 1 day.
    double factor = 2.0;                       ///< Ratio of consecutive delays; at least 1.
    double jitter = 0.5;                       ///< Maximum random reduction of a delay, as a share of it; 0 to 1.
};

/// Exponential backoff with jitter, which spreads the reconnects of many clients. A value, not a timer.
class ACS_API Backoff
{
    BackoffOptions _options;
    std::chrono::milliseconds _next;

public:
    /// The first delay is the initial one.
    explicit Backoff(const BackoffOptions& options = {});

    /// The delay before the next attempt; increases with every call, up to the maximum.
    [[nodiscard]] std::chrono::milliseconds GetNextDelay(IRandom& random);

    /// After a success: the next delay is the initial one again.
    void Reset() noexcept;
};

} // namespace ACS::Core
