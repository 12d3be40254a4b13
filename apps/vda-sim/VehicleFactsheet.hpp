#pragma once

#include "vda-sim/LoadHandling.hpp"
#include "vda-sim/VehicleMotion.hpp"
#include <acs/vda5050/EVda5050Version.hpp>
#include <acs/vda5050/FactsheetMessage.hpp>

#include <cstdint>
#include <string_view>

namespace ACS::VdaSim
{

/// Actions of a virtual vehicle (VDA5050, predefined actions).
constexpr std::string_view ACTION_PICK = "pick";
constexpr std::string_view ACTION_DROP = "drop";
constexpr std::string_view ACTION_START_CHARGING = "startCharging";
constexpr std::string_view ACTION_STOP_CHARGING = "stopCharging";
constexpr std::string_view ACTION_FINE_POSITIONING = "finePositioning";
constexpr std::string_view ACTION_DETECT_OBJECT = "detectObject";
constexpr std::string_view ACTION_WAIT_FOR_TRIGGER = "waitForTrigger";
constexpr std::string_view ACTION_LOG_REPORT = "logReport";
constexpr std::string_view ACTION_INIT_POSITION = "initPosition";

/// Maximum length of an id in bytes, as of a name in the library.
constexpr std::uint32_t MAX_ID_LENGTH = 1024;

/// The factsheet of a vehicle of this type, in the form of its version. The session adds the header.
[[nodiscard]] VDA5050::FactsheetMessage MakeFactsheet(
    EVehicleType type,
    const MotionLimits& limits,
    VDA5050::EVda5050Version version,
    const LoadHandling& handling = {});

} // namespace ACS::VdaSim
