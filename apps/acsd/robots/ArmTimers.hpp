#pragma once

#include <acs/plan/IRobotAdapter.hpp>

#include <chrono>

namespace ACS::Acsd::ArmTimers
{

// The timers of an arm. The session of the robot's base has the numbers of its own, which are fewer.

/// To ask again for a motor that is off, for what MONITOR was to show, or for a program that does not resume.
inline constexpr Planning::AdapterTimerID RETRY = 100;
inline constexpr std::chrono::milliseconds RETRY_DELAY{5'000};
/// For a program to begin.
inline constexpr Planning::AdapterTimerID START = 101;
/// To probe now and then.
inline constexpr Planning::AdapterTimerID PROBE = 102;
/// For the effect of a CONTROL to be shown.
inline constexpr Planning::AdapterTimerID EFFECT = 103;
/// For inputs to read back as they were written.
inline constexpr Planning::AdapterTimerID INPUT = 104;

} // namespace ACS::Acsd::ArmTimers
