#include "world/MemoryWorld.hpp"

#include "world/EWorldError.hpp"
#include "world/WorldNames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>
#include <variant>

namespace ACS::Sim
{
namespace
{

std::set<std::string, std::less<>> MakeStations(const std::vector<std::string>& stationIDs)
{
    std::set<std::string, std::less<>> stations;
    for (const std::string& stationID : stationIDs)
    {
        stations.insert(MakeCanonical(stationID));
    }
    return stations;
}

/// Sets the path of an error to that in the world file. The path that it had before is added to what was found.
template <typename TValue>
Core::Result<void> AtPath(std::string path, const Core::Result<TValue>& result)
{
    if (result.has_value())
    {
        return {};
    }
    Core::Error error = result.error();
    if (!error.path.empty())
    {
        error.found = error.found.empty() ? error.path : fmt::format("{} at {}", error.found, error.path);
    }
    error.path = std::move(path);
    return tl::make_unexpected(std::move(error));
}

} // namespace

Core::Result<std::unique_ptr<MemoryWorld>> MemoryWorld::Create(const WorldStart& start)
{
    auto world = std::make_unique<MemoryWorld>();
    Core::Result<void> done;
    for (auto place = start.places.begin(); done.has_value() && place != start.places.end(); ++place)
    {
        done = AtPath(fmt::format("places \"{}\"", *place), world->_places.Add(*place));
    }
    // A cassette must be placed before the trays in it. Its place is the shorter text.
    std::vector<std::pair<std::string, std::string>> carriers;
    for (const auto& [carrierID, place] : start.carriers)
    {
        carriers.emplace_back(place, carrierID);
    }
    std::ranges::stable_sort(carriers, {}, [](const auto& carrier) { return std::ranges::count(carrier.first, '.'); });
    for (auto carrier = carriers.begin(); done.has_value() && carrier != carriers.end(); ++carrier)
    {
        const std::string path = fmt::format("carriers.{}", carrier->second);
        const Core::Result<Place> place = world->FindPort(carrier->first);
        done = AtPath(path, CheckName(carrier->second));
        done = done.has_value() ? AtPath(path, place) : done;
        done = done.has_value() ? AtPath(path, world->CheckFree(*place)) : done;
        done = done.has_value() ? AtPath(path, world->Act(CarrierPlaced{carrier->second, carrier->first})) : done;
    }
    for (auto memory = start.memories.begin(); done.has_value() && memory != start.memories.end(); ++memory)
    {
        done =
            AtPath(fmt::format("memories.{}", memory->first), world->Act(MemoryPlaced{memory->first, memory->second}));
    }
    for (auto cover = start.covers.begin(); done.has_value() && cover != start.covers.end(); ++cover)
    {
        const Core::Result<Place> place = world->FindSet(cover->first);
        done = AtPath(fmt::format("covers.{}", cover->first), place);
        if (done.has_value())
        {
            world->Apply(CoverMoved{{}, place->text, cover->second});
        }
    }
    if (!done.has_value())
    {
        return tl::make_unexpected(std::move(done.error()));
    }
    world->_events.clear();
    return world;
}

Core::Result<void> MemoryWorld::Act(const WorldEvent& event)
{
    Core::Result<WorldEvent> checked = Check(event);
    if (!checked.has_value())
    {
        return tl::make_unexpected(std::move(checked.error()));
    }
    if (IsRepeated(*checked))
    {
        return {};
    }
    std::visit([this](const auto& happened) { Apply(happened); }, *checked);
    if (_events.size() == MAX_EVENTS)
    {
        _events.pop_front();
    }
    _events.push_back(std::move(*checked));
    return {};
}

std::optional<std::string> MemoryWorld::GetCarrierOrNull(std::string_view place)
{
    return _contents.GetCarrierOrNull(MakeCanonical(place));
}

std::optional<std::string> MemoryWorld::GetPlaceOrNull(std::string_view carrierID)
{
    return _contents.GetPlaceOrNull(carrierID);
}

EMemory MemoryWorld::GetMemory(std::string_view place)
{
    return _contents.GetMemory(MakeCanonical(place));
}

bool MemoryWorld::IsCovered(std::string_view set)
{
    return _closedSets.contains(MakeCanonical(set));
}

std::vector<WorldEvent> MemoryWorld::TakeEvents()
{
    std::vector<WorldEvent> events(std::make_move_iterator(_events.begin()), std::make_move_iterator(_events.end()));
    _events.clear();
    return events;
}

Core::Result<WorldEvent> MemoryWorld::Check(const WorldEvent& event) const
{
    return std::visit([this](const auto& wanted) { return CheckEvent(wanted); }, event);
}

bool MemoryWorld::IsRepeated(const WorldEvent& event) const
{
    const auto* const docked = std::get_if<RobotDocked>(&event);
    if (docked == nullptr)
    {
        return false;
    }
    const auto known = _stations.find(docked->robotID);
    return known == _stations.end() ? docked->stationIDs.empty() : known->second == MakeStations(docked->stationIDs);
}

Core::Result<Place> MemoryWorld::FindPlace(std::string_view text) const
{
    Core::Result<Place> place = ParsePlace(text);
    if (!place.has_value())
    {
        return place;
    }
    if (!_places.Contains(*place))
    {
        return Core::Fail(EWorldError::NoSuchPlace, place->text, "a place of the floor", "an unlisted place");
    }
    const std::string carrierPort = place->GetCarrierPort();
    if (!carrierPort.empty() && !_contents.GetCarrierOrNull(carrierPort).has_value())
    {
        return Core::Fail(
            EWorldError::PlaceEmpty,
            place->text,
            fmt::format("a carrier at {}, which has this place", carrierPort),
            "none");
    }
    return place;
}

Core::Result<Place> MemoryWorld::FindKind(std::string_view text, Core::ESegmentKind kind, std::string_view expected)
    const
{
    Core::Result<Place> place = FindPlace(text);
    if (place.has_value() && place->kind != kind)
    {
        return Core::Fail(EWorldError::InvalidPlace, place->text, std::string(expected));
    }
    return place;
}

Core::Result<Place> MemoryWorld::FindPort(std::string_view text) const
{
    Core::Result<Place> place = FindPlace(text);
    if (place.has_value() && !place->IsPort())
    {
        return Core::Fail(EWorldError::InvalidPlace, place->text, "a cassette port or tray port");
    }
    return place;
}

Core::Result<Place> MemoryWorld::FindMemoryPlace(std::string_view text) const
{
    return FindKind(text, Core::ESegmentKind::MemoryPort, "a memory place");
}

Core::Result<Place> MemoryWorld::FindSet(std::string_view text) const
{
    return FindKind(text, Core::ESegmentKind::Set, "a set");
}

Core::Result<void> MemoryWorld::CheckReach(std::string_view robotID, const Place& place) const
{
    Core::Result<void> robot = CheckRobotName(robotID);
    if (!robot.has_value() || place.robotID == robotID)
    {
        return robot;
    }
    if (!place.robotID.empty())
    {
        return Core::Fail(
            EWorldError::OutOfReach,
            place.text,
            fmt::format("a port of {} or a fixed place", robotID),
            fmt::format("a port of {}", place.robotID));
    }
    const auto docked = _stations.find(robotID);
    if (docked != _stations.end() && docked->second.contains(place.station))
    {
        return {};
    }
    const bool bDocked = docked != _stations.end() && !docked->second.empty();
    return Core::Fail(
        EWorldError::OutOfReach,
        place.text,
        fmt::format("{} docked at {}", robotID, place.station),
        bDocked ? fmt::format("it docked at {}", fmt::join(docked->second, ", ")) : "it not docked");
}

Core::Result<void> MemoryWorld::CheckCover(const Place& place) const
{
    if (_closedSets.contains(place.station))
    {
        return Core::Fail(
            EWorldError::CoverClosed,
            place.text,
            fmt::format("{} open", place.station),
            "its cover closed");
    }
    return {};
}

Core::Result<void> MemoryWorld::CheckFree(const Place& place) const
{
    const std::optional<std::string> obstacle = _contents.GetObstacleOrNull(place.text);
    if (obstacle.has_value())
    {
        return Core::Fail(EWorldError::PlaceOccupied, place.text, "a free place", *obstacle);
    }
    return {};
}

} // namespace ACS::Sim
