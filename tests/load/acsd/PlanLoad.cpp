#include "BareCommit.hpp"
#include "BoundLine.hpp"
#include "ChildProcess.hpp"
#include "common/config/CommandLine.hpp"
#include "PlanSender.hpp"
#include "TemporaryFolder.hpp"
#include <acs/plan_sqlite/SqlitePlanStore.hpp>
#include <acs/protocol/AcsCodec.hpp>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

// What stands between an ExecutionPlan and its Ack, beside the least that a disk needs; and what a burst saves.

namespace ACS::Load
{

namespace
{

using Milliseconds = std::chrono::duration<double, std::milli>;
using Seconds = std::chrono::duration<double>;

constexpr double ACK_BOUND = 3.0;     ///< p99, times the bare commit's.
constexpr double STORE_BOUND = 15.0;  ///< Plans per second in one commit, times one commit for each.
constexpr double BURST_BOUND = 3.0;   ///< Plans per second from end to end, in a burst, times one after the other.
constexpr std::size_t TOGETHER = 100; ///< Plans of one commit, in the store alone.

struct Options
{
    std::size_t plans = 500;
};

struct Figures
{
    std::vector<double> acks; ///< ms, sorted.
    std::vector<double> bare;
    double burst = 0.0; ///< Plans per second.
    double storeEach = 0.0;
    double storeTogether = 0.0;
};

double GetQuantile(const std::vector<double>& sorted, double share)
{
    return sorted[static_cast<std::size_t>(std::floor(share * static_cast<double>(sorted.size() - 1)))];
}

Seconds Time(const std::function<void()>& work)
{
    const auto begin = std::chrono::steady_clock::now();
    work();
    return std::chrono::steady_clock::now() - begin;
}

/// One plan in acsd, one bare commit of its bytes, in turns, so that both meet the same disk.
void MeasureAcks(PlanSender& sender, BareCommit& bare, std::size_t plans, Figures& figures)
{
    for (std::size_t i = 0; i < plans; ++i)
    {
        figures.acks.push_back(Milliseconds(sender.Send(1)).count());
        std::string text;
        Protocol::AcsCodec::EncodeRequest({"transaction", {}, MakePlan(i)}, text);
        figures.bare.push_back(Milliseconds(Time([&]() { bare.Commit(text); })).count());
    }
    std::ranges::sort(figures.acks);
    std::ranges::sort(figures.bare);
}

Planning::PlanAdded MakeAdded(std::uint64_t sequence)
{
    const Protocol::ExecutionPlan plan = MakePlan(sequence);
    Planning::PlanAdded added;
    added.record.sequence = sequence;
    added.record.plan.planID = plan.planID;
    for (const Protocol::PlanStep& step : plan.steps)
    {
        const Protocol::PlanJob& job = step.jobs.front();
        added.record.plan.steps.push_back(
            {step.stepNo, step.action, step.position, step.carrierIDs, {{job.jobID, job.from, job.to}}});
        added.record.progress.steps.push_back({Planning::EStepState::Pending, {Planning::EJobState::Pending}});
    }
    return added;
}

/// Plans per second with so many in a commit.
double MeasureStore(Planning::IPlanStore& store, std::uint64_t& sequence, std::size_t plans, std::size_t together)
{
    const Seconds time = Time([&]() {
        for (std::size_t done = 0; done < plans; done += together)
        {
            Planning::StoreBatch batch;
            for (std::size_t i = 0; i < together; ++i)
            {
                batch.changes.emplace_back(MakeAdded(++sequence));
            }
            if (const Core::Result<void> stored = store.Append(batch); !stored)
            {
                throw std::runtime_error(Core::Describe(stored.error()));
            }
        }
    });
    return static_cast<double>(plans) / time.count();
}

void PrintFigures(const Options& options, const Figures& figures)
{
    const double ackP99 = GetQuantile(figures.acks, 0.99);
    const double bareP99 = GetQuantile(figures.bare, 0.99);
    const double each = 1000.0 * static_cast<double>(figures.acks.size())
        / std::accumulate(figures.acks.begin(), figures.acks.end(), 0.0);
    fmt::print("acsd, {} plans\n", options.plans);
    PrintFigure(
        "a bare commit of a plan's bytes",
        fmt::format("p50 {:.3f} ms, p99 {:.3f} ms", GetQuantile(figures.bare, 0.5), bareP99));
    PrintBound(
        "ExecutionPlan to Ack",
        fmt::format(
            "p50 {:.3f} ms, p99 {:.3f} ms: {:.2f} times",
            GetQuantile(figures.acks, 0.5),
            ackP99,
            ackP99 / bareP99),
        ackP99 <= ACK_BOUND * bareP99,
        fmt::format("{} times the bare commit's p99", ACK_BOUND));
    PrintBound(
        "plans accepted in a burst",
        fmt::format("{:.0f} a second: {:.1f} times {:.0f}", figures.burst, figures.burst / each, each),
        figures.burst >= BURST_BOUND * each,
        fmt::format("{} times one after the other, or more", BURST_BOUND));
    PrintBound(
        fmt::format("the store, {} plans a commit", TOGETHER),
        fmt::format(
            "{:.0f} a second: {:.1f} times {:.0f}",
            figures.storeTogether,
            figures.storeTogether / figures.storeEach,
            figures.storeEach),
        figures.storeTogether >= STORE_BOUND * figures.storeEach,
        fmt::format("{} times a commit each, or more", STORE_BOUND));
}

int Run(const Options& options)
{
    const Testing::TemporaryFolder folder;
    boost::asio::io_context context(1);
    PlanSender sender(context);
    Testing::ChildProcess acsd(std::vector<std::string>{
        ACS_ACSD,
        "--config",
        ACS_CONFIG,
        "--log-level",
        "error",
        "--set",
        fmt::format("mcs.url=ws://127.0.0.1:{}/acs/", sender.GetPort()),
        "--set",
        "mqtt.url=mqtt://127.0.0.1:1", // nobody: plans are taken, and wait
        "--set",
        fmt::format("store.directory={}", (folder.GetPath() / "acsd").string()),
        "--set",
        "http.listen=127.0.0.1:0",
        "--set",
        fmt::format("queue.max_plans={}", 2 * options.plans)});
    if (!acsd.TryWaitForText("ready:", std::chrono::seconds(30)))
    {
        throw std::runtime_error("acsd does not start: " + acsd.GetText());
    }
    sender.WaitForACS();

    Figures figures;
    BareCommit bare((folder.GetPath() / "bare.db").string());
    MeasureAcks(sender, bare, options.plans, figures);
    figures.burst = static_cast<double>(options.plans) / Seconds(sender.Send(options.plans)).count();
    const auto store = Planning::SqlitePlanStore::Open((folder.GetPath() / "store").string());
    if (!store)
    {
        throw std::runtime_error(Core::Describe(store.error()));
    }
    std::uint64_t sequence = 0;
    figures.storeEach = MeasureStore(**store, sequence, options.plans, 1);
    figures.storeTogether = MeasureStore(**store, sequence, 10 * TOGETHER, TOGETHER);
    PrintFigures(options, figures);
    if (sender.GetAccepted() != 2 * options.plans)
    {
        fmt::print("{} of {} plans accepted: {}\n", sender.GetAccepted(), 2 * options.plans, sender.GetFirstRefusal());
        return 1;
    }
    return 0;
}

} // namespace

} // namespace ACS::Load

int main(int argc, char** argv)
{
    using namespace ACS; // NOLINT(google-build-using-namespace)
    return Apps::RunProgram("acsd_load", [argc, argv]() {
        Load::Options options;
        CLI::App app{
            "measures what acsd needs to take a plan, beside a bare commit of its bytes on the same disk; fails where a "
            "plan is refused",
            "acsd_load"};
        app.add_option("--plans", options.plans, "how many are sent one after the other, and as many again at once")
            ->check(CLI::Range(1, 100'000))
            ->capture_default_str();
        const std::optional<int> exitCode = Apps::ParseCommandLineOrNull(app, argc, argv);
        return exitCode.has_value() ? *exitCode : Load::Run(options);
    });
}
