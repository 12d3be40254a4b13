#pragma once

#include "common/config/ConfigSection.hpp"
#include <acs/plan/SiteMap.hpp>

#include <optional>

namespace ACS::Acsd
{

/// Reads `site.corridors`, a list of tables, and puts the corridors on the edges of the map. nullopt: there is no map to check the
/// edges with.
void ReadCorridors(const Apps::ConfigSection& site, std::optional<Planning::SiteMap>& map);

} // namespace ACS::Acsd
