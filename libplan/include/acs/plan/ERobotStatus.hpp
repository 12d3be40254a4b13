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
    Moving,       ///< Drives.
    Arrival,      ///< Has just reached its place; always told once.
    Docking,      ///< Docks.
    UnDocking,    ///< Leaves a dock.
    Working,      ///< A job runs, or it waits for its way with a plan.
    Charging,     ///< Charges.
    Error,        ///< A fatal error, an emergency or a protective stop.
    Stopped,      ///< Paused.
};

/// The word of section 3 ("UnDocking").
[[nodiscard]] std::string_view GetText(ERobotStatus value) noexcept;

} // namespace ACS::Planning
