#include "world/MemoryWorld.hpp"

#include "world/EWorldError.hpp"
#include "world/WorldNames.hpp"
#include <acs/core/Location.hpp>

#include <fmt/format.h>

#include <initializer_list>
#include <utility>

namespace ACS::Sim
{
namespace
{

/// Returns the event, or the first error.
Core::Result<WorldEvent> Conclude(std::initializer_list<Core::Result<void>> checks, WorldEvent event)
{
    for (const Core::Result<void>& check : checks)
    {
        if (!check.has_value())
        {
            return tl::make_unexpected(check.error());
        }
    }
    return event;
}

Core::Result<void> CheckCount(std::size_t count, std::size_t maximum, std::string_view what)
{
    if (count >= maximum)
    {
        return Core::Fail(EWorldError::LimitExceeded, {}, fmt::format("at most {} {}", maximum, what));
    }
    return {};
}

/// Checks that the ports are of the same kind: a cassette fits into cassette ports, a tray into tray ports.
Core::Result<void> CheckFits(std::string_view from, const Place& to)
{
    const Core::Result<Place> place = ParsePlace(from);
    if (place.has_value() && place->kind != to.kind)
    {
        return Core::Fail(EWorldError::InvalidPlace, to.text, fmt::format("a port of the kind of {}", from));
    }
    return {};
}

Core::Result<void> CheckHolds(
    const Place& place,
    const std::optional<std::string>& carrierOrNull,
    const std::string& wanted)
{
    if (!carrierOrNull.has_value())
    {
        return Core::Fail(
            EWorldError::PlaceEmpty,
            place.text,
            wanted.empty() ? "a carrier" : fmt::format("the carrier {}", wanted),
            "an empty place");
    }
    if (!wanted.empty() && *carrierOrNull != wanted)
    {
        return Core::Fail(EWorldError::OtherCarrier, place.text, fmt::format("the carrier {}", wanted), *carrierOrNull);
    }
    return {};
}

/// Checks the content of a memory place. Unknown content is accepted as empty and as occupied.
Core::Result<void> CheckNotHolding(const Place& place, EMemory found, EMemory excluded)
{
    if (found != excluded)
    {
        return {};
    }
    return excluded == EMemory::Empty ? Core::Fail(EWorldError::PlaceEmpty, place.text, "a memory", "an empty place")
                                      : Core::Fail(EWorldError::PlaceOccupied, place.text, "a free place", "a memory");
}

/// Checks that a robot can dock there: at a fixed place, which the floor need not have, or at a station that is not a place, such
/// as a charger.
Core::Result<void> CheckStation(std::string_view stationID)
{
    const Core::Result<Place> place = ParsePlace(stationID);
    if (!place.has_value())
    {
        return Core::Location::IsLocation(stationID) ? tl::make_unexpected(place.error()) : CheckName(stationID);
    }
    if (place->station != place->text)
    {
        return Core::Fail(
            EWorldError::InvalidPlace,
            place->text,
            "a fixed place at which a robot docks (A01.CP01, A01.SET01)",
            place->robotID.empty() ? fmt::format("a place inside {}", place->station)
                                   : fmt::format("a port of {}", place->robotID));
    }
    return {};
}

} // namespace

Core::Result<WorldEvent> MemoryWorld::CheckEvent(const RobotDocked& docked) const
{
    RobotDocked canonical{docked.robotID, {}};
    for (const std::string& stationID : docked.stationIDs)
    {
        const Core::Result<void> possible = CheckStation(stationID);
        if (!possible.has_value())
        {
            return tl::make_unexpected(possible.error());
        }
        canonical.stationIDs.push_back(MakeCanonical(stationID));
    }
    const std::size_t robots = _stations.contains(docked.robotID) ? 0 : _stations.size();
    return Conclude(
        {CheckRobotName(docked.robotID),
         CheckCount(robots, MAX_ROBOTS, "robots"),
         CheckCount(docked.stationIDs.size(), MAX_STATIONS + 1, "stations of a robot")},
        std::move(canonical));
}

Core::Result<WorldEvent> MemoryWorld::CheckEvent(const CarrierMoved& moved) const
{
    const Core::Result<Place> from = FindPort(moved.from);
    const Core::Result<Place> to = FindPort(moved.to);
    if (!from.has_value() || !to.has_value())
    {
        return tl::make_unexpected(from.has_value() ? to.error() : from.error());
    }
    const std::optional<std::string> carrier = _contents.GetCarrierOrNull(from->text);
    return Conclude(
        {CheckReach(moved.robotID, *from),
         CheckReach(moved.robotID, *to),
         CheckHolds(*from, carrier, moved.carrierID),
         CheckFits(from->text, *to),
         CheckFree(*to)},
        CarrierMoved{moved.robotID, carrier.value_or(""), from->text, to->text});
}

Core::Result<WorldEvent> MemoryWorld::CheckEvent(const MemoryMoved& moved) const
{
    const Core::Result<Place> from = FindMemoryPlace(moved.from);
    const Core::Result<Place> to = FindMemoryPlace(moved.to);
    if (!from.has_value() || !to.has_value())
    {
        return tl::make_unexpected(from.has_value() ? to.error() : from.error());
    }
    const EMemory target = from->text == to->text ? EMemory::Occupied : _contents.GetMemory(to->text);
    return Conclude(
        {CheckReach(moved.robotID, *from),
         CheckReach(moved.robotID, *to),
         CheckCover(*from),
         CheckCover(*to),
         CheckNotHolding(*from, _contents.GetMemory(from->text), EMemory::Empty),
         CheckNotHolding(*to, target, EMemory::Occupied),
         CheckCount(_contents.GetMemoryCount() + 1, MAX_MEMORIES, "memory places")},
        MemoryMoved{moved.robotID, from->text, to->text});
}

Core::Result<WorldEvent> MemoryWorld::CheckEvent(const CoverMoved& moved) const
{
    const Core::Result<Place> set = FindSet(moved.set);
    if (!set.has_value())
    {
        return tl::make_unexpected(set.error());
    }
    return Conclude({CheckReach(moved.robotID, *set)}, CoverMoved{moved.robotID, set->text, moved.bClosed});
}

Core::Result<WorldEvent> MemoryWorld::CheckEvent(const ButtonPushed& pushed) const
{
    const Core::Result<Place> place = FindPlace(pushed.place);
    if (!place.has_value())
    {
        return tl::make_unexpected(place.error());
    }
    return Conclude({CheckReach(pushed.robotID, *place)}, ButtonPushed{pushed.robotID, place->text});
}

Core::Result<WorldEvent> MemoryWorld::CheckEvent(const CarrierPlaced& placed) const
{
    if (placed.place.empty())
    {
        return Conclude({CheckName(placed.carrierID)}, placed);
    }
    const Core::Result<Place> place = FindPort(placed.place);
    if (!place.has_value())
    {
        return tl::make_unexpected(place.error());
    }
    const CarrierPlaced canonical{placed.carrierID, place->text};
    if (placed.carrierID.empty())
    {
        return canonical;
    }
    const std::optional<std::string> present = _contents.GetPlaceOrNull(placed.carrierID);
    return Conclude(
        {CheckName(placed.carrierID),
         CheckFits(present.value_or(""), *place),
         CheckCount(present.has_value() ? 0 : _contents.GetCarrierCount(), MAX_CARRIERS, "carriers")},
        canonical);
}

Core::Result<WorldEvent> MemoryWorld::CheckEvent(const MemoryPlaced& placed) const
{
    const Core::Result<Place> place = FindMemoryPlace(placed.place);
    if (!place.has_value())
    {
        return tl::make_unexpected(place.error());
    }
    return Conclude(
        {CheckCount(_contents.GetMemoryCount(), MAX_MEMORIES, "memory places")},
        MemoryPlaced{place->text, placed.memory});
}

void MemoryWorld::Apply(const RobotDocked& docked)
{
    _stations[docked.robotID] = {docked.stationIDs.begin(), docked.stationIDs.end()};
}

void MemoryWorld::Apply(const CarrierMoved& moved)
{
    _contents.Move(moved.from, moved.to);
}

void MemoryWorld::Apply(const MemoryMoved& moved)
{
    _contents.SetMemory(moved.from, EMemory::Empty);
    _contents.SetMemory(moved.to, EMemory::Occupied);
}

void MemoryWorld::Apply(const CoverMoved& moved)
{
    if (moved.bClosed)
    {
        _closedSets.insert(moved.set);
    }
    else
    {
        _closedSets.erase(moved.set);
    }
}

void MemoryWorld::Apply(const ButtonPushed& /*pushed*/)
{
    // A button is not part of the modelled floor.
}

void MemoryWorld::Apply(const CarrierPlaced& placed)
{
    const std::optional<std::string> present =
        placed.carrierID.empty() ? std::nullopt : _contents.GetPlaceOrNull(placed.carrierID);
    if (placed.place.empty())
    {
        if (present.has_value())
        {
            _contents.Remove(*present);
        }
        return;
    }
    if (present == placed.place)
    {
        return;
    }
    _contents.Remove(placed.place);
    if (present.has_value())
    {
        _contents.Move(*present, placed.place);
    }
    else if (!placed.carrierID.empty())
    {
        _contents.Put(placed.carrierID, placed.place);
    }
}

void MemoryWorld::Apply(const MemoryPlaced& placed)
{
    _contents.SetMemory(placed.place, placed.memory);
}

} // namespace ACS::Sim
