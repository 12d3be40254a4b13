#pragma once

#include "common/config/ConfigReader.hpp"
#include "common/config/ConfigSection.hpp"
#include "config/AcsdConfig.hpp"
#include <acs/acsd/IRobotDriver.hpp>

#include <optional>
#include <string>

namespace ACS::Acsd
{

/// Why these drivers cannot be used: a name is invalid or used twice.
[[nodiscard]] std::optional<std::string> FindDriverFaultOrNull(const RobotDrivers& drivers);

/// The key `driver` of a robot; without it OPEN_STREAM_DRIVER for a robot with an arm, else VDA5050_DRIVER. An unknown driver is an
/// error.
[[nodiscard]] std::string ReadDriver(const Apps::ConfigSection& robot, const RobotDrivers& drivers);

/// Has the drivers read the keys of their robots. Call after the robots and the actions have been read.
void MakeSetups(
    const Apps::ConfigReader& reader,
    const std::string& fileName,
    const RobotDrivers& drivers,
    AcsdConfig& config);

/// Has the drivers state the capabilities of their robots. Call when the configuration of the robots is complete.
void ApplyCapabilities(const Apps::ConfigReader& reader, AcsdConfig& config);

} // namespace ACS::Acsd
