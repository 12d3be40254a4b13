#include "fixtures/PlanWorldSteps.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace std::chrono_literals;
using ACS::Testing::BeginPlan;
using ACS::Testing::Contains;
using ACS::Testing::CountStarts;
using ACS::Testing::FinishPlan;
using ACS::Testing::Lines;
using ACS::Testing::MakeControlPlan;
using ACS::Testing::MakeLogisticsPlan;
using ACS::Testing::PausePlan;
using ACS::Testing::PlanWorld;
using ACS::Testing::RestartEngine;
using ACS::Testing::TryRunFor;
using ACS::Testing::TryRunUntil;

namespace
{

/// The job that an operator must resolve; empty: none.
std::string GetUnresolvedJob(const PlanWorld& world)
{
    const std::vector<Alarm> alarms = world.engine->GetActiveAlarms();
    const auto held = std::ranges::find(alarms, "ACS-1008", &Alarm::errorCode);
    return held == alarms.end() ? std::string() : held->jobID.value_or(std::string());
}

/// While the disk fails, LR01 does its first job.
void CrashBehindFirstJob(PlanWorld& world)
{
    BeginPlan(world, MakeLogisticsPlan("P1"), "Step 1 InProgress");
    world.store.bFails = true;
    REQUIRE(world.TryRun([&world] { return world.GetRobot("LR01").doneJobs.size() == 1; }));
    world.Crash();
    world.store.bFails = false;
}

/// The first job of LR01 was done and not stored: both of its jobs are unresolved, and each is done once.
void CheckFirstJobHeld(PlanWorld& world)
{
    REQUIRE(world.TryRun());
    CHECK(GetUnresolvedJob(world) == "P1-a4");
    world.ResolveJob("P1", "P1-a4", EJobResolution::Done);
    REQUIRE(world.TryRun());
    world.ResolveJob("P1", "P1-b2", EJobResolution::Again);
    FinishPlan(world);
    CHECK(world.GetRobot("LR01").doneJobs == Lines{"P1-a4", "P1-b2"});
}

} // namespace

TEST_CASE("A crash while the disk fails: a job that was done and not stored is unresolved, and is not repeated")
{
    PlanWorld world;
    CrashBehindFirstJob(world);
    RestartEngine(world);
    REQUIRE(world.TryRun());
    REQUIRE(world.engine->GetActiveAlarms().size() == 1);
    CHECK(world.engine->GetActiveAlarms().front().errorCode == "ACS-1008");
    CHECK(world.GetRobot("LR01").doneJobs == Lines{"P1-a4"});
    world.ResolveJob("P1", "P1-a4", EJobResolution::Done);
    // The next one may have been done as well.
    REQUIRE(world.TryRun());
    CHECK(CountStarts(world, "P1-b2") == 0);
    world.ResolveJob("P1", "P1-b2", EJobResolution::Again);
    FinishPlan(world);
    CHECK(world.GetRobot("LR01").doneJobs == Lines{"P1-a4", "P1-b2"});
}

TEST_CASE("A crash while the disk fails: each job that may have been done is unresolved, also after another crash")
{
    PlanWorld world;
    BeginPlan(world, MakeControlPlan("P1"), "Job 1 P1-cd InProgress");
    world.store.bFails = true;
    REQUIRE(world.TryRun([&world] { return world.GetRobot("CR01").doneJobs.size() == 3; }));
    world.Crash();
    world.store.bFails = false;
    RestartEngine(world);
    REQUIRE(world.TryRun());
    CHECK(GetUnresolvedJob(world) == "P1-b3");
    world.Crash();
    RestartEngine(world);
    REQUIRE(world.TryRun());
    CHECK(GetUnresolvedJob(world) == "P1-b3");
    world.ResolveJob("P1", "P1-b3", EJobResolution::Done);
    REQUIRE(world.TryRun());
    CHECK(GetUnresolvedJob(world) == "P1-f3"); // of the next step
    world.ResolveJob("P1", "P1-f3", EJobResolution::Done);
    REQUIRE(world.TryRun());
    CHECK(GetUnresolvedJob(world) == "P1-e0");
    world.ResolveJob("P1", "P1-e0", EJobResolution::Done); // begun before the crash, and done after it
    REQUIRE(world.TryRun());
    CHECK(GetUnresolvedJob(world) == "P1-d1");
    world.ResolveJob("P1", "P1-d1", EJobResolution::Again);
    FinishPlan(world);
    CHECK(world.GetRobot("CR01").doneJobs == Lines{"P1-cd", "P1-b3", "P1-f3", "P1-e0", "P1-d1", "P1-d2"});
    CHECK(GetUnresolvedJob(world).empty());
}

TEST_CASE(
    "A crash while the disk fails: the first job of a robot that was switched off after its first drive is unresolved")
{
    PlanWorld world;
    CrashBehindFirstJob(world);
    world.GetRobot("LR01").Forget();
    RestartEngine(world);
    CheckFirstJobHeld(world);
}

TEST_CASE("The evidence of an arm at the begin of its plan is stored with the plan")
{
    PlanWorld world;
    world.Connect();
    StateChanged state;
    state.lastNodeID = "D-CHG02";
    state.restartEvidence.progressToken = "5 5 0";
    world.Raise("CR01", state);
    world.Submit(MakeControlPlan("P1"));
    REQUIRE(TryRunUntil(world, "P1", "Plan InProgress"));
    const std::vector<RobotWorkChanged>& works = world.store.GetState().robotWorks;
    CHECK(std::ranges::find(works, "CR01", &RobotWorkChanged::robotID)->progressToken == "5 5 0");
}

TEST_CASE("A crash while the disk fails: an arm whose motor is off is checked when it shows its evidence")
{
    PlanWorld world;
    world.GetRobot("CR01").progressToken = "6 6 0";
    BeginPlan(world, MakeControlPlan("P1"), "Step 1 InProgress");
    world.store.bFails = true;
    REQUIRE(world.TryRun([&world] { return world.GetRobot("CR01").doneJobs.size() == 1; }));
    world.GetRobot("CR01").progressToken = "7 7 0";
    world.Crash();
    world.store.bFails = false;
    world.Restart(ACS::Testing::MakeTestOptions(false), ACS::Testing::MakeTestSite());
    StateChanged state;
    state.lastNodeID = world.GetRobot("CR01").GetOccupied().front();
    state.batteryPercent = 80;
    state.restartEvidence.commandID = world.driveIDs.at("CR01");
    state.errors.push_back({"ARM-motorOff", EAlarmLevel::Heavy, "The arm's motor is off."});
    world.Raise("CR01", LinkChanged{true});
    world.Raise("CR01", state);
    const bool bCrashes = GENERATE(false, true); // what is stored meanwhile keeps the evidence
    if (bCrashes)
    {
        world.Control(EPlanControl::Pause, "P1");
        world.Crash();
        RestartEngine(world);
        REQUIRE(world.TryRun());
        world.Control(EPlanControl::Resume, "P1");
    }
    else
    {
        world.Connect();
    }
    REQUIRE(world.TryRun());
    CHECK(GetUnresolvedJob(world) == "P1-cd");
    CHECK(CountStarts(world, "P1-cd") == 1);
}

TEST_CASE("A crash at any action after an arm's job was resolved: its robot gets no command before the program's end")
{
    const EJobResolution answer = GENERATE(EJobResolution::Done, EJobResolution::Failed);
    bool bCrashed = true;
    for (std::size_t action = 0; bCrashed; ++action)
    {
        INFO("action " << action);
        REQUIRE(action < 400);
        PlanWorld world(action + 1);
        ACS::Testing::FakeRobotAdapter& arm = world.GetRobot("CR01");
        arm.bLikeArm = true;
        arm.progressToken = "5 5 0";
        BeginPlan(world, MakeControlPlan("P1"), "Job 1 P1-cd InProgress");
        world.Raise("CR01", LinkChanged{false});
        world.CrashAtAction(action);
        world.ResolveJob("P1", "P1-cd", answer);
        if (world.engine != nullptr)
        {
            world.Connect();
        }
        static_cast<void>(world.TryRun([&world] { return world.engine == nullptr; }));
        bCrashed = world.engine == nullptr;
        if (bCrashed)
        {
            RestartEngine(world);
        }
        REQUIRE(world.TryRun());
        CHECK(arm.orderedAtWork == 0);
        CHECK(std::ranges::count(arm.doneJobs, "P1-cd") == 1);
        CHECK(world.violations == Lines{});
        CHECK(world.engine->GetActiveAlarms().empty());
        CHECK(world.engine->GetActivePlans().empty());
    }
}

TEST_CASE("The next job of a robot that was switched off during a restart and shows no evidence is unresolved")
{
    PlanWorld world;
    BeginPlan(world, MakeControlPlan("P1"), "Job 1 P1-cd InProgress");
    world.store.bFails = true;
    REQUIRE(world.TryRun([&world] { return world.GetRobot("CR01").doneJobs.size() == 1; }));
    world.store.bFails = false;
    REQUIRE(TryRunUntil(world, "P1", "Job 1 P1-cd Completed"));
    PausePlan(world);
    REQUIRE(world.TryRun());
    world.Crash();
    world.GetRobot("CR01").Forget();
    RestartEngine(world);
    world.Control(EPlanControl::Resume, "P1");
    REQUIRE(world.TryRun());
    CHECK_FALSE(GetUnresolvedJob(world).empty());
}

TEST_CASE("A job is not begun in the call that begins its plan if that cannot be stored: a crash would repeat it")
{
    PlanWorld world =
        ACS::Testing::MakeWorld([](EngineOptions& options) { options.robots.front().startNodeID = "D-A01.CP01"; });
    world.Connect();
    world.Submit(MakeLogisticsPlan("P1"));
    world.store.bFails = true;
    static_cast<void>(TryRunFor(world, 500ms));
    CHECK(CountStarts(world, "P1-a4") == 0);
    world.store.bFails = false;
    FinishPlan(world);
    CHECK(CountStarts(world, "P1-a4") == 1);
}

TEST_CASE("A robot is not paused by a request that cannot be stored: after a crash it would not be resumed")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Step 1 InProgress");
    world.store.bFails = true;
    world.Control(EPlanControl::Pause, "P1", 5, "T5");
    CHECK_FALSE(world.replies.at(5).bAccepted);
    CHECK(world.GetTraceOf("command LR01 Pause").empty());
    world.Crash();
    world.store.bFails = false;
    RestartEngine(world);
    FinishPlan(world);
}

TEST_CASE("A pause that was refused, because it could not be stored, is executed when it is repeated")
{
    for (const bool bCrashes : {false, true})
    {
        INFO("crash " << bCrashes);
        PlanWorld world;
        BeginPlan(world, MakeLogisticsPlan("P1"), "Step 1 InProgress");
        world.store.bFails = true;
        world.Control(EPlanControl::Pause, "P1", 5, "T5");
        CHECK_FALSE(world.replies.at(5).bAccepted);
        world.store.bFails = false;
        static_cast<void>(TryRunFor(world, 2s)); // what was not stored is stored now
        if (bCrashes)
        {
            world.Crash();
            RestartEngine(world);
        }
        world.Control(EPlanControl::Pause, "P1", 6, "T5");
        CHECK(world.replies.at(6).bAccepted);
        REQUIRE(TryRunUntil(world, "P1", "PauseResult Success"));
    }
}

TEST_CASE("A control that cannot be stored is refused: after a crash it would be lost")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Step 1 InProgress");
    world.store.bFails = true;
    world.Control(EPlanControl::Pause, "P1", 5, "T5"); // This write shows that the disk fails.
    CHECK_FALSE(world.replies.at(5).bAccepted);
    CHECK(world.replies.at(5).message.find("cannot be stored") != std::string::npos);
    world.Control(EPlanControl::Pause, "P1", 6, "T5");
    CHECK_FALSE(world.replies.at(6).bAccepted);
    world.Control(EPlanControl::Abort, "P1", 7, "T7");
    CHECK_FALSE(world.replies.at(7).bAccepted);
    world.Control(EPlanControl::Abort, "unknown", 8, "T8");
    CHECK_FALSE(world.replies.at(8).bAccepted);
    static_cast<void>(TryRunFor(world, 1s));
    world.store.bFails = false;
    static_cast<void>(TryRunFor(world, 2s));
    CHECK_FALSE(Contains(world.GetReportsOf("P1"), "AbortResult Success"));
    world.Control(EPlanControl::Abort, "P1", 9, "T7");
    CHECK(world.replies.at(9).bAccepted);
    REQUIRE(world.TryRun());
    CHECK(Contains(world.GetReportsOf("P1"), "AbortResult Success"));
}

TEST_CASE("A control that has taken effect is acknowledged when it is stored: Fail would not be true")
{
    struct Case
    {
        EPlanControl control;
        const char* begun; ///< Empty: the plan waits for a robot.
        const char* result;
    };
    const std::vector<Case> cases = {
        {EPlanControl::Pause, "", "PauseResult Success"},
        {EPlanControl::Cancel, "", "CancelResult Success"},
        {EPlanControl::Abort, "", "AbortResult Success"},
        {EPlanControl::Cancel, "Step 1 InProgress", "CancelResult Success"},
        {EPlanControl::Abort, "Step 1 InProgress", "AbortResult Success"},
        {EPlanControl::Abort, "Job 1 P1-a4 InProgress", "AbortResult Success"}};
    for (const Case& single : cases)
    {
        INFO(GetText(single.control) << " after " << single.begun);
        PlanWorld world;
        if (*single.begun == '\0')
        {
            world.Submit(MakeLogisticsPlan("P1")); // no robot is connected
        }
        else
        {
            BeginPlan(world, MakeLogisticsPlan("P1"), single.begun);
        }
        world.store.bFails = true;
        world.Control(single.control, "P1", 5, "T5"); // This write shows that the disk fails.
        world.Control(single.control, "P1", 6, "T5");
        CHECK_FALSE(world.replies.contains(5));
        CHECK_FALSE(world.replies.contains(6));
        CHECK_FALSE(Contains(world.GetReportsOf("P1"), single.result));
        world.store.bFails = false;
        static_cast<void>(TryRunFor(world, 2s));
        REQUIRE(world.replies.contains(5));
        CHECK(world.replies.at(5).bAccepted);
        CHECK(world.replies.at(6).bAccepted);
        REQUIRE(TryRunUntil(world, "P1", single.result));
        CHECK(std::ranges::count(world.GetReportsOf("P1"), single.result) == 1);
    }
}

TEST_CASE("A robot is not resumed by a request that cannot be stored, and resumes when it is repeated")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Step 1 InProgress");
    PausePlan(world);
    const std::size_t resumed = world.GetTraceOf("command LR01 Resume").size();
    const std::size_t reports = world.GetReportsOf("P1").size();
    world.store.bFails = true;
    world.Control(EPlanControl::Resume, "P1", 5, "T5"); // This write shows that the disk fails.
    CHECK_FALSE(world.replies.at(5).bAccepted);
    world.store.bFails = false;
    static_cast<void>(TryRunFor(world, 60s));
    CHECK(world.GetTraceOf("command LR01 Resume").size() == resumed);
    CHECK(world.GetReportsOf("P1").size() == reports);
    world.Control(EPlanControl::Resume, "P1", 6, "T5");
    CHECK(world.replies.at(6).bAccepted);
    FinishPlan(world);
}

TEST_CASE("13.5 A stored plan that is sent again is accepted although another plan of the batch cannot be stored")
{
    PlanWorld world;
    world.Connect();
    world.Submit(MakeLogisticsPlan("P1"), 1, "T1");
    world.store.bFails = true;
    world.SubmitTogether(
        {{SubmitPlan{MakeLogisticsPlan("P1"), 2, "T1"}}, {SubmitPlan{MakeLogisticsPlan("P2"), 3, "T2"}}});
    CHECK(world.replies.at(2).bAccepted);
    CHECK_FALSE(world.replies.at(3).bAccepted);
}

TEST_CASE("6.7 A pause that waits for the end of an unresolved job is confirmed when the job is to be done again")
{
    const auto change = [](EngineOptions& options) {
        options.controls.bPausesAfterJob = true;
    };
    PlanWorld world = ACS::Testing::MakeWorld(change);
    BeginPlan(world, MakeLogisticsPlan("P1"), "Job 1 P1-a4 InProgress");
    world.GetRobot("LR01").unresolvedReason = "it was switched off";
    RestartEngine(world, change);
    REQUIRE(world.TryRun());
    REQUIRE(GetUnresolvedJob(world) == "P1-a4");
    world.Control(EPlanControl::Pause, "P1");
    world.ResolveJob("P1", "P1-a4", EJobResolution::Again);
    CHECK(world.GetReportsOf("P1").back() != "Plan Completed");
    CHECK(Contains(world.GetReportsOf("P1"), "PauseResult Success"));
    world.Control(EPlanControl::Resume, "P1");
    FinishPlan(world);
}

TEST_CASE("While the disk fails no plan begins, and one whose begin was lost starts no job: a crash would repeat it")
{
    PlanWorld world;
    world.Connect();
    world.Submit(MakeLogisticsPlan("P1"));
    world.store.bFails = true;
    static_cast<void>(TryRunFor(world, 60s));
    CHECK(world.GetRobot("LR01").drives == 1);
    CHECK(CountStarts(world, "P1-a4") == 0);
    world.Crash();
    world.store.bFails = false;
    RestartEngine(world);
    FinishPlan(world);
    CHECK(world.GetRobot("LR01").doneJobs == Lines{"P1-a4", "P1-b2"});
    world.Submit(MakeLogisticsPlan("P2"));
    world.store.bFails = true;
    world.SwitchTSC(true); // fails to be stored
    world.SwitchTSC(false);
    static_cast<void>(TryRunFor(world, 5s));
    CHECK(world.engine->GetPlanOrNull("P2")->state == EPlanState::Pending);
    world.store.bFails = false;
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P2").back() == "Plan Completed");
}
