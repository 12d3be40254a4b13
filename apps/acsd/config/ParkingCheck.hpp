#pragma once

#include <acs/plan/EngineOptions.hpp>
#include <acs/plan/SiteMap.hpp>

#include <string>
#include <vector>

namespace ACS::Acsd
{

/// Of robots with a parking position in the options: one that they cannot reach with a load or without, and stations from which no
/// route leads there. The traffic control guarantees progress only to robots that can park. A line for each; robots that differ in
/// nothing else share it. Then a line for each parking position or charger that cuts the routes of others between stations: its
/// node, or one within the clearance. The options have no errors.
[[nodiscard]] std::vector<std::string> FindParkingFaults(
    const Planning::EngineOptions& options,
    const Planning::SiteMap& site);

} // namespace ACS::Acsd
