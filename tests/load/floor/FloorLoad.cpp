#include "EngineControl.hpp"
#include "FleetWorld.hpp"
#include "FloorBound.hpp"
#include "MeteredControl.hpp"
#include "OrderedControl.hpp"
#include "ZoneControl.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

// How many transports a fleet does on several floors, in virtual time: the engine, simple rules, and what no control can exceed.

namespace ACS::Testing
{

namespace
{

struct Options
{
    std::vector<std::size_t> densities{10, 20, 30, 40, 50, 60}; ///< Vehicles, in % of the parking positions.
    std::string only;                                           ///< Of the floors; empty: all.
    std::size_t transportsEach = 25;                            ///< Of a vehicle.
    std::uint64_t seed = 1;
    bool bEngineOnly = false;
};

struct Outcome
{
    bool bDone = false;
    std::size_t completed = 0;
    std::vector<std::string> violations;
    std::string description; ///< Of a run that did not end.
    double perHour = 0;
    double meanSlowdown = 0;
    double slowdown95 = 0;
    double unfairness = 0; ///< The longest time from submission to completion, relative to the mean.
    double cpu = 0;        ///< Milliseconds of a transport.
};

using MakeControl = std::function<std::unique_ptr<IFleetControl>(const Floor& floor, std::size_t vehicles)>;

template <typename TControl>
std::unique_ptr<IFleetControl> Make(const Floor& floor, std::size_t vehicles)
{
    return std::make_unique<TControl>(floor, vehicles);
}

Outcome Run(const Floor& floor, const FleetOptions& options, const MakeControl& make)
{
    constexpr double MILLISECONDS = 1e3;
    double cpu = 0;
    FleetWorld world(floor, options, std::make_unique<MeteredControl>(make(floor, options.vehicles), cpu));
    Outcome outcome;
    outcome.bDone = world.TryRun();
    outcome.violations = world.violations;
    outcome.completed = world.completed;
    outcome.description = outcome.bDone ? std::string() : world.Describe();
    if (world.completed == 0)
    {
        return outcome;
    }
    const auto count = static_cast<double>(world.completed);
    std::vector<double> slowdowns;
    std::vector<double> totals;
    for (const FinishedTransport& transport : world.GetFinished())
    {
        slowdowns.push_back(transport.slowdown);
        totals.push_back(transport.totalSeconds);
    }
    std::ranges::sort(slowdowns);
    outcome.perHour = count / world.GetVirtualHours();
    outcome.meanSlowdown = world.GetMeanSlowdown();
    outcome.slowdown95 = slowdowns[slowdowns.size() * 95 / 100];
    outcome.unfairness = *std::ranges::max_element(totals) * count / std::accumulate(totals.begin(), totals.end(), 0.0);
    outcome.cpu = cpu * MILLISECONDS / count;
    return outcome;
}

std::string Describe(const Outcome& outcome)
{
    return outcome.bDone
        ? fmt::format("{:8.0f} {:5.2f} {:5.2f}", outcome.perHour, outcome.meanSlowdown, outcome.slowdown95)
        : fmt::format("{:>20}", fmt::format("deadlock after {}", outcome.completed));
}

/// Whether the engine did all transports without a collision.
bool TryRow(const Floor& floor, std::size_t density, const Options& options)
{
    FleetOptions fleet;
    fleet.vehicles = std::max<std::size_t>(1, floor.parking.size() * density / 100);
    fleet.transports = options.transportsEach * fleet.vehicles;
    fleet.plansAtOnce = 2 * fleet.vehicles;
    fleet.priorities = 1;
    fleet.seed = options.seed;
    const FloorBound bound =
        FindBound(floor, MakeDemands(floor, fleet.seed, fleet.transports, fleet.priorities), fleet.vehicles);
    const Outcome engine = Run(floor, fleet, &Make<EngineControl>);
    const Outcome zone = options.bEngineOnly ? Outcome{} : Run(floor, fleet, &Make<ZoneControl>);
    const Outcome ordered = options.bEngineOnly ? Outcome{} : Run(floor, fleet, &Make<OrderedControl>);
    fmt::print(
        "{:>3} % {:>4} | {} {:5.1f} {:6.3f} | {} | {} | {:6.0f} {:6.0f} {:5.2f}\n",
        density,
        fleet.vehicles,
        Describe(engine),
        engine.unfairness,
        engine.cpu,
        Describe(zone),
        Describe(ordered),
        bound.fleetPerHour,
        bound.nodePerHour,
        engine.perHour / bound.GetPerHour());
    static_cast<void>(std::fflush(stdout));
    for (const Outcome* outcome : {&engine, &zone, &ordered})
    {
        for (const std::string& violation : outcome->violations)
        {
            fmt::print("  {}\n", violation);
        }
    }
    if (!engine.bDone)
    {
        fmt::print("  {}\n", engine.description);
    }
    return engine.bDone && engine.violations.empty();
}

} // namespace

} // namespace ACS::Testing

int main(int argc, char** argv)
{
    using namespace ACS::Testing; // NOLINT(google-build-using-namespace): this program
    Options options;
    CLI::App app("Throughput of fleets on several floors, in virtual time");
    app.add_option("--floor", options.only, "Only the floor of this name");
    app.add_option("--density", options.densities, "Vehicles, in % of the parking positions")->delimiter(',');
    app.add_option("--transports", options.transportsEach, "Transports of each vehicle");
    app.add_option("--seed", options.seed, "Of the transports");
    app.add_flag("--engine-only", options.bEngineOnly, "Without the rules that the engine is compared with");
    CLI11_PARSE(app, argc, argv);
    bool bOK = true;
    const std::vector<Floor> floors{MakeGridFloor(false), MakeLaneFloor(), MakeDocumentFloor(), MakePlantFloor()};
    for (const Floor& floor : floors)
    {
        if (!options.only.empty() && floor.name != options.only)
        {
            continue;
        }
        fmt::print(
            "{}: {} nodes, {} parking positions\n",
            floor.name,
            floor.site.GetNodes().size(),
            floor.parking.size());
        for (const std::size_t density : options.densities)
        {
            bOK = TryRow(floor, density, options) && bOK;
        }
    }
    return bOK ? 0 : 1;
}
