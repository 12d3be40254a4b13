#include "config/SitePlaces.hpp"

#include <algorithm>

namespace ACS::Acsd
{

namespace
{

using Core::ESegmentKind;
using Core::Location;
using Planning::EPlaceRule;

bool IsAllowed(EPlaceRule rule, const Location& place)
{
    switch (rule)
    {
        case EPlaceRule::FixedCassette:
        case EPlaceRule::RobotCassette:
            return place.IsCassettePort() && place.IsRobotPort() == (rule == EPlaceRule::RobotCassette);
        case EPlaceRule::FixedTray:
        case EPlaceRule::RobotTray:
            return place.IsTrayPort() && place.IsRobotPort() == (rule == EPlaceRule::RobotTray);
        case EPlaceRule::Memory:
            return place.IsMemoryPort();
        case EPlaceRule::None:
        default:
            return false;
    }
}

bool HasKind(const Location& place, ESegmentKind kind)
{
    return std::ranges::count(place.GetSegments(), kind, &Core::LocationSegment::kind) > 0;
}

bool IsFixed(EPlaceRule rule)
{
    return rule == EPlaceRule::FixedCassette || rule == EPlaceRule::FixedTray || rule == EPlaceRule::Memory;
}

/// A job with both ends on the robot, or with no end, can be at any station.
bool CanBeOnRobot(EPlaceRule rule)
{
    return rule != EPlaceRule::FixedCassette && rule != EPlaceRule::FixedTray;
}

/// Whether places of the rule that are on a robot have such a segment: "CR01.TP01.MP03".
bool IsSegmentOnRobot(EPlaceRule rule, ESegmentKind kind)
{
    switch (rule)
    {
        case EPlaceRule::RobotCassette:
            return kind == ESegmentKind::CassettePort;
        case EPlaceRule::RobotTray:
            return kind == ESegmentKind::TrayPort;
        case EPlaceRule::Memory:
            return kind == ESegmentKind::TrayPort || kind == ESegmentKind::MemoryPort;
        case EPlaceRule::FixedCassette:
        case EPlaceRule::FixedTray:
        case EPlaceRule::None:
        default:
            return false;
    }
}

/// Whether there are places of a rule, and whether one of them has the segment.
struct Search
{
    bool bPlace = false;
    bool bSegment = false;

    void Add(const Location& place, EPlaceRule rule, ESegmentKind kind)
    {
        const bool bAllowed = IsAllowed(rule, place);
        bPlace = bPlace || bAllowed;
        bSegment = bSegment || (bAllowed && HasKind(place, kind));
    }
};

} // namespace

SitePlaces::SitePlaces(const StationTable& stations, const Planning::EngineOptions& engine)
    : _ports(engine.places)
{
    for (const auto& [stationID, values] : stations)
    {
        const Core::Result<Location> place = Location::Parse(stationID);
        if (place.has_value())
        {
            _stations.push_back(*place);
        }
    }
    for (const Planning::RobotOptions& robot : engine.robots)
    {
        for (const std::vector<Location>* places : {&robot.ports, &robot.childPorts})
        {
            for (const Location& place : *places)
            {
                _robotPlaces.push_back({robot.type, place});
            }
        }
    }
}

bool SitePlaces::HasSegment(EPlaceRule rule, Planning::ERobotType robotType, ESegmentKind kind) const
{
    Search fixed;
    for (const std::vector<Location>* places : {&_stations, &_ports})
    {
        std::ranges::for_each(*places, [&](const Location& place) { fixed.Add(place, rule, kind); });
    }
    Search onRobot;
    for (const RobotPlace& entry : _robotPlaces)
    {
        if (entry.robotType == robotType)
        {
            onRobot.Add(entry.place, rule, kind);
        }
    }
    return fixed.bSegment || onRobot.bSegment || (!fixed.bPlace && IsFixed(rule))
        || (!onRobot.bPlace && IsSegmentOnRobot(rule, kind));
}

bool SitePlaces::HasStationSegment(ESegmentKind kind) const
{
    return _stations.empty()
        || std::ranges::any_of(_stations, [kind](const Location& station) { return HasKind(station, kind); });
}

bool SitePlaces::HasPlaceAt(std::string_view stationID, const Planning::ActionRule& rule) const
{
    const auto isAt = [&stationID](const Location& place) {
        return place.GetDockingPlace().GetText() == stationID;
    };
    if (CanBeOnRobot(rule.from) && CanBeOnRobot(rule.to))
    {
        return std::ranges::any_of(_stations, isAt);
    }
    const auto isOwn = [&](const Location& place) {
        return isAt(place) && (IsAllowed(rule.from, place) || IsAllowed(rule.to, place));
    };
    return std::ranges::any_of(_stations, isOwn) || std::ranges::any_of(_ports, isOwn);
}

} // namespace ACS::Acsd
