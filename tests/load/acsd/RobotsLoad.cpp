#include "BoundLine.hpp"
#include "common/config/CommandLine.hpp"
#include "LoadOptions.hpp"
#include "RobotsRun.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

// acsd with a working fleet: a broker, vehicles and an MCS as in a plant, all on this machine.

namespace ACS::Load
{

namespace
{

constexpr double MOST_CPU = 25.0; ///< % of a core.
constexpr double MOST_MIB = 100.0;
constexpr double PERIOD = 200.0; ///< ms
constexpr double TOLERANCE = 0.02;
constexpr double FLAT = 1.5; ///< Cost of a robot among the most, relative to that among the fewest.
constexpr std::size_t MOST_ROBOTS = 1000;
constexpr std::size_t LEAST_CELLS = 100; ///< Of the site.

double GetCostOfRobot(const RobotsMetrics& metrics)
{
    return metrics.acsdCpu / static_cast<double>(metrics.robots);
}

/// Prints the value; returns whether it is within its bound.
bool IsBoundKept(const std::string& what, const std::string& measured, bool bKept, const std::string& bound)
{
    PrintBound(what, measured, bKept, bound);
    return bKept;
}

bool IsEveryBoundKept(const RobotsMetrics& metrics)
{
    constexpr double KIB = 1024.0;
    const double perSecond = 1.0 / metrics.seconds;
    const TickMetrics& positions = metrics.positions;
    const double resident = static_cast<double>(metrics.residentKiB) / KIB;
    fmt::print("\nacsd, {} robots with a plan each, measured for {:.0f} s\n", metrics.robots, metrics.seconds);
    bool bKept = IsBoundKept(
        "CPU of acsd",
        fmt::format("{:.2f} % of a core, {:.3f} % a robot", metrics.acsdCpu, GetCostOfRobot(metrics)),
        metrics.acsdCpu < MOST_CPU,
        fmt::format("{} %", MOST_CPU));
    bKept = IsBoundKept(
                "memory of acsd",
                fmt::format("{:.1f} MiB resident", resident),
                resident < MOST_MIB,
                fmt::format("{} MiB", MOST_MIB))
        && bKept;
    // If the machine stalled in every interval, their mean still shows the schedule.
    const double mean = positions.count > 0 ? positions.mean : positions.meanOfAll;
    bKept = IsBoundKept(
                "RobotPositionUpdate, mean interval",
                fmt::format("{:.2f} ms, longest {:.1f} ms", mean, positions.longest),
                std::abs(mean - PERIOD) <= TOLERANCE * PERIOD,
                fmt::format("{} ms, {} % more or less", PERIOD, 100.0 * TOLERANCE))
        && bKept;
    bKept = IsBoundKept(
                "RobotPositionUpdates omitted",
                fmt::format("{} of {}", positions.left, positions.count),
                positions.left == 0,
                "none")
        && bKept;
    PrintValue(
        "intervals with a stall of the machine",
        fmt::format("{}; mean of all {:.2f} ms", positions.ofMachine, positions.meanOfAll));
    PrintValue(
        "reports and robot states a second",
        fmt::format(
            "{:.1f} and {:.1f}",
            static_cast<double>(metrics.count.reports) * perSecond,
            static_cast<double>(metrics.count.statuses) * perSecond));
    PrintValue("plans", fmt::format("{} run at the end, {} were completed", metrics.running, metrics.count.completed));
    PrintValue(
        "CPU of vda-sim, mosquitto and the MCS",
        fmt::format("{:.1f}, {:.1f} and {:.1f} %", metrics.simulatorCpu, metrics.brokerCpu, metrics.ownCpu));
    return bKept;
}

/// Conditions that hold however busy the machine is.
bool WasEverythingWell(const RobotsMetrics& metrics)
{
    const KeeperCount& count = metrics.count;
    const bool bWell = count.errors == 0 && metrics.unsent == 0 && count.positions > 0;
    if (!bWell)
    {
        fmt::print(
            "FAILED: {} errors, {} messages not sent, {} reports, {} position updates; {}\n",
            count.errors,
            metrics.unsent,
            count.reports,
            count.positions,
            count.firstError);
    }
    return bWell;
}

bool IsCurveKept(const std::vector<RobotsMetrics>& rows)
{
    std::string curve;
    for (const RobotsMetrics& row : rows)
    {
        curve += fmt::format("{}{}: {:.3f} %", curve.empty() ? "" : ", ", row.robots, GetCostOfRobot(row));
    }
    const double ratio = GetCostOfRobot(rows.back()) / GetCostOfRobot(rows.front());
    fmt::print("\n");
    PrintValue("CPU of acsd for one robot, among", curve);
    return IsBoundKept(
        fmt::format("one among {} by one among {}", rows.back().robots, rows.front().robots),
        fmt::format("{:.2f} times", ratio),
        ratio <= FLAT,
        fmt::format("{} times", FLAT));
}

int Run(LoadOptions options)
{
    constexpr int INTERRUPTED = 130;
    std::ranges::sort(options.robots);
    std::vector<RobotsMetrics> rows;
    bool bWell = true;
    bool bKept = true;
    for (const std::size_t robots : options.robots)
    {
        const RobotsSetup setup{robots, robots, std::max(robots, LEAST_CELLS), 0, 0};
        const std::optional<RobotsMetrics> metrics = MeasureRobotsOrNull(setup, std::chrono::seconds(options.seconds));
        if (!metrics.has_value())
        {
            return INTERRUPTED;
        }
        rows.push_back(*metrics);
        bKept = IsEveryBoundKept(rows.back()) && bKept;
        bWell = WasEverythingWell(rows.back()) && bWell;
        std::fflush(stdout);
    }
    bKept = (rows.size() < 2 || IsCurveKept(rows)) && bKept;
    return bWell && (bKept || options.bCountsOnly) ? 0 : 1;
}

} // namespace

} // namespace ACS::Load

int main(int argc, char** argv)
{
    using namespace ACS; // NOLINT(google-build-using-namespace)
    return Apps::RunProgram("acsd_robots_load", [argc, argv]() {
        Load::LoadOptions options{{10, 25, 50, 100}, 30};
        CLI::App app{
            "Measures acsd with a working fleet of vda-sim and an MCS that keeps a plan running for each robot, on its own broker; "
            "fails if a plan or a report fails, or a value is out of its bound",
            "acsd_robots_load"};
        Load::AddLoadOptions(app, options, "10,100", 1, Load::MOST_ROBOTS);
        const std::optional<int> exitCode = Apps::ParseCommandLineOrNull(app, argc, argv);
        return exitCode.has_value() ? *exitCode : Load::Run(options);
    });
}
