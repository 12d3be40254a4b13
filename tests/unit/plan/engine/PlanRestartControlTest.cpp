#include "fixtures/PlanWorldSteps.hpp"

#include <algorithm>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace std::chrono_literals;
using ACS::Testing::BeginPlan;
using ACS::Testing::Contains;
using ACS::Testing::CountStarts;
using ACS::Testing::FindLine;
using ACS::Testing::FinishPlan;
using ACS::Testing::IsJobCancelledFirst;
using ACS::Testing::Lines;
using ACS::Testing::MakeControlPlan;
using ACS::Testing::MakeLogisticsPlan;
using ACS::Testing::MakeTestOptions;
using ACS::Testing::MakeTestSite;
using ACS::Testing::MakeWorld;
using ACS::Testing::PausePlan;
using ACS::Testing::PlanWorld;
using ACS::Testing::RestartEngine;
using ACS::Testing::TryRunFor;

namespace
{

/// P1 was being resumed when the engine ended, and its robot has not received the command.
void CrashInResume(PlanWorld& world)
{
    BeginPlan(world, MakeLogisticsPlan("P1"), "Job 1 P1-a4 InProgress");
    PausePlan(world);
    world.GetRobot("LR01").bIgnoresPause = true;
    world.Control(EPlanControl::Resume, "P1");
    world.Crash();
    world.GetRobot("LR01").bIgnoresPause = false;
}

/// The first job of P1 runs on the arm of CR01.
void BeginArmJob(PlanWorld& world)
{
    world.GetRobot("CR01").bLikeArm = true;
    world.GetRobot("CR01").progressToken = "5 5 0";
    BeginPlan(world, MakeControlPlan("P1"), "Job 1 P1-cd InProgress");
}

ERobotStatus GetStatus(const PlanWorld& world, const std::string& robotID)
{
    const std::vector<RobotStatus> statuses = world.engine->GetRobotStatuses();
    return std::ranges::find(statuses, robotID, &RobotStatus::robotID)->status;
}

} // namespace

TEST_CASE("After a restart a paused plan is still paused, and continues where it was when it is resumed")
{
    for (const char* report :
         {"Step 1 InProgress", "Job 1 P1-a4 Instructed", "Job 1 P1-a4 InProgress", "Step 2 InProgress"})
    {
        INFO(report);
        PlanWorld world;
        BeginPlan(world, MakeLogisticsPlan("P1"), report);
        PausePlan(world);
        world.Crash();
        static_cast<void>(TryRunFor(world, 20s));
        RestartEngine(world);
        REQUIRE(world.TryRun());
        CHECK(world.engine->GetPlanOrNull("P1")->state == EPlanState::Paused);
        CHECK(world.engine->GetRobotStatuses()[0].status == ERobotStatus::Stopped);
        world.Control(EPlanControl::Resume, "P1");
        FinishPlan(world);
        CHECK(Contains(world.GetReportsOf("P1"), "ResumeResult Success"));
        CHECK(world.GetRobot("LR01").doneJobs == Lines{"P1-a4", "P1-b2"});
        CHECK(world.violations == Lines{});
    }
}

TEST_CASE("6.5 to 6.8 A control whose outcome was open has one result after the restart, also when it was repeated")
{
    struct Case
    {
        EPlanControl control;
        const char* report;
        const char* result;
        const char* end;
    };
    const std::vector<Case> cases{
        {EPlanControl::Cancel, "Step 1 InProgress", "CancelResult Success", "Plan Cancelled"},
        {EPlanControl::Abort, "Step 2 Dispatched", "AbortResult Success", "Plan Aborted"},
        {EPlanControl::Abort, "Job 1 P1-a4 InProgress", "AbortResult Success", "Plan Aborted"},
        {EPlanControl::Pause, "Step 1 InProgress", "PauseResult Success", "Plan Paused"},
        {EPlanControl::Pause, "Job 1 P1-a4 InProgress", "PauseResult Success", "Plan Paused"}};
    for (const Case& row : cases)
    {
        INFO(GetText(row.control) << " at " << row.report);
        PlanWorld world;
        BeginPlan(world, MakeLogisticsPlan("P1"), row.report);
        world.GetRobot("LR01").bIgnoresPause = true;
        world.GetRobot("LR01").bIgnoresDriveCancel = true;
        world.Control(row.control, "P1", 5, "T5");
        CHECK(world.replies.at(5).bAccepted);
        CHECK_FALSE(Contains(world.GetReportsOf("P1"), row.result));
        world.Crash();
        world.GetRobot("LR01").bIgnoresPause = false;
        world.GetRobot("LR01").bIgnoresDriveCancel = false;
        RestartEngine(world);
        world.Control(row.control, "P1", 6, "T5"); // The MCS repeats it because it has no Ack.
        CHECK(world.replies.at(6).bAccepted);
        REQUIRE(world.TryRun());
        CHECK(std::ranges::count(world.GetReportsOf("P1"), row.result) == 1);
        CHECK(std::ranges::count(world.GetReportsOf("P1"), row.end) == 1);
        world.Control(row.control, "P1", 7, "T5");
        CHECK(world.replies.at(7).bAccepted);
        CHECK(std::ranges::count(world.GetReportsOf("P1"), row.result) == 1);
    }
}

TEST_CASE("6.8 A Resume whose outcome was open is carried out after the restart")
{
    PlanWorld world;
    CrashInResume(world);
    RestartEngine(world);
    FinishPlan(world);
    CHECK(std::ranges::count(world.GetReportsOf("P1"), "ResumeResult Success") == 1);
}

TEST_CASE("6.8 A robot that shows no pause after the restart is still commanded to resume: its arm may be paused")
{
    PlanWorld world;
    CrashInResume(world);
    world.GetRobot("LR01").bFinishesJobs = true; // It continues.
    world.GetRobot("LR01").resumesAsked = 0;
    RestartEngine(world);
    FinishPlan(world);
    CHECK(world.GetRobot("LR01").resumesAsked > 0);
    CHECK(std::ranges::count(world.GetReportsOf("P1"), "ResumeResult Success") == 1);
}

TEST_CASE("6.5 A cancel that was open and whose robot arrived meanwhile fails, and the plan continues")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Step 1 InProgress");
    world.GetRobot("LR01").bIgnoresDriveCancel = true;
    world.Control(EPlanControl::Cancel, "P1");
    world.Restart(MakeTestOptions(false), MakeTestSite());
    StateChanged state;
    state.lastNodeID = "D-A01.CP01";
    world.Raise("LR01", LinkChanged{true});
    world.Raise("LR01", state);
    CHECK(world.GetReportsOf("P1").back() == "CancelResult Failed");
    CHECK(world.engine->GetPlanOrNull("P1")->state == EPlanState::InProgress);
}

TEST_CASE("D-16 An unresolved job that was abandoned is cancelled before its robot may resume, also after a restart")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Job 1 P1-a4 InProgress");
    PausePlan(world);
    world.GetRobot("LR01").bIgnoresJobCancel = true; // it has lost the job
    world.Raise("LR01", JobUnresolved{"P1-a4", "simulated by the test"});
    const bool bDisconnected = GENERATE(false, true);
    if (bDisconnected)
    {
        world.Raise("LR01", LinkChanged{false});
    }
    std::size_t line = world.trace.size();
    switch (GENERATE(0, 1, 2))
    {
        case 0:
            world.ResolveJob("P1", "P1-a4", EJobResolution::Failed);
            break;
        case 1:
            world.Control(EPlanControl::Abort, "P1");
            break;
        default:
            world.Ask(SkipStep{"P1", 1, 7});
            CHECK(world.replies.at(7).bAccepted);
            break;
    }
    CHECK(IsJobCancelledFirst(world, line));
    world.Raise("LR01", LinkChanged{false});
    line = world.trace.size();
    const bool bRestarted = GENERATE(false, true);
    if (bRestarted)
    {
        RestartEngine(world);
    }
    else
    {
        world.Connect();
    }
    CHECK(IsJobCancelledFirst(world, line));
    const std::size_t later = world.trace.size();
    world.Raise("LR01", LinkChanged{false});
    world.Connect();
    CHECK(FindLine(world, "command LR01 CancelJob", later) == world.trace.size());
}

TEST_CASE("After a restart a robot whose arm still runs the program of a resolved job is occupied until its end")
{
    PlanWorld world;
    BeginArmJob(world);
    const EJobResolution answer = GENERATE(EJobResolution::Done, EJobResolution::Failed);
    world.Raise("CR01", LinkChanged{false});
    world.ResolveJob("P1", "P1-cd", answer);
    const bool bTwice = GENERATE(false, true);
    if (bTwice)
    {
        RestartEngine(world);
    }
    const std::size_t line = world.trace.size();
    RestartEngine(world);
    CHECK(
        FindLine(world, "command CR01 RecoverJob P1-cd", line) + 1 == FindLine(world, "command CR01 CancelJob", line));
    CHECK(GetStatus(world, "CR01") == ERobotStatus::Working);
    REQUIRE(world.TryRun());
    CHECK(world.GetRobot("CR01").orderedAtWork == 0);
    CHECK(std::ranges::count(world.GetRobot("CR01").doneJobs, "P1-cd") == 1);
    CHECK(world.GetReportsOf("P1").back() == (answer == EJobResolution::Done ? "Plan Completed" : "Plan Failed"));
    CHECK(world.engine->GetActiveAlarms().empty());
    const std::size_t later = world.trace.size();
    RestartEngine(world);
    CHECK(FindLine(world, "command CR01 RecoverJob", later) == world.trace.size());
}

TEST_CASE("After a restart a resolved job that the arm cannot prove leaves no later job of its plan proven")
{
    PlanWorld world;
    BeginArmJob(world);
    world.Raise("CR01", LinkChanged{false});
    world.ResolveJob("P1", "P1-cd", EJobResolution::Done);
    const bool bRestarted = GENERATE(false, true);
    if (bRestarted)
    {
        world.GetRobot("CR01").unresolvedReason = "more than this one program has run";
        RestartEngine(world);
    }
    else
    {
        world.Connect();
        world.Raise("CR01", JobUnresolved{"P1-cd", "another program of the arm has run"});
    }
    world.GetRobot("CR01").unresolvedReason.clear();
    REQUIRE(world.TryRun());
    CHECK(world.engine->GetActiveAlarms().size() == (bRestarted ? 1 : 0));
    CHECK((CountStarts(world, "P1-b3") == 0) == bRestarted);
}

TEST_CASE("A resolved job is not asked for after a restart if its robot has reported that it no longer has the job")
{
    PlanWorld world;
    BeginArmJob(world);
    world.Raise("CR01", JobUnresolved{"P1-cd", "the counters have fallen"});
    world.ResolveJob("P1", "P1-cd", EJobResolution::Failed);
    const std::size_t line = world.trace.size();
    RestartEngine(world);
    CHECK(FindLine(world, "command CR01 RecoverJob", line) == world.trace.size());
}

TEST_CASE("D-16 abort.paused_job finish: after a restart the job has its time limit")
{
    const auto change = [](EngineOptions& options) {
        options.controls.bAbortFinishesPausedJob = true;
        options.actions.at("CassetteLoad").timeout = 60s;
    };
    PlanWorld world = MakeWorld(change);
    BeginPlan(world, MakeLogisticsPlan("P1"), "Job 1 P1-a4 InProgress");
    PausePlan(world);
    world.GetRobot("LR01").bIgnoresPause = true; // the job does not continue
    world.Control(EPlanControl::Abort, "P1");
    world.Crash();
    RestartEngine(world, change);
    static_cast<void>(TryRunFor(world, 2min));
    CHECK(world.engine->GetPlanOrNull("P1")->state == EPlanState::Failed);
    CHECK(Contains(world.GetReportsOf("P1"), "AbortResult Failed"));
}
