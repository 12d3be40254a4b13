#pragma once

#include <acs/core/Api.hpp>

#include <cstdint>
#include <string_view>

namespace ACS::Planning
{

/// Whether new work is started (section 6.20 of MCS-ACS; the states of SEMI E82).
enum class ETscState : std::uint8_t
{
    Auto,    ///< Plans are started.
    Paused,  ///< No plan runs and none is started; accepted plans wait.
    Pausing, ///< Running plans continue; none is started.
};

/// The value of section 3 ("Pausing").
[[nodiscard]] ACS_API std::string_view GetText(ETscState value) noexcept;

} // namespace ACS::Planning
