#pragma once

#include <cstdint>
#include <string_view>

namespace ACS::Planning
{

/// What the MCS asks of an accepted plan (sections 6.5 to 6.8).
enum class EPlanControl : std::uint8_t
{
    Cancel, ///< End it, unless a robot has arrived.
    Abort,  ///< End it; a running job is let to its end.
    Pause,  ///< Hold it.
    Resume, ///< Go on with it.
};

/// "Cancel"
[[nodiscard]] std::string_view GetText(EPlanControl value) noexcept;

} // namespace ACS::Planning
