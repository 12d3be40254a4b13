#pragma once

#include "vda-sim/VehicleMotion.hpp"
#include "vda-sim/VehicleSpec.hpp"
#include <acs/vda5050/FactsheetMessage.hpp>

#include <string_view>

namespace ACS::VdaSim
{

/// What a virtual vehicle performs (VDA5050, predefined actions).
constexpr std::string_view ACTION_PICK = "pick";
constexpr std::string_view ACTION_DROP = "drop";
constexpr std::string_view ACTION_START_CHARGING = "startCharging";
constexpr std::string_view ACTION_STOP_CHARGING = "stopCharging";
constexpr std::string_view ACTION_FINE_POSITIONING = "finePositioning";
constexpr std::string_view ACTION_DETECT_OBJECT = "detectObject";
constexpr std::string_view ACTION_WAIT_FOR_TRIGGER = "waitForTrigger";
constexpr std::string_view ACTION_LOG_REPORT = "logReport";
constexpr std::string_view ACTION_INIT_POSITION = "initPosition";

/// The factsheet of a vehicle of this type. The header is left to the session.
[[nodiscard]] VDA5050::FactsheetMessage MakeFactsheet(EVehicleType type, const MotionLimits& limits);

} // namespace ACS::VdaSim
