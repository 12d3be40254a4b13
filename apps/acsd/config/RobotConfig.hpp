#pragma once

#include "common/config/ConfigSection.hpp"
#include "config/AcsdConfig.hpp"

namespace ACS::Acsd
{

/// Reads the keys of the table `robots` that the robots of every driver have into EngineOptions::robots and AcsdConfig::robots, which
/// have one entry per robot in the same order. Their drivers read the others later (MakeSetups).
void ReadRobots(const Apps::ConfigSection& root, const RobotDrivers& drivers, AcsdConfig& config);

} // namespace ACS::Acsd
