#pragma once

#include "common/config/ConfigSection.hpp"
#include "config/AcsdConfig.hpp"

namespace ACS::Acsd
{

/// Reads the table `actions` and the tables `actions` of robots and stations into EngineOptions::actions and
/// RobotLinkConfig::methods. Stations and robots have been read.
void ReadJobs(const Apps::ConfigSection& root, AcsdConfig& config);

/// What a robot cannot do is not given to it (RobotOptions::rejectedActions). An action that no robot can do is a mistake:
/// else the first plan would show it. Only for a configuration without mistakes.
void RejectActions(const Apps::ConfigSection& root, AcsdConfig& config);

} // namespace ACS::Acsd
