#include "Catch.hpp"
#include "PlanWorld.hpp"

#include <algorithm>
#include <functional>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using ACS::Testing::MakeControlPlan;
using ACS::Testing::MakeLogisticsPlan;
using ACS::Testing::MakeTestOptions;
using ACS::Testing::MakeTestSite;
using ACS::Testing::PlanWorld;

namespace
{

using Lines = std::vector<std::string>;

bool Contains(const Lines& lines, const std::string& line)
{
    return std::ranges::find(lines, line) != lines.end();
}

bool TryRunUntil(PlanWorld& world, const std::string& planID, const std::string& report)
{
    return world.TryRun([&world, planID, report] { return Contains(world.GetReportsOf(planID), report); });
}

bool TryRunFor(PlanWorld& world, std::chrono::milliseconds time)
{
    const auto end = world.GetNow().steady + time;
    return world.TryRun([&world, end] { return world.GetNow().steady >= end; });
}

/// The reports of the plan behind the first so many.
Lines GetReportsAfter(const PlanWorld& world, const std::string& planID, std::size_t count)
{
    const Lines reports = world.GetReportsOf(planID);
    return {reports.begin() + static_cast<std::ptrdiff_t>(std::min(count, reports.size())), reports.end()};
}

/// A world whose options were changed, with its robots at home.
PlanWorld MakeWorld(const std::function<void(EngineOptions&)>& change)
{
    EngineOptions options = MakeTestOptions(false);
    change(options);
    return {1, options, MakeTestSite()};
}

/// Where in the trace a line stands that begins so, from an index on; the trace's size where none does.
std::size_t Find(const PlanWorld& world, const std::string& start, std::size_t from)
{
    const auto found = std::find_if(
        world.trace.begin() + static_cast<std::ptrdiff_t>(from),
        world.trace.end(),
        [&start](const std::string& line) { return line.starts_with(start); });
    return static_cast<std::size_t>(found - world.trace.begin());
}

} // namespace

TEST_CASE(
    "R8, 6.7 Pause in a drive: the robot stands, then its status, the plan and the result are told; Resume goes on")
{
    PlanWorld world;
    world.Connect();
    world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(TryRunUntil(world, "P1", "Step 1 InProgress"));
    const std::size_t before = world.GetReportsOf("P1").size();
    const std::size_t line = world.trace.size();
    world.Control(EPlanControl::Pause, "P1", 4);
    CHECK(world.replies.at(4).bAccepted);
    CHECK(GetReportsAfter(world, "P1", before).empty());
    REQUIRE(TryRunUntil(world, "P1", "PauseResult Success"));
    CHECK(GetReportsAfter(world, "P1", before) == Lines{"Plan Paused", "PauseResult Success"});
    CHECK(world.GetRobot("LR01").IsPaused());
    CHECK(world.engine->GetPlanOrNull("P1")->state == EPlanState::Paused);
    const std::size_t status = Find(world, "status LR01 Stopped", line);
    CHECK(Find(world, "command LR01 Pause", line) < status);
    CHECK(status < Find(world, "report P1 Plan Paused", line));

    REQUIRE(world.TryRun()); // nothing moves any more
    CHECK(GetReportsAfter(world, "P1", before).size() == 2);
    const std::size_t resumed = world.trace.size();
    world.Control(EPlanControl::Resume, "P1");
    REQUIRE(world.TryRun());
    const Lines after = GetReportsAfter(world, "P1", before + 2);
    CHECK(Lines(after.begin(), after.begin() + 2) == Lines{"Plan InProgress", "ResumeResult Success"});
    CHECK(after.back() == "Plan Completed");
    CHECK(Find(world, "status LR01 Moving", resumed) < Find(world, "report P1 Plan InProgress", resumed));
    CHECK(world.violations == Lines{});
}

TEST_CASE("R8, 6.7 Pause in a job stops it where it is, and Resume has it done, once")
{
    PlanWorld world;
    world.Connect();
    world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(TryRunUntil(world, "P1", "Job 1 P1-a4 InProgress"));
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
    CHECK(Find(world, "status LR01 Working", line) < Find(world, "report P1 Plan InProgress", line));
    CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
    CHECK(world.GetRobot("LR01").doneJobs == Lines{"P1-a4", "P1-b2"});
}

TEST_CASE("D-22 A job that the robot cannot pause comes to its end first, and the next is begun after Resume")
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
    "D-22 pause.mode after_job: the running job ends, the robot is not asked to stop, and nothing further is begun")
{
    PlanWorld world = MakeWorld([](EngineOptions& options) { options.controls.bPausesAfterJob = true; });
    world.Connect();
    world.Submit(MakeControlPlan("P1"));
    REQUIRE(TryRunUntil(world, "P1", "Job 1 P1-cd InProgress"));
    const std::size_t before = world.GetReportsOf("P1").size();
    world.Control(EPlanControl::Pause, "P1");
    REQUIRE(world.TryRun());
    CHECK(GetReportsAfter(world, "P1", before) == Lines{"Job 1 P1-cd Completed", "Plan Paused", "PauseResult Success"});
    CHECK_FALSE(Contains(world.trace, "command CR01 Pause"));
    CHECK(world.engine->GetRobotStatuses()[1].status == ERobotStatus::Stopped);
    CHECK(world.engine->GetPlanOrNull("P1")->jobID == "P1-b3");
    world.Control(EPlanControl::Resume, "P1");
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
}

TEST_CASE("9 pause.confirm_timeout: a robot that does not stop makes the pause fail, and the plan goes on")
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
    CHECK(Contains(world.trace, "command LR01 Resume")); // it may have heard after all
    REQUIRE(world.TryRun());
    CHECK_FALSE(Contains(world.GetReportsOf("P1"), "Plan Paused"));
    CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
}

TEST_CASE("9 A pause that fails after its job was done has the plan go on with what comes next")
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

TEST_CASE("7 A plan that waits for a robot is held in the queue, and takes its place in it when it is resumed")
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

TEST_CASE("6.7 Pause of a robot that stands and waits is told at once, and it is not driven before Resume")
{
    PlanWorld world;
    world.Connect();
    Plan control = MakeControlPlan("P2");
    control.priority = 20;
    world.Submit(control);
    REQUIRE(TryRunUntil(world, "P2", "Job 1 P2-cd InProgress"));
    world.Submit(MakeLogisticsPlan("P1")); // wants the dock where the other one works
    REQUIRE(TryRunUntil(world, "P1", "Step 1 Dispatched"));
    world.Control(EPlanControl::Pause, "P1");
    CHECK(world.GetReportsOf("P1").back() == "PauseResult Success");
    CHECK(world.engine->GetRobotStatuses()[0].status == ERobotStatus::Stopped);
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P2").back() == "Plan Completed");
    CHECK(world.GetRobot("LR01").drives == 0);
    CHECK_FALSE(Contains(world.trace, "command LR01 Pause"));
    world.Control(EPlanControl::Resume, "P1");
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
}

TEST_CASE("D-21 Pause of a paused plan succeeds again, Resume of one that runs or waits fails")
{
    PlanWorld world;
    world.Submit(MakeLogisticsPlan("P1"));
    world.Control(EPlanControl::Resume, "P1");
    CHECK(world.GetReportsOf("P1") == Lines{"ResumeResult Failed"});
    world.Connect();
    REQUIRE(TryRunUntil(world, "P1", "Step 1 InProgress"));
    world.Control(EPlanControl::Resume, "P1");
    CHECK(world.GetReportsOf("P1").back() == "ResumeResult Failed");
    world.Control(EPlanControl::Pause, "P1");
    REQUIRE(TryRunUntil(world, "P1", "PauseResult Success"));
    const std::size_t before = world.GetReportsOf("P1").size();
    world.Control(EPlanControl::Pause, "P1");
    CHECK(GetReportsAfter(world, "P1", before) == Lines{"PauseResult Success"});
    world.Control(EPlanControl::Resume, "P1");
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
}

TEST_CASE("Controls that meet on one plan: the same one again shares the outcome, each has one result")
{
    PlanWorld world;
    world.Connect();
    world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(TryRunUntil(world, "P1", "Step 1 InProgress"));
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

TEST_CASE("6.8 A robot that does not go on leaves its plan paused, and the result says so")
{
    PlanWorld world;
    world.Connect();
    world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(TryRunUntil(world, "P1", "Step 1 InProgress"));
    world.Control(EPlanControl::Pause, "P1");
    REQUIRE(TryRunUntil(world, "P1", "PauseResult Success"));
    world.GetRobot("LR01").bIgnoresPause = true;
    world.Control(EPlanControl::Resume, "P1");
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1").back() == "ResumeResult Failed");
    CHECK(world.engine->GetPlanOrNull("P1")->state == EPlanState::Paused);
    world.GetRobot("LR01").bIgnoresPause = false;
    world.Control(EPlanControl::Resume, "P1");
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
}

TEST_CASE("6.7 A robot that is lost while it is to pause is told again when it is back")
{
    PlanWorld world;
    world.Connect();
    world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(TryRunUntil(world, "P1", "Step 1 InProgress"));
    world.GetRobot("LR01").bIgnoresPause = true;
    world.Raise("LR01", LinkChanged{false});
    world.Control(EPlanControl::Pause, "P1");
    CHECK(world.GetReportsOf("P1").back() == "Step 1 InProgress");
    world.GetRobot("LR01").bIgnoresPause = false;
    REQUIRE(TryRunFor(world, std::chrono::seconds(1)));
    world.Connect();
    REQUIRE(TryRunUntil(world, "P1", "PauseResult Success"));

    // Nor does it go on by itself after another loss.
    world.Raise("LR01", LinkChanged{false});
    world.Operate("LR01", Resume{});
    const std::size_t line = world.trace.size();
    world.Connect();
    CHECK(Find(world, "command LR01 Pause", line) < world.trace.size());
    world.Control(EPlanControl::Resume, "P1");
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
}

TEST_CASE("D-16 Abort of a paused plan drops its job, tells where to look, and the robot is used again")
{
    PlanWorld world;
    world.Connect();
    world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(TryRunUntil(world, "P1", "Job 1 P1-a4 InProgress"));
    world.Control(EPlanControl::Pause, "P1");
    REQUIRE(TryRunUntil(world, "P1", "PauseResult Success"));
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

TEST_CASE("D-16 abort.paused_job finish: the paused job is done, then the plan is aborted")
{
    PlanWorld world = MakeWorld([](EngineOptions& options) { options.controls.bAbortFinishesPausedJob = true; });
    world.Connect();
    world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(TryRunUntil(world, "P1", "Job 1 P1-a4 InProgress"));
    world.Control(EPlanControl::Pause, "P1");
    REQUIRE(TryRunUntil(world, "P1", "PauseResult Success"));
    const std::size_t before = world.GetReportsOf("P1").size();
    world.Control(EPlanControl::Abort, "P1");
    REQUIRE(world.TryRun());
    CHECK(
        GetReportsAfter(world, "P1", before) == Lines{"Job 1 P1-a4 Completed", "Plan Aborted", "AbortResult Success"});
    CHECK(world.GetRobot("LR01").doneJobs == Lines{"P1-a4"});
}

TEST_CASE("6.6 Abort of a plan that is paused in a drive stands the robot free again")
{
    PlanWorld world;
    world.Connect();
    world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(TryRunUntil(world, "P1", "Step 1 InProgress"));
    world.Control(EPlanControl::Pause, "P1");
    REQUIRE(TryRunUntil(world, "P1", "PauseResult Success"));
    const std::size_t before = world.GetReportsOf("P1").size();
    world.Control(EPlanControl::Abort, "P1");
    REQUIRE(world.TryRun());
    CHECK(GetReportsAfter(world, "P1", before) == Lines{"Plan Aborted", "AbortResult Success"});
    CHECK(world.GetRobot("LR01").GetOccupied() == Lines{"D-CHG01"});
}

TEST_CASE("R5, 7 A paused plan is cancelled inside the window by way of the state that it was paused in")
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
    world.Connect();
    world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(TryRunUntil(world, "P1", "Job 1 P1-a4 InProgress"));
    world.Control(EPlanControl::Pause, "P1");
    REQUIRE(TryRunUntil(world, "P1", "PauseResult Success"));
    const std::size_t before = world.GetReportsOf("P1").size();
    world.Raise("LR01", JobFailed{"P1-a4", "the gripper let go"});
    CHECK(
        GetReportsAfter(world, "P1", before)
        == Lines{"Plan InProgress", "Job 1 P1-a4 Failed", "Step 1 Failed", "Plan Failed"});
    REQUIRE(world.TryRun());
    CHECK(world.GetRobot("LR01").IsPaused() == false);
}

TEST_CASE("6.7 A job that ends though its plan is paused is told, and what comes next waits for Resume")
{
    PlanWorld world;
    world.Connect();
    Plan plan = MakeLogisticsPlan("P1");
    plan.steps.pop_back();
    world.Submit(plan);
    REQUIRE(TryRunUntil(world, "P1", "Job 1 P1-a4 InProgress"));
    world.Control(EPlanControl::Pause, "P1");
    REQUIRE(TryRunUntil(world, "P1", "PauseResult Success"));
    const std::size_t before = world.GetReportsOf("P1").size();
    world.Raise("LR01", JobFinished{"P1-a4"});
    CHECK(GetReportsAfter(world, "P1", before) == Lines{"Job 1 P1-a4 Completed", "Step 1 Completed"});
    world.Control(EPlanControl::Resume, "P1");
    REQUIRE(world.TryRun());
    CHECK(
        GetReportsAfter(world, "P1", before + 2) == Lines{"Plan InProgress", "ResumeResult Success", "Plan Completed"});
}

TEST_CASE("A job's time limit stands still while its plan is paused")
{
    PlanWorld world = MakeWorld(
        [](EngineOptions& options) { options.actions.at("CassetteLoad").timeout = std::chrono::seconds(10); });
    world.Connect();
    world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(TryRunUntil(world, "P1", "Job 1 P1-a4 InProgress"));
    world.Control(EPlanControl::Pause, "P1");
    REQUIRE(TryRunUntil(world, "P1", "PauseResult Success"));
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1").back() == "PauseResult Success");
    world.GetRobot("LR01").bIgnoresPause = true; // goes on as far as it tells, and does nothing
    StateChanged state;
    state.lastNodeID = world.GetRobot("LR01").GetOccupied().front();
    world.Control(EPlanControl::Resume, "P1");
    world.Raise("LR01", state);
    const auto resumed = world.GetNow().steady;
    REQUIRE(TryRunUntil(world, "P1", "Plan Failed"));
    CHECK(world.GetNow().steady - resumed > std::chrono::seconds(4));
    CHECK(world.GetNow().steady - resumed < std::chrono::seconds(10));
}

TEST_CASE("R5, R6, 13.6 CancelPlan one event before the arrival succeeds, one event after it fails")
{
    for (const bool bAfter : {false, true})
    {
        PlanWorld world;
        world.Connect();
        world.Submit(MakeLogisticsPlan("P1"));
        REQUIRE(world.TryRun([&world] { return world.GetRobot("LR01").GetOccupied() == Lines{"L03", "D-A01.CP01"}; }));
        if (bAfter)
        {
            REQUIRE(world.TryRun([&world] { return Contains(world.trace, "status LR01 Arrival A01.CP01"); }));
            world.Control(EPlanControl::Cancel, "P1");
            CHECK(world.GetReportsOf("P1").back() == "CancelResult Failed");
            REQUIRE(world.TryRun());
            CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
            continue;
        }
        // What is asked before and confirmed before: the robot turns out to have stood still.
        world.Control(EPlanControl::Cancel, "P1");
        const std::string driveID = world.driveIDs.at("LR01");
        world.Raise("LR01", DriveCancelled{driveID, "L03"});
        CHECK(GetReportsAfter(world, "P1", 3) == Lines{"Plan Cancelled", "CancelResult Success"});
    }
}

TEST_CASE("R6 A cancel that is overtaken by the arrival fails, and the plan goes on")
{
    PlanWorld world;
    world.Connect();
    world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(world.TryRun([&world] { return world.GetRobot("LR01").GetOccupied() == Lines{"L03", "D-A01.CP01"}; }));
    world.Control(EPlanControl::Cancel, "P1");
    REQUIRE(world.TryRun());
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

TEST_CASE("D-14 cancel.until first_job: a robot that has arrived and has not begun to work can be called back")
{
    PlanWorld world = MakeWorld([](EngineOptions& options) { options.controls.cancelUntil = ECancelWindow::FirstJob; });
    world.Connect();
    world.Submit(MakeControlPlan("P1"));
    REQUIRE(TryRunUntil(world, "P1", "Step 1 InProgress"));
    SECTION("it waits at the place")
    {
        world.Raise("CR01", LinkChanged{false});
        REQUIRE(world.TryRun([&world] { return Contains(world.trace, "status CR01 Arrival A01.CP01"); }));
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

TEST_CASE("9 cancel.confirm_timeout: a robot that does not confirm makes the cancel fail, and the plan goes on")
{
    PlanWorld world =
        MakeWorld([](EngineOptions& options) { options.controls.cancelTimeout = std::chrono::milliseconds(900); });
    world.Connect();
    world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(TryRunUntil(world, "P1", "Step 1 InProgress"));
    world.GetRobot("LR01").bIgnoresDriveCancel = true;
    world.GetRobot("LR01").bIgnoresPause = true;
    world.Control(EPlanControl::Cancel, "P1");
    const auto asked = world.GetNow().steady;
    REQUIRE(TryRunUntil(world, "P1", "CancelResult Failed"));
    CHECK(world.GetNow().steady - asked == std::chrono::milliseconds(900));
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
}

TEST_CASE("9 A paused plan whose cancel is not confirmed stays paused, and its robot is told to pause again")
{
    PlanWorld world;
    world.Connect();
    world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(TryRunUntil(world, "P1", "Step 1 InProgress"));
    world.Control(EPlanControl::Pause, "P1");
    REQUIRE(TryRunUntil(world, "P1", "PauseResult Success"));
    world.GetRobot("LR01").bIgnoresDriveCancel = true;
    world.GetRobot("LR01").bIgnoresPause = true;
    const std::size_t line = world.trace.size();
    world.Control(EPlanControl::Cancel, "P1");
    // It may have to drive on to the next node before it can stop for good.
    CHECK(Find(world, "command LR01 CancelDrive", line) < Find(world, "command LR01 Resume", line));
    CHECK(Find(world, "command LR01 Resume", line) < world.trace.size());
    REQUIRE(TryRunUntil(world, "P1", "CancelResult Failed"));
    CHECK(world.engine->GetPlanOrNull("P1")->state == EPlanState::Paused);
    CHECK(Find(world, "command LR01 Pause", line) < world.trace.size());
}

TEST_CASE("R7, 13.7 AbortPlan during job 2 of 5: exactly its end, the plan's and the result")
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
    world.Connect();
    world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(TryRunUntil(world, "P1", "Job 1 P1-a4 InProgress"));
    const std::size_t before = world.GetReportsOf("P1").size();
    world.Control(EPlanControl::Abort, "P1");
    CHECK(GetReportsAfter(world, "P1", before) == Lines{"Error ACS-1007 set", "Plan Aborted", "AbortResult Success"});
    REQUIRE(world.TryRun());
    CHECK(GetReportsAfter(world, "P1", before).size() == 3);
    CHECK(world.GetRobot("LR01").doneJobs.empty());
    CHECK(world.GetRobot("LR01").GetOccupied() == Lines{"D-CHG01"});
}

TEST_CASE("D-17 A job that fails during an abort fails step and plan, and the abort; or just itself, by the key")
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

TEST_CASE("D-18 abort.report_step: the step that ends with the last job of an aborted plan is told, or not")
{
    for (const bool bTold : {false, true})
    {
        PlanWorld world = MakeWorld([bTold](EngineOptions& options) { options.controls.bAbortReportsStep = bTold; });
        world.Connect();
        world.Submit(MakeLogisticsPlan("P1"));
        REQUIRE(TryRunUntil(world, "P1", "Job 1 P1-a4 InProgress"));
        world.Control(EPlanControl::Abort, "P1");
        REQUIRE(world.TryRun());
        CHECK(Contains(world.GetReportsOf("P1"), "Step 1 Completed") == bTold);
        CHECK(world.GetReportsOf("P1").back() == "AbortResult Success");
    }
}

TEST_CASE("D-19, D-20 Controls of unknown and of finished plans have one result that says why, by the key")
{
    for (const bool bTold : {true, false})
    {
        PlanWorld world = MakeWorld([bTold](EngineOptions& options) { options.controls.bResultAfterRefusal = bTold; });
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
        CHECK(world.GetReportsOf("P9") == (bTold ? finished : Lines{}));
        CHECK(GetReportsAfter(world, "P1", before) == finished);
    }
}
