#include "BoundLine.hpp"
#include "common/config/CommandLine.hpp"
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

// acsd with a fleet at work: a broker, vehicles and an MCS as in a plant, all on this machine.

namespace ACS::Load
{

namespace
{

constexpr double MOST_CPU = 25.0; ///< % of a core.
constexpr double MOST_MIB = 100.0;
constexpr double PERIOD = 200.0; ///< ms
constexpr double TOLERANCE = 0.02;
constexpr double FLAT = 1.5; ///< Cost of a robot among the most, times that among the fewest.
constexpr std::size_t MOST_ROBOTS = 1000;

struct Options
{
    std::vector<std::size_t> robots{10, 25, 50, 100};
    int seconds = 30;
    bool bCountsOnly = false;
};

double GetCostOfRobot(const RobotsFigures& figures)
{
    return figures.acsdCpu / static_cast<double>(figures.robots);
}

/// Prints it, and returns whether it was kept.
bool IsBoundKept(const std::string& what, const std::string& measured, bool bKept, const std::string& bound)
{
    PrintBound(what, measured, bKept, bound);
    return bKept;
}

bool IsEveryBoundKept(const RobotsFigures& figures)
{
    constexpr double KIB = 1024.0;
    const double perSecond = 1.0 / figures.seconds;
    const TickFigures& positions = figures.positions;
    const double resident = static_cast<double>(figures.residentKiB) / KIB;
    fmt::print("\nacsd, {} robots with a plan each, measured for {:.0f} s\n", figures.robots, figures.seconds);
    bool bKept = IsBoundKept(
        "CPU of acsd",
        fmt::format("{:.2f} % of a core, {:.3f} % a robot", figures.acsdCpu, GetCostOfRobot(figures)),
        figures.acsdCpu < MOST_CPU,
        fmt::format("{} %", MOST_CPU));
    bKept = IsBoundKept(
                "memory of acsd",
                fmt::format("{:.1f} MiB resident", resident),
                resident < MOST_MIB,
                fmt::format("{} MiB", MOST_MIB))
        && bKept;
    // Where the machine had a part in every interval, their mean still shows the schedule.
    const double mean = positions.count > 0 ? positions.mean : positions.meanOfAll;
    bKept = IsBoundKept(
                "RobotPositionUpdate, mean interval",
                fmt::format("{:.2f} ms, longest {:.1f} ms", mean, positions.longest),
                std::abs(mean - PERIOD) <= TOLERANCE * PERIOD,
                fmt::format("{} ms, {} % more or less", PERIOD, 100.0 * TOLERANCE))
        && bKept;
    bKept = IsBoundKept(
                "RobotPositionUpdates left out",
                fmt::format("{} of {}", positions.left, positions.count),
                positions.left == 0,
                "none")
        && bKept;
    PrintFigure(
        "intervals in which the machine stood still",
        fmt::format("{}; mean of all {:.2f} ms", positions.ofMachine, positions.meanOfAll));
    PrintFigure(
        "reports and robot states a second",
        fmt::format(
            "{:.1f} and {:.1f}",
            static_cast<double>(figures.count.reports) * perSecond,
            static_cast<double>(figures.count.statuses) * perSecond));
    PrintFigure("plans", fmt::format("{} run at the end, {} were completed", figures.running, figures.count.completed));
    PrintFigure(
        "CPU of vda-sim, mosquitto and the MCS",
        fmt::format("{:.1f}, {:.1f} and {:.1f} %", figures.simulatorCpu, figures.brokerCpu, figures.ownCpu));
    return bKept;
}

/// What may never be, however busy the machine is.
bool WasEverythingWell(const RobotsFigures& figures)
{
    const KeeperCount& count = figures.count;
    const bool bWell = count.errors == 0 && count.positions > 0;
    if (!bWell)
    {
        fmt::print(
            "NOT WELL: {} errors, {} reports, {} position updates; {}\n",
            count.errors,
            count.reports,
            count.positions,
            count.firstError);
    }
    return bWell;
}

bool IsCurveKept(const std::vector<RobotsFigures>& rows)
{
    std::string curve;
    for (const RobotsFigures& row : rows)
    {
        curve += fmt::format("{}{}: {:.3f} %", curve.empty() ? "" : ", ", row.robots, GetCostOfRobot(row));
    }
    const double ratio = GetCostOfRobot(rows.back()) / GetCostOfRobot(rows.front());
    fmt::print("\n");
    PrintFigure("CPU of acsd for one robot, among", curve);
    return IsBoundKept(
        fmt::format("one among {} by one among {}", rows.back().robots, rows.front().robots),
        fmt::format("{:.2f} times", ratio),
        ratio <= FLAT,
        fmt::format("{} times", FLAT));
}

int Run(Options options)
{
    constexpr int INTERRUPTED = 130;
    std::ranges::sort(options.robots);
    std::vector<RobotsFigures> rows;
    bool bWell = true;
    bool bKept = true;
    for (const std::size_t robots : options.robots)
    {
        const std::optional<RobotsFigures> figures = MeasureRobotsOrNull(robots, std::chrono::seconds(options.seconds));
        if (!figures.has_value())
        {
            return INTERRUPTED;
        }
        rows.push_back(*figures);
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
        Load::Options options;
        CLI::App app{
            "measures acsd with a fleet of vda-sim at work and an MCS that keeps a plan running for each robot, on a broker of "
            "their own; fails where a plan or a report does, and where a bound is not kept",
            "acsd_robots_load"};
        app.add_option("--robots", options.robots, "how many, a row each, for example 10,100")
            ->delimiter(',')
            ->check(CLI::Range(std::size_t{1}, Load::MOST_ROBOTS))
            ->capture_default_str();
        app.add_option("--seconds", options.seconds, "how long each row is measured")
            ->check(CLI::Range(1, 100'000))
            ->capture_default_str();
        app.add_flag("--counts-only", options.bCountsOnly, "bounds are shown, but do not make it fail");
        const std::optional<int> exitCode = Apps::ParseCommandLineOrNull(app, argc, argv);
        return exitCode.has_value() ? *exitCode : Load::Run(options);
    });
}
