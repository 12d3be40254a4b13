#pragma once

#include <system_error>

namespace ACS::Sim
{

/// Why simulated equipment cannot do what it is asked for, or why a world file cannot be used.
enum class EWorldError
{
    InvalidPlace = 1, ///< No place, or none of the kind that the event needs.
    NoSuchPlace,      ///< The world file lists its places, and this is none of them.
    PlaceEmpty,
    PlaceOccupied,
    OtherCarrier, ///< Another carrier is there than the one that is named.
    CoverClosed,
    OutOfReach,    ///< The robot's base is docked elsewhere.
    InvalidName,   ///< Of a robot, a carrier or a station.
    LimitExceeded, ///< More carriers, memories or events than a world has.
    JournalFailed, ///< It cannot be read or written, or does not belong to the world file.
};

[[nodiscard]] std::error_code make_error_code(EWorldError error) noexcept;

} // namespace ACS::Sim

template <>
struct std::is_error_code_enum<ACS::Sim::EWorldError> : std::true_type
{
};
