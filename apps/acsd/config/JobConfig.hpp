#pragma once

#include "common/config/ConfigSection.hpp"
#include "config/AcsdConfig.hpp"
#include "robots/MethodResolver.hpp"

namespace ACS::Acsd
{

/// Reads the table `actions`: rules into EngineOptions::actions. Returns how robots with built-in drivers do them. Call after the
/// stations and the robots have been read.
[[nodiscard]] MethodTables ReadActions(const Apps::ConfigSection& root, AcsdConfig& config);

/// Reads the tables `actions` of vehicles and stations, and sets VehicleConfig::methods. Call after the vehicles have been read.
void ReadMethods(const Apps::ConfigSection& root, const MethodTables& actions, AcsdConfig& config);

/// An action that no robot can do is an error of the configuration; otherwise only the first plan would reveal it. The
/// configuration must be without errors.
void CheckActions(const Apps::ConfigSection& root, const AcsdConfig& config);

} // namespace ACS::Acsd
