#include <acs/core/IRandom.hpp>
#include <acs/core/Overloaded.hpp>
#include <acs/plan/MemoryPlanStore.hpp>
#include <acs/plan/PlanEngine.hpp>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <deque>
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

/// A ring of docks with one robot, whose every command is obeyed at once.
SiteMap MakeRing()
{
    constexpr int DOCKS = 20;
    std::vector<SiteNode> nodes;
    std::vector<SiteEdge> edges;
    std::vector<SiteStation> stations;
    SiteEdgeRule rule;
    rule.vehicleTypeID = "lr";
    for (int i = 0; i < DOCKS; ++i)
    {
        const std::string nodeID = fmt::format("N{:02}", i);
        const std::string nextID = fmt::format("N{:02}", (i + 1) % DOCKS);
        nodes.push_back({nodeID, static_cast<double>(i), 0, "", {{"lr", std::nullopt}}});
        edges.push_back({nodeID + nextID, nodeID, nextID, {rule}});
        stations.push_back({fmt::format("A01.CP{:02}", i + 1), {nodeID}});
    }
    return *SiteMap::Create(std::move(nodes), std::move(edges), std::move(stations));
}

EngineOptions MakeOptions()
{
    EngineOptions options;
    options.robots.push_back(
        {*Core::RobotID::Parse("LR01"),
         ERobotType::LR,
         "lr",
         "N00",
         std::nullopt,
         *Core::ParseLocationRange("LR01.CP01"),
         {},
         {}});
    options.finishedPlansKept = 10;
    return options;
}

Plan MakePlan(std::uint64_t number)
{
    return {
        fmt::format("P{}", number),
        "",
        std::nullopt,
        {{1, "CassetteLoad", "A01.CP05", {"C"}, {{"J1", "A01.CP05", "AMR.CP01"}}},
         {2, "CassetteUnload", "A01.CP15", {"C"}, {{"J2", "AMR.CP01", "A01.CP15"}}}}};
}

/// What the robot says to the actions, in order.
void Answer(const EngineActions& actions, std::deque<RobotEvent>& events, std::vector<std::uint64_t>& acknowledged)
{
    for (const EngineAction& action : actions)
    {
        if (const auto* reportOrNull = std::get_if<SendReport>(&action); reportOrNull != nullptr)
        {
            acknowledged.push_back(reportOrNull->entry.sequence);
        }
        const auto* commandOrNull = std::get_if<CommandRobot>(&action);
        if (commandOrNull == nullptr)
        {
            continue;
        }
        if (const auto* driveOrNull = std::get_if<Drive>(&commandOrNull->command); driveOrNull != nullptr)
        {
            for (const RouteNode& node : driveOrNull->route.nodes)
            {
                events.emplace_back(NodePassed{driveOrNull->driveID, node.nodeID});
            }
            events.emplace_back(Arrived{driveOrNull->driveID});
        }
        if (const auto* jobOrNull = std::get_if<StartJob>(&commandOrNull->command); jobOrNull != nullptr)
        {
            events.emplace_back(JobStarted{jobOrNull->jobID});
            events.emplace_back(JobFinished{jobOrNull->jobID});
        }
    }
}

/// Events of a robot per second, with the engine in memory, whole plans from submission to completion.
void BenchEngineEvents(benchmark::State& state)
{
    CountingRandom random;
    PlanEngine engine(MakeOptions(), MakeRing(), random);
    const Core::Now now{};
    EngineActions actions;
    StateChanged place;
    place.lastNodeID = "N00";
    engine.Handle("LR01", LinkChanged{true}, now, actions);
    engine.Handle("LR01", place, now, actions);
    std::uint64_t plans = 0;
    std::int64_t count = 0;
    for (auto iteration : state)
    {
        static_cast<void>(iteration);
        std::deque<RobotEvent> events;
        std::vector<std::uint64_t> acknowledged;
        actions.clear();
        ++plans;
        engine.Handle(SubmitPlan{MakePlan(plans), plans}, now, actions);
        engine.OnTimer({EEngineTimer::Dispatch, {}}, now, actions);
        Answer(actions, events, acknowledged);
        while (!events.empty())
        {
            actions.clear();
            engine.Handle("LR01", events.front(), now, actions);
            events.pop_front();
            ++count;
            Answer(actions, events, acknowledged);
        }
        for (const std::uint64_t sequence : acknowledged)
        {
            actions.clear();
            engine.Handle(MessageAcknowledged{sequence}, now, actions);
        }
    }
    state.SetItemsProcessed(count);
}
BENCHMARK(BenchEngineEvents);

#ifdef ACS_BENCH_SQLITE
/// One accepted plan on disk: what stands between a plan and its Ack.
void BenchStoreCommit(benchmark::State& state)
{
    const std::string file = (std::filesystem::temp_directory_path() / "acs-plan-bench.db").string();
    const auto remove = [&file] {
        for (const char* ending : {"", "-wal", "-shm"})
        {
            std::error_code ignored;
            std::filesystem::remove(file + ending, ignored);
        }
    };
    remove();
    {
        const auto store = SqlitePlanStore::Open(file);
        PlanRecord record;
        record.plan = MakePlan(0);
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
    remove();
}
BENCHMARK(BenchStoreCommit);
#endif

} // namespace

} // namespace ACS::Planning
