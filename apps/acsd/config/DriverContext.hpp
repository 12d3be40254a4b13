#pragma once

#include "common/config/ConfigSection.hpp"
#include "config/AcsdConfig.hpp"
#include <acs/plan/EngineOptions.hpp>

#include <string>

namespace ACS::Acsd
{

/// What acsd's own drivers read besides DrivenRobotConfig: keys of the robot's table itself, the stations and the map, and the
/// other robots.
struct DriverContext
{
    const Apps::ConfigSection& robot; ///< The table `robots.NAME`.
    const std::string& fileName;      ///< Paths are relative to its folder.
    const Planning::RobotOptions& options;
    AcsdConfig& config; ///< The vehicle is added to it, and warnings.
};

} // namespace ACS::Acsd
