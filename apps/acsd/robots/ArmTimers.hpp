#pragma once

#include <acs/plan/IRobotAdapter.hpp>

#include <chrono>

namespace ACS::Acsd::ArmTimers
{

/// A time limit for something that the counters show, which are up to one period old.
[[nodiscard]] constexpr std::chrono::milliseconds AddPeriods(
    std::chrono::milliseconds limit,
    std::chrono::milliseconds period) noexcept
{
    return limit + 2 * period;
}

// The timers of an arm. Timers of the session of the robot's base have smaller numbers.

/// Retries to switch on the motor, a MONITOR, or to resume a program.
inline constexpr Planning::AdapterTimerID RETRY = 100;
inline constexpr std::chrono::milliseconds RETRY_DELAY{5'000};
/// Time limit for a program to begin.
inline constexpr Planning::AdapterTimerID START = 101;
/// Until the next probe.
inline constexpr Planning::AdapterTimerID PROBE = 102;
/// Time limit for the general state to show the effect of a CONTROL.
inline constexpr Planning::AdapterTimerID EFFECT = 103;
/// Time limit for inputs to read back as they were written.
inline constexpr Planning::AdapterTimerID INPUT = 104;

} // namespace ACS::Acsd::ArmTimers
