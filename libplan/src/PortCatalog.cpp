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
    _places.insert(location.GetText());
}

void PortCatalog::Add(std::span<const Core::Location> locations)
{
    for (const Core::Location& location : locations)
    {
        Add(location);
    }
}

bool PortCatalog::Contains(const Core::Location& location) const
{
    return _places.contains(location.GetText());
}

std::optional<Core::Location> PortCatalog::CompleteSetOrNull(const Core::Location& shortForm) const
{
    const std::string ending = "." + shortForm.GetText();
    const std::string* foundOrNull = nullptr;
    for (const std::string& place : _places)
    {
        if (!place.ends_with(ending))
        {
            continue;
        }
        if (foundOrNull != nullptr)
        {
            return std::nullopt;
        }
        foundOrNull = &place;
    }
    if (foundOrNull == nullptr)
    {
        return std::nullopt;
    }
    Core::Result<Core::Location> location = Core::Location::Parse(*foundOrNull);
    return location.has_value() ? std::optional(std::move(*location)) : std::nullopt;
}

} // namespace ACS::Planning
