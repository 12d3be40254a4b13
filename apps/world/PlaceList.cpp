#include "world/PlaceList.hpp"

#include "world/EWorldError.hpp"
#include <acs/core/Location.hpp>

#include <fmt/format.h>

#include <utility>
#include <vector>

namespace ACS::Sim
{

Core::Result<void> PlaceList::Add(std::string_view range)
{
    const Core::Result<std::vector<Core::Location>> locations = Core::ParseLocationRange(range);
    if (!locations.has_value())
    {
        return tl::make_unexpected(locations.error());
    }
    if (_places.size() + locations->size() > MAX_PLACES)
    {
        return Core::Fail(EWorldError::LimitExceeded, {}, fmt::format("at most {} places", MAX_PLACES));
    }
    for (const Core::Location& location : *locations)
    {
        Core::Result<Place> place = ParsePlace(location.GetText());
        if (!place.has_value())
        {
            return tl::make_unexpected(std::move(place.error()));
        }
        if (!place->station.empty())
        {
            _places.insert(std::move(place->station));
        }
        _owners.insert(std::move(place->robotID));
        _places.insert(std::move(place->text));
    }
    return {};
}

bool PlaceList::Contains(const Place& place) const
{
    if (!_owners.contains(place.robotID) || _places.contains(place.text))
    {
        return true;
    }
    const std::string outer = place.robotID.empty()
        ? place.GetCarrierPort()
        : place.text.substr(0, place.text.find('.', place.robotID.size() + 1));
    return _places.contains(outer);
}

} // namespace ACS::Sim
