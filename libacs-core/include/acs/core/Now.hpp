#pragma once

#include <acs/core/Api.hpp>

#include <chrono>

namespace ACS::Core
{

/// A time that never goes back, for deadlines.
using SteadyTime = std::chrono::steady_clock::time_point;
/// A time of the calendar in UTC, for timestamps.
using WallTime = std::chrono::system_clock::time_point;
/// A difference of two SteadyTimes.
using Duration = std::chrono::steady_clock::duration;

/// The current time, which the caller passes to every call of a state machine. No library reads a clock.
struct Now
{
    SteadyTime steady; ///< For deadlines and periods; never goes back.
    WallTime wall;     ///< For the timestamps of messages only; may jump.
};

/// Returns the current time: from the system's clocks in programs, from a manual clock in tests.
class ACS_API IClock
{
public:
    IClock() = default;
    IClock(const IClock&) = delete;
    IClock& operator=(const IClock&) = delete;
    virtual ~IClock() = default;

    /// Both times, read together.
    [[nodiscard]] virtual Now GetNow() const = 0;
};

} // namespace ACS::Core
