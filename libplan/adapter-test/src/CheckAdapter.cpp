#include "EngineSteps.hpp"
#include "Scenarios.hpp"
#include <acs/adapter_test/CheckAdapter.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::AdapterTest
{

namespace
{

using DisturbedSteps = void (*)(ScenarioRun& run, const Disturbance& disturbance);

/// Moments of a drive or job at which it is disturbed.
constexpr std::size_t MAXIMUM_POINTS = 24;
/// More findings of a point would only repeat what was found.
constexpr std::size_t ENOUGH_FINDINGS = 50;

class Suite
{
    IAdapterBench& _bench;
    const BenchOptions _options;
    ContractReport _report;

public:
    explicit Suite(IAdapterBench& bench)
        : _bench(bench),
          _options(bench.GetOptions())
    {
    }

    ContractReport Run()
    {
        if (!TryRunConnection())
        {
            return std::move(_report); // nothing else can be commanded
        }
        RunScenarios();
        RunDisturbances();
        return std::move(_report);
    }

private:
    bool TryRunConnection()
    {
        ScenarioRun run(_bench, _options, _report, "connection");
        if (!run.TryConnect())
        {
            return false;
        }
        VerifyAtRest(run);
        return true;
    }

    void RunScenarios()
    {
        std::vector<Scenario> scenarios;
        if (_options.bDrives)
        {
            AddDriveScenarios(scenarios);
        }
        else
        {
            _report.omitted.emplace_back("drives: the robot does not drive");
        }
        AddControlScenarios(scenarios);
        AddJobScenarios(scenarios);
        AddLinkScenarios(scenarios);
        AddRestartScenarios(scenarios);
        for (const Scenario& scenario : scenarios)
        {
            const bool bPossible = scenario.needed == nullptr || _options.*scenario.needed;
            if (!bPossible)
            {
                _report.omitted.push_back(fmt::format("{}: {}", scenario.name, scenario.reason));
                continue;
            }
            ScenarioRun run(_bench, _options, _report, scenario.name);
            if (run.TryConnect())
            {
                scenario.steps(run);
            }
        }
    }

    void RunDisturbances()
    {
        if (const std::vector<Core::Duration> points = FindPointsOfJob(); !points.empty())
        {
            const Core::Duration length = points.back();
            RunAtPoints("link lost {:.3f} s after StartJob for {:.3f} s", points, length, LoseLinkInJob);
            RunAtPoints("crash {:.3f} s after StartJob for {:.3f} s", points, length, CrashInJob);
        }
        if (const std::vector<Core::Duration> points = FindPointsOfDrive(); !points.empty())
        {
            const Core::Duration length = points.back();
            RunAtPoints("link lost {:.3f} s after Drive for {:.3f} s", points, length, LoseLinkInDrive);
            RunAtPoints("crash {:.3f} s after Drive for {:.3f} s", points, length, CrashInDrive);
        }
    }

    /// A short disturbance, and one that outlasts the drive or job.
    void RunAtPoints(
        std::string_view format,
        const std::vector<Core::Duration>& points,
        Core::Duration length,
        DisturbedSteps steps)
    {
        const std::array<Core::Duration, 2> durations{std::chrono::seconds(1), length + _options.answerLimit};
        for (const Core::Duration point : points)
        {
            for (const Core::Duration lasts : durations)
            {
                if (_report.findings.size() >= ENOUGH_FINDINGS)
                {
                    return;
                }
                const Disturbance disturbance{point, lasts};
                ScenarioRun run(
                    _bench,
                    _options,
                    _report,
                    fmt::format(fmt::runtime(format), ToSeconds(point), ToSeconds(lasts)));
                if (run.TryConnect())
                {
                    steps(run, disturbance);
                }
            }
        }
    }

    std::vector<Core::Duration> FindPointsOfJob()
    {
        ScenarioRun run(_bench, _options, _report, "job without a disturbance");
        if (!run.TryConnect())
        {
            return {};
        }
        const Core::SteadyTime begin = run.GetTime();
        run.Command(run.MakeJob(0));
        return TryAwaitJobEnd(run, ERule::JobAnswered) ? ListPoints(run, begin) : std::vector<Core::Duration>();
    }

    std::vector<Core::Duration> FindPointsOfDrive()
    {
        if (!_options.bDrives)
        {
            return {};
        }
        ScenarioRun run(_bench, _options, _report, "drive without a disturbance");
        if (!run.TryConnect())
        {
            return {};
        }
        const Core::SteadyTime begin = run.GetTime();
        return TryDriveToEnd(run, ERule::DriveAnswered) ? ListPoints(run, begin) : std::vector<Core::Duration>();
    }

    /// Immediately before and after each call of the adapter: a message is in transit, or was just received.
    static std::vector<Core::Duration> ListPoints(const ScenarioRun& run, Core::SteadyTime begin)
    {
        std::vector<Core::Duration> points{Core::Duration::zero()};
        for (const Core::SteadyTime time : run.ListCallTimes(begin))
        {
            points.push_back(time - begin - Core::Duration(1));
            points.push_back(time - begin);
        }
        if (points.size() <= MAXIMUM_POINTS)
        {
            return points;
        }
        std::vector<Core::Duration> chosen;
        for (std::size_t i = 0; i < MAXIMUM_POINTS; ++i)
        {
            chosen.push_back(points[i * (points.size() - 1) / (MAXIMUM_POINTS - 1)]);
        }
        return chosen;
    }

    static double ToSeconds(Core::Duration span)
    {
        return std::chrono::duration<double>(span).count();
    }
};

} // namespace

ContractReport CheckAdapter(IAdapterBench& bench)
{
    return Suite(bench).Run();
}

} // namespace ACS::AdapterTest
