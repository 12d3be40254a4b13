#pragma once

#include <acs/core/Api.hpp>

#include <cstdint>
#include <string_view>

namespace ACS::Planning
{

/// The status of a robot as it is reported to the MCS (section 3 of MCS-ACS).
enum class ERobotStatus : std::uint8_t
{
    Init,         ///< Connected; its position is unknown.
    Disconnected, ///< Not connected.
    Manual,       ///< Not under automatic control.
    Idle,         ///< Has no plan, no drive and no job.
    Moving,       ///< Drives, or has a plan and waits for a route.
    Arrival,      ///< Reached the last node before the position of its step, or the position. Reported once per drive.
    Docking,      ///< On the last edge of its route, which leads into a station.
    UnDocking,    ///< On the first edge of its route, which leads out of a station.
    Working,      ///< Executes a job, or waits at the position of its step.
    Charging,     ///< Its battery is being charged.
    Error,        ///< Fatal error, emergency stop or protective stop.
    Stopped,      ///< Paused.
};

/// The value of section 3 ("UnDocking").
[[nodiscard]] ACS_API std::string_view GetText(ERobotStatus value) noexcept;

} // namespace ACS::Planning
