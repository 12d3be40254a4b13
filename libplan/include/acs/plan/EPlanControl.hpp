#pragma once

#include <acs/core/Api.hpp>

#include <cstdint>
#include <string_view>

namespace ACS::Planning
{

/// A control of an accepted plan (sections 6.5 to 6.8 of MCS-ACS).
enum class EPlanControl : std::uint8_t
{
    Cancel, ///< End the plan; fails after ControlOptions::cancelUntil.
    Abort,  ///< End the plan; a running job finishes first, unless ControlOptions::bAbortStopsJob.
    Pause,  ///< Interrupt the plan; the robot keeps it.
    Resume, ///< Continue a paused plan.
};

/// "Cancel"
[[nodiscard]] ACS_API std::string_view GetText(EPlanControl value) noexcept;

} // namespace ACS::Planning
