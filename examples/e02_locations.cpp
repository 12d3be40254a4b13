// Lesson 2: places. "A01.CP02.TP01" is tray port 1 in cassette port 2 of area 1; "AMR.CP01" is cassette port 1 of
// whichever robot executes the plan.
//
// A Location is valid by construction: a function that takes one has nothing left to check.

#include <acs/core/Location.hpp>

#include <fmt/core.h>

#include <string_view>
#include <vector>

using namespace ACS; // NOLINT(google-build-using-namespace): an example reads better without the prefix

namespace
{

/// Whether the text is a location; prints what it is, or why it is none.
bool IsLocation(std::string_view text)
{
    const Core::Result<Core::Location> location = Core::Location::Parse(text);
    if (!location.has_value())
    {
        fmt::print("{} is no location: {}\n", text, Core::Describe(location.error()));
        return false;
    }
    // The sender's spelling is kept, because reports to him repeat it. Compare and store the canonical text.
    fmt::print("{} is {}{}\n", text, location->GetText(), location->WasNormalised() ? " (normalised)" : "");
    return true;
}

/// The alias of the plan becomes the robot that was chosen for it: commands and reports name a real robot.
Core::Result<Core::Location> ResolveAlias(std::string_view place, std::string_view robot)
{
    const Core::Result<Core::RobotID> robotID = Core::RobotID::Parse(robot);
    if (!robotID.has_value())
    {
        return tl::unexpected(robotID.error());
    }
    // and_then continues only with a value; the chain results in its first error.
    return Core::Location::Parse(place).and_then(
        [&robotID](const Core::Location& location) { return location.WithRobot(*robotID); });
}

} // namespace

int main()
{
    const bool bCanonical = IsLocation("A01.CP02.TP01");
    const bool bSloppy = IsLocation("a01.cp2.tp1");
    const bool bNonsense = IsLocation("A01.XY07");
    if (!bCanonical || !bSloppy || bNonsense)
    {
        return 1;
    }

    const Core::Result<Core::Location> port = ResolveAlias("AMR.CP01", "LR01");
    const Core::Result<Core::Location> memory = Core::Location::Parse("A01.SET03.MP15");
    // Configurations write many ports as a range over the last number.
    const Core::Result<std::vector<Core::Location>> range = Core::ParseLocationRange("A01.CP01.TP01-04");
    if (!port.has_value() || !memory.has_value() || !range.has_value())
    {
        return 1;
    }
    fmt::print("AMR.CP01 on LR01 is {}, a robot's port: {}\n", port->GetText(), port->IsRobotPort());

    // A plan names the port; the robot drives to the station that the port is part of.
    fmt::print("{} is reached from {}\n", memory->GetText(), memory->GetDockingPlace().GetText());

    fmt::print("A01.CP01.TP01-04 are {} places:\n", range->size());
    for (const Core::Location& place : *range)
    {
        fmt::print("  {}\n", place.GetText());
    }
    return 0;
}
