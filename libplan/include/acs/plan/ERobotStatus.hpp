#pragma once

#include <cstdint>
#include <string_view>

namespace ACS::Planning
{

/// What a robot does, as the MCS sees it (section 3 of MCS-ACS).
enum class ERobotStatus : std::uint8_t
{
    Init,         ///< Online, its place is not known yet.
    Disconnected, ///< No connection.
    Manual,       ///< Not under automatic control.
    Idle,         ///< No assigned work.
    Moving,       ///< Drives, or waits for its way with a plan.
    Arrival,   ///< Has reached the last node before its step's place, or the place; reported once for each drive there.
    Docking,   ///< On the last edge of its way, which leads to a station.
    UnDocking, ///< On the first edge of its way, which leads out of a station.
    Working,   ///< A job runs, or the robot waits at its step's place.
    Charging,  ///< Charges.
    Error,     ///< A fatal error, an emergency or a protective stop.
    Stopped,   ///< Paused.
};

/// The word of section 3 ("UnDocking").
[[nodiscard]] std::string_view GetText(ERobotStatus value) noexcept;

} // namespace ACS::Planning
