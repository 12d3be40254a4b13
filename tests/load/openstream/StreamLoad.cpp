#include "BareStream.hpp"
#include "BoundLine.hpp"
#include "common/config/CommandLine.hpp"
#include "ServedStream.hpp"
#include "StallWatch.hpp"
#include <acs/openstream_asio/RealTime.hpp>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Load
{

namespace
{

using Seconds = std::chrono::duration<double>;

constexpr double MEAN_BOUND = 0.001;  ///< Of the period.
constexpr double MONITOR_BOUND = 1.2; ///< Times the bare loop's, p50 and p99 of |gap - period|.
constexpr double CONTROL_BOUND = 1.5;
constexpr double RESOLUTION = 0.001; ///< ms: a difference that the figures cannot show.
constexpr std::chrono::seconds LONGEST_TURN{5};
constexpr std::size_t SOAK_SESSIONS = 8;
constexpr std::uint64_t MOST_GROWTH = 16U * 1024U * 1024U; ///< Bytes, in a soak.
constexpr std::size_t MOST_SESSIONS = 1'000;

struct Options
{
    int seconds = 30;
    std::size_t sessions = 64;
    bool bSoak = false;
    bool bRealTime = false;
};

struct Row
{
    StreamKind kind;
    StreamFigures figures;
};

double GetCoreShare(Core::Duration used, Core::Duration elapsed)
{
    return 100.0 * Seconds(used).count() / Seconds(elapsed).count();
}

void PrintHeader()
{
    fmt::print(
        "\n{:<30}{:>9} {:>8} {:>5}  {:>8} {:>7} {:>7} {:>7} {:>8} {:>6} {:>8} {:>7} {:>7}\n",
        "traffic, period 2 ms",
        "frames",
        "skipped",
        "lost",
        "mean ms",
        "p50",
        "p99",
        "p99.9",
        "largest",
        "> 2 T",
        "machine",
        "server",
        "client");
}

std::string DescribeGaps(const GapFigures& gaps)
{
    return fmt::format(
        "{:>8.4f} {:>7.4f} {:>7.4f} {:>7.4f} {:>8.2f} {:>6} {:>8}",
        gaps.mean,
        gaps.p50,
        gaps.p99,
        gaps.p999,
        gaps.largest,
        gaps.beyondTwo,
        gaps.ofMachine);
}

void PrintRow(const Row& row, const std::vector<StallWatch::Stall>& stalls)
{
    const StreamFigures& figures = row.figures;
    fmt::print(
        "{:<30}{:>9} {:>8} {:>5}  {} {:>6.1f}% {:>6.1f}%\n",
        row.kind.name,
        figures.framesReceived,
        figures.ticksSkipped,
        figures.framesSent - figures.framesReceived,
        DescribeGaps(figures.frames.Evaluate(stalls)),
        GetCoreShare(figures.serverTime, figures.elapsed),
        GetCoreShare(figures.clientTime, figures.elapsed));
    if (row.kind.bControls)
    {
        fmt::print(
            "{:<30}{:>9} {:>8} {:>5}  {}\n",
            "  its CONTROLs",
            figures.controlsServed,
            figures.controlsHeldBack,
            figures.controlsSent - figures.controlsServed,
            DescribeGaps(figures.controls.Evaluate(stalls)));
    }
}

void PrintMost(const std::string& what, double value, double bound, const char* unit)
{
    PrintBound(what, fmt::format("{:.3f}{}", value, unit), value <= bound, fmt::format("{}{}", bound, unit));
}

/// Ratios to the bare loop of the same run.
void PrintBounds(const Row& row, const GapFigures& bare, const std::vector<StallWatch::Stall>& stalls)
{
    const GapFigures gaps = row.figures.frames.Evaluate(stalls);
    const double bound = row.kind.bControls ? CONTROL_BOUND : MONITOR_BOUND;
    const auto compare = [](double ours, double theirs) {
        return std::max(ours, RESOLUTION) / std::max(theirs, RESOLUTION);
    };
    const double period = std::chrono::duration<double, std::milli>(PERIOD).count();
    PrintMost(
        row.kind.name + ": mean, off the period",
        100.0 * std::abs(gaps.mean / period - 1.0),
        100.0 * MEAN_BOUND,
        "%");
    PrintMost(row.kind.name + ": p50 of the bare loop's", compare(gaps.p50, bare.p50), bound, "x");
    PrintMost(row.kind.name + ": p99 of the bare loop's", compare(gaps.p99, bare.p99), bound, "x");
}

/// What may never be, however busy the machine is: true where all is well.
bool WasEverythingAccountedFor(const Row& row)
{
    const StreamFigures& figures = row.figures;
    const auto seen = static_cast<std::int64_t>(figures.framesAtPeriod + figures.framesReplaced + figures.ticksSkipped);
    const bool bWell = figures.framesSent == figures.framesReceived && figures.periods == seen
        && figures.controlsSent == figures.controlsServed && figures.linesRefused == 0;
    if (!bWell)
    {
        fmt::print(
            "{}: NOT ACCOUNTED FOR: {} frames sent, {} received; {} periods, {} with a frame, replaced or skipped; {} CONTROLs "
            "sent, {} served; {} lines refused {}\n",
            row.kind.name,
            figures.framesSent,
            figures.framesReceived,
            figures.periods,
            seen,
            figures.controlsSent,
            figures.controlsServed,
            figures.linesRefused,
            figures.firstRefusal);
    }
    return bWell;
}

/// Both ends and the allocator have taken what they need soon after the beginning.
bool WasMemoryKept(const StreamFigures& figures, const std::vector<StallWatch::Stall>& stalls)
{
    const std::uint64_t after =
        figures.residentAfter - std::min(figures.residentAfter, stalls.size() * sizeof(StallWatch::Stall));
    const bool bKept = after <= figures.residentBefore + MOST_GROWTH;
    PrintBound(
        "resident memory without the run's own lists",
        fmt::format("{} KiB at the beginning, {} KiB at the end", figures.residentBefore / 1024U, after / 1024U),
        bKept,
        fmt::format("{} KiB of growth", MOST_GROWTH / 1024U));
    return bKept;
}

std::vector<Row> MakeRows(const Options& options)
{
    if (options.bSoak)
    {
        return {Row{StreamKind{"8 x MONITOR and CONTROL", SOAK_SESSIONS, false, true}, {}}};
    }
    return {
        Row{StreamKind{"bare loop, 200 bytes", 1, true, false}, {}},
        Row{StreamKind{"MONITOR", 1, false, false}, {}},
        Row{StreamKind{"MONITOR and CONTROL", 1, false, true}, {}},
        Row{StreamKind{fmt::format("{} x MONITOR and CONTROL", options.sessions), options.sessions, false, true}, {}}};
}

/// The kinds in turns, so that all meet the same machine. False where a turn was given up.
bool TryMeasure(const Options& options, std::vector<Row>& rows)
{
    const std::chrono::milliseconds total = std::chrono::seconds(options.seconds);
    const std::chrono::milliseconds turn =
        options.bSoak ? total : std::min<std::chrono::milliseconds>(total, LONGEST_TURN);
    for (std::chrono::milliseconds done{0}; done < total; done += turn)
    {
        for (Row& row : rows)
        {
            fmt::print(
                stderr,
                "\r{:>5.0f} s of {} each: {:<40}",
                Seconds(done).count(),
                options.seconds,
                row.kind.name);
            if (row.kind.bBare)
            {
                RunBareTurn(turn, row.figures);
            }
            else if (!TryRunServedTurn(row.kind, turn, row.figures))
            {
                fmt::print(stderr, "\r{:<70}\ropenstream_load: {}: {}\n", "", row.kind.name, row.figures.failure);
                return false;
            }
        }
    }
    fmt::print(stderr, "\r{:<70}\r", "");
    return true;
}

int Run(const Options& options)
{
    if (options.bRealTime)
    {
        // All threads are started later and inherit it.
        for (const std::string& refusal : OpenStreamAsio::TuneThread(OpenStreamAsio::RealTimeOptions::MakeAll()))
        {
            fmt::print("{}\n", refusal);
        }
    }
    std::vector<Row> rows = MakeRows(options);
    StallWatch watch;
    if (!TryMeasure(options, rows))
    {
        return 1;
    }
    const std::vector<StallWatch::Stall> stalls = watch.Stop();
    bool bWell = true;
    PrintHeader();
    std::ranges::for_each(rows, [&stalls](const Row& row) { PrintRow(row, stalls); });
    fmt::print("\n");
    if (options.bSoak)
    {
        bWell = WasMemoryKept(rows.front().figures, stalls);
    }
    else
    {
        const GapFigures bare = rows.front().figures.frames.Evaluate(stalls);
        PrintBounds(rows[1], bare, stalls);
        PrintBounds(rows[2], bare, stalls);
        PrintMost(
            rows[3].kind.name + ": server, of a core",
            GetCoreShare(rows[3].figures.serverTime, rows[3].figures.elapsed),
            100.0,
            "%");
    }
    fmt::print("the machine stood still {} times by its own doing\n", stalls.size());
    for (const Row& row : rows)
    {
        bWell = WasEverythingAccountedFor(row) && bWell;
    }
    return bWell ? 0 : 1;
}

} // namespace

} // namespace ACS::Load

int main(int argc, char** argv)
{
    using namespace ACS; // NOLINT(google-build-using-namespace)
    return Apps::RunProgram("openstream_load", [argc, argv]() {
        Load::Options options;
        CLI::App app{
            "measures the Open Stream at 2 ms beside a bare timer loop; fails where a frame is lost",
            "openstream_load"};
        app.add_option("--seconds", options.seconds, "how long each kind of traffic runs, in all")
            ->check(CLI::Range(1, 100'000))
            ->capture_default_str();
        CLI::Option* const sessions =
            app.add_option("--sessions", options.sessions, "how many at once make the crowd of the last row")
                ->check(CLI::Range(std::size_t{1}, Load::MOST_SESSIONS))
                ->capture_default_str();
        app.add_flag(
               "--soak",
               options.bSoak,
               "8 sessions with MONITOR and CONTROL on one connection each, without a turn in between")
            ->excludes(sessions);
        app.add_flag(
            "--realtime",
            options.bRealTime,
            "asks the system for a real-time priority, precise timers and locked memory, for the bare loop as well");
        const std::optional<int> exitCode = Apps::ParseCommandLineOrNull(app, argc, argv);
        return exitCode.has_value() ? *exitCode : Load::Run(options);
    });
}
