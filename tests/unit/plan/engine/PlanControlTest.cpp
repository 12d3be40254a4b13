#include "fixtures/PlanWorldSteps.hpp"

#include <algorithm>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using ACS::Testing::BeginPlan;
using ACS::Testing::Contains;
using ACS::Testing::FindLine;
using ACS::Testing::FinishPlan;
using ACS::Testing::GetReportsAfter;
using ACS::Testing::Lines;
using ACS::Testing::MakeControlPlan;
using ACS::Testing::MakeLogisticsPlan;
using ACS::Testing::MakeWorld;
using ACS::Testing::PausePlan;
using ACS::Testing::PlanWorld;
using ACS::Testing::TryRunFor;
using ACS::Testing::TryRunUntil;

TEST_CASE("Several controls of one plan: a repeated one shares the outcome, each has one result")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Step 1 InProgress");
    const std::size_t before = world.GetReportsOf("P1").size();
    SECTION("pause twice, and resume before it is confirmed")
    {
        world.Control(EPlanControl::Pause, "P1");
        world.Control(EPlanControl::Pause, "P1");
        world.Control(EPlanControl::Resume, "P1");
        REQUIRE(world.TryRun());
        CHECK(
            GetReportsAfter(world, "P1", before)
            == Lines{"ResumeResult Failed", "Plan Paused", "PauseResult Success", "PauseResult Success"});
    }
    SECTION("pause, then cancel before it is confirmed")
    {
        world.Control(EPlanControl::Pause, "P1");
        world.Control(EPlanControl::Cancel, "P1");
        REQUIRE(world.TryRun());
        CHECK(
            GetReportsAfter(world, "P1", before)
            == Lines{"PauseResult Failed", "Plan Cancelled", "CancelResult Success"});
        CHECK_FALSE(world.GetRobot("LR01").IsPaused());
        CHECK(world.GetRobot("LR01").GetOccupied() == Lines{"D-CHG01"});
    }
    SECTION("cancel, then abort")
    {
        world.Control(EPlanControl::Cancel, "P1");
        world.Control(EPlanControl::Abort, "P1");
        REQUIRE(world.TryRun());
        CHECK(
            GetReportsAfter(world, "P1", before)
            == Lines{"CancelResult Failed", "Plan Aborted", "AbortResult Success"});
        CHECK(world.GetTraceOf("command LR01 CancelDrive").size() == 1);
    }
    SECTION("abort, then everything else")
    {
        world.Control(EPlanControl::Abort, "P1");
        world.Control(EPlanControl::Cancel, "P1");
        world.Control(EPlanControl::Pause, "P1");
        world.Control(EPlanControl::Resume, "P1");
        world.Control(EPlanControl::Abort, "P1");
        REQUIRE(world.TryRun());
        CHECK(
            GetReportsAfter(world, "P1", before)
            == Lines{
                "CancelResult Failed",
                "PauseResult Failed",
                "ResumeResult Failed",
                "Plan Aborted",
                "AbortResult Success",
                "AbortResult Success"});
    }
    SECTION("resume, then pause before it is confirmed")
    {
        world.Control(EPlanControl::Pause, "P1");
        REQUIRE(TryRunUntil(world, "P1", "PauseResult Success"));
        world.GetRobot("LR01").bIgnoresPause = true;
        world.Control(EPlanControl::Resume, "P1");
        world.Control(EPlanControl::Pause, "P1");
        REQUIRE(TryRunFor(world, std::chrono::seconds(1)));
        CHECK(GetReportsAfter(world, "P1", before + 2) == Lines{"ResumeResult Failed", "PauseResult Success"});
        CHECK(world.engine->GetPlanOrNull("P1")->state == EPlanState::Paused);
    }
    CHECK(world.violations == Lines{});
}

TEST_CASE("R5, R6, 13.6 CancelPlan one event before the arrival succeeds, one event after it fails")
{
    for (const bool bAfter : {false, true})
    {
        PlanWorld world;
        world.Connect();
        world.Submit(MakeLogisticsPlan("P1"));
        REQUIRE(world.TryRun([&world] { return world.GetRobot("LR01").GetOccupied() == Lines{"L02", "L03"}; }));
        if (bAfter)
        {
            REQUIRE(world.TryRun([&world] { return Contains(world.trace, "status LR01 Arrival A01.CP01"); }));
            CHECK(world.GetRobot("LR01").GetOccupied().front() == "L03"); // the last node before the dock
            world.Control(EPlanControl::Cancel, "P1");
            CHECK(world.GetReportsOf("P1").back() == "CancelResult Failed");
            REQUIRE(world.TryRun());
            CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
            continue;
        }
        // Requested and confirmed before the arrival: the robot had not moved.
        world.Control(EPlanControl::Cancel, "P1");
        const std::string driveID = world.driveIDs.at("LR01");
        world.Raise("LR01", DriveCancelled{driveID, "L02"});
        CHECK(GetReportsAfter(world, "P1", 3) == Lines{"Plan Cancelled", "CancelResult Success"});
    }
}

TEST_CASE("R6 A cancel that is overtaken by the arrival fails, and the plan continues")
{
    PlanWorld world;
    world.Connect();
    world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(world.TryRun([&world] { return world.GetRobot("LR01").GetOccupied() == Lines{"L02", "L03"}; }));
    world.GetRobot("LR01").bIgnoresDriveCancel = true;
    world.Control(EPlanControl::Cancel, "P1");
    REQUIRE(world.TryRun());
    CHECK(world.GetTraceOf("status LR01 Arrival") == Lines{" A01.CP01", " A02.CP03"});
    CHECK(FindLine(world, "status LR01 Arrival", 0) < FindLine(world, "status LR01 Docking", 0));
    CHECK(Contains(world.GetReportsOf("P1"), "CancelResult Failed"));
    CHECK_FALSE(Contains(world.GetReportsOf("P1"), "Plan Cancelled"));
    CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
}

TEST_CASE("D-14 cancel.until dispatch: a plan that a robot has is not cancelled")
{
    PlanWorld world = MakeWorld([](EngineOptions& options) { options.controls.cancelUntil = ECancelWindow::Dispatch; });
    world.Submit(MakeLogisticsPlan("P1"));
    world.Control(EPlanControl::Cancel, "P1");
    CHECK(world.GetReportsOf("P1") == Lines{"Plan Cancelled", "CancelResult Success"});
    world.Connect();
    world.Submit(MakeLogisticsPlan("P2"));
    REQUIRE(TryRunUntil(world, "P2", "Step 1 Dispatched"));
    world.Control(EPlanControl::Cancel, "P2");
    CHECK(world.GetReportsOf("P2").back() == "CancelResult Failed");
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P2").back() == "Plan Completed");
}

TEST_CASE("D-14 cancel.until first_job: a plan is cancelled after the arrival until its first job begins")
{
    PlanWorld world = MakeWorld([](EngineOptions& options) { options.controls.cancelUntil = ECancelWindow::FirstJob; });
    BeginPlan(world, MakeControlPlan("P1"), "Step 1 InProgress");
    SECTION("it waits at the place")
    {
        world.Raise("CR01", LinkChanged{false});
        REQUIRE(world.TryRun([&world] { return world.GetRobot("CR01").GetOccupied() == Lines{"D-A01.CP01"}; }));
        world.Control(EPlanControl::Cancel, "P1");
        CHECK(world.GetReportsOf("P1").back() == "CancelResult Success");
    }
    SECTION("it arrives while it is called back")
    {
        REQUIRE(world.TryRun([&world] { return world.GetRobot("CR01").GetOccupied().back() == "D-A01.CP01"; }));
        world.Control(EPlanControl::Cancel, "P1");
        REQUIRE(world.TryRun());
        CHECK(world.GetReportsOf("P1").back() == "CancelResult Success");
    }
    SECTION("it works")
    {
        REQUIRE(TryRunUntil(world, "P1", "Job 1 P1-cd Instructed"));
        world.Control(EPlanControl::Cancel, "P1");
        CHECK(world.GetReportsOf("P1").back() == "CancelResult Failed");
    }
}

TEST_CASE("9 cancel.confirm_timeout: a cancel that the robot does not confirm fails, and the plan continues")
{
    PlanWorld world =
        MakeWorld([](EngineOptions& options) { options.controls.cancelTimeout = std::chrono::milliseconds(900); });
    BeginPlan(world, MakeLogisticsPlan("P1"), "Step 1 InProgress");
    world.GetRobot("LR01").bIgnoresDriveCancel = true;
    world.GetRobot("LR01").bIgnoresPause = true;
    world.Control(EPlanControl::Cancel, "P1");
    const auto asked = world.GetNow().steady;
    REQUIRE(TryRunUntil(world, "P1", "CancelResult Failed"));
    CHECK(world.GetNow().steady - asked == std::chrono::milliseconds(900));
    FinishPlan(world);
}

TEST_CASE("9 A paused plan whose cancel is not confirmed stays paused, and its robot is commanded to pause again")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Step 1 InProgress");
    PausePlan(world);
    world.GetRobot("LR01").bIgnoresDriveCancel = true;
    world.GetRobot("LR01").bIgnoresPause = true;
    const std::size_t line = world.trace.size();
    world.Control(EPlanControl::Cancel, "P1");
    // The robot may have to drive to the next node before it stops.
    CHECK(FindLine(world, "command LR01 CancelDrive", line) < FindLine(world, "command LR01 Resume", line));
    CHECK(FindLine(world, "command LR01 Resume", line) < world.trace.size());
    REQUIRE(TryRunUntil(world, "P1", "CancelResult Failed"));
    CHECK(world.engine->GetPlanOrNull("P1")->state == EPlanState::Paused);
    CHECK(FindLine(world, "command LR01 Pause", line) < world.trace.size());
}

TEST_CASE("R7, 13.7 AbortPlan during job 2 of 5: the end of the job, the end of the plan and the result are reported")
{
    PlanWorld world;
    world.Connect();
    Plan plan = MakeControlPlan("P1");
    plan.steps.erase(plan.steps.begin() + 1, plan.steps.end());
    plan.steps[0].action = "MemoryPickAndPlace";
    plan.steps[0].position = "A01.SET01";
    plan.steps[0].carrierIDs.clear();
    plan.steps[0].jobs.clear();
    for (const std::string number : {"1", "2", "3", "4", "5"})
    {
        plan.steps[0].jobs.push_back({"J" + number, "AMR.TP01.MP0" + number, "A01.SET01.MP0" + number});
    }
    world.Ask(SetCarriers{"CR01", {"TRAY_01", {}, {}}, 0});
    world.Submit(plan);
    REQUIRE(TryRunUntil(world, "P1", "Job 1 J2 InProgress"));
    const std::size_t before = world.GetReportsOf("P1").size();
    world.Control(EPlanControl::Abort, "P1");
    REQUIRE(world.TryRun());
    CHECK(GetReportsAfter(world, "P1", before) == Lines{"Job 1 J2 Completed", "Plan Aborted", "AbortResult Success"});
    CHECK(world.GetRobot("CR01").doneJobs == Lines{"J1", "J2"});
}

TEST_CASE("D-15 abort.running_job stop: the job is dropped and the plan aborted at once")
{
    PlanWorld world = MakeWorld([](EngineOptions& options) { options.controls.bAbortStopsJob = true; });
    BeginPlan(world, MakeLogisticsPlan("P1"), "Job 1 P1-a4 InProgress");
    const std::size_t before = world.GetReportsOf("P1").size();
    world.Control(EPlanControl::Abort, "P1");
    CHECK(GetReportsAfter(world, "P1", before) == Lines{"Error ACS-1007 set", "Plan Aborted", "AbortResult Success"});
    REQUIRE(world.TryRun());
    CHECK(GetReportsAfter(world, "P1", before).size() == 3);
    CHECK(world.GetRobot("LR01").doneJobs.empty());
    CHECK(world.GetRobot("LR01").GetOccupied() == Lines{"D-CHG01"});
}

TEST_CASE("D-17 A job that fails during an abort fails step, plan and abort, or by option only the job")
{
    for (const bool bFails : {true, false})
    {
        PlanWorld world =
            MakeWorld([bFails](EngineOptions& options) { options.controls.bJobFailureFailsAbort = bFails; });
        world.Connect();
        world.GetRobot("LR01").failingJobs.insert("P1-a4");
        world.Submit(MakeLogisticsPlan("P1"));
        REQUIRE(TryRunUntil(world, "P1", "Job 1 P1-a4 InProgress"));
        const std::size_t before = world.GetReportsOf("P1").size();
        world.Control(EPlanControl::Abort, "P1");
        REQUIRE(world.TryRun());
        CHECK(
            GetReportsAfter(world, "P1", before)
            == (bFails ? Lines{"Job 1 P1-a4 Failed", "Step 1 Failed", "Plan Failed", "AbortResult Failed"}
                       : Lines{"Job 1 P1-a4 Failed", "Plan Aborted", "AbortResult Success"}));
    }
}

TEST_CASE("D-18 abort.report_step decides whether the step that ends with the last job of an aborted plan is reported")
{
    for (const bool bReported : {false, true})
    {
        PlanWorld world =
            MakeWorld([bReported](EngineOptions& options) { options.controls.bAbortReportsStep = bReported; });
        world.Connect();
        world.Submit(MakeLogisticsPlan("P1"));
        REQUIRE(TryRunUntil(world, "P1", "Job 1 P1-a4 InProgress"));
        world.Control(EPlanControl::Abort, "P1");
        REQUIRE(world.TryRun());
        CHECK(Contains(world.GetReportsOf("P1"), "Step 1 Completed") == bReported);
        CHECK(world.GetReportsOf("P1").back() == "AbortResult Success");
    }
}

TEST_CASE("D-19, D-20 Controls of unknown and of finished plans have one result with the reason, by option")
{
    for (const bool bReported : {true, false})
    {
        PlanWorld world =
            MakeWorld([bReported](EngineOptions& options) { options.controls.bResultAfterRefusal = bReported; });
        world.Connect();
        world.Submit(MakeLogisticsPlan("P1"));
        REQUIRE(world.TryRun());
        const std::size_t before = world.GetReportsOf("P1").size();
        Lines finished;
        for (const auto control :
             {EPlanControl::Cancel, EPlanControl::Abort, EPlanControl::Pause, EPlanControl::Resume})
        {
            world.Control(control, "P9", 1);
            CHECK_FALSE(world.replies.at(1).bAccepted);
            world.Control(control, "P1", 2);
            CHECK(world.replies.at(2).bAccepted);
            finished.push_back(std::string(GetText(control)) + "Result Failed");
        }
        CHECK(world.GetReportsOf("P9") == (bReported ? finished : Lines{}));
        CHECK(GetReportsAfter(world, "P1", before) == finished);
    }
}
