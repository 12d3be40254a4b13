#include <acs/plan/PortCatalog.hpp>

namespace ACS::Planning
{

PortCatalog::PortCatalog(const SiteMap& site)
{
    for (const SiteStation& station : site.GetStations())
    {
        // A charger's name need not be a location; no plan can name it then.
        if (const Core::Result<Core::Location> location = Core::Location::Parse(station.stationID))
        {
            Add(*location);
        }
    }
}

void PortCatalog::Add(const Core::Location& location)
{
    _places.Add(location);
}

void PortCatalog::Add(std::span<const Core::Location> locations)
{
    _places.Add(locations);
}

bool PortCatalog::Contains(const Core::Location& location) const
{
    return _places.Contains(location);
}

std::optional<Core::Location> PortCatalog::CompleteSetOrNull(const Core::Location& shortForm) const
{
    return _places.CompleteSetOrNull(shortForm);
}

} // namespace ACS::Planning
