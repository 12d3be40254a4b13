#include "fixtures/PlanWorldSteps.hpp"

#include <algorithm>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using ACS::Testing::BeginPlan;
using ACS::Testing::Contains;
using ACS::Testing::FindLine;
using ACS::Testing::FinishPlan;
using ACS::Testing::GetReportsAfter;
using ACS::Testing::IsJobCancelledFirst;
using ACS::Testing::Lines;
using ACS::Testing::MakeControlPlan;
using ACS::Testing::MakeLogisticsPlan;
using ACS::Testing::MakeWorld;
using ACS::Testing::PausePlan;
using ACS::Testing::PlanWorld;
using ACS::Testing::TryRunFor;
using ACS::Testing::TryRunUntil;

TEST_CASE(
    "R8, 6.7 Pause in a drive: after the robot has stopped, its status, the plan and the result follow; Resume ends it")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Step 1 InProgress");
    const std::size_t before = world.GetReportsOf("P1").size();
    const std::size_t line = world.trace.size();
    world.Control(EPlanControl::Pause, "P1", 4);
    CHECK(world.replies.at(4).bAccepted);
    CHECK(GetReportsAfter(world, "P1", before).empty());
    REQUIRE(TryRunUntil(world, "P1", "PauseResult Success"));
    CHECK(GetReportsAfter(world, "P1", before) == Lines{"Plan Paused", "PauseResult Success"});
    CHECK(world.GetRobot("LR01").IsPaused());
    CHECK(world.engine->GetPlanOrNull("P1")->state == EPlanState::Paused);
    const std::size_t status = FindLine(world, "status LR01 Stopped", line);
    CHECK(FindLine(world, "command LR01 Pause", line) < status);
    CHECK(status < FindLine(world, "report P1 Plan Paused", line));

    REQUIRE(world.TryRun()); // nothing moves any more
    CHECK(GetReportsAfter(world, "P1", before).size() == 2);
    const std::size_t resumed = world.trace.size();
    world.Control(EPlanControl::Resume, "P1");
    REQUIRE(world.TryRun());
    const Lines after = GetReportsAfter(world, "P1", before + 2);
    CHECK(Lines(after.begin(), after.begin() + 2) == Lines{"Plan InProgress", "ResumeResult Success"});
    CHECK(after.back() == "Plan Completed");
    CHECK(FindLine(world, "status LR01 Moving", resumed) < FindLine(world, "report P1 Plan InProgress", resumed));
    CHECK(world.violations == Lines{});
}

TEST_CASE("R8, 6.7 Pause in a job interrupts it, and after Resume it is completed once")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Job 1 P1-a4 InProgress");
    world.Control(EPlanControl::Pause, "P1");
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1").back() == "PauseResult Success");
    CHECK(world.GetRobot("LR01").doneJobs.empty());
    CHECK(world.engine->GetPlanOrNull("P1")->jobID == "P1-a4");
    CHECK(world.engine->GetRobotStatuses()[0].status == ERobotStatus::Stopped);
    CHECK(world.engine->GetRobotStatuses()[0].jobID == "P1-a4");
    const std::size_t line = world.trace.size();
    world.Control(EPlanControl::Resume, "P1");
    REQUIRE(world.TryRun());
    CHECK(FindLine(world, "status LR01 Working", line) < FindLine(world, "report P1 Plan InProgress", line));
    CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
    CHECK(world.GetRobot("LR01").doneJobs == Lines{"P1-a4", "P1-b2"});
}

TEST_CASE("D-22 A job that the robot cannot pause is completed first, and the next one begins after Resume")
{
    PlanWorld world;
    world.Connect();
    world.GetRobot("CR01").bFinishesJobs = true;
    world.Submit(MakeControlPlan("P1"));
    for (const std::string jobID : {"1 P1-cd", "1 P1-b3"}) // in the middle of a step, and at its end
    {
        REQUIRE(TryRunUntil(world, "P1", "Job " + jobID + " InProgress"));
        const std::size_t before = world.GetReportsOf("P1").size();
        world.Control(EPlanControl::Pause, "P1");
        REQUIRE(world.TryRun());
        Lines expected{"Job " + jobID + " Completed", "Plan Paused", "PauseResult Success"};
        if (jobID == "1 P1-b3")
        {
            expected.insert(expected.begin() + 1, "Step 1 Completed");
        }
        CHECK(GetReportsAfter(world, "P1", before) == expected);
        world.Control(EPlanControl::Resume, "P1");
    }
    REQUIRE(world.TryRun());
    CHECK(world.GetRobot("CR01").doneJobs == Lines{"P1-cd", "P1-b3", "P1-f3", "P1-e0", "P1-d1", "P1-d2"});
    CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
}

TEST_CASE(
    "D-22 pause.mode after_job: the running job ends, the robot is not commanded to stop, and nothing else begins")
{
    PlanWorld world = MakeWorld([](EngineOptions& options) { options.controls.bPausesAfterJob = true; });
    BeginPlan(world, MakeControlPlan("P1"), "Job 1 P1-cd InProgress");
    const std::size_t before = world.GetReportsOf("P1").size();
    world.Control(EPlanControl::Pause, "P1");
    REQUIRE(world.TryRun());
    CHECK(GetReportsAfter(world, "P1", before) == Lines{"Job 1 P1-cd Completed", "Plan Paused", "PauseResult Success"});
    CHECK_FALSE(Contains(world.trace, "command CR01 Pause"));
    CHECK(world.engine->GetRobotStatuses()[1].status == ERobotStatus::Stopped);
    CHECK(world.engine->GetPlanOrNull("P1")->jobID == "P1-b3");
    world.Control(EPlanControl::Resume, "P1");
    FinishPlan(world);
}

TEST_CASE("9 pause.confirm_timeout: the pause fails if the robot does not stop, and the plan continues")
{
    PlanWorld world =
        MakeWorld([](EngineOptions& options) { options.controls.pauseTimeout = std::chrono::milliseconds(700); });
    world.Connect();
    world.GetRobot("LR01").bIgnoresPause = true;
    world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(TryRunUntil(world, "P1", "Step 1 InProgress"));
    world.Control(EPlanControl::Pause, "P1");
    const auto asked = world.GetNow().steady;
    REQUIRE(TryRunUntil(world, "P1", "PauseResult Failed"));
    CHECK(world.GetNow().steady - asked == std::chrono::milliseconds(700));
    CHECK(Contains(world.trace, "command LR01 Resume")); // The robot may have received the pause.
    REQUIRE(world.TryRun());
    CHECK_FALSE(Contains(world.GetReportsOf("P1"), "Plan Paused"));
    CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
}

TEST_CASE("9 After a pause that fails at the end of its job, the plan continues with the next job")
{
    PlanWorld world;
    world.Connect();
    world.GetRobot("CR01").bIgnoresPause = true;
    world.Submit(MakeControlPlan("P1"));
    REQUIRE(TryRunUntil(world, "P1", "Job 1 P1-b3 InProgress"));
    world.Control(EPlanControl::Pause, "P1");
    REQUIRE(world.TryRun());
    CHECK(Contains(world.GetReportsOf("P1"), "PauseResult Failed"));
    CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
}

TEST_CASE("7 A plan that waits for a robot is held in the queue, and has its position again when it is resumed")
{
    PlanWorld world;
    world.Submit(MakeLogisticsPlan("P1"));
    world.Submit(MakeLogisticsPlan("P2"));
    world.Control(EPlanControl::Pause, "P1");
    CHECK(world.GetReportsOf("P1") == Lines{"Plan Paused", "PauseResult Success"});
    CHECK(world.engine->GetActivePlans().front().planID == "P1");
    CHECK(world.engine->GetActivePlans().front().state == EPlanState::Paused);
    world.Connect();
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P2").back() == "Plan Completed");
    CHECK(world.GetReportsOf("P1").back() == "PauseResult Success");
    world.Control(EPlanControl::Resume, "P1");
    REQUIRE(world.TryRun());
    const Lines reports = GetReportsAfter(world, "P1", 2);
    CHECK(
        Lines(reports.begin(), reports.begin() + 3)
        == Lines{"Plan Pending", "ResumeResult Success", "Plan InProgress"});
    CHECK(reports.back() == "Plan Completed");
}

TEST_CASE("6.7 Pause of a robot that is stationary is reported at once, and it is not driven before Resume")
{
    PlanWorld world;
    world.Connect();
    Plan control = MakeControlPlan("P2");
    control.priority = 20;
    world.Submit(control);
    REQUIRE(TryRunUntil(world, "P2", "Job 1 P2-cd InProgress"));
    world.Submit(MakeLogisticsPlan("P1")); // Waits for the dock where the other robot works.
    REQUIRE(world.TryRun([&world] { return world.engine->GetRobotStatuses()[0].planID == "P1"; }));
    world.Control(EPlanControl::Pause, "P1");
    CHECK(world.GetReportsOf("P1").back() == "PauseResult Success");
    CHECK_FALSE(world.engine->GetRobotStatuses()[0].planID.has_value());
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P2").back() == "Plan Completed");
    CHECK(world.GetRobot("LR01").drives == 0);
    CHECK_FALSE(Contains(world.trace, "command LR01 Pause"));
    world.Control(EPlanControl::Resume, "P1");
    FinishPlan(world);
}

TEST_CASE("D-21 Pause of a paused plan succeeds again, Resume of a running or waiting plan fails")
{
    PlanWorld world;
    world.Submit(MakeLogisticsPlan("P1"));
    world.Control(EPlanControl::Resume, "P1");
    CHECK(world.GetReportsOf("P1") == Lines{"ResumeResult Failed"});
    world.Connect();
    REQUIRE(TryRunUntil(world, "P1", "Step 1 InProgress"));
    world.Control(EPlanControl::Resume, "P1");
    CHECK(world.GetReportsOf("P1").back() == "ResumeResult Failed");
    PausePlan(world);
    const std::size_t before = world.GetReportsOf("P1").size();
    world.Control(EPlanControl::Pause, "P1");
    CHECK(GetReportsAfter(world, "P1", before) == Lines{"PauseResult Success"});
    world.Control(EPlanControl::Resume, "P1");
    FinishPlan(world);
}

TEST_CASE("6.8 A plan stays paused if its robot does not resume, and the result reports that")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Step 1 InProgress");
    PausePlan(world);
    world.GetRobot("LR01").bIgnoresPause = true;
    world.Control(EPlanControl::Resume, "P1");
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1").back() == "ResumeResult Failed");
    CHECK(world.engine->GetPlanOrNull("P1")->state == EPlanState::Paused);
    world.GetRobot("LR01").bIgnoresPause = false;
    world.Control(EPlanControl::Resume, "P1");
    FinishPlan(world);
}

TEST_CASE("6.7 A robot that disconnects before it pauses is commanded again after the reconnect")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Step 1 InProgress");
    world.GetRobot("LR01").bIgnoresPause = true;
    world.Raise("LR01", LinkChanged{false});
    world.Control(EPlanControl::Pause, "P1");
    CHECK(world.GetReportsOf("P1").back() == "Step 1 InProgress");
    world.GetRobot("LR01").bIgnoresPause = false;
    REQUIRE(TryRunFor(world, std::chrono::seconds(1)));
    world.Connect();
    REQUIRE(TryRunUntil(world, "P1", "PauseResult Success"));

    // It stays paused after another disconnect.
    world.Raise("LR01", LinkChanged{false});
    world.Operate("LR01", Resume{});
    const std::size_t line = world.trace.size();
    world.Connect();
    CHECK(FindLine(world, "command LR01 Pause", line) < world.trace.size());
    world.Control(EPlanControl::Resume, "P1");
    FinishPlan(world);
}

TEST_CASE("6.8 A robot that was in manual mode when it was to resume is commanded again in automatic mode")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Job 1 P1-a4 InProgress");
    PausePlan(world);
    world.GetRobot("LR01").bIgnoresPause = true;
    StateChanged byHand;
    byHand.lastNodeID = "D-A01.CP01";
    byHand.bAutomatic = false;
    byHand.bPaused = true;
    world.Raise("LR01", byHand);
    world.Raise("LR01", JobFailed{"P1-a4", "the operating mode changed"});
    CHECK(world.GetReportsOf("P1").back() == "Plan Failed");
    const std::size_t line = world.trace.size();
    StateChanged back = byHand;
    back.bAutomatic = true;
    world.Raise("LR01", back);
    CHECK(FindLine(world, "command LR01 Resume", line) < world.trace.size());
}

TEST_CASE("D-16 Abort of a paused plan drops its job, an alarm asks for a check, and the robot is used again")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Job 1 P1-a4 InProgress");
    PausePlan(world);
    const std::size_t before = world.GetReportsOf("P1").size();
    world.Control(EPlanControl::Abort, "P1");
    REQUIRE(world.TryRun());
    CHECK(GetReportsAfter(world, "P1", before) == Lines{"Error ACS-1007 set", "Plan Aborted", "AbortResult Success"});
    CHECK(Contains(world.trace, "command LR01 CancelJob"));
    CHECK_FALSE(world.GetRobot("LR01").IsPaused());
    CHECK(world.engine->GetActiveAlarms().size() == 1);
    world.Submit(MakeLogisticsPlan("P2"));
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P2").back() == "Plan Completed");
    CHECK(world.engine->GetActiveAlarms().empty());
}

TEST_CASE(
    "D-16 A robot that is disconnected at the Abort of its paused plan is commanded to cancel before it may resume")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Job 1 P1-a4 InProgress");
    PausePlan(world);
    world.Raise("LR01", LinkChanged{false});
    world.GetRobot("LR01").bIgnoresJobCancel = true; // it misses the command
    world.Control(EPlanControl::Abort, "P1");
    world.GetRobot("LR01").bIgnoresJobCancel = false;
    const bool bResolved = GENERATE(false, true);
    if (bResolved)
    {
        world.ResolveJob("P1", "P1-a4", EJobResolution::Failed);
    }
    const std::size_t line = world.trace.size();
    world.Connect();
    CHECK(IsJobCancelledFirst(world, line));
    const std::size_t again = world.trace.size();
    world.Raise("LR01", LinkChanged{false});
    world.Connect();
    CHECK(FindLine(world, "command LR01 CancelJob", again) == world.trace.size());
}

TEST_CASE("D-16 abort.paused_job finish: the paused job is completed, then the plan is aborted")
{
    PlanWorld world = MakeWorld([](EngineOptions& options) { options.controls.bAbortFinishesPausedJob = true; });
    BeginPlan(world, MakeLogisticsPlan("P1"), "Job 1 P1-a4 InProgress");
    PausePlan(world);
    const std::size_t before = world.GetReportsOf("P1").size();
    world.Control(EPlanControl::Abort, "P1");
    REQUIRE(world.TryRun());
    CHECK(
        GetReportsAfter(world, "P1", before) == Lines{"Job 1 P1-a4 Completed", "Plan Aborted", "AbortResult Success"});
    CHECK(world.GetRobot("LR01").doneJobs == Lines{"P1-a4"});
}

TEST_CASE("6.6 Abort of a plan that is paused in a drive makes the robot available again")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Step 1 InProgress");
    PausePlan(world);
    const std::size_t before = world.GetReportsOf("P1").size();
    world.Control(EPlanControl::Abort, "P1");
    REQUIRE(world.TryRun());
    CHECK(GetReportsAfter(world, "P1", before) == Lines{"Plan Aborted", "AbortResult Success"});
    CHECK(world.GetRobot("LR01").GetOccupied() == Lines{"D-CHG01"});
}

TEST_CASE("R5, 7 A paused plan that may be cancelled passes through the state in which it was paused")
{
    PlanWorld world;
    world.Submit(MakeLogisticsPlan("P1"));
    world.Control(EPlanControl::Pause, "P1");
    world.Control(EPlanControl::Cancel, "P1");
    CHECK(GetReportsAfter(world, "P1", 2) == Lines{"Plan Pending", "Plan Cancelled", "CancelResult Success"});
    world.Connect();
    world.Submit(MakeLogisticsPlan("P2"));
    REQUIRE(TryRunUntil(world, "P2", "Step 1 InProgress"));
    world.Control(EPlanControl::Pause, "P2");
    REQUIRE(TryRunUntil(world, "P2", "PauseResult Success"));
    const std::size_t before = world.GetReportsOf("P2").size();
    world.Control(EPlanControl::Cancel, "P2");
    REQUIRE(world.TryRun());
    CHECK(GetReportsAfter(world, "P2", before) == Lines{"Plan InProgress", "Plan Cancelled", "CancelResult Success"});
    world.Submit(MakeLogisticsPlan("P3"));
    REQUIRE(TryRunUntil(world, "P3", "Job 1 P3-a4 InProgress"));
    world.Control(EPlanControl::Pause, "P3");
    REQUIRE(TryRunUntil(world, "P3", "PauseResult Success"));
    world.Control(EPlanControl::Cancel, "P3");
    CHECK(world.GetReportsOf("P3").back() == "CancelResult Failed");
    CHECK(world.engine->GetPlanOrNull("P3")->state == EPlanState::Paused);
}

TEST_CASE("R9 A job that fails while its plan is paused fails step and plan at once")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Job 1 P1-a4 InProgress");
    PausePlan(world);
    const std::size_t before = world.GetReportsOf("P1").size();
    world.Raise("LR01", JobFailed{"P1-a4", "the gripper let go"});
    CHECK(
        GetReportsAfter(world, "P1", before)
        == Lines{"Plan InProgress", "Job 1 P1-a4 Failed", "Step 1 Failed", "Plan Failed"});
    REQUIRE(world.TryRun());
    CHECK(world.GetRobot("LR01").IsPaused() == false);
}

TEST_CASE("6.7 A job that ends while its plan is paused is reported, and the next one waits for Resume")
{
    PlanWorld world;
    world.Connect();
    Plan plan = MakeLogisticsPlan("P1");
    plan.steps.pop_back();
    world.Submit(plan);
    REQUIRE(TryRunUntil(world, "P1", "Job 1 P1-a4 InProgress"));
    PausePlan(world);
    const std::size_t before = world.GetReportsOf("P1").size();
    world.Raise("LR01", JobFinished{"P1-a4"});
    CHECK(GetReportsAfter(world, "P1", before) == Lines{"Job 1 P1-a4 Completed", "Step 1 Completed"});
    world.Control(EPlanControl::Resume, "P1");
    REQUIRE(world.TryRun());
    CHECK(
        GetReportsAfter(world, "P1", before + 2) == Lines{"Plan InProgress", "ResumeResult Success", "Plan Completed"});
}

TEST_CASE("A job's time limit does not run while its plan is paused")
{
    PlanWorld world = MakeWorld(
        [](EngineOptions& options) { options.actions.at("CassetteLoad").timeout = std::chrono::seconds(10); });
    BeginPlan(world, MakeLogisticsPlan("P1"), "Job 1 P1-a4 InProgress");
    PausePlan(world);
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1").back() == "PauseResult Success");
    world.GetRobot("LR01").bIgnoresPause = true; // It reports that it has resumed, and does nothing.
    StateChanged state;
    state.lastNodeID = world.GetRobot("LR01").GetOccupied().front();
    world.Control(EPlanControl::Resume, "P1");
    world.Raise("LR01", state);
    const auto resumed = world.GetNow().steady;
    REQUIRE(TryRunUntil(world, "P1", "Plan Failed"));
    CHECK(world.GetNow().steady - resumed > std::chrono::seconds(4));
    CHECK(world.GetNow().steady - resumed < std::chrono::seconds(10));
}

TEST_CASE("A robot that stops in manual mode after its Resume is commanded to resume again in automatic mode")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Step 1 InProgress");
    world.GetRobot("LR01").bIgnoresPause = true;
    world.Control(EPlanControl::Pause, "P1");
    world.SwitchMode("LR01", true);
    REQUIRE(TryRunUntil(world, "P1", "PauseResult Failed"));
    CHECK(world.GetTraceOf("command LR01 Resume").size() == 1);
    StateChanged state;
    state.lastNodeID = world.GetRobot("LR01").GetOccupied().front();
    state.bAutomatic = false;
    world.Raise("LR01", state);
    state.bPaused = true;
    world.Raise("LR01", state);
    CHECK(world.GetTraceOf("command LR01 Resume").size() == 1);
    state.bAutomatic = true;
    world.Raise("LR01", state);
    CHECK(world.GetTraceOf("command LR01 Resume").size() == 2);
}
