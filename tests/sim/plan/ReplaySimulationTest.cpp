#include "AcsdProcess.hpp"
#include "Catch.hpp"
#include "replay/CoreRecord.hpp"
#include "replay/CoreReplay.hpp"
#include "World.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Simulation
{

namespace
{

using Recording = std::vector<Acsd::CoreRecord>;

/// The recordings of all starts of acsd in the run of a seed.
std::vector<Recording> Record(const Scenario& scenario, EMutation mutation)
{
    std::vector<Recording> recordings;
    World world(scenario, mutation, false, [&recordings](std::uint64_t start) {
        recordings.emplace_back();
        return [&recordings, start](const Acsd::CoreRecord& record) {
            recordings.at(start - 1).push_back(record);
        };
    });
    static_cast<void>(world.Run());
    return recordings;
}

Acsd::ReplayOutcome Replay(const Recording& recording, const Acsd::AcsdConfig& config)
{
    std::size_t next = 0;
    Acsd::CoreReplay replay(
        config,
        [&recording, &next] { return next < recording.size() ? std::optional(recording[next++]) : std::nullopt; },
        [&config](const std::string& /*text*/) { return config; });
    return replay.Run();
}

std::string Describe(const Acsd::ReplayOutcome& outcome)
{
    return outcome.differenceOrNull.has_value() ? fmt::format(
               "{}\nexpected {}\nactual   {}",
               outcome.differenceOrNull->input,
               outcome.differenceOrNull->expected,
               outcome.differenceOrNull->actual)
                                                : outcome.fault;
}

/// The first difference of all runs of the seeds with this mutation.
std::optional<Acsd::ReplayDifference> FindDifferenceOrNull(EMutation mutation)
{
    constexpr std::uint64_t SEEDS = 30;
    for (std::uint64_t seed = 1; seed <= SEEDS; ++seed)
    {
        const Scenario scenario = MakeScenario(seed, {});
        for (const Recording& recording : Record(scenario, mutation))
        {
            Acsd::ReplayOutcome outcome = Replay(recording, AcsdProcess::MakeConfig(scenario));
            if (outcome.differenceOrNull.has_value())
            {
                return outcome.differenceOrNull;
            }
        }
    }
    return std::nullopt;
}

} // namespace

TEST_CASE("A recorded run with faults of disk, links, robots and acsd replays to the same reports and commands")
{
    constexpr std::uint64_t SEEDS = 100;
    std::vector<std::uint64_t> seeds(SEEDS);
    std::iota(seeds.begin(), seeds.end(), 1);
    seeds.push_back(417); // acsd ends within an input that draws numbers
    seeds.push_back(775); // a later job check accepts what an earlier one rejected
    std::size_t reports = 0;
    std::size_t commands = 0;
    for (const std::uint64_t seed : seeds)
    {
        const Scenario scenario = MakeScenario(seed, {});
        for (const Recording& recording : Record(scenario, EMutation::None))
        {
            const Acsd::ReplayOutcome outcome = Replay(recording, AcsdProcess::MakeConfig(scenario));
            INFO("seed " << seed << ": " << Describe(outcome));
            REQUIRE_FALSE(outcome.differenceOrNull.has_value());
            REQUIRE(outcome.fault.empty());
            reports += outcome.reports;
            commands += outcome.commands;
        }
    }
    CHECK(reports > 1'000);
    CHECK(commands > 1'000);
}

TEST_CASE("A replay shows the first report that the present engine makes otherwise")
{
    const std::optional<Acsd::ReplayDifference> difference = FindDifferenceOrNull(EMutation::ResultInverted);
    REQUIRE(difference.has_value());
    CHECK(difference->expected.starts_with("report "));
    CHECK(difference->actual.starts_with("report "));
    CHECK(difference->expected != difference->actual);
    CHECK_FALSE(difference->input.empty());
}

TEST_CASE("A replay shows a command that the recorded run never gave")
{
    const Scenario scenario = MakeScenario(1, {});
    const std::vector<Recording> recordings = Record(scenario, EMutation::None);
    Acsd::AcsdConfig changed = AcsdProcess::MakeConfig(scenario);
    changed.engine.baseLength += 1;
    std::optional<Acsd::ReplayDifference> difference;
    for (const Recording& recording : recordings)
    {
        const Acsd::ReplayOutcome outcome = Replay(recording, changed);
        if (outcome.differenceOrNull.has_value())
        {
            difference = outcome.differenceOrNull;
            break;
        }
    }
    REQUIRE(difference.has_value());
    CHECK(difference->expected.find("Drive") != std::string::npos);
    CHECK(difference->actual.find("Drive") != std::string::npos);
}

TEST_CASE("A repeated end of a transaction is a fault of the recording, and never reaches the engine")
{
    constexpr std::size_t MOST_COPIES = 20;
    const Scenario scenario = MakeScenario(1, {});
    const Recording recording = Record(scenario, EMutation::None).front();
    const auto isOuterInput = [](const Acsd::CoreRecord& record) {
        return record.bInput && record.depth == 0;
    };
    std::size_t faults = 0;
    std::size_t copies = 0;
    for (auto stored = recording.begin(); stored != recording.end() && copies < MOST_COPIES; ++stored)
    {
        if (stored->kind != "stored" || !isOuterInput(*stored))
        {
            continue;
        }
        ++copies;
        Recording changed(recording.begin(), std::find_if(stored + 1, recording.end(), isOuterInput));
        changed.push_back(*stored);
        changed.back().place = "copy";
        const Acsd::ReplayOutcome outcome = Replay(changed, AcsdProcess::MakeConfig(scenario));
        faults += outcome.fault == "copy: the end of a transaction that has not begun" ? 1U : 0U;
    }
    CHECK(copies == MOST_COPIES);
    CHECK(faults > 0);
}

TEST_CASE("A replay shows a timer that did not expire in the recorded run")
{
    const std::optional<Acsd::ReplayDifference> difference = FindDifferenceOrNull(EMutation::TimerForgotten);
    REQUIRE(difference.has_value());
    CHECK(difference->expected.starts_with("no timer "));
}

} // namespace ACS::Simulation
