#pragma once

#include <acs/plan/EngineOptions.hpp>
#include <acs/plan/SiteMap.hpp>

#include <cstddef>

namespace ACS::Testing
{

/// Stations A01.CP01 and so on, each with a dock of its own ("D-A01.CP01").
inline constexpr std::size_t FLEET_PLACES = 40;

/// A floor of 92 lane nodes with FLEET_PLACES places and 36 parking positions.
/// With load restrictions some of the two-way lanes are only for empty vehicles, and others only for loaded ones.
[[nodiscard]] Planning::SiteMap MakeFleetSite(bool bLoadRestrictions);

/// Logistics robots LR01 and so on (36 at most), each on its parking position.
[[nodiscard]] Planning::EngineOptions MakeFleetEngineOptions(std::size_t vehicles);

} // namespace ACS::Testing
