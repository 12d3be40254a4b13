#pragma once

#include <system_error>

namespace ACS::Sim
{

/// Why simulated equipment cannot execute an action, or why a world file cannot be used.
enum class EWorldError
{
    InvalidPlace = 1, ///< Not a place, or not of the kind that the event requires.
    NoSuchPlace,      ///< The world file lists its places, and this one is not listed.
    PlaceEmpty,
    PlaceOccupied,
    OtherCarrier, ///< The place has another carrier than the named one.
    CoverClosed,
    OutOfReach,    ///< The robot is not docked at the station of the place.
    InvalidName,   ///< Name of a robot, a carrier or a station.
    LimitExceeded, ///< Too many carriers, memories or events.
    JournalFailed, ///< The journal cannot be read or written, or does not match the world file.
};

[[nodiscard]] std::error_code make_error_code(EWorldError error) noexcept;

} // namespace ACS::Sim

template <>
struct std::is_error_code_enum<ACS::Sim::EWorldError> : std::true_type
{
};
