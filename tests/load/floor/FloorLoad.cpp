#include "common/config/CommandLine.hpp"
#include "EngineControl.hpp"
#include "FleetWorld.hpp"
#include "FloorBound.hpp"
#include "MeteredControl.hpp"
#include "OrderedControl.hpp"
#include "ZoneControl.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <memory>
#include <numeric>
#include <optional>
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
    std::uint64_t overtakingSeconds = 0; ///< EngineOptions::queueOvertaking.
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
    outcome.completed = world.GetTransports().GetFinished().size();
    outcome.description = outcome.bDone ? std::string() : world.Describe();
    if (outcome.completed == 0)
    {
        return outcome;
    }
    const auto count = static_cast<double>(outcome.completed);
    std::vector<double> slowdowns;
    std::vector<double> totals;
    for (const FinishedTransport& transport : world.GetTransports().GetFinished())
    {
        slowdowns.push_back(transport.slowdown);
        totals.push_back(transport.totalSeconds);
    }
    std::ranges::sort(slowdowns);
    outcome.perHour = count / world.GetVirtualHours();
    outcome.meanSlowdown = world.GetTransports().GetMeanSlowdown();
    outcome.slowdown95 = slowdowns[slowdowns.size() * 95 / 100];
    outcome.unfairness = *std::ranges::max_element(totals) * count / std::accumulate(totals.begin(), totals.end(), 0.0);
    outcome.cpu = cpu * MILLISECONDS / count;
    return outcome;
}

std::string Describe(const Outcome& outcome)
{
    return outcome.bDone ? fmt::format("{:>12.0f}", outcome.perHour)
                         : fmt::format("{:>12}", fmt::format("stuck at {}", outcome.completed));
}

FleetOptions MakeFleet(const Floor& floor, std::size_t density, const Options& options)
{
    constexpr std::size_t HUNDRED = 100;
    FleetOptions fleet;
    fleet.vehicles = std::max<std::size_t>(1, floor.parking.size() * density / HUNDRED);
    fleet.transports = options.transportsEach * fleet.vehicles;
    fleet.plansAtOnce = 2 * fleet.vehicles;
    fleet.priorities = 1;
    fleet.seed = options.seed;
    return fleet;
}

void PrintHead(const Floor& floor)
{
    fmt::print(
        "\n{}: {} nodes, {} parking positions\n"
        "{:>7} {:>8} | {:>12} {:>8} {:>8} {:>7} {:>7} | {:>12} {:>12} | {:>8} {:>8} {:>6}\n",
        floor.name,
        floor.site.GetNodes().size(),
        floor.parking.size(),
        "density",
        "vehicles",
        "engine, 1/h",
        "slowdown",
        "95th",
        "longest",
        "CPU, ms",
        "zones, 1/h",
        "in order",
        "fleet",
        "node",
        "ratio");
}

/// False: the engine did not do all transports, vehicles were in one place, or a rule did more.
bool TryRow(const Floor& floor, std::size_t density, const Options& options)
{
    const FleetOptions fleet = MakeFleet(floor, density, options);
    const FloorBound bound =
        FindBound(floor, MakeDemands(floor, fleet.seed, fleet.transports, fleet.priorities), fleet.vehicles);
    const Outcome engine = Run(floor, fleet, [&options](const Floor& ofEngine, std::size_t vehicles) {
        return std::make_unique<EngineControl>(ofEngine, vehicles, std::chrono::seconds(options.overtakingSeconds));
    });
    const Outcome zone = Run(floor, fleet, &Make<ZoneControl>);
    const Outcome ordered = Run(floor, fleet, &Make<OrderedControl>);
    fmt::print(
        "{:>5} % {:>8} | {} {:>8.2f} {:>8.2f} {:>7.1f} {:>7.2f} | {} {} | {:>8.0f} {:>8.0f} {:>6.2f}\n",
        density,
        fleet.vehicles,
        Describe(engine),
        engine.meanSlowdown,
        engine.slowdown95,
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
    const auto isBetter = [&engine](const Outcome& rule) {
        return rule.bDone && rule.perHour > engine.perHour;
    };
    if (isBetter(zone) || isBetter(ordered))
    {
        fmt::print("  a rule did more than the engine\n");
    }
    return engine.bDone && engine.violations.empty() && !isBetter(zone) && !isBetter(ordered);
}

int RunAll(const Options& options)
{
    const std::vector<Floor> floors{MakeGridFloor(false), MakeLaneFloor(), MakeDocumentFloor(), MakePlantFloor()};
    if (!options.only.empty() && std::ranges::count(floors, options.only, &Floor::name) == 0)
    {
        fmt::print(stderr, "--floor: there is no floor {}; expected one of", options.only);
        std::ranges::for_each(floors, [](const Floor& floor) { fmt::print(stderr, " '{}'", floor.name); });
        fmt::print(stderr, "\n");
        return 2;
    }
    bool bOK = true;
    for (const Floor& floor : floors)
    {
        if (!options.only.empty() && floor.name != options.only)
        {
            continue;
        }
        PrintHead(floor);
        for (const std::size_t density : options.densities)
        {
            bOK = TryRow(floor, density, options) && bOK;
        }
    }
    return bOK ? 0 : 1;
}

} // namespace

} // namespace ACS::Testing

int main(int argc, char** argv)
{
    using namespace ACS; // NOLINT(google-build-using-namespace)
    return Apps::RunProgram("floor_load", [argc, argv]() {
        Testing::Options options;
        CLI::App app{
            "Transports of a fleet on several floors, in virtual time: of the engine, of simple rules, and what no control can exceed; "
            "fails if a transport does not end or a rule does more. docs/design/performance.md describes the columns",
            "floor_load"};
        app.add_option("--floor", options.only, "Only the floor of this name");
        app.add_option("--density", options.densities, "Vehicles, in % of the parking positions, a row each")
            ->delimiter(',')
            ->check(CLI::Range(1, 100))
            ->capture_default_str();
        app.add_option("--transports", options.transportsEach, "Transports of each vehicle")
            ->check(CLI::Range(1, 10'000))
            ->capture_default_str();
        app.add_option("--seed", options.seed, "Of the transports")->capture_default_str();
        app.add_option("--overtaking", options.overtakingSeconds, "queue.overtaking of the engine, in seconds")
            ->check(CLI::Range(0, 86'400))
            ->capture_default_str();
        const std::optional<int> exitCode = Apps::ParseCommandLineOrNull(app, argc, argv);
        return exitCode.has_value() ? *exitCode : Testing::RunAll(options);
    });
}
