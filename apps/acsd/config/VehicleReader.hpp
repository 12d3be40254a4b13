#pragma once

#include "config/DriverContext.hpp"
#include "config/VehicleConfig.hpp"
#include <acs/acsd/IRobotDriver.hpp>
#include <acs/acsd/IRobotSetup.hpp>

#include <memory>
#include <string_view>

namespace ACS::Acsd
{

/// Reads the keys of a robot whose driver is built in, all but its actions, and adds it to AcsdConfig::vehicles. The table `arm`, the
/// broker if it is given, and the stations have been read.
[[nodiscard]] std::shared_ptr<VehicleConfig> ReadVehicle(const DriverContext& context, std::string_view driver);

/// Likewise, as the setup of a built-in driver.
[[nodiscard]] std::unique_ptr<IRobotSetup> MakeVehicleSetup(const DrivenRobotConfig& config, std::string_view driver);

} // namespace ACS::Acsd
