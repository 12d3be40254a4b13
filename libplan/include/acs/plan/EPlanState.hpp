#pragma once

#include <cstdint>
#include <string_view>

namespace ACS::Planning
{

/// The state of a plan (section 7 of MCS-ACS).
enum class EPlanState : std::uint8_t
{
    Pending,    ///< Accepted, waits for a robot.
    InProgress, ///< A robot works on it.
    Paused,     ///< Held by PausePlan.
    Completed,  ///< Final: every step done.
    Failed,     ///< Final: a job failed, or the plan could not go on.
    Cancelled,  ///< Final: ended by CancelPlan before the first arrival.
    Aborted,    ///< Final: ended by AbortPlan.
};

/// The word of section 3 ("InProgress").
[[nodiscard]] std::string_view GetText(EPlanState value) noexcept;

} // namespace ACS::Planning
