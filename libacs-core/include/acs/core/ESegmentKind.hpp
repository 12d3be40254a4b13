#pragma once

#include <cstdint>

namespace ACS::Core
{

/// The kind of a segment of a location (section 10 of MCS-ACS).
enum class ESegmentKind : std::uint8_t
{
    Stocker,      ///< ST01
    Area,         ///< A01
    Table,        ///< T01
    Set,          ///< SET01
    CassettePort, ///< CP01
    TrayPort,     ///< TP01
    MemoryPort,   ///< MP01
    Robot,        ///< A robot or the alias AMR; has no number.
};

} // namespace ACS::Core
