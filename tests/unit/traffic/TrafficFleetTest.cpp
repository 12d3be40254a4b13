#include "Catch.hpp"
#include "EngineControl.hpp"
#include "FleetWorld.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

using ACS::Testing::EngineControl;
using ACS::Testing::FleetOptions;
using ACS::Testing::FleetWorld;
using ACS::Testing::Floor;
using ACS::Testing::MakeGridFloor;
using ACS::Testing::MakeLaneFloor;

namespace
{

void Run(const Floor& floor, const FleetOptions& options)
{
    INFO("seed " << options.seed << (options.bFaults ? " with faults" : ""));
    FleetWorld world(floor, options, std::make_unique<EngineControl>(floor, options.vehicles));
    const bool bDone = world.TryRun();
    INFO(world.Describe());
    CHECK(world.violations == std::vector<std::string>{});
    REQUIRE(bDone);
    CHECK(world.GetTransports().GetFinished().size() == options.transports);
    const std::string line = fmt::format(
        "{} vehicles, {} transports, seed {}{}: mean slowdown {:.2f}, {:.1f} h, {} drives, {} cancelled, {} events\n",
        options.vehicles,
        options.transports,
        options.seed,
        options.bFaults ? ", with faults" : "",
        world.GetTransports().GetMeanSlowdown(),
        world.GetVirtualHours(),
        world.drives,
        world.cancels,
        world.events);
    static_cast<void>(std::fputs(line.c_str(), stdout));
}

} // namespace

TEST_CASE("20 vehicles do 1,000 random transports on one-way and two-way lanes: no conflict, no deadlock")
{
    FleetOptions options;
    Run(MakeGridFloor(false), options);
    FleetOptions alone;
    alone.vehicles = 1;
    alone.transports = 50;
    Run(MakeGridFloor(false), alone);
}

TEST_CASE("20 vehicles that pause, are slow, are lost and recover do all transports")
{
    for (std::uint64_t seed = 1; seed <= 3; ++seed)
    {
        FleetOptions options;
        options.seed = seed;
        options.transports = 120;
        options.bFaults = true;
        Run(MakeGridFloor(false), options);
    }
}

TEST_CASE("36 vehicles on the same floor do all transports")
{
    FleetOptions options;
    options.vehicles = 36;
    options.transports = 100;
    options.plansAtOnce = 72;
    options.seed = 7;
    Run(MakeGridFloor(false), options);
}

TEST_CASE("20 vehicles use lanes for empty and for loaded vehicles only, with faults and without")
{
    const Floor floor = MakeGridFloor(true);
    for (const bool bFaults : {false, true})
    {
        FleetOptions options;
        options.transports = 200;
        options.seed = 3;
        options.bFaults = bFaults;
        Run(floor, options);
    }
}

TEST_CASE("Vehicles on one two-way lane let each other pass in the bays beside it, up to one on each parking position")
{
    const Floor floor = MakeLaneFloor();
    for (const std::size_t vehicles : std::vector<std::size_t>{5, 10})
    {
        FleetOptions options;
        options.vehicles = vehicles;
        options.transports = 125;
        options.plansAtOnce = 2 * vehicles;
        options.priorities = 1;
        Run(floor, options);
    }
}
