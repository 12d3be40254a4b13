#pragma once

#include <acs/core/Api.hpp>

#include <cstdint>
#include <string_view>

namespace ACS::Planning
{

/// Who controls a plan.
enum class EControlOrigin : std::uint8_t
{
    MCS,      ///< It is owed a result report for each control.
    Operator, ///< Without a report of the result.
};

/// "MCS"
[[nodiscard]] ACS_API std::string_view GetText(EControlOrigin value) noexcept;

} // namespace ACS::Planning
