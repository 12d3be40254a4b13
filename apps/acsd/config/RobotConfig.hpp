#pragma once

#include "common/config/ConfigSection.hpp"
#include "config/AcsdConfig.hpp"

#include <string>

namespace ACS::Acsd
{

/// Reads the table `robots`, all but their actions, into EngineOptions::robots and AcsdConfig::robots, which have one entry
/// per robot in the same order. The table `arm` and the stations have been read. Paths are relative to
/// the folder of the file.
/// Of a robot with a driver that is not built in, its options are read later (ReadDrivenRobots).
void ReadRobots(
    const Apps::ConfigSection& root,
    const std::string& fileName,
    const RobotDrivers& drivers,
    AcsdConfig& config);

} // namespace ACS::Acsd
