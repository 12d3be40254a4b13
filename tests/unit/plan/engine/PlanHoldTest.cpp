#include "fixtures/PlanWorldSteps.hpp"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <string>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace std::chrono_literals;
using ACS::Testing::BeginPlan;
using ACS::Testing::Contains;
using ACS::Testing::Lines;
using ACS::Testing::MakeLogisticsPlan;
using ACS::Testing::PausePlan;
using ACS::Testing::PlanWorld;
using ACS::Testing::RestartEngine;
using ACS::Testing::TryRunFor;

namespace
{

const std::string REASON = "The store was restored.";

/// The engine starts again on a store that was restored from a backup.
void RestartHeld(PlanWorld& world)
{
    world.trace.clear();
    world.store.SetHoldReason(REASON);
    RestartEngine(world);
}

/// Commands that make a robot drive or work.
Lines ListMotions(const PlanWorld& world)
{
    Lines motions;
    std::ranges::copy_if(world.GetTraceOf("command "), std::back_inserter(motions), [](const std::string& line) {
        return std::ranges::any_of(
            Lines{" Drive to ", "ExtendDrive", "StartJob", "Resume", "StartCharging"},
            [&](const auto& word) { return line.find(word) != std::string::npos; });
    });
    return motions;
}

} // namespace

TEST_CASE(
    "A restored store moves no robot at any state of a plan until the TSC is resumed, and then the plan completes")
{
    for (std::size_t action = 0; action < 400; ++action)
    {
        INFO("action " << action);
        PlanWorld world(action + 1);
        world.Connect();
        world.CrashAtAction(action);
        world.Submit(MakeLogisticsPlan("P1"), 1, "T1");
        static_cast<void>(world.TryRun([&world] { return world.engine == nullptr; }));
        if (world.engine != nullptr)
        {
            return; // the plan has fewer actions
        }
        static_cast<void>(TryRunFor(world, std::chrono::milliseconds(world.GetRandom(10'000))));
        RestartHeld(world);
        static_cast<void>(TryRunFor(world, 30min));
        CHECK(ListMotions(world) == Lines{});
        CHECK(world.engine->GetTscState() == ETscState::Paused);
        CHECK(world.engine->GetHoldReason() == REASON);
        CHECK(world.engine->GetTscReason() == REASON);
        for (const WaitReason& wait : world.engine->GetWaitReasons())
        {
            CHECK(wait.message == "The TSC is Paused: " + REASON);
        }
        RestartEngine(world); // the hold is stored until the operator ends it
        CHECK(world.engine->GetHoldReason() == REASON);
        world.SwitchTSC(false);
        CHECK(world.engine->GetHoldReason().empty());
        world.Submit(MakeLogisticsPlan("P1"), 2, "T1");
        REQUIRE(world.TryRun());
        CHECK(world.violations == Lines{});
        CHECK(world.GetRobot("LR01").doneJobs == Lines{"P1-a4", "P1-b2"});
        RestartEngine(world);
        CHECK(world.engine->GetTscState() == ETscState::Auto);
        CHECK(world.engine->GetHoldReason().empty());
    }
    FAIL("the plan has more actions than were crashed at");
}

TEST_CASE("A restored store resumes no robot that was paused, until the TSC is resumed")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Job 1 P1-a4 InProgress");
    PausePlan(world);
    world.GetRobot("LR01").bIgnoresPause = true;
    world.Control(EPlanControl::Resume, "P1");
    world.Crash();
    world.GetRobot("LR01").bIgnoresPause = false;
    RestartHeld(world);
    CHECK(ListMotions(world) == Lines{});
    world.SwitchTSC(false);
    REQUIRE(world.TryRun());
    CHECK(Contains(ListMotions(world), "LR01 Resume"));
    CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
}

TEST_CASE("A restored store resumes no robot that does not confirm its pause, until the TSC is resumed")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Job 1 P1-a4 InProgress");
    world.GetRobot("LR01").bIgnoresPause = true;
    world.Control(EPlanControl::Pause, "P1");
    world.Crash();
    RestartHeld(world);
    static_cast<void>(TryRunFor(world, 1min));
    for (int i = 0; i < 3; ++i)
    {
        world.PublishState("LR01"); // its base shows no pause; its arm may be stopped
    }
    CHECK(Contains(world.GetReportsOf("P1"), "PauseResult Failed"));
    CHECK(ListMotions(world) == Lines{});
    world.SwitchTSC(false);
    CHECK(Contains(ListMotions(world), "LR01 Resume"));
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
}
