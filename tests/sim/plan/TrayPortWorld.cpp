#include "TrayPortWorld.hpp"

#include <utility>
#include <variant>

namespace ACS::Simulation
{

namespace
{

constexpr std::string_view OF_VEHICLE = ".CP";
constexpr std::string_view OF_FLOOR = ".TP";

} // namespace

TrayPortWorld::TrayPortWorld(Sim::IWorld& floor, std::string robotID)
    : _floor(floor),
      _robotID(std::move(robotID))
{
}

std::string TrayPortWorld::Translate(std::string_view place, std::string_view from, std::string_view to) const
{
    const std::string own = _robotID + std::string(from);
    return place.starts_with(own) ? _robotID + std::string(to) + std::string(place.substr(own.size()))
                                  : std::string(place);
}

Core::Result<void> TrayPortWorld::Act(const Sim::WorldEvent& event)
{
    Sim::WorldEvent translated = event;
    if (auto* const movedOrNull = std::get_if<Sim::CarrierMoved>(&translated); movedOrNull != nullptr)
    {
        movedOrNull->from = Translate(movedOrNull->from, OF_VEHICLE, OF_FLOOR);
        movedOrNull->to = Translate(movedOrNull->to, OF_VEHICLE, OF_FLOOR);
    }
    return _floor.Act(translated);
}

std::optional<std::string> TrayPortWorld::GetCarrierOrNull(std::string_view place)
{
    return _floor.GetCarrierOrNull(Translate(place, OF_VEHICLE, OF_FLOOR));
}

std::optional<std::string> TrayPortWorld::GetPlaceOrNull(std::string_view carrierID)
{
    const std::optional<std::string> place = _floor.GetPlaceOrNull(carrierID);
    return place.has_value() ? std::optional(Translate(*place, OF_FLOOR, OF_VEHICLE)) : std::nullopt;
}

Sim::EMemory TrayPortWorld::GetMemory(std::string_view place)
{
    return _floor.GetMemory(place);
}

bool TrayPortWorld::IsCovered(std::string_view set)
{
    return _floor.IsCovered(set);
}

std::vector<Sim::WorldEvent> TrayPortWorld::TakeEvents()
{
    return _floor.TakeEvents();
}

} // namespace ACS::Simulation
