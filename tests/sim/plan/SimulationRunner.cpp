#include "SimulationRunner.hpp"

#include "World.hpp"

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <mutex>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

namespace ACS::Simulation
{

namespace
{

double GetSecondsSince(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

} // namespace

SimulationRunner::SimulationRunner(const SimulationOptions& options)
    : _options(options)
{
}

int SimulationRunner::Run() const
{
    if (_options.bListMutations)
    {
        for (const MutationText& text : MUTATION_TEXTS)
        {
            fmt::print("{:24}{}\n", text.name, text.meaning);
        }
        return 0;
    }
    if (_options.bAllMutations)
    {
        return RunMutations();
    }
    if (_options.seedOrNull.has_value())
    {
        return RunSeed(*_options.seedOrNull);
    }
    const auto start = std::chrono::steady_clock::now();
    const Tally tally = RunWorlds(_options.mutation, isatty(STDOUT_FILENO) != 0);
    fmt::print(
        "{} runs, {:.1f} simulated hours, {} starts of acsd, {:.1f} s\n",
        tally.worlds,
        tally.simulatedHours,
        tally.starts,
        GetSecondsSince(start));
    if (!tally.failureOrNull.has_value())
    {
        return 0;
    }
    fmt::print("seed {}: {}\n", tally.failureOrNull->seed, tally.failureOrNull->violation);
    fmt::print("replay: {}\n", DescribeReplay(_options.mutation, tally.failureOrNull->seed));
    return 1;
}

std::string SimulationRunner::DescribeReplay(EMutation mutation, std::uint64_t seed) const
{
    std::string text = fmt::format("plan_simulation --seed {} --trace", seed);
    for (std::size_t fault = 0; fault < FAULT_COUNT; ++fault)
    {
        text += _options.without.test(fault) ? fmt::format(" --without {}", FAULT_NAMES[fault]) : "";
    }
    const ScenarioDemands demands = MakeDemands(mutation);
    if (demands.robots.has_value())
    {
        text += fmt::format(" --robots {}", GetText(*demands.robots));
    }
    text += demands.bShared.has_value() ? " --shared" : "";
    if (mutation != EMutation::None)
    {
        text += fmt::format(" --mutation {}", MUTATION_TEXTS[static_cast<std::size_t>(mutation)].name);
    }
    return text;
}

ScenarioDemands SimulationRunner::MakeDemands(EMutation mutation) const
{
    const MutationText& text = MUTATION_TEXTS[static_cast<std::size_t>(mutation)];
    ScenarioDemands demands{_options.without, _options.robots, {}};
    if (text.bOfArms && !_options.robots.has_value())
    {
        demands.robots = ERobotKind::Arms;
    }
    if (_options.bShared || text.bOfLease)
    {
        demands.bShared = true;
    }
    return demands;
}

int SimulationRunner::RunSeed(std::uint64_t seed) const
{
    World world(MakeScenario(seed, MakeDemands(_options.mutation)), _options.mutation, _options.bTrace);
    const std::vector<std::string> violations = world.Run();
    for (const std::string& violation : violations)
    {
        fmt::print("seed {}: {}\n", seed, violation);
    }
    return violations.empty() ? 0 : 1;
}

SimulationRunner::Tally SimulationRunner::RunWorlds(EMutation mutation, bool bProgress) const
{
    Tally tally;
    std::mutex mutex;
    std::atomic<std::uint64_t> next = _options.first;
    const std::uint64_t end = _options.first + _options.seeds;
    const auto work = [&] {
        for (std::uint64_t seed = next++; seed < end; seed = next++)
        {
            World world(MakeScenario(seed, MakeDemands(mutation)), mutation, false);
            const std::vector<std::string> violations = world.Run();
            const std::lock_guard lock(mutex);
            ++tally.worlds;
            tally.starts += world.GetStarts();
            tally.simulatedHours += std::chrono::duration<double, std::ratio<3600>>(world.GetAge()).count();
            if (!violations.empty())
            {
                if (!_options.bKeepsGoing)
                {
                    next = end;
                }
                else
                {
                    fmt::print("seed {}: {}\n", seed, violations.front());
                }
                if (!tally.failureOrNull.has_value() || seed < tally.failureOrNull->seed)
                {
                    tally.failureOrNull = Failure{seed, violations.front()};
                }
            }
            if (bProgress)
            {
                fmt::print("\r{} of {} runs", tally.worlds, _options.seeds);
                std::fflush(stdout);
            }
        }
    };
    std::vector<std::thread> threads;
    for (std::size_t worker = 1; worker < _options.workers; ++worker)
    {
        threads.emplace_back(work);
    }
    work();
    for (std::thread& thread : threads)
    {
        thread.join();
    }
    if (bProgress)
    {
        fmt::print("\r");
    }
    return tally;
}

int SimulationRunner::RunMutations() const
{
    const Tally intact = RunWorlds(EMutation::None, false);
    if (intact.failureOrNull.has_value())
    {
        fmt::print("without a mutation seed {}: {}\n", intact.failureOrNull->seed, intact.failureOrNull->violation);
        return 1; // a seed that fails without the mutation proves nothing
    }
    std::size_t missed = 0;
    for (std::size_t index = 1; index < MUTATION_COUNT; ++index)
    {
        const auto mutation = static_cast<EMutation>(index);
        const auto start = std::chrono::steady_clock::now();
        const Tally tally = RunWorlds(mutation, false);
        const bool bCaught = tally.failureOrNull.has_value();
        missed += bCaught ? 0U : 1U;
        fmt::print(
            "{:24}{} {:5.1f} s\n",
            MUTATION_TEXTS[index].name,
            bCaught ? fmt::format("seed {}: {}", tally.failureOrNull->seed, tally.failureOrNull->violation)
                    : fmt::format("NOT CAUGHT within {} seeds", tally.worlds),
            GetSecondsSince(start));
        std::fflush(stdout);
    }
    return missed == 0 ? 0 : 1;
}

} // namespace ACS::Simulation
