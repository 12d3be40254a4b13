#include "world/Place.hpp"

#include "world/EWorldError.hpp"
#include <acs/core/Location.hpp>

#include <cstddef>
#include <utility>

namespace ACS::Sim
{
namespace
{

/// Replaces the robot while the rest of the place is parsed as a location.
constexpr std::string_view STAND_IN = "A01";

tl::unexpected<Core::Error> Refuse(std::string_view text)
{
    return Core::Fail(
        EWorldError::InvalidPlace,
        Core::QuoteForError(text),
        "a place such as A01.CP01, A01.CP01.TP01, A01.SET01.MP01, LR01.CP01 or CR01.TP01.MP01");
}

Place MakeFixed(const Core::Location& location)
{
    return {location.GetText(), location.GetKind(), {}, location.GetDockingPlace().GetText()};
}

/// A tray port or memory place inside a cassette on a robot.
Core::Result<Place> ParseInsideRobot(std::string_view text)
{
    const std::size_t dot = text.find('.');
    const std::string_view robot = text.substr(0, dot);
    if (dot == std::string_view::npos || !Core::RobotID::IsRobotID(robot) || robot == Core::RobotID::ALIAS)
    {
        return Refuse(text);
    }
    const Core::Result<Core::Location> inside = Core::Location::Parse(std::string(STAND_IN).append(text.substr(dot)));
    constexpr std::size_t SHORTEST = 3;
    if (!inside.has_value() || inside->GetSegments().size() < SHORTEST
        || inside->GetSegments()[1].kind != Core::ESegmentKind::CassettePort)
    {
        return Refuse(text);
    }
    return Place{
        std::string(robot) + inside->GetText().substr(STAND_IN.size()),
        inside->GetKind(),
        std::string(robot),
        {}};
}

} // namespace

bool Place::IsPort() const noexcept
{
    return kind == Core::ESegmentKind::CassettePort || kind == Core::ESegmentKind::TrayPort;
}

std::string Place::GetCarrierPort() const
{
    std::string outer = text.substr(0, text.rfind('.'));
    const bool bOnTray = kind == Core::ESegmentKind::MemoryPort && outer != station;
    const bool bInRobotCassette = kind == Core::ESegmentKind::TrayPort && !robotID.empty() && outer != robotID;
    return bOnTray || bInRobotCassette ? outer : std::string();
}

Core::Result<Place> ParsePlace(std::string_view text)
{
    const Core::Result<Core::Location> location = Core::Location::Parse(text);
    if (!location.has_value())
    {
        return ParseInsideRobot(text);
    }
    if (location->GetSegments().front().kind == Core::ESegmentKind::Set)
    {
        return Refuse(text);
    }
    if (!location->IsRobotPort())
    {
        return MakeFixed(*location);
    }
    const Core::RobotID& robotID = *location->GetRobotOrNull();
    if (robotID.IsAlias())
    {
        return Refuse(text);
    }
    return Place{location->GetText(), location->GetKind(), robotID.GetText(), {}};
}

} // namespace ACS::Sim
