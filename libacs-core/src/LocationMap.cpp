#include <acs/core/LocationMap.hpp>

#include <fmt/format.h>

#include <utility>
#include <vector>

namespace ACS::Core
{

namespace
{

bool IsShortForm(const Location& location)
{
    return location.GetSegments().front().kind == ESegmentKind::Set;
}

tl::unexpected<Error> Refuse(const Location& location, std::string expected)
{
    return Fail(ECoreError::InvalidLocation, {}, std::move(expected), QuoteForError(location.GetOriginalText()));
}

} // namespace

Result<LocationMap> LocationMap::Create(std::span<const std::string> ranges)
{
    LocationMap map;
    for (std::size_t i = 0; i < ranges.size(); ++i)
    {
        Result<std::vector<Location>> locations = ParseLocationRange(ranges[i]);
        if (!locations.has_value())
        {
            locations.error().path = fmt::format("[{}]", i);
            return tl::unexpected(std::move(locations.error()));
        }
        map.Add(*locations);
    }
    return map;
}

void LocationMap::Add(const Location& location)
{
    const std::span<const LocationSegment> segments = location.GetSegments();
    if (!_places.insert(location).second || !location.HasArea() || segments.size() < 2
        || segments[1].kind != ESegmentKind::Set)
    {
        return;
    }
    std::string shortForm = location.GetText().substr(location.GetText().find('.') + 1);
    const auto [found, bNew] = _shortForms.try_emplace(std::move(shortForm), ShortForm{location, false});
    found->second.bAmbiguous = !bNew;
}

void LocationMap::Add(std::span<const Location> locations)
{
    for (const Location& location : locations)
    {
        Add(location);
    }
}

std::size_t LocationMap::GetCount() const noexcept
{
    return _places.size();
}

bool LocationMap::Contains(const Location& location) const
{
    return _places.contains(location);
}

std::optional<Location> LocationMap::CompleteSetOrNull(const Location& shortForm) const
{
    const auto found = _shortForms.find(shortForm.GetText());
    return found == _shortForms.end() || found->second.bAmbiguous ? std::nullopt : std::optional(found->second.place);
}

Result<Location> LocationMap::Resolve(const Location& location, const RobotID& robotID, const Location* positionOrNull)
    const
{
    const std::optional<RobotID>& namedOrNull = location.GetRobotOrNull();
    if (namedOrNull.has_value() && !namedOrNull->IsAlias() && *namedOrNull != robotID)
    {
        return Refuse(location, "a port of " + robotID.GetText());
    }
    Result<Location> place = location.WithRobot(robotID);
    if (place.has_value() && positionOrNull != nullptr)
    {
        place = place->WithAreaOf(*positionOrNull);
    }
    if (place.has_value() && IsShortForm(*place))
    {
        std::optional<Location> completeOrNull = CompleteSetOrNull(*place);
        if (!completeOrNull.has_value())
        {
            return Refuse(location, "a set of this site, with its area");
        }
        return std::move(*completeOrNull);
    }
    if (place.has_value() && !Contains(*place))
    {
        return Refuse(location, "a place of this site");
    }
    return place;
}

} // namespace ACS::Core
