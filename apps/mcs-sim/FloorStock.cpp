#include "FloorStock.hpp"

#include "CleanText.hpp"
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

void Act(const Sim::WorldEvent& event, const std::string& place, Sim::IWorld& world, std::vector<std::string>& lines)
{
    const Core::Result<void> done = world.Act(event);
    if (!done.has_value())
    {
        lines.push_back(fmt::format("{} not restocked: {}", CleanText(place), Core::Describe(done.error())));
    }
}

} // namespace

void Restock(const FloorPlan& plan, Sim::IWorld& world, std::vector<std::string>& lines)
{
    for (const Sim::CarrierPlaced& wanted : plan.carriers)
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
        }
        else if (place != wanted.place)
        {
            Act(wanted, wanted.place, world, lines);
        }
    }
    for (const Sim::MemoryPlaced& wanted : plan.memories)
    {
        if (world.GetMemory(wanted.place) != wanted.memory)
        {
            Act(wanted, wanted.place, world, lines);
        }
    }
}

} // namespace ACS::McsSim
