#include "floor/FloorStock.hpp"

#include "console/CleanText.hpp"
#include "world/EWorldError.hpp"
#include <acs/core/Location.hpp>

#include <fmt/format.h>

#include <optional>

namespace ACS::McsSim
{

namespace
{

bool IsOnRobot(const std::string& place)
{
    const Core::Result<Core::Location> location = Core::Location::Parse(place);
    return location.has_value() && location->IsRobotPort();
}

/// What the floor does not allow is a line; the error is the world's own.
Core::Result<void> Act(
    const Sim::WorldEvent& event,
    const std::string& place,
    Sim::IWorld& world,
    std::vector<std::string>& lines)
{
    Core::Result<void> done = world.Act(event);
    if (done.has_value() || done.error().code == Sim::EWorldError::JournalFailed
        || done.error().code == Sim::EWorldError::LimitExceeded)
    {
        return done;
    }
    lines.push_back(fmt::format("{} not restocked: {}", CleanText(place), CleanText(Core::Describe(done.error()))));
    return {};
}

Core::Result<void> RestockCarrier(const Sim::CarrierPlaced& wanted, Sim::IWorld& world, std::vector<std::string>& lines)
{
    const std::optional<std::string> place =
        wanted.carrierID.empty() ? std::nullopt : world.GetPlaceOrNull(wanted.carrierID);
    if (place.has_value() && IsOnRobot(*place))
    {
        lines.push_back(fmt::format(
            "{} not restocked: {} is on {}",
            CleanText(wanted.place),
            CleanText(wanted.carrierID),
            CleanText(*place)));
        return {};
    }
    return place == wanted.place ? Core::Result<void>() : Act(wanted, wanted.place, world, lines);
}

} // namespace

Core::Result<void> Restock(const FloorPlan& plan, Sim::IWorld& world, std::vector<std::string>& lines)
{
    Core::Result<void> done;
    for (auto wanted = plan.carriers.begin(); done.has_value() && wanted != plan.carriers.end(); ++wanted)
    {
        done = RestockCarrier(*wanted, world, lines);
    }
    for (auto wanted = plan.memories.begin(); done.has_value() && wanted != plan.memories.end(); ++wanted)
    {
        if (world.GetMemory(wanted->place) != wanted->memory)
        {
            done = Act(*wanted, wanted->place, world, lines);
        }
    }
    return done;
}

} // namespace ACS::McsSim
