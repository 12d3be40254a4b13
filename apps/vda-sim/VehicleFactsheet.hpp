#pragma once

#include "vda-sim/LoadHandling.hpp"
#include "vda-sim/VehicleMotion.hpp"
#include <acs/vda5050/EVda5050Version.hpp>
#include <acs/vda5050/FactsheetMessage.hpp>

#include <cstdint>

namespace ACS::VdaSim
{

/// Maximum length of an id in bytes, as of a name in the library.
constexpr std::uint32_t MAX_ID_LENGTH = 1024;

/// The factsheet of a vehicle of this type, in the form of its version. The session adds the header.
[[nodiscard]] VDA5050::FactsheetMessage MakeFactsheet(
    EVehicleType type,
    const MotionLimits& limits,
    VDA5050::EVda5050Version version,
    const LoadHandling& handling = {});

} // namespace ACS::VdaSim
