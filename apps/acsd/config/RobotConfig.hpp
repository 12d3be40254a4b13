#pragma once

#include "common/config/ConfigSection.hpp"
#include "config/AcsdConfig.hpp"

namespace ACS::Acsd
{

/// Reads the table `robots`, all but their actions, into EngineOptions::robots and AcsdConfig::robots, which have one entry
/// per robot in the same order. The table `arm` and the stations have been read.
void ReadRobots(const Apps::ConfigSection& root, AcsdConfig& config);

} // namespace ACS::Acsd
