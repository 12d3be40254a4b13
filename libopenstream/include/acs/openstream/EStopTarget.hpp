#pragma once

#include <cstdint>

namespace ACS::OpenStream
{

/// What a STOP ends.
enum class EStopTarget : std::uint8_t
{
    Monitor,
    Control, ///< The hard stop: also discards buffered data such as a trajectory.
    Session, ///< Orderly end of the connection.
};

} // namespace ACS::OpenStream
