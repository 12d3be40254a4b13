#pragma once

#include <acs/plan/EngineOptions.hpp>
#include <acs/plan/SiteMap.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace ACS::Acsd
{

inline constexpr std::size_t MOST_REACH_WARNINGS = 20;

/// Stations whose nodes a vehicle type may use, and which no robot of the type can reach from its start, with a load or without: a
/// line for each station and type, with the reason. At most MOST_REACH_WARNINGS lines; the last one then states how many more there
/// are. `open` is the map without the restrictions of factsheets, `closed` the one in effect, with the same nodes and stations. The
/// options have no errors.
[[nodiscard]] std::vector<std::string> FindUnreachableStations(
    const Planning::EngineOptions& options,
    const Planning::SiteMap& open,
    const Planning::SiteMap& closed);

} // namespace ACS::Acsd
