#pragma once

#include <acs/core/Location.hpp>
#include <acs/core/LocationMap.hpp>
#include <acs/plan/SiteMap.hpp>

#include <optional>
#include <span>

namespace ACS::Planning
{

/// The set of all places that plans may name: the map's stations, the ports inside them, the robots' ports.
class PortCatalog
{
    Core::LocationMap _places;

public:
    PortCatalog() = default;
    explicit PortCatalog(const SiteMap& site);

    void Add(const Core::Location& location);
    void Add(std::span<const Core::Location> locations);

    [[nodiscard]] bool Contains(const Core::Location& location) const;

    /// A set without its area (SET02, SET02.MP15) with the only area that has it; nullopt where none or several have.
    [[nodiscard]] std::optional<Core::Location> CompleteSetOrNull(const Core::Location& shortForm) const;
};

} // namespace ACS::Planning
