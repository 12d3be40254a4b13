#pragma once

#include <cstdint>

namespace ACS::Planning
{

/// Why a robot can neither drive nor work.
enum class EUnavailability : std::uint8_t
{
    None,
    Link,
    Place,
    Maintenance,
    Error,
    SafetyStop,
    Paused,
    Manual,
    Occupied,
    Incompatible,
    Rejecting,
};

} // namespace ACS::Planning
