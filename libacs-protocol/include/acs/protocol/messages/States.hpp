#pragma once

#include <acs/core/Api.hpp>

#include <cstdint>
#include <string_view>

namespace ACS::Protocol
{

/// Section 6.20.
enum class ETscState : std::uint8_t
{
    Auto,
    Paused,
    Pausing,
};

/// The name on the wire.
[[nodiscard]] ACS_API std::string_view GetText(ETscState state);

/// ACS to MCS: whether plans are being executed (section 6.20).
struct TscStateUpdate
{
    ETscState state = ETscState::Auto;

    bool operator==(const TscStateUpdate&) const = default;
};

/// ACS to MCS: whether the ACS can take work; the MCS sends no plans while it cannot (section 6.21).
struct AcsCommStateUpdate
{
    bool bConnected = true;

    bool operator==(const AcsCommStateUpdate&) const = default;
};

} // namespace ACS::Protocol
