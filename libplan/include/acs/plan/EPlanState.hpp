#pragma once

#include <acs/core/Api.hpp>

#include <cstdint>
#include <string_view>

namespace ACS::Planning
{

/// The state of a plan (section 6.12 of MCS-ACS).
enum class EPlanState : std::uint8_t
{
    Pending,    ///< Accepted; waits for a robot.
    InProgress, ///< A robot executes it.
    Paused,     ///< Paused by PausePlan.
    Completed,  ///< Final: every step is done.
    Failed,     ///< Final: a job failed, or the plan could not be continued.
    Cancelled,  ///< Final: ended by CancelPlan before the first arrival.
    Aborted,    ///< Final: ended by AbortPlan.
};

/// The value of section 3 ("InProgress").
[[nodiscard]] ACS_API std::string_view GetText(EPlanState value) noexcept;

} // namespace ACS::Planning
