#pragma once

#include "common/config/ConfigReader.hpp"
#include "common/config/ConfigSection.hpp"
#include "config/AcsdConfig.hpp"
#include <acs/acsd/IRobotDriver.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace ACS::Acsd
{

/// Why these drivers cannot be used: a name is invalid, built in or used twice.
[[nodiscard]] std::optional<std::string> FindDriverFaultOrNull(const RobotDrivers& drivers);

[[nodiscard]] bool IsBuiltInDriver(std::string_view name);

/// The key `driver` of a robot; VDA5050_DRIVER without it. An unknown driver is an error.
[[nodiscard]] std::string ReadDriver(const Apps::ConfigSection& robot, const RobotDrivers& drivers);

/// Has the drivers read the options of their robots and actions. Call after the actions have been read.
void ReadDrivenRobots(const Apps::ConfigReader& reader, const RobotDrivers& drivers, AcsdConfig& config);

} // namespace ACS::Acsd
