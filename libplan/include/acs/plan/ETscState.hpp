#pragma once

#include <cstdint>
#include <string_view>

namespace ACS::Planning
{

/// Whether new work is begun at all (section 6.20 of MCS-ACS, with the meaning of SEMI E82).
enum class ETscState : std::uint8_t
{
    Auto,    ///< As usual.
    Paused,  ///< Nothing runs, nothing is begun; plans are accepted and wait.
    Pausing, ///< Nothing is begun any more, what runs goes on.
};

/// The word of section 3 ("Pausing").
[[nodiscard]] std::string_view GetText(ETscState value) noexcept;

} // namespace ACS::Planning
