#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace ACS::Simulation
{

/// What goes wrong in a world; each kind can be left out, to see which of them a violation needs.
enum class EFault : std::uint8_t
{
    Crashes,  ///< acsd ends at any moment, also between any two of its actions and before or after a write.
    Disk,     ///< Writes fail for a while, or are slow.
    Link,     ///< The connection to the MCS breaks, is slow, or cannot be made.
    Mcs,      ///< Acks come late or never, registrations are refused, requests are repeated.
    Robots,   ///< Robots refuse drives, fail jobs, stop for safety or by hand.
    Radio,    ///< Robots are out of reach for a while.
    Controls, ///< CancelPlan, AbortPlan, PausePlan, ResumePlan, and the TSC.
    BadPlans, ///< Plans that must be refused.
};

inline constexpr std::size_t FAULT_COUNT = 8;

/// As the command line has them, by EFault.
inline constexpr std::array<std::string_view, FAULT_COUNT>
    FAULT_NAMES{"crashes", "disk", "link", "mcs", "robots", "radio", "controls", "bad-plans"};

} // namespace ACS::Simulation
