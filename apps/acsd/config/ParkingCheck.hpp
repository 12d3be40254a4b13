#pragma once

#include <acs/plan/EngineOptions.hpp>
#include <acs/plan/SiteMap.hpp>

#include <string>
#include <vector>

namespace ACS::Acsd
{

/// Finds the parking positions and chargers that a robot cannot reach with a load or without, and the stations from which no route
/// leads to its parking position: the traffic control guarantees progress only to robots that can park. There is a line for each;
/// robots that differ in nothing else share it. Then there is a line for each parking position or charger that cuts the routes of
/// others between stations: its node, or one within the clearance. The options have no errors.
[[nodiscard]] std::vector<std::string> FindParkingFaults(
    const Planning::EngineOptions& options,
    const Planning::SiteMap& site);

} // namespace ACS::Acsd
