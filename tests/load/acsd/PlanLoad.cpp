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

// The time from an ExecutionPlan to its Ack, compared with a plain commit, and the gain of a burst.

namespace ACS::Load
{

namespace
{

using Milliseconds = std::chrono::duration<double, std::milli>;
using Seconds = std::chrono::duration<double>;

constexpr double ACK_BOUND = 3.0;     ///< p99, relative to that of the bare commit.
constexpr double STORE_BOUND = 15.0;  ///< Plans per second in one commit, relative to one commit each.
constexpr double BURST_BOUND = 3.0;   ///< Plans per second from end to end in a burst, relative to one after the other.
constexpr std::size_t TOGETHER = 100; ///< Plans of one commit, in the store alone.

struct Options
{
    std::size_t plans = 500;
};

struct Metrics
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

/// Alternates a plan in acsd and a bare commit of its bytes, so that both have the same disk.
void MeasureAcks(PlanSender& sender, BareCommit& bare, std::size_t plans, Metrics& metrics)
{
    for (std::size_t i = 0; i < plans; ++i)
    {
        metrics.acks.push_back(Milliseconds(sender.Send(1)).count());
        std::string text;
        Protocol::AcsCodec::EncodeRequest({"transaction", {}, MakePlan(i)}, text);
        metrics.bare.push_back(Milliseconds(Time([&]() { bare.Commit(text); })).count());
    }
    std::ranges::sort(metrics.acks);
    std::ranges::sort(metrics.bare);
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

/// Plans per second with this number of plans in a commit.
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

void PrintMetrics(const Options& options, const Metrics& metrics)
{
    const double ackP99 = GetQuantile(metrics.acks, 0.99);
    const double bareP99 = GetQuantile(metrics.bare, 0.99);
    const double each = 1000.0 * static_cast<double>(metrics.acks.size())
        / std::accumulate(metrics.acks.begin(), metrics.acks.end(), 0.0);
    fmt::print("acsd, {} plans\n", options.plans);
    PrintValue(
        "a bare commit of a plan's bytes",
        fmt::format("p50 {:.3f} ms, p99 {:.3f} ms", GetQuantile(metrics.bare, 0.5), bareP99));
    PrintBound(
        "ExecutionPlan to Ack",
        fmt::format(
            "p50 {:.3f} ms, p99 {:.3f} ms: {:.2f} times",
            GetQuantile(metrics.acks, 0.5),
            ackP99,
            ackP99 / bareP99),
        ackP99 <= ACK_BOUND * bareP99,
        fmt::format("{} times the bare commit's p99", ACK_BOUND));
    PrintBound(
        "plans accepted in a burst",
        fmt::format("{:.0f} a second: {:.1f} times {:.0f}", metrics.burst, metrics.burst / each, each),
        metrics.burst >= BURST_BOUND * each,
        fmt::format("{} times one after the other, or more", BURST_BOUND));
    PrintBound(
        fmt::format("the store, {} plans a commit", TOGETHER),
        fmt::format(
            "{:.0f} a second: {:.1f} times {:.0f}",
            metrics.storeTogether,
            metrics.storeTogether / metrics.storeEach,
            metrics.storeEach),
        metrics.storeTogether >= STORE_BOUND * metrics.storeEach,
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
        "mqtt.url=mqtt://127.0.0.1:1", // no broker: plans are accepted and wait
        "--set",
        fmt::format("store.directory={}", (folder.GetPath() / "acsd").string()),
        "--set",
        "http.listen=127.0.0.1:0",
        "--set",
        "operator.listen=127.0.0.1:0",
        "--set",
        fmt::format("queue.max_plans={}", 2 * options.plans)});
    if (!acsd.TryWaitForText("ready:", std::chrono::seconds(30)))
    {
        throw std::runtime_error("acsd did not start: " + acsd.GetText());
    }
    sender.WaitForACS();

    Metrics metrics;
    BareCommit bare((folder.GetPath() / "bare.db").string());
    MeasureAcks(sender, bare, options.plans, metrics);
    metrics.burst = static_cast<double>(options.plans) / Seconds(sender.Send(options.plans)).count();
    const auto store = Planning::SqlitePlanStore::Open((folder.GetPath() / "store").string());
    if (!store)
    {
        throw std::runtime_error(Core::Describe(store.error()));
    }
    std::uint64_t sequence = 0;
    metrics.storeEach = MeasureStore(**store, sequence, options.plans, 1);
    metrics.storeTogether = MeasureStore(**store, sequence, 10 * TOGETHER, TOGETHER);
    PrintMetrics(options, metrics);
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
            "Measures the time of acsd to accept a plan, compared with a bare commit of its bytes on the same disk; fails if a "
            "plan is refused",
            "acsd_load"};
        app.add_option("--plans", options.plans, "Number of plans sent one after the other, and again in a burst")
            ->check(CLI::Range(1, 100'000))
            ->capture_default_str();
        const std::optional<int> exitCode = Apps::ParseCommandLineOrNull(app, argc, argv);
        return exitCode.has_value() ? *exitCode : Load::Run(options);
    });
}
