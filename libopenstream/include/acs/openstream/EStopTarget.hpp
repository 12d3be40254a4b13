#pragma once

#include <cstdint>

namespace ACS::OpenStream
{

/// What a STOP ends.
enum class EStopTarget : std::uint8_t
{
    Monitor,
    Control, ///< Also releases what was buffered, such as a trajectory: the hard stop.
    Session, ///< Announces the orderly end of the connection.
};

} // namespace ACS::OpenStream
