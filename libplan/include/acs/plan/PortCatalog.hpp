#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/Location.hpp>
#include <acs/core/LocationMap.hpp>
#include <acs/plan/SiteMap.hpp>

#include <optional>
#include <span>

namespace ACS::Planning
{

/// All places that plans may name: the stations of the map, their ports, the ports of the robots.
class ACS_API PortCatalog
{
    Core::LocationMap _places;

public:
    PortCatalog() = default;
    /// The stations of the map whose ids are locations.
    explicit PortCatalog(const SiteMap& site);

    /// No effect for a place that was added before.
    void Add(const Core::Location& location);
    /// Adds each of them.
    void Add(std::span<const Core::Location> locations);

    /// Whether exactly this place was added, in any spelling.
    [[nodiscard]] bool Contains(const Core::Location& location) const;

    /// Adds the area to a set without one (SET02, SET02.MP15); nullopt if no area or several have this set.
    [[nodiscard]] std::optional<Core::Location> CompleteSetOrNull(const Core::Location& shortForm) const;
};

} // namespace ACS::Planning
