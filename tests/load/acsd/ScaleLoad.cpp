#include "BoundLine.hpp"
#include "common/config/CommandLine.hpp"
#include "LoadOptions.hpp"
#include "RobotsRun.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>
#include <sys/resource.h>
#include <vector>

// acsd on a large floor: a map of 5,000 nodes with a parking position for each of 1,000 robots, of which any number is there.

namespace ACS::Load
{

namespace
{

constexpr std::size_t CELLS = 500; ///< Of ten nodes each.
constexpr std::size_t PARKING = 2; ///< Of a cell.
constexpr std::size_t MOST_ROBOTS = CELLS * PARKING;
constexpr double MOST_CPU = 50.0; ///< % of a core.
constexpr double MOST_MIB = 300.0;
constexpr double LONGEST_START = 3.0; ///< Seconds.
constexpr double PERIOD = 0.2;        ///< Of position updates, in seconds.
constexpr double FLAT = 1.5;          ///< Cost of a robot among the most, relative to that among the fewest.
constexpr double KIB = 1024.0;

struct Options : LoadOptions
{
    std::size_t storedPlans = 10'000;
};

double GetCostOfRobot(const RobotsMetrics& metrics)
{
    return metrics.acsdCpu / static_cast<double>(metrics.robots);
}

double GetMiB(const RobotsMetrics& metrics)
{
    return static_cast<double>(metrics.residentKiB) / KIB;
}

/// Of the measuring time; one less may fall into it.
std::size_t CountDue(const RobotsMetrics& metrics)
{
    return static_cast<std::size_t>(metrics.seconds / PERIOD);
}

void PrintTable(const std::vector<RobotsMetrics>& rows)
{
    fmt::print(
        "\n{:>6} {:>6} {:>9} {:>9} {:>9} {:>9} {:>7} {:>7} {:>9} {:>5} {:>9} {:>6} {:>11}\n",
        "robots",
        "plans",
        "ready s",
        "online s",
        "placed s",
        "start CPU",
        "CPU %",
        "MiB",
        "ms/robot",
        "due",
        "received",
        "late",
        "by machine");
    for (const RobotsMetrics& row : rows)
    {
        constexpr double MILLISECONDS = 10.0; // of a second, from % of it
        fmt::print(
            "{:>6} {:>6} {:>9.2f} {:>9.2f} {:>9.2f} {:>9.2f} {:>7.2f} {:>7.1f} {:>9.3f} {:>5} {:>9} {:>6} {:>11}\n",
            row.robots,
            row.running,
            row.start.ready,
            row.start.online,
            row.start.placed,
            row.start.cpu,
            row.acsdCpu,
            GetMiB(row),
            MILLISECONDS * GetCostOfRobot(row),
            CountDue(row),
            row.count.positions,
            row.positions.left,
            row.positions.ofMachine);
    }
    fmt::print("\n");
}

/// Prints the value; returns whether it is within its bound.
bool IsBoundKept(const std::string& what, const std::string& measured, bool bKept, const std::string& bound)
{
    PrintBound(what, measured, bKept, bound);
    return bKept;
}

bool IsStartKept(const RobotsMetrics& metrics, std::size_t storedPlans)
{
    return IsBoundKept(
        fmt::format("start, {} robots, {} stored plans", metrics.robots, storedPlans),
        fmt::format(
            "{:.2f} s, {:.2f} s to the last position, CPU {:.2f} s",
            std::max(metrics.start.ready, metrics.start.online),
            metrics.start.placed,
            metrics.start.cpu),
        std::max(metrics.start.ready, metrics.start.online) < LONGEST_START,
        fmt::format("{} s", LONGEST_START));
}

bool IsEveryBoundKept(const RobotsMetrics& metrics)
{
    const std::string among = fmt::format(", {} robots", metrics.robots);
    bool bKept = IsBoundKept(
        "CPU of acsd" + among,
        fmt::format("{:.2f} % of a core", metrics.acsdCpu),
        metrics.acsdCpu < MOST_CPU,
        fmt::format("{} %", MOST_CPU));
    bKept = IsBoundKept(
                "memory of acsd" + among,
                fmt::format("{:.1f} MiB resident", GetMiB(metrics)),
                GetMiB(metrics) < MOST_MIB,
                fmt::format("{} MiB", MOST_MIB))
        && bKept;
    bKept = IsBoundKept(
                "RobotPositionUpdates" + among,
                fmt::format(
                    "{} of {}, {} late, longest {:.0f} ms",
                    metrics.count.positions,
                    CountDue(metrics),
                    metrics.positions.left,
                    metrics.positions.longest),
                metrics.count.positions + 1 >= CountDue(metrics) && metrics.positions.left == 0,
                "all, none late")
        && bKept;
    PrintValue(
        "CPU of vda-sim, mosquitto and the MCS",
        fmt::format("{:.1f}, {:.1f} and {:.1f} %", metrics.simulatorCpu, metrics.brokerCpu, metrics.ownCpu));
    PrintValue(
        "plans",
        fmt::format(
            "{} run at the end, {} were completed; {:.1f} reports and {:.1f} robot states a second",
            metrics.running,
            metrics.count.completed,
            static_cast<double>(metrics.count.reports) / metrics.seconds,
            static_cast<double>(metrics.count.statuses) / metrics.seconds));
    return bKept;
}

bool IsCurveKept(const std::vector<RobotsMetrics>& rows)
{
    const double ratio = GetCostOfRobot(rows.back()) / GetCostOfRobot(rows.front());
    return IsBoundKept(
        fmt::format("CPU of one among {} by one among {}", rows.back().robots, rows.front().robots),
        fmt::format("{:.2f} times", ratio),
        ratio <= FLAT,
        fmt::format("{} times", FLAT));
}

/// Conditions that hold however busy the machine is.
bool WasEverythingWell(const RobotsMetrics& metrics)
{
    const bool bWell = metrics.count.errors == 0 && metrics.unsent == 0;
    if (!bWell)
    {
        fmt::print(
            "FAILED: {} robots, {} errors, {} messages not sent to vehicles; {}\n",
            metrics.robots,
            metrics.count.errors,
            metrics.unsent,
            metrics.count.firstError);
    }
    return bWell;
}

int Run(Options options)
{
    constexpr int INTERRUPTED = 130;
    std::ranges::sort(options.robots);
    std::vector<RobotsMetrics> rows;
    const std::chrono::seconds howLong(options.seconds);
    for (const std::size_t robots : options.robots)
    {
        const std::size_t plans = (robots + 1) / PARKING;
        const auto metrics = MeasureRobotsOrNull({robots, plans, CELLS, PARKING, 0}, howLong);
        if (!metrics.has_value())
        {
            return INTERRUPTED;
        }
        rows.push_back(*metrics);
        PrintTable({*metrics});
        std::fflush(stdout);
    }
    std::optional<RobotsMetrics> queued;
    if (options.storedPlans > 0)
    {
        queued = MeasureRobotsOrNull({options.robots.back(), 0, CELLS, PARKING, options.storedPlans}, howLong);
        if (!queued.has_value())
        {
            return INTERRUPTED;
        }
    }
    PrintTable(rows);
    bool bWell = true;
    bool bKept = rows.size() < 2 || IsCurveKept(rows);
    for (const RobotsMetrics& row : rows)
    {
        bKept = IsEveryBoundKept(row) && bKept;
        bKept = IsStartKept(row, 0) && bKept;
        bWell = WasEverythingWell(row) && bWell;
    }
    if (queued.has_value())
    {
        fmt::print("\nThe queue has {} plans at the start, and all robots work:\n", options.storedPlans);
        PrintTable({*queued});
        bKept = IsStartKept(*queued, options.storedPlans) && bKept;
        bKept = IsEveryBoundKept(*queued) && bKept;
        bWell = WasEverythingWell(*queued) && bWell;
    }
    return bWell && (bKept || options.bCountsOnly) ? 0 : 1;
}

/// A connection of the broker for each vehicle, and one of each vda-sim.
void RaiseFileLimit()
{
    rlimit limit{};
    if (getrlimit(RLIMIT_NOFILE, &limit) == 0)
    {
        limit.rlim_cur = limit.rlim_max;
        static_cast<void>(setrlimit(RLIMIT_NOFILE, &limit));
    }
}

} // namespace

} // namespace ACS::Load

int main(int argc, char** argv)
{
    using namespace ACS; // NOLINT(google-build-using-namespace)
    return Apps::RunProgram("acsd_scale_load", [argc, argv]() {
        Load::Options options{{{100, 250, 500, 1000}, 60}};
        CLI::App app{
            "Measures acsd on a map of 5,000 nodes with a growing number of vda-sim vehicles, half of them with a plan, on its own "
            "broker, and its start with many stored plans; fails if a plan or a report fails, or a value is out of its bound",
            "acsd_scale_load"};
        Load::AddLoadOptions(app, options, "100,1000", 2, Load::MOST_ROBOTS);
        app.add_option(
               "--stored",
               options.storedPlans,
               "Number of plans that wait in the store at the last start; 0: no such start")
            ->check(CLI::Range(std::size_t{0}, std::size_t{90'000}))
            ->capture_default_str();
        const std::optional<int> exitCode = Apps::ParseCommandLineOrNull(app, argc, argv);
        if (exitCode.has_value())
        {
            return *exitCode;
        }
        Load::RaiseFileLimit();
        return Load::Run(options);
    });
}
