#pragma once

#include "common/config/ConfigSection.hpp"
#include "config/AcsdConfig.hpp"

namespace ACS::Acsd
{

/// Reads the table `actions` and the tables `actions` of robots and stations into EngineOptions::actions and
/// RobotLinkConfig::methods. Call after the stations and the robots have been read.
void ReadJobs(const Apps::ConfigSection& root, AcsdConfig& config);

/// Sets RobotOptions::rejectedActions: robots are not assigned actions that they cannot do. An action that no robot can do
/// is an error of the configuration; otherwise only the first plan would reveal it. The configuration must be without
/// errors.
void RejectActions(const Apps::ConfigSection& root, AcsdConfig& config);

} // namespace ACS::Acsd
