#pragma once

#include <cstdint>
#include <string_view>

namespace ACS::Planning
{

/// The state of a job (section 7 of MCS-ACS).
enum class EJobState : std::uint8_t
{
    Pending,    ///< Not begun.
    Instructed, ///< Commanded; the robot has not begun it.
    InProgress, ///< The robot does it.
    Completed,  ///< Final.
    Failed,     ///< Final.
};

/// The word of section 3 ("Instructed").
[[nodiscard]] std::string_view GetText(EJobState value) noexcept;

} // namespace ACS::Planning
