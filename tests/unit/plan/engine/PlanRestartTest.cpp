#include "fixtures/PlanWorldSteps.hpp"

#include <algorithm>
#include <chrono>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace std::chrono_literals;
using ACS::Testing::BeginPlan;
using ACS::Testing::CountStarts;
using ACS::Testing::GetReportsAfter;
using ACS::Testing::Lines;
using ACS::Testing::MakeControlPlan;
using ACS::Testing::MakeLogisticsPlan;
using ACS::Testing::MakeTestOptions;
using ACS::Testing::MakeTestSite;
using ACS::Testing::PlanWorld;
using ACS::Testing::RestartEngine;
using ACS::Testing::TryRunFor;
using ACS::Testing::TryRunUntil;

namespace
{

const Lines LOGISTICS_REPORTS{
    "Plan InProgress",
    "Step 1 Dispatched",
    "Step 1 InProgress",
    "Job 1 P1-a4 Instructed",
    "Job 1 P1-a4 InProgress",
    "Job 1 P1-a4 Completed",
    "Step 1 Completed",
    "Step 2 Dispatched",
    "Step 2 InProgress",
    "Job 2 P1-b2 Instructed",
    "Job 2 P1-b2 InProgress",
    "Job 2 P1-b2 Completed",
    "Step 2 Completed",
    "Plan Completed"};

/// P1, whose first job runs, after a restart. The outcome of the job is unknown.
void BeginUnresolved(PlanWorld& world)
{
    BeginPlan(world, MakeLogisticsPlan("P1"), "Job 1 P1-a4 InProgress");
    world.GetRobot("LR01").unresolvedReason = "it was switched off";
    RestartEngine(world);
    REQUIRE(world.engine->GetActiveAlarms().size() == 1);
    const Alarm& alarm = world.engine->GetActiveAlarms().front();
    CHECK(alarm.errorCode == "ACS-1008");
    CHECK(alarm.level == EAlarmLevel::Heavy);
    CHECK(alarm.planID == "P1");
    CHECK(alarm.jobID == "P1-a4");
    CHECK(alarm.message.find("it was switched off") != std::string::npos);
}

} // namespace

TEST_CASE("13.8 After a crash at any action and a restart each state is reported once in order, each job is done once")
{
    for (std::size_t action = 0; action < 400; ++action)
    {
        INFO("action " << action);
        PlanWorld world(action + 1);
        world.Connect();
        world.CrashAtAction(action);
        world.Submit(MakeLogisticsPlan("P1"), 1, "T1");
        static_cast<void>(world.TryRun([&world] { return world.engine == nullptr; }));
        const bool bCrashed = world.engine == nullptr;
        if (bCrashed)
        {
            const auto pause = std::chrono::milliseconds(world.GetRandom(4) * world.GetRandom(3'000));
            static_cast<void>(TryRunFor(world, pause)); // The robot continues without the engine.
            RestartEngine(world);
            world.Submit(MakeLogisticsPlan("P1"), 2, "T1"); // its Ack may have been lost
            CHECK(world.replies.at(2).bAccepted);
        }
        REQUIRE(world.TryRun());
        CHECK(world.violations == Lines{});
        CHECK(world.GetReportsOf("P1") == LOGISTICS_REPORTS);
        CHECK(world.GetRobot("LR01").doneJobs == Lines{"P1-a4", "P1-b2"});
        CHECK(world.engine->GetActiveAlarms().empty());
        if (!bCrashed)
        {
            return; // the plan has fewer actions
        }
    }
    FAIL("the plan has more actions than were crashed at");
}

TEST_CASE("13.8 Crashes at random moments with four robots: every plan ends and every job is done once")
{
    for (std::uint64_t seed = 1; seed <= 80; ++seed)
    {
        INFO("seed " << seed);
        PlanWorld world(seed, true);
        world.Connect();
        std::size_t jobs = 0;
        for (const char* planID : {"P1", "P2", "P3", "P4"})
        {
            world.Submit(MakeLogisticsPlan(planID), 0, planID);
            world.Submit(MakeControlPlan(planID + std::string("C")), 0, planID);
            jobs += 8;
        }
        for (int crash = 0; crash < 12; ++crash)
        {
            world.CrashAtAction(world.GetRandom(150));
            static_cast<void>(world.TryRun([&world] { return world.engine == nullptr; }));
            static_cast<void>(TryRunFor(world, std::chrono::milliseconds(world.GetRandom(5'000))));
            world.Restart(MakeTestOptions(true), MakeTestSite());
            world.Connect();
        }
        REQUIRE(world.TryRun());
        CHECK(world.violations == Lines{});
        CHECK(world.engine->GetActivePlans().empty());
        std::vector<std::string> done;
        for (const char* robotID : {"LR01", "LR02", "CR01", "CR02"})
        {
            const Lines& ofRobot = world.GetRobot(robotID).doneJobs;
            done.insert(done.end(), ofRobot.begin(), ofRobot.end());
        }
        std::ranges::sort(done);
        CHECK(done.size() == jobs);
        CHECK(std::ranges::adjacent_find(done) == done.end());
        for (const char* planID : {"P1", "P2C", "P4", "P4C"})
        {
            const Lines reports = world.GetReportsOf(planID);
            CHECK(std::ranges::count(reports, "Plan Completed") == 1);
            CHECK(reports.back() == "Plan Completed");
        }
    }
}

TEST_CASE("A job that ended during a restart is reported once, done or failed, and never commanded again")
{
    for (const bool bFails : {false, true})
    {
        PlanWorld world;
        BeginPlan(world, MakeLogisticsPlan("P1"), "Job 1 P1-a4 InProgress");
        if (bFails)
        {
            world.GetRobot("LR01").failingJobs.insert("P1-a4");
        }
        world.Crash();
        static_cast<void>(TryRunFor(world, 10s));
        const std::size_t told = world.GetReportsOf("P1").size();
        RestartEngine(world);
        REQUIRE(world.TryRun());
        const Lines reports = GetReportsAfter(world, "P1", told);
        CHECK(reports.front() == (bFails ? "Job 1 P1-a4 Failed" : "Job 1 P1-a4 Completed"));
        CHECK(reports.back() == (bFails ? "Plan Failed" : "Plan Completed"));
        CHECK(CountStarts(world, "P1-a4") == 1);
    }
}

TEST_CASE("A job whose outcome is unknown after a restart is unresolved: not repeated, its robot gets no other job")
{
    PlanWorld world;
    BeginUnresolved(world);
    world.Submit(MakeLogisticsPlan("P2"));
    REQUIRE(world.TryRun());
    CHECK(world.engine->GetPlanOrNull("P1")->state == EPlanState::InProgress);
    CHECK(world.engine->GetPlanOrNull("P2")->state == EPlanState::Pending);
    CHECK(CountStarts(world, "P1-a4") == 1);
    RestartEngine(world); // The same after another restart.
    REQUIRE(world.TryRun());
    CHECK(world.engine->GetActiveAlarms().size() == 1);
    CHECK(CountStarts(world, "P1-a4") == 1);
    CHECK(std::ranges::count(world.GetReportsOf("P1"), "Error ACS-1008 set") == 1);
}

TEST_CASE("The operator resolves a job as done, failed or again; later reports of the robot change nothing")
{
    for (const EJobResolution answer : {EJobResolution::Done, EJobResolution::Failed, EJobResolution::Again})
    {
        INFO(GetText(answer));
        PlanWorld world;
        BeginUnresolved(world);
        REQUIRE(world.TryRun());
        world.Raise("LR01", JobFailed{"P1-a4", "late report"});
        CHECK(world.engine->GetActiveAlarms().size() == 1);
        world.ResolveJob("P1", "P1-b2", answer, 7);
        CHECK_FALSE(world.replies.at(7).bAccepted);
        const std::size_t told = world.GetReportsOf("P1").size();
        world.ResolveJob("P1", "P1-a4", answer, 8);
        CHECK(world.replies.at(8).bAccepted);
        world.ResolveJob("P1", "P1-a4", answer, 9);
        CHECK_FALSE(world.replies.at(9).bAccepted);
        CHECK(world.engine->GetActiveAlarms().empty());
        REQUIRE(world.TryRun());
        const Lines reports = GetReportsAfter(world, "P1", told);
        CHECK(reports.front() == "Error ACS-1008 cleared");
        CHECK(reports.back() == (answer == EJobResolution::Failed ? "Plan Failed" : "Plan Completed"));
        CHECK(CountStarts(world, "P1-a4") == (answer == EJobResolution::Again ? 2 : 1));
        CHECK(CountStarts(world, "P1-b2") == (answer == EJobResolution::Failed ? 0 : 1));
        CHECK(std::ranges::count(world.GetReportsOf("P1"), "Job 1 P1-a4 InProgress") == 1);
    }
}

TEST_CASE("A plan whose job is unresolved can be aborted, and an alarm asks for a check")
{
    PlanWorld world;
    BeginUnresolved(world);
    REQUIRE(world.TryRun());
    const std::size_t told = world.GetReportsOf("P1").size();
    world.Control(EPlanControl::Abort, "P1");
    CHECK(
        GetReportsAfter(world, "P1", told)
        == Lines{"Error ACS-1007 set", "Plan Aborted", "AbortResult Success", "Error ACS-1008 cleared"});
    world.GetRobot("LR01").unresolvedReason.clear();
    world.Submit(MakeLogisticsPlan("P2"));
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P2").back() == "Plan Completed");
}

TEST_CASE("After a restart no robot sets out before every robot has reported its position, or 30 s have passed")
{
    for (const bool bAllThere : {true, false})
    {
        PlanWorld world(1, true);
        world.Connect();
        world.Submit(MakeLogisticsPlan("P1"));
        world.Restart(MakeTestOptions(true), MakeTestSite());
        const std::size_t before = world.GetTraceOf("command ").size();
        StateChanged state;
        for (const char* robotID : {"LR01", "CR01", "CR02"})
        {
            state.lastNodeID = world.GetRobot(robotID).GetOccupied().front();
            world.Raise(robotID, LinkChanged{true});
            world.Raise(robotID, state);
        }
        CHECK(world.GetTraceOf("command ").size() == before);
        if (bAllThere)
        {
            world.Connect();
        }
        const auto start = world.GetNow().steady;
        REQUIRE(world.TryRun([&world, before] { return world.GetTraceOf("command ").size() > before; }));
        CHECK(world.GetNow().steady - start == (bAllThere ? 0s : 30s));
    }
}

TEST_CASE("After a restart no robot waits for one that is in maintenance")
{
    PlanWorld world(1, true);
    BeginPlan(world, MakeLogisticsPlan("P1"), "Step 1 Dispatched");
    REQUIRE(world.store.Append({{MaintenanceChanged{"LR02", true}}}).has_value());
    world.Restart(MakeTestOptions(true), MakeTestSite());
    const std::size_t before = world.GetTraceOf("command ").size();
    StateChanged state;
    for (const char* robotID : {"LR01", "CR01", "CR02"})
    {
        CHECK(world.GetTraceOf("command ").size() == before);
        state.lastNodeID = world.GetRobot(robotID).GetOccupied().front();
        world.Raise(robotID, LinkChanged{true});
        world.Raise(robotID, state);
    }
    CHECK(world.GetTraceOf("command ").size() > before);
    REQUIRE(TryRunFor(world, 31s));
    const auto countAlarms = [&world] {
        return world.engine->GetActiveAlarms().size();
    };
    CHECK(countAlarms() == 0);
    world.Ask(SetMaintenance{"LR02", false});
    CHECK(countAlarms() == 1);
}

TEST_CASE("After a restart the nodes that a robot may still drive to are reserved for it")
{
    PlanWorld world(1, true);
    world.Connect();
    world.Restart(MakeTestOptions(true), MakeTestSite());
    world.Connect();
    StateChanged state;
    state.lastNodeID = "D-CHG03";
    state.bOccupied = true;
    state.heldNodeIDs = {"L15", "L16", "L01", "L02"};
    world.Raise("LR02", state);
    world.Submit(MakeLogisticsPlan("P1"));
    CHECK_FALSE(TryRunUntil(world, "P1", "Step 1 Dispatched")); // Its route begins on L01.
    CHECK(world.GetTraceOf("command LR01 ").empty());
    state.heldNodeIDs.clear();
    state.bOccupied = false;
    world.Raise("LR02", state);
    CHECK(world.GetTraceOf("command LR01 ").size() == 1);
}

TEST_CASE("After a restart the nodes where a missing robot may be are kept free until it is out of service")
{
    for (const bool bDriving : {false, true})
    {
        PlanWorld world(1, true);
        BeginPlan(world, MakeLogisticsPlan("P1"), bDriving ? "Step 1 InProgress" : "Job 1 P1-a4 InProgress");
        world.Crash();
        world.Restart(MakeTestOptions(true), MakeTestSite());
        for (const char* robotID : {"LR02", "CR01", "CR02"})
        {
            world.Raise(robotID, LinkChanged{true});
            world.PublishState(robotID);
        }
        REQUIRE(TryRunFor(world, MakeTestOptions(true).restartWait));
        world.Submit(MakeLogisticsPlan("P2")); // its first place is that of P1
        REQUIRE(world.TryRun());
        CHECK(world.GetTraceOf("command LR02 ").empty());
        world.Ask(SetMaintenance{"LR01", true, 0});
        REQUIRE(TryRunUntil(world, "P2", "Job 1 P2-a4 Completed"));
    }
}

TEST_CASE("After a restart the nodes where a connected robot may be are kept free in maintenance too")
{
    PlanWorld world(1, true);
    BeginPlan(world, MakeLogisticsPlan("P1"), "Step 1 InProgress");
    world.GetRobot("LR01").bStuck = true;
    REQUIRE(TryRunFor(world, 10s));
    world.Crash();
    world.Restart(MakeTestOptions(true), MakeTestSite());
    for (const char* const robotID : {"LR02", "CR01", "CR02"})
    {
        world.Raise(robotID, LinkChanged{true});
        world.PublishState(robotID);
    }
    world.Raise("LR01", LinkChanged{true});
    world.Raise("LR01", StateChanged{}); // on the floor, and it reports no node
    REQUIRE(TryRunFor(world, MakeTestOptions(true).restartWait));
    world.Submit(MakeLogisticsPlan("P2")); // from the same place
    world.Ask(SetMaintenance{"LR01", true, 0});
    static_cast<void>(TryRunFor(world, 120s));
    CHECK(world.GetTraceOf("command LR02 ").empty());
}

TEST_CASE("D-23, 13.5 The same plan under the same transactionId has the same answer again, also after a restart")
{
    PlanWorld world;
    world.Connect();
    world.Submit(MakeLogisticsPlan("P1"), 1, "T1");
    world.Submit(MakeLogisticsPlan("P1"), 2, "T1");
    RestartEngine(world);
    world.Submit(MakeLogisticsPlan("P1"), 3, "T1");
    REQUIRE(world.TryRun());
    RestartEngine(world);
    world.Submit(MakeLogisticsPlan("P1"), 4, "T1");
    for (const ReplyToken token : {2U, 3U, 4U})
    {
        CHECK(world.replies.at(token).bAccepted);
        CHECK(world.replies.at(token).message == world.replies.at(1).message);
    }
    world.Submit(MakeLogisticsPlan("P1"), 5, "T2");
    Plan other = MakeLogisticsPlan("P1");
    other.lotID = "another";
    world.Submit(other, 6, "T1");
    for (const ReplyToken token : {5U, 6U})
    {
        CHECK_FALSE(world.replies.at(token).bAccepted);
        CHECK(world.replies.at(token).message.find("Duplicated Plan") != std::string::npos);
    }
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1") == LOGISTICS_REPORTS);
}

TEST_CASE("D-23 Another control under the transactionId of an earlier one is no repetition, also after a restart")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Job 1 P1-a4 InProgress");
    world.Control(EPlanControl::Cancel, "P1", 1, "T");
    RestartEngine(world);
    world.Control(EPlanControl::Cancel, "P1", 2, "T");
    world.Control(EPlanControl::Abort, "P1", 3, "T");
    REQUIRE(world.TryRun());
    CHECK(world.replies.at(2).bAccepted);
    CHECK(world.replies.at(3).bAccepted);
    const Lines reports = world.GetReportsOf("P1");
    CHECK(std::ranges::count(reports, "CancelResult Failed") == 1);
    CHECK(std::ranges::count(reports, "AbortResult Success") == 1);
}

TEST_CASE("A job that was dropped and has not ended keeps its robot unavailable, also after a restart")
{
    for (const bool bUnresolved : {false, true})
    {
        PlanWorld world =
            ACS::Testing::MakeWorld([](EngineOptions& options) { options.controls.bAbortStopsJob = true; });
        BeginPlan(world, MakeLogisticsPlan("P1"), "Job 1 P1-a4 InProgress");
        world.GetRobot("LR01").bIgnoresJobCancel = true;
        world.Control(EPlanControl::Abort, "P1");
        CHECK(world.engine->GetPlanOrNull("P1")->state == EPlanState::Aborted);
        world.GetRobot("LR01").unresolvedReason = bUnresolved ? "it was switched off" : "";
        RestartEngine(world);
        world.Submit(MakeLogisticsPlan("P2"));
        if (bUnresolved)
        {
            CHECK(world.engine->GetPlanOrNull("P2")->state == EPlanState::Pending);
            world.ResolveJob("P1", "P1-a4", EJobResolution::Again, 8);
            CHECK_FALSE(world.replies.at(8).bAccepted);
            world.ResolveJob("P1", "P1-a4", EJobResolution::Done, 9);
            CHECK(world.replies.at(9).bAccepted);
        }
        REQUIRE(world.TryRun());
        CHECK(world.GetReportsOf("P2").empty()); // the job has filled the port
        world.Ask(SetCarriers{"LR01", {std::nullopt}, 0});
        REQUIRE(world.TryRun());
        CHECK(world.GetReportsOf("P2").back() == "Plan Completed");
        CHECK(world.engine->GetActiveAlarms().empty());
    }
}

TEST_CASE("With a store of an older version, without work of robots, a running job is unresolved, a waiting one begins")
{
    for (const EJobState state : {EJobState::Pending, EJobState::InProgress})
    {
        PlanWorld world;
        PlanRecord record;
        record.sequence = 1;
        record.plan = MakeLogisticsPlan("P1");
        record.progress.state = EPlanState::InProgress;
        record.progress.robotID = "LR01";
        record.progress.steps = {{EStepState::InProgress, {state}}, {EStepState::Pending, {EJobState::Pending}}};
        REQUIRE(world.store.Append({{PlanAdded{record}}}).has_value());
        RestartEngine(world);
        REQUIRE(world.TryRun());
        const bool bHeld = state == EJobState::InProgress;
        CHECK(world.engine->GetActiveAlarms().size() == (bHeld ? 1 : 0));
        CHECK(world.engine->GetPlanOrNull("P1")->state == (bHeld ? EPlanState::InProgress : EPlanState::Completed));
        CHECK(CountStarts(world, "P1-a4") == (bHeld ? 0 : 1));
    }
}

TEST_CASE("After a restart with the alarm of a store that failed, a waiting plan begins when the store works")
{
    PlanWorld world;
    world.Connect();
    REQUIRE(world.TryRun()); // what the robots show is stored
    Alarm alarm;
    alarm.robotID = "ACS";
    alarm.errorCode = "ACS-1005";
    alarm.level = EAlarmLevel::Heavy;
    PlanRecord record;
    record.sequence = 1;
    record.plan = MakeLogisticsPlan("P1");
    record.progress.steps = {{EStepState::Pending, {EJobState::Pending}}, {EStepState::Pending, {EJobState::Pending}}};
    REQUIRE(world.store.Append({{PlanAdded{record}, AlarmSet{alarm}}}).has_value());
    RestartEngine(world);
    REQUIRE(world.TryRun());
    CHECK(world.engine->GetPlanOrNull("P1")->state == EPlanState::Completed);
    CHECK(world.engine->GetActiveAlarms().empty());
}
