#pragma once

#include <acs/vda5050/Header.hpp>

#include <cstdint>

namespace ACS::VDA5050
{

/// Whether the vehicle is connected to the broker (section 6.14).
enum class EConnectionState : std::uint8_t
{
    Online,           ///< Connected.
    Offline,          ///< Orderly disconnect of the vehicle.
    ConnectionBroken, ///< The last will, published by the broker.
};

/// Topic connection (section 6.14), retained.
struct ConnectionMessage
{
    Header header;
    EConnectionState connectionState = EConnectionState::Offline;

    bool operator==(const ConnectionMessage&) const = default;
};

} // namespace ACS::VDA5050
