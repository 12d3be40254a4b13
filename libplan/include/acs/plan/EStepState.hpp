#pragma once

#include <acs/core/Api.hpp>

#include <cstdint>
#include <string_view>

namespace ACS::Planning
{

/// The state of a step (section 6.13 of MCS-ACS).
enum class EStepState : std::uint8_t
{
    Pending,    ///< Not started.
    Dispatched, ///< Assigned to the robot.
    InProgress, ///< The robot drives or works for it.
    Completed,  ///< Final: all its jobs are done.
    Failed,     ///< Final.
    Skipped,    ///< Final: skipped by an operator.
};

/// The value of section 3 ("Dispatched").
[[nodiscard]] ACS_API std::string_view GetText(EStepState value) noexcept;

} // namespace ACS::Planning
