#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace ACS::Simulation
{

/// The kinds of faults. Each can be left out to find those that cause a violation.
enum class EFault : std::uint8_t
{
    Crashes,    ///< acsd ends at any moment, also between any two of its actions and before or after a write.
    Disk,       ///< Writes fail for a while, or are slow.
    Link,       ///< The connection to the MCS breaks, is slow, or cannot be established.
    Mcs,        ///< Acks are late or missing, registrations are refused, requests are repeated.
    Robots,     ///< Robots reject drives, fail jobs, stop for safety or are in manual mode.
    Radio,      ///< Robots are disconnected for a while.
    Controls,   ///< CancelPlan, AbortPlan, PausePlan, ResumePlan, and the TSC.
    BadPlans,   ///< Plans that must be refused.
    Partitions, ///< The leader loses its connection to a shared store. Only in runs with one.
};

inline constexpr std::size_t FAULT_COUNT = 9;

/// Names on the command line, by EFault.
inline constexpr std::array<std::string_view, FAULT_COUNT>
    FAULT_NAMES{"crashes", "disk", "link", "mcs", "robots", "radio", "controls", "bad-plans", "partitions"};

} // namespace ACS::Simulation
