#pragma once

#include "common/config/ConfigSection.hpp"
#include "config/AcsdConfig.hpp"

namespace ACS::Acsd
{

/// Reads the table `stations`, all but its actions, into AcsdConfig::stations and EngineOptions::reach. The site has been
/// read: every station of the map has its `type` and, where the map or the table gives it, its `height`.
void ReadStations(const Apps::ConfigSection& root, AcsdConfig& config);

} // namespace ACS::Acsd
