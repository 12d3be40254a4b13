#pragma once

#include <cstdint>

namespace ACS::OpenStream
{

/// What a STOP ends.
enum class EStopTarget : std::uint8_t
{
    Monitor, ///< The MONITOR; the session continues.
    Control, ///< The hard stop: also discards buffered data such as a trajectory.
    Session, ///< Orderly end of the connection.
};

} // namespace ACS::OpenStream
