// Lesson 8: the plan engine by hand: one event after the other, and after a crash a second engine on the same store.
//
// The engine tells nobody anything before the store has it. So what the MCS was promised survives the crash, and a report
// that it did not acknowledge is sent again as the very same message. SqlitePlanStore is the store that is on disk.

#include "ExampleFloor.hpp"
#include "ExampleRandom.hpp"
#include <acs/plan/MemoryPlanStore.hpp>
#include <acs/plan/PlanEngine.hpp>

#include <fmt/core.h>

#include <cstdint>
#include <span>
#include <utility>
#include <variant>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): an example reads better without the prefix
namespace Core = ACS::Core;

namespace
{

/// Prints what a program would send, and stores what must survive.
void Execute(PlanEngine& engine, IPlanStore& store, EngineActions& actions, Core::Now now)
{
    for (std::size_t i = 0; i < actions.size(); ++i)
    {
        if (const auto* storeOrNull = std::get_if<StorePlans>(&actions[i]))
        {
            const Core::Result<void> stored = store.Append(storeOrNull->batch);
            if (!stored.has_value()) // A full disk, for example: nothing behind this action must be told to anybody.
            {
                EngineActions instead;
                const auto skipped = std::span<const EngineAction>(actions).subspan(i + 1);
                engine.OnStoreFailed(storeOrNull->batch, skipped, Core::Describe(stored.error()), now, instead);
                actions = std::move(instead);
                return; // A program goes on with these actions.
            }
        }
        else if (const auto* sendOrNull = std::get_if<SendReport>(&actions[i]))
        {
            fmt::print("  to the MCS: report {}\n", sendOrNull->entry.sequence);
        }
        else if (const auto* commandOrNull = std::get_if<CommandRobot>(&actions[i]))
        {
            const bool bDrive = std::holds_alternative<Drive>(commandOrNull->command);
            fmt::print("  to {}: {}\n", commandOrNull->robotID, bDrive ? "drive" : "another command");
        }
        // Timers are ignored: this lesson calls OnTimer by hand.
    }
    actions.clear();
}

/// The engine's view of the plan.
void PrintPlan(const PlanEngine& engine)
{
    const std::optional<PlanSummary> planOrNull = engine.GetPlanOrNull("PLAN-1");
    fmt::print(
        "PLAN-1 is {}, {} report(s) unacknowledged\n",
        planOrNull.has_value() ? GetText(planOrNull->state) : "unknown",
        engine.GetUnacknowledged().size());
}

/// Until the robot is under way with the plan.
void RunFirstEngine(const EngineOptions& options, const SiteMap& site, IPlanStore& store, Core::IRandom& random)
{
    const Core::Now now;
    PlanEngine engine(options, site, random);
    EngineActions actions;

    fmt::print("the robot comes into reach\n");
    engine.Handle(ExampleFloor::ROBOT, LinkChanged{true}, now, actions);
    Execute(engine, store, actions, now);
    StateChanged state;
    state.lastNodeID = "N-HOME";
    engine.Handle(ExampleFloor::ROBOT, state, now, actions);
    Execute(engine, store, actions, now);

    fmt::print("the MCS submits a plan\n");
    engine.Handle(SubmitPlan{ExampleFloor::MakePlan(), 1}, now, actions);
    Execute(engine, store, actions, now);

    fmt::print("time to look for work\n");
    engine.OnTimer({EEngineTimer::Dispatch, {}}, now, actions);
    Execute(engine, store, actions, now);

    // Acknowledgements are stored a little later, together: a crash before that only repeats a report.
    fmt::print("the MCS acknowledges the first report\n");
    engine.Handle(MessageAcknowledged{1}, now, actions);
    Execute(engine, store, actions, now);
    PrintPlan(engine);
} // The engine is gone, as in a crash: all that is left is the store.

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
    RunFirstEngine(*options, *site, store, random);

    fmt::print("crash and restart\n");
    Core::Result<StoredState> stored = store.Load();
    if (!stored.has_value())
    {
        fmt::print("{}\n", Core::Describe(stored.error()));
        return 1;
    }
    PlanEngine engine(*options, *site, random);
    EngineActions actions;
    // The plan is still its robot's. A job would be asked for (RecoverJob); here it was driving, and begins to anew as soon
    // as it has told where it stands.
    engine.Restore(std::move(*stored), {}, actions);
    Execute(engine, store, actions, {});
    PrintPlan(engine);
    fmt::print("the robot comes into reach\n");
    engine.Handle(ExampleFloor::ROBOT, LinkChanged{true}, {}, actions);
    StateChanged state;
    state.lastNodeID = "N-HOME";
    engine.Handle(ExampleFloor::ROBOT, state, {}, actions);
    Execute(engine, store, actions, {});
    const std::optional<PlanSummary> planOrNull = engine.GetPlanOrNull("PLAN-1");
    return planOrNull.has_value() && planOrNull->state == EPlanState::InProgress ? 0 : 1;
}
