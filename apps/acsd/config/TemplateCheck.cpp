#include "config/TemplateCheck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

namespace ACS::Acsd
{

namespace
{

using Core::ESegmentKind;
using Planning::EPlaceRule;
using ESubject = JobName::ESubject;

/// The keys that every station may have.
constexpr std::array<std::string_view, 3> STANDARD_KEYS{"type", "height", "side"};

EPlaceRule GetRule(ESubject subject, const Planning::ActionRule& rule)
{
    return subject == ESubject::To ? rule.to : rule.from;
}

std::string_view GetRuleName(EPlaceRule rule)
{
    switch (rule)
    {
        case EPlaceRule::FixedCassette:
            return "a cassette port of the site";
        case EPlaceRule::FixedTray:
            return "a tray port of the site";
        case EPlaceRule::RobotCassette:
            return "a cassette port of the robot";
        case EPlaceRule::RobotTray:
            return "a tray port of the robot";
        case EPlaceRule::Memory:
            return "a memory port";
        case EPlaceRule::None:
        default:
            return "none";
    }
}

/// Whether a place of the rule can have a segment of the kind.
bool CanHave(EPlaceRule rule, ESegmentKind kind)
{
    const bool bStation = kind == ESegmentKind::Stocker || kind == ESegmentKind::Area;
    switch (rule)
    {
        case EPlaceRule::FixedCassette:
            return bStation || kind == ESegmentKind::CassettePort;
        case EPlaceRule::FixedTray:
            return bStation || kind == ESegmentKind::CassettePort || kind == ESegmentKind::TrayPort;
        case EPlaceRule::RobotCassette:
            return kind == ESegmentKind::CassettePort;
        case EPlaceRule::RobotTray:
            return kind == ESegmentKind::TrayPort;
        case EPlaceRule::Memory:
            return true;
        case EPlaceRule::None:
        default:
            return false;
    }
}

bool IsOnRobot(EPlaceRule rule)
{
    return rule == EPlaceRule::RobotCassette || rule == EPlaceRule::RobotTray || rule == EPlaceRule::Memory;
}

/// `source` describes the origin of the value; empty: a literal value of the input.
std::string MakeWidthText(const ArmInputTemplate& input, std::int64_t value, const std::string& source)
{
    return fmt::format("{} cannot hold {}{}; it holds {}", input.relay.name, value, source, MakeRangeText(input.relay));
}

} // namespace

TemplateCheck::TemplateCheck(
    const StationTable& stations,
    const Planning::EngineOptions& engine,
    EArmRelayIndex relayIndex)
    : _stations(stations),
      _places(stations, engine),
      _relayIndex(relayIndex)
{
    for (const auto& [stationID, values] : stations)
    {
        const Core::Result<Core::Location> place = Core::Location::Parse(stationID);
        if (place.has_value())
        {
            Count(*place);
        }
    }
    std::ranges::for_each(engine.places, [this](const Core::Location& place) { Count(place); });
    for (const Planning::RobotOptions& robot : engine.robots)
    {
        std::ranges::for_each(robot.childPorts, [this](const Core::Location& place) { Count(place); });
        for (const Core::Location& port : robot.ports)
        {
            Count(port);
            _highestRobotPort = std::max(_highestRobotPort, std::int64_t{port.GetSegments().back().number});
        }
    }
}

const SitePlaces& TemplateCheck::GetPlaces() const noexcept
{
    return _places;
}

EArmRelayIndex TemplateCheck::GetRelayIndex() const noexcept
{
    return _relayIndex;
}

void TemplateCheck::Count(const Core::Location& place)
{
    for (const Core::LocationSegment& segment : place.GetSegments())
    {
        std::int64_t& highest = _highest[segment.kind];
        highest = std::max(highest, std::int64_t{segment.number});
    }
}

std::int64_t TemplateCheck::GetHighest(const JobName& name) const
{
    if (name.subject == ESubject::JobNumber)
    {
        return std::numeric_limits<std::int32_t>::max();
    }
    if (name.subject == ESubject::RobotPort)
    {
        return _highestRobotPort;
    }
    const auto highest = name.segment.has_value() ? _highest.find(*name.segment) : _highest.end();
    return highest == _highest.end() ? 0 : highest->second;
}

std::optional<std::string> TemplateCheck::FindPlaceFaultOrNull(const JobName& name, const Planning::ActionRule& rule)
    const
{
    const EPlaceRule place = GetRule(name.subject, rule);
    if (place == EPlaceRule::None || (name.segment.has_value() && !CanHave(place, *name.segment)))
    {
        return fmt::format(
            "no job of this action has {}: its {} is {}",
            MakeNameText(name),
            name.subject == ESubject::To ? "to" : "from",
            GetRuleName(place));
    }
    return !name.segment.has_value() || _places.HasSegment(place, rule.robotType, *name.segment)
        ? std::nullopt
        : std::optional(fmt::format("no place of this action has {}", MakeNameText(name)));
}

std::optional<std::string> TemplateCheck::FindStationFaultOrNull(const std::string& key) const
{
    const bool bKnown = std::ranges::find(STANDARD_KEYS, key) != STANDARD_KEYS.end()
        || std::ranges::any_of(_stations, [&key](const auto& station) { return station.second.contains(key); });
    return bKnown
        ? std::nullopt
        : std::optional(fmt::format("{{station.{}}}: no station has a key {}", key, Core::QuoteForError(key)));
}

std::optional<std::string> TemplateCheck::FindStationNumberFaultOrNull(const ArmInputTemplate& input) const
{
    const JobName& name = *input.value.GetNameOrNull();
    for (const auto& [stationID, values] : _stations)
    {
        const auto value = values.find(name.key);
        if (value == values.end())
        {
            continue;
        }
        const auto* const number = std::get_if<std::int64_t>(&value->second);
        if (number == nullptr)
        {
            return fmt::format("{} is not a whole number at station {}", MakeNameText(name), stationID);
        }
        if (!CanHold(input.relay, *number))
        {
            return MakeWidthText(input, *number, fmt::format(", the {} of station {}", name.key, stationID));
        }
    }
    return std::nullopt;
}

std::optional<std::string> TemplateCheck::FindFaultOrNull(const JobName& name, const Planning::ActionRule& rule) const
{
    switch (name.subject)
    {
        case ESubject::From:
        case ESubject::To:
            return FindPlaceFaultOrNull(name, rule);
        case ESubject::Position:
            return !name.segment.has_value() || _places.HasStationSegment(*name.segment)
                ? std::nullopt
                : std::optional(fmt::format("no station has {}", MakeNameText(name)));
        case ESubject::RobotPort:
            return IsOnRobot(rule.from) || IsOnRobot(rule.to)
                ? std::nullopt
                : std::optional(
                    std::string("no job of this action has {robot_port}: neither from nor to is on the robot"));
        case ESubject::Station:
            return FindStationFaultOrNull(name.key);
        case ESubject::Place:
        case ESubject::Carrier:
        case ESubject::JobNumber:
        default:
            return std::nullopt;
    }
}

std::optional<std::string> TemplateCheck::FindFaultOrNull(
    const ArmInputTemplate& input,
    const Planning::ActionRule& rule) const
{
    const JobName* const name = input.value.GetNameOrNull();
    if (name == nullptr)
    {
        const std::int64_t number = *input.value.GetNumberOrNull();
        return CanHold(input.relay, number) ? std::nullopt : std::optional(MakeWidthText(input, number, {}));
    }
    if (std::optional<std::string> fault = FindFaultOrNull(*name, rule); fault.has_value())
    {
        return fault;
    }
    if (name->subject == ESubject::Station)
    {
        return FindStationNumberFaultOrNull(input);
    }
    const std::int64_t highest = GetHighest(*name);
    return CanHold(input.relay, highest)
        ? std::nullopt
        : std::optional(MakeWidthText(input, highest, fmt::format(", the highest {}", MakeNameText(*name))));
}

} // namespace ACS::Acsd
