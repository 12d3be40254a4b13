#pragma once

#include <acs/core/Api.hpp>

#include <cstdint>
#include <string_view>

namespace ACS::Planning
{

/// The state of a job (section 6.14 of MCS-ACS).
enum class EJobState : std::uint8_t
{
    Pending,    ///< Not started.
    Instructed, ///< Commanded; the robot has not started it.
    InProgress, ///< The robot executes it.
    Completed,  ///< Final.
    Failed,     ///< Final.
};

/// The value of section 3 ("Instructed").
[[nodiscard]] ACS_API std::string_view GetText(EJobState value) noexcept;

} // namespace ACS::Planning
