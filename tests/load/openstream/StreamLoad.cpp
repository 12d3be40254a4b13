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
constexpr double MONITOR_BOUND = 1.2; ///< p50 and p99 of |gap - period|, relative to the bare loop.
constexpr double CONTROL_BOUND = 1.5;
constexpr double RESOLUTION = 0.001; ///< ms: smaller differences are not measurable.
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
    StreamMetrics metrics;
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

std::string DescribeGaps(const GapMetrics& gaps)
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
    const StreamMetrics& metrics = row.metrics;
    fmt::print(
        "{:<30}{:>9} {:>8} {:>5}  {} {:>6.1f}% {:>6.1f}%\n",
        row.kind.name,
        metrics.framesReceived,
        metrics.ticksSkipped,
        metrics.framesSent - metrics.framesReceived,
        DescribeGaps(metrics.frames.Evaluate(stalls)),
        GetCoreShare(metrics.serverTime, metrics.elapsed),
        GetCoreShare(metrics.clientTime, metrics.elapsed));
    if (row.kind.bControls)
    {
        fmt::print(
            "{:<30}{:>9} {:>8} {:>5}  {}\n",
            "  its CONTROLs",
            metrics.controlsServed,
            metrics.controlsHeldBack,
            metrics.controlsSent - metrics.controlsServed,
            DescribeGaps(metrics.controls.Evaluate(stalls)));
    }
}

void PrintMost(const std::string& what, double value, double bound, const char* unit)
{
    PrintBound(what, fmt::format("{:.3f}{}", value, unit), value <= bound, fmt::format("{}{}", bound, unit));
}

/// Ratios to the bare loop of the same run.
void PrintBounds(const Row& row, const GapMetrics& bare, const std::vector<StallWatch::Stall>& stalls)
{
    const GapMetrics gaps = row.metrics.frames.Evaluate(stalls);
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

/// Conditions that hold however busy the machine is; true if they do.
bool WasEverythingAccountedFor(const Row& row)
{
    const StreamMetrics& metrics = row.metrics;
    const auto seen = static_cast<std::int64_t>(metrics.framesAtPeriod + metrics.framesReplaced + metrics.ticksSkipped);
    const bool bWell = metrics.framesSent == metrics.framesReceived && metrics.periods == seen
        && metrics.controlsSent == metrics.controlsServed && metrics.linesRefused == 0;
    if (!bWell)
    {
        fmt::print(
            "{}: NOT ACCOUNTED FOR: {} frames sent, {} received; {} periods, {} with a frame, replaced or skipped; {} CONTROLs "
            "sent, {} served; {} lines refused {}\n",
            row.kind.name,
            metrics.framesSent,
            metrics.framesReceived,
            metrics.periods,
            seen,
            metrics.controlsSent,
            metrics.controlsServed,
            metrics.linesRefused,
            metrics.firstRefusal);
    }
    return bWell;
}

/// Both ends and the allocator have allocated what they need soon after the beginning.
bool WasMemoryKept(const StreamMetrics& metrics, const std::vector<StallWatch::Stall>& stalls)
{
    const std::uint64_t after =
        metrics.residentAfter - std::min(metrics.residentAfter, stalls.size() * sizeof(StallWatch::Stall));
    const bool bKept = after <= metrics.residentBefore + MOST_GROWTH;
    PrintBound(
        "resident memory without the run's own lists",
        fmt::format("{} KiB at the beginning, {} KiB at the end", metrics.residentBefore / 1024U, after / 1024U),
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

/// Runs the kinds in turns, so that all have the same machine. False if a run was abandoned.
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
                RunBareTurn(turn, row.metrics);
            }
            else if (!TryRunServedTurn(row.kind, turn, row.metrics))
            {
                fmt::print(stderr, "\r{:<70}\ropenstream_load: {}: {}\n", "", row.kind.name, row.metrics.failure);
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
        bWell = WasMemoryKept(rows.front().metrics, stalls);
    }
    else
    {
        const GapMetrics bare = rows.front().metrics.frames.Evaluate(stalls);
        PrintBounds(rows[1], bare, stalls);
        PrintBounds(rows[2], bare, stalls);
        PrintMost(
            rows[3].kind.name + ": server, of a core",
            GetCoreShare(rows[3].metrics.serverTime, rows[3].metrics.elapsed),
            100.0,
            "%");
    }
    fmt::print("the machine stalled {} times by itself\n", stalls.size());
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
            "Measures the Open Stream at 2 ms compared with a bare timer loop; fails if a frame is lost",
            "openstream_load"};
        app.add_option("--seconds", options.seconds, "Total time of each kind of traffic in seconds")
            ->check(CLI::Range(1, 100'000))
            ->capture_default_str();
        CLI::Option* const sessions =
            app.add_option("--sessions", options.sessions, "Number of sessions at a time in the last row")
                ->check(CLI::Range(std::size_t{1}, Load::MOST_SESSIONS))
                ->capture_default_str();
        app.add_flag(
               "--soak",
               options.bSoak,
               "Run only 8 sessions with MONITOR and CONTROL on one connection each, in a single run")
            ->excludes(sessions);
        app.add_flag(
            "--realtime",
            options.bRealTime,
            "Use a real-time priority, precise timers and locked memory, for the bare loop as well");
        const std::optional<int> exitCode = Apps::ParseCommandLineOrNull(app, argc, argv);
        return exitCode.has_value() ? *exitCode : Load::Run(options);
    });
}
