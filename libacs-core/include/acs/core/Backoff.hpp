#pragma once

#include <acs/core/IRandom.hpp>

#include <chrono>

namespace ACS::Core
{

/// How long to wait between attempts. What makes no sense is pulled to the nearest value that does.
struct BackoffOptions
{
    std::chrono::milliseconds initial{500};    ///< Before the second attempt; at least 1 ms.
    std::chrono::milliseconds maximum{10'000}; ///< Never more than this; at least initial.
    double factor = 2.0;                       ///< Each wait is this times the one before; 1 or more.
    double jitter = 0.5;                       ///< The part of each wait that chance may take away, 0 to 1.
};

/// Ever longer waits between attempts, scattered so that many clients do not come back in step. A value, no timer.
class Backoff
{
    BackoffOptions _options;
    std::chrono::milliseconds _next;

public:
    explicit Backoff(const BackoffOptions& options = {});

    /// The wait before the next attempt; every call makes the following one longer, up to the maximum.
    [[nodiscard]] std::chrono::milliseconds GetNextDelay(IRandom& random);

    /// After a success: the next wait is the initial one again.
    void Reset() noexcept;
};

} // namespace ACS::Core
