#include <acs/core/IRandom.hpp>
#include <acs/core/Overloaded.hpp>
#include <acs/plan/MemoryPlanStore.hpp>
#include <acs/plan/PlanEngine.hpp>
#include <acs/plan/Router.hpp>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#ifdef ACS_BENCH_SQLITE
#include <acs/plan_sqlite/SqlitePlanStore.hpp>

#include <filesystem>
#endif

namespace ACS::Planning
{

namespace
{

class CountingRandom final : public Core::IRandom
{
    std::uint64_t _next = 0;

public:
    [[nodiscard]] std::uint64_t GetNext() override
    {
        _next += 0x9E3779B97F4A7C15U;
        return _next * (_next | 1U);
    }
};

constexpr int DOCKS = 20; ///< Of each robot's ring.

std::string MakeRobotID(int robot)
{
    return fmt::format("LR{:03}", robot);
}

/// A ring of docks for each robot, which executes every command at once.
SiteMap MakeRings(int robots)
{
    std::vector<SiteNode> nodes;
    std::vector<SiteEdge> edges;
    std::vector<SiteStation> stations;
    SiteEdgeRule rule;
    rule.vehicleTypeID = "lr";
    for (int i = 0; i < robots * DOCKS; ++i)
    {
        const int ring = i / DOCKS;
        const int dock = i % DOCKS;
        const std::string nodeID = fmt::format("N{}-{:02}", ring + 1, dock);
        const std::string nextID = fmt::format("N{}-{:02}", ring + 1, (dock + 1) % DOCKS);
        nodes.push_back({nodeID, static_cast<double>(dock), static_cast<double>(ring), "", {{"lr", std::nullopt}}});
        edges.push_back({nodeID + nextID, nodeID, nextID, {rule}});
        stations.push_back({fmt::format("A{:02}.CP{:02}", ring + 1, dock + 1), {nodeID}});
    }
    return *SiteMap::Create(std::move(nodes), std::move(edges), std::move(stations));
}

EngineOptions MakeOptions(int robots, bool bHomes)
{
    EngineOptions options;
    for (int robot = 1; robot <= robots; ++robot)
    {
        const std::string robotID = MakeRobotID(robot);
        options.robots.push_back(
            {*Core::RobotID::Parse(robotID),
             ERobotType::LR,
             "lr",
             fmt::format("N{}-00", robot),
             bHomes ? std::optional(fmt::format("A{:02}.CP01", robot)) : std::nullopt,
             *Core::ParseLocationRange(robotID + ".CP01"),
             {},
             {}});
    }
    options.finishedPlansKept = 10;
    options.maximumPlans = 2 * static_cast<std::size_t>(robots);
    return options;
}

/// A dock in the ring of this robot.
Plan MakePlan(std::uint64_t number, int robot)
{
    const std::string from = fmt::format("A{:02}.CP05", robot);
    const std::string to = fmt::format("A{:02}.CP15", robot);
    return {
        fmt::format("P{}", number),
        "",
        std::nullopt,
        {{1, "CassetteLoad", from, {"C"}, {{"J1", from, "AMR.CP01"}}},
         {2, "CassetteUnload", to, {"C"}, {{"J2", "AMR.CP01", to}}}}};
}

/// A fleet that answers in the order of the commands, and an MCS that acknowledges each report.
class BenchFleet
{
    struct ObeyedDrive
    {
        Drive drive;
        std::size_t passed = 0; ///< Nodes.
    };

    PlanEngine& _engine;
    std::map<std::string, ObeyedDrive> _drives; ///< By robot: the latest.
    EngineActions _actions;
    std::deque<std::pair<std::string, RobotEvent>> _events;
    std::vector<std::uint64_t> _reported;

public:
    explicit BenchFleet(PlanEngine& engine)
        : _engine(engine)
    {
    }

    void Connect(int robots)
    {
        for (int robot = 1; robot <= robots; ++robot)
        {
            StateChanged place;
            place.lastNodeID = fmt::format("N{}-00", robot);
            _events.emplace_back(MakeRobotID(robot), LinkChanged{true});
            _events.emplace_back(MakeRobotID(robot), place);
        }
        static_cast<void>(Run());
    }

    void Submit(Plan plan, std::uint64_t number)
    {
        _engine.Handle(SubmitPlan{std::move(plan), number}, {}, _actions);
        Answer();
    }

    /// Runs until no event is left; returns the number of the robots' events.
    std::int64_t Run()
    {
        _engine.OnTimer({EEngineTimer::Dispatch, {}}, {}, _actions);
        Answer();
        std::int64_t count = 0;
        while (!_events.empty())
        {
            const auto [robotID, event] = std::move(_events.front());
            _events.pop_front();
            _engine.Handle(robotID, event, {}, _actions);
            Answer();
            ++count;
        }
        return count;
    }

private:
    void Answer()
    {
        if (_engine.IsStoring())
        {
            _engine.OnStored({}, {}, _actions);
        }
        for (const EngineAction& action : std::exchange(_actions, {}))
        {
            if (const auto* const reportOrNull = std::get_if<SendReport>(&action); reportOrNull != nullptr)
            {
                _reported.push_back(reportOrNull->entry.sequence);
            }
            else if (const auto* const commandOrNull = std::get_if<CommandRobot>(&action); commandOrNull != nullptr)
            {
                Obey(*commandOrNull);
            }
        }
        for (const std::uint64_t sequence : std::exchange(_reported, {}))
        {
            _engine.Handle(MessageAcknowledged{sequence}, {}, _actions);
            if (_engine.IsStoring())
            {
                _engine.OnStored({}, {}, _actions);
            }
        }
        _actions.clear(); // of the acknowledgements: a timer at most
    }

    void Obey(const CommandRobot& command)
    {
        if (const auto* const driveOrNull = std::get_if<Drive>(&command.command); driveOrNull != nullptr)
        {
            _drives[command.robotID] = ObeyedDrive{*driveOrNull, 0};
            Pass(command.robotID, driveOrNull->releasedCount);
        }
        if (const auto* const moreOrNull = std::get_if<ExtendDrive>(&command.command); moreOrNull != nullptr)
        {
            Pass(command.robotID, moreOrNull->releasedCount);
        }
        if (const auto* const jobOrNull = std::get_if<StartJob>(&command.command); jobOrNull != nullptr)
        {
            _events.emplace_back(command.robotID, JobStarted{jobOrNull->jobID});
            _events.emplace_back(command.robotID, JobFinished{jobOrNull->jobID});
        }
    }

    /// Drives to the end of the base.
    void Pass(const std::string& robotID, std::size_t releasedCount)
    {
        ObeyedDrive& obeyed = _drives.at(robotID);
        const std::vector<RouteNode>& nodes = obeyed.drive.route.nodes;
        for (; obeyed.passed < releasedCount; ++obeyed.passed)
        {
            _events.emplace_back(robotID, NodePassed{obeyed.drive.driveID, nodes[obeyed.passed].nodeID});
        }
        if (obeyed.passed == nodes.size())
        {
            _events.emplace_back(robotID, Arrived{obeyed.drive.driveID});
        }
    }
};

/// Events of robots per second, with the engine in memory: a plan for each robot from submission to completion. The
/// cost of an event should not depend on the number of robots.
void BenchEngineEvents(benchmark::State& state)
{
    const auto robots = static_cast<int>(state.range(0));
    CountingRandom random;
    PlanEngine engine(MakeOptions(robots, state.range(1) != 0), MakeRings(robots), random);
    BenchFleet fleet(engine);
    fleet.Connect(robots);
    std::uint64_t plans = 0;
    std::int64_t count = 0;
    for (auto iteration : state)
    {
        static_cast<void>(iteration);
        for (int robot = 1; robot <= robots; ++robot)
        {
            ++plans;
            fleet.Submit(MakePlan(plans, robot), plans);
        }
        count += fleet.Run();
        if (!engine.GetActivePlans().empty())
        {
            state.SkipWithError("a plan does not end");
            break;
        }
    }
    state.SetItemsProcessed(count);
}
BENCHMARK(BenchEngineEvents)
    ->ArgNames({"robots", "homes"})
    ->Args({1, 0})
    ->Args({10, 0})
    ->Args({100, 0})
    ->Args({10, 1})
    ->Args({100, 1});

/// A route over a grid of 2,000 nodes; the argument is the number of columns that it crosses.
void BenchRoute(benchmark::State& state)
{
    constexpr int COLUMNS = 50;
    constexpr int ROWS = 40;
    const auto getNodeID = [](int column, int row) {
        return fmt::format("N{}", row * COLUMNS + column);
    };
    std::vector<SiteNode> nodes;
    std::vector<SiteEdge> edges;
    SiteEdgeRule rule;
    rule.vehicleTypeID = "lr";
    const auto join = [&edges, &rule](const std::string& from, const std::string& to) {
        edges.push_back({from + ">" + to, from, to, {rule}});
        edges.push_back({to + ">" + from, to, from, {rule}});
    };
    for (int i = 0; i < ROWS * COLUMNS; ++i)
    {
        const int row = i / COLUMNS;
        const int column = i % COLUMNS;
        nodes.push_back(
            {getNodeID(column, row),
             static_cast<double>(column),
             static_cast<double>(row),
             "",
             {{"lr", std::nullopt}}});
        if (column > 0)
        {
            join(getNodeID(column - 1, row), getNodeID(column, row));
        }
        if (row > 0)
        {
            join(getNodeID(column, row - 1), getNodeID(column, row));
        }
    }
    const SiteMap site = *SiteMap::Create(std::move(nodes), std::move(edges), {});
    const Router router(site);
    const std::string from = getNodeID(0, 0);
    const std::string to = getNodeID(static_cast<int>(state.range(0)), ROWS - 1);
    for (auto iteration : state)
    {
        static_cast<void>(iteration);
        benchmark::DoNotOptimize(router.FindRouteOrNull("lr", from, state.range(0) == 0 ? getNodeID(5, 5) : to));
    }
    state.counters["visited"] =
        benchmark::Counter(static_cast<double>(router.CountVisitedNodes()), benchmark::Counter::kAvgIterations);
}
BENCHMARK(BenchRoute)->ArgName("columns")->Arg(0)->Arg(25)->Arg(49);

#ifdef ACS_BENCH_SQLITE
/// One accepted plan on disk: the time between a plan and its Ack.
void BenchStoreCommit(benchmark::State& state)
{
    const std::filesystem::path directory = std::filesystem::temp_directory_path() / "acs-plan-bench";
    std::error_code ignored;
    std::filesystem::remove_all(directory, ignored);
    {
        const auto store = SqlitePlanStore::Open(directory.string());
        PlanRecord record;
        record.plan = MakePlan(0, 1);
        record.progress.steps = {
            {EStepState::Pending, {EJobState::Pending}},
            {EStepState::Pending, {EJobState::Pending}}};
        for (auto iteration : state)
        {
            static_cast<void>(iteration);
            ++record.sequence;
            record.plan.planID = fmt::format("P{}", record.sequence);
            if (!store.has_value() || !(*store)->Append({{PlanAdded{record}}}).has_value())
            {
                state.SkipWithError("the store failed");
                break;
            }
        }
    }
    std::filesystem::remove_all(directory, ignored);
}
BENCHMARK(BenchStoreCommit);
#endif

} // namespace

} // namespace ACS::Planning
