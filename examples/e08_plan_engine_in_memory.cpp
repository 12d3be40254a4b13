// Lesson 8: the plan engine by hand: one event after the other, and after a crash a second engine on the same store.
//
// The engine publishes nothing before it is stored. So what the MCS was promised survives the crash, and a report
// that it did not acknowledge is sent again as the very same message. SqlitePlanStore is the store that is on disk.

#include "ExampleFloor.hpp"
#include "ExampleRandom.hpp"
#include <acs/plan/MemoryPlanStore.hpp>
#include <acs/plan/PlanEngineHost.hpp>

#include <fmt/core.h>

#include <cstdint>
#include <string>
#include <utility>
#include <variant>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): an example reads better without the prefix
namespace Core = ACS::Core;

namespace
{

/// An ACS without timers: the engine, its host, and a store that outlives both. Prints what a program would send.
class MemoryACS : private Core::IClock
{
    IPlanStore& _store;
    PlanEngine _engine;
    PlanEngineHost _host;

public:
    std::string driveID; ///< Of the latest drive.

    MemoryACS(const EngineOptions& options, const SiteMap& site, IPlanStore& store, Core::IRandom& random)
        : _store(store),
          _engine(options, site, random),
          _host(
              _engine,
              *this,
              [this](const EngineAction& action) { Execute(action); },
              // A store can fail, on a full disk for example. The engine then rejects new plans and repeats the rest later.
              [this](const StoreBatch& batch) { _host.OnStored(_store.Append(batch)); })
    {
    }

    void Restore(StoredState state)
    {
        _host.Restore(std::move(state));
    }

    void Push(EngineInput input)
    {
        _host.Push(std::move(input));
    }

    /// The robot connects and reports where it is.
    void ConnectRobot()
    {
        Push(RobotInput{ExampleFloor::ROBOT, LinkChanged{true}});
        StateChanged state;
        state.lastNodeID = "N-HOME";
        Push(RobotInput{ExampleFloor::ROBOT, state});
    }

    [[nodiscard]] const PlanEngine& GetEngine() const noexcept
    {
        return _engine;
    }

private:
    [[nodiscard]] Core::Now GetNow() const override
    {
        return {};
    }

    void Execute(const EngineAction& action)
    {
        if (const auto* sendOrNull = std::get_if<SendReport>(&action))
        {
            fmt::print("  to the MCS: report {}\n", sendOrNull->entry.sequence);
        }
        else if (const auto* commandOrNull = std::get_if<CommandRobot>(&action))
        {
            const auto* driveOrNull = std::get_if<Drive>(&commandOrNull->command);
            fmt::print("  to {}: {}\n", commandOrNull->robotID, driveOrNull != nullptr ? "drive" : "another command");
            driveID = driveOrNull != nullptr ? driveOrNull->driveID : driveID;
        }
        // Timers are ignored: this lesson pushes the one that it needs.
    }
};

/// The engine's view of the plan.
void PrintPlan(const PlanEngine& engine)
{
    const std::optional<PlanSummary> planOrNull = engine.GetPlanOrNull("PLAN-1");
    fmt::print(
        "PLAN-1 is {}, {} report(s) unacknowledged\n",
        planOrNull.has_value() ? GetText(planOrNull->state) : "unknown",
        engine.GetUnacknowledged().size());
}

/// Until the robot is driving.
void RunFirstACS(const EngineOptions& options, const SiteMap& site, IPlanStore& store, Core::IRandom& random)
{
    MemoryACS acs(options, site, store, random);
    fmt::print("the robot connects\n");
    acs.ConnectRobot();
    fmt::print("the MCS submits a plan\n");
    acs.Push(SubmitPlan{ExampleFloor::MakePlan(), 1});
    fmt::print("the engine assigns plans to robots, and the robot accepts its drive\n");
    acs.Push(EngineTimer{EEngineTimer::Dispatch, {}});
    acs.Push(RobotInput{ExampleFloor::ROBOT, NodePassed{acs.driveID, "N-HOME"}});
    // Acknowledgements are stored a little later, together: a crash before that only repeats a report.
    fmt::print("the MCS acknowledges the first report\n");
    acs.Push(MessageAcknowledged{1});
    PrintPlan(acs.GetEngine());
} // The engine is gone, as in a crash: only the store is left.

} // namespace

int main()
{
    const Core::Result<SiteMap> site = ExampleFloor::MakeSite();
    const Core::Result<EngineOptions> options = site.and_then(ExampleFloor::MakeOptions);
    if (!options.has_value())
    {
        fmt::print("{}\n", Core::Describe(options.error()));
        return 1;
    }
    MemoryPlanStore store;
    ExampleRandom random;
    RunFirstACS(*options, *site, store, random);

    fmt::print("crash and restart\n");
    Core::Result<StoredState> stored = store.Load();
    if (!stored.has_value())
    {
        fmt::print("{}\n", Core::Describe(stored.error()));
        return 1;
    }
    MemoryACS acs(*options, *site, store, random);
    // The plan still has its robot, which was driving: its drive starts again when it has reported its position.
    acs.Restore(std::move(*stored));
    PrintPlan(acs.GetEngine());
    fmt::print("the robot connects\n");
    acs.ConnectRobot();
    const std::optional<PlanSummary> planOrNull = acs.GetEngine().GetPlanOrNull("PLAN-1");
    return planOrNull.has_value() && planOrNull->state == EPlanState::InProgress ? 0 : 1;
}
