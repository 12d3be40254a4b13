#pragma once

#include <acs/acsd/IRobotDriver.hpp>
#include <acs/acsd/IRobotSetup.hpp>

#include <memory>
#include <string_view>

namespace ACS::Acsd
{

/// Reads the keys of a robot whose driver is built in, all but its actions, and adds it to AcsdConfig::vehicles. The table `arm`,
/// the broker if it is given, and the stations have been read. The context of the configuration is set.
[[nodiscard]] std::unique_ptr<IRobotSetup> MakeVehicleSetup(const DrivenRobotConfig& config, std::string_view driver);

} // namespace ACS::Acsd
