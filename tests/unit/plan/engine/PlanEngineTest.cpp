#include "fixtures/PlanWorldSteps.hpp"

#include <fmt/format.h>

#include <algorithm>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using ACS::Testing::BeginPlan;
using ACS::Testing::Contains;
using ACS::Testing::FinishPlan;
using ACS::Testing::Lines;
using ACS::Testing::MakeControlPlan;
using ACS::Testing::MakeLogisticsPlan;
using ACS::Testing::MakeTestOptions;
using ACS::Testing::MakeTestSite;
using ACS::Testing::PlanWorld;
using ACS::Testing::TryRunUntil;

TEST_CASE("6.3 The logistics plan of the document completes and reports every state in order")
{
    PlanWorld world;
    world.Connect();
    world.Submit(MakeLogisticsPlan("P1"), 1);
    REQUIRE(world.TryRun());
    CHECK(
        world.GetReportsOf("P1")
        == Lines{
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
            "Plan Completed"});
    CHECK(Contains(world.trace, "command LR01 StartJob P1-a4 CassetteLoad A01.CP01 A01.CP01>LR01.CP01 CASSETTE_01"));
    CHECK(
        world.GetTraceOf("status LR01 ")
        == Lines{
            "Init ",
            "Idle CHG01",
            "UnDocking CHG01",
            "Moving CHG01",
            "Arrival A01.CP01",
            "Docking A01.CP01",
            "Working A01.CP01",
            "UnDocking A01.CP01",
            "Moving A01.CP01",
            "Arrival A02.CP03",
            "Docking A02.CP03",
            "Working A02.CP03",
            "UnDocking A02.CP03",
            "Moving A02.CP03",
            "Docking CHG01",
            "Idle CHG01"});
}

TEST_CASE("6.4 The control plan of the document completes with all its jobs")
{
    PlanWorld world;
    world.Connect();
    world.Submit(MakeControlPlan("P1"));
    REQUIRE(world.TryRun());
    CHECK(world.GetRobot("CR01").doneJobs == Lines{"P1-cd", "P1-b3", "P1-f3", "P1-e0", "P1-d1", "P1-d2"});
    const Lines reports = world.GetReportsOf("P1");
    CHECK(reports.size() == 2 + 3 * 3 + 6 * 3);
    CHECK(reports.back() == "Plan Completed");
    CHECK(world.engine->GetActiveAlarms().empty());
}

TEST_CASE("Both plans of the document dock at A01.CP01 one after the other")
{
    PlanWorld world;
    world.Connect();
    world.Submit(MakeLogisticsPlan("P1"));
    world.Submit(MakeControlPlan("P2"));
    REQUIRE(world.TryRun());
    CHECK(world.violations == Lines{});
    CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
    CHECK(world.GetReportsOf("P2").back() == "Plan Completed");
}

TEST_CASE("Of two robots that wait for each other's place one drives to its parking position first")
{
    // The first two stations of the plans are different, so that both begin.
    const auto makeShuttle = [](const std::string& planID, bool bLogistics, const std::vector<std::string>& places) {
        const char* const carrier = bLogistics ? "Cassette" : "Tray";
        const char* const port = bLogistics ? "AMR.CP01" : "AMR.TP01";
        Plan plan{planID, "", bLogistics ? 1 : 0, {}};
        for (const std::string& place : places)
        {
            const auto number = static_cast<std::int32_t>(plan.steps.size()) + 1;
            const bool bLoads = number % 2 == 1;
            const std::string at = bLogistics ? place : place + ".TP01";
            plan.steps.push_back(
                {number,
                 fmt::format("{}{}", carrier, bLoads ? "Load" : "Unload"),
                 place,
                 {"C"},
                 {{fmt::format("{}-{}", planID, number), bLoads ? at : port, bLoads ? port : at}}});
        }
        return plan;
    };
    std::size_t retreats = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed)
    {
        PlanWorld world(seed);
        world.Connect();
        world.Submit(makeShuttle("P1", true, {"A01.CP04", "A01.CP01", "A01.CP02", "A01.CP01", "A01.CP02", "A01.CP01"}));
        world.Submit(
            makeShuttle("P2", false, {"A01.CP03", "A01.CP02", "A01.CP01", "A01.CP02", "A01.CP01", "A01.CP02"}));
        REQUIRE(world.TryRun());
        CHECK(world.violations == Lines{});
        CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
        CHECK(world.GetReportsOf("P2").back() == "Plan Completed");
        const std::size_t drives =
            world.GetTraceOf("command CR01 Drive to ").size() + world.GetTraceOf("command LR01 Drive to ").size();
        constexpr std::size_t NEEDED = 14; // to six stations and to the parking position, each robot
        retreats += drives > NEEDED ? 1 : 0;
    }
    CHECK(retreats > 0);
}

TEST_CASE("Of two robots on the lane that block each other's parking position one drives to a free place")
{
    EngineOptions options = MakeTestOptions(true);
    options.robots[0].startNodeID = "L05";
    options.robots[1].startNodeID = "D-A01.SET03";
    options.robots[2].startNodeID = "L16";
    options.robots[3].startNodeID = "D-A01.CP02";
    PlanWorld world(1, options, MakeTestSite());
    world.Submit({"P1", "", 0, {{1, "TrayLoad", "A01.CP01", {}, {{"J", "A01.CP01.TP01", "CR01.TP01"}}}}});
    world.Submit({"P2", "", 0, {{1, "CassetteLoad", "A01.CP01", {}, {{"J", "A01.CP01", "LR01.CP01"}}}}});
    world.Submit({"P3", "", 0, {{1, "CassetteLoad", "A01.CP02", {}, {{"J", "A01.CP02", "LR02.CP01"}}}}});
    const Job place{"J", "CR02.TP01.MP01", "A01.SET01.MP01"};
    world.Ask(SetCarriers{"CR02", {"TRAY_01", {}, {}}, 0});
    world.Submit({"P4", "", 0, {{1, "MemoryPickAndPlace", "A01.SET01", {}, {place}}}});
    world.Connect();
    REQUIRE(world.TryRun());
    CHECK(world.violations == Lines{});
    for (const std::string planID : {"P1", "P2", "P3", "P4"})
    {
        INFO(planID);
        CHECK(world.GetReportsOf(planID).back() == "Plan Completed");
    }
}

TEST_CASE("A robot without work drives to its parking position at once and clears the route of robots with a plan")
{
    for (std::uint64_t seed = 1; seed <= 20; ++seed)
    {
        INFO("seed " << seed);
        PlanWorld world(seed);
        world.Connect();
        Plan control = MakeControlPlan("P2");
        for (int job = 0; job < 20; ++job)
        {
            Job more = control.steps[1].jobs.front();
            more.jobID += "-" + std::to_string(job);
            control.steps[1].jobs.push_back(more);
        }
        Plan logistics = MakeLogisticsPlan("P1");
        logistics.steps.erase(logistics.steps.begin());
        world.Submit(logistics);
        world.Submit(control);
        REQUIRE(TryRunUntil(world, "P1", "Plan Completed"));
        REQUIRE_FALSE(Contains(world.GetReportsOf("P2"), "Step 2 Completed"));
        REQUIRE(TryRunUntil(world, "P2", "Step 3 Dispatched"));
        CHECK(world.GetRobot("LR01").GetOccupied() == Lines{"D-CHG01"});
        REQUIRE(world.TryRun());
        CHECK(world.GetRobot("LR01").GetOccupied() == Lines{"D-CHG01"});
        CHECK(world.GetReportsOf("P2").back() == "Plan Completed");
    }
}

TEST_CASE("A robot without work that blocks one with a plan drives to its parking position at once")
{
    PlanWorld world;
    world.Connect();
    Plan logistics = MakeLogisticsPlan("P1");
    logistics.steps.pop_back();
    Plan control = MakeControlPlan("P2");
    control.steps.erase(control.steps.begin(), control.steps.begin() + 2);
    world.Submit(logistics);
    REQUIRE(TryRunUntil(world, "P1", "Job 1 P1-a4 InProgress"));
    world.Submit(control);
    REQUIRE(world.TryRun());
    CHECK(world.violations == Lines{});
    CHECK(world.GetReportsOf("P2").back() == "Plan Completed");
}

TEST_CASE("5.9, 6.5 A robot that arrives while disconnected works after the reconnect; the arrival is reported once")
{
    PlanWorld world;
    BeginPlan(world, MakeControlPlan("P1"), "Step 1 InProgress");
    world.Raise("CR01", LinkChanged{false});
    REQUIRE(world.TryRun());
    CHECK(world.GetRobot("CR01").GetOccupied() == Lines{"D-A01.CP01"});
    CHECK(world.GetReportsOf("P1").back() == "Step 1 InProgress");
    world.Control(EPlanControl::Cancel, "P1");
    CHECK(world.GetReportsOf("P1").back() == "CancelResult Failed");
    world.Connect();
    FinishPlan(world);
    const Lines statuses = world.GetTraceOf("status CR01 ");
    CHECK(std::ranges::count(statuses, "Arrival A01.CP01") == 2); // step 1 and step 3
}

TEST_CASE("VDA5050: every drive has a base and is extended before the robot reaches its end")
{
    PlanWorld world;
    world.Connect();
    world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(world.TryRun());
    // Alone: a robot that waits for another one reaches the end of its base.
    world.Submit(MakeControlPlan("P2"));
    REQUIRE(world.TryRun());
    for (const std::string robotID : {"LR01", "CR01"})
    {
        CHECK(world.GetRobot(robotID).drives >= 3);
        CHECK(world.GetRobot(robotID).extensions >= world.GetRobot(robotID).drives);
        CHECK(world.GetRobot(robotID).ranOverBase == 0);
    }
    CHECK(Contains(world.trace, "command LR01 Drive to D-A01.CP01 released 3 of 5"));
}

TEST_CASE("4.1 A plan is stored before its reply is sent, and a report is stored before it is sent")
{
    PlanWorld world;
    world.Connect();
    world.Submit(MakeLogisticsPlan("P1"), 1);
    const auto reply = std::ranges::find(world.trace, "reply accepted");
    REQUIRE(reply != world.trace.end());
    REQUIRE(reply != world.trace.begin());
    CHECK(*(reply - 1) == "store");
    CHECK(world.store.GetState().plans.size() == 1);
    CHECK(world.GetReportsOf("P1").empty());
    REQUIRE(world.TryRun());
    CHECK(world.violations == Lines{}); // PlanWorld notes each report that is sent before it is stored.
    CHECK(world.store.GetState().plans.front().progress.state == EPlanState::Completed);
}

TEST_CASE("A store that fails raises an alarm and refuses new plans with a reason, while running ones continue")
{
    PlanWorld world;
    world.Connect();
    world.Submit(MakeLogisticsPlan("P1"), 1);
    REQUIRE(TryRunUntil(world, "P1", "Step 1 InProgress"));
    world.store.bFails = true;
    world.Submit(MakeLogisticsPlan("P2"), 2);
    CHECK_FALSE(world.replies.at(2).bAccepted);
    CHECK(world.replies.at(2).message.find("disk full") != std::string::npos);
    CHECK_FALSE(world.engine->GetPlanOrNull("P2").has_value());
    const std::size_t told = world.reports.size();
    REQUIRE(world.TryRun([&world] { return world.GetRobot("LR01").doneJobs.size() == 2; }));
    CHECK(world.reports.size() == told);
    CHECK(world.engine->GetActiveAlarms().size() == 1);

    world.store.bFails = false;
    REQUIRE(world.TryRun());
    CHECK(world.violations == Lines{});
    CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
    CHECK(world.GetReportsOf("-") == Lines{"Error ACS-1005 set", "Error ACS-1005 cleared"});
    CHECK(world.engine->GetActiveAlarms().empty());
    CHECK(world.store.GetState().outbox.empty());
    world.Submit(MakeLogisticsPlan("P2"), 3);
    CHECK(world.replies.at(3).bAccepted);
}

TEST_CASE("When every n-th store fails, the plan completes, reports stay in order and none is lost")
{
    for (std::size_t nth = 1; nth < 40; ++nth)
    {
        INFO("store " << nth);
        PlanWorld world;
        world.Connect();
        world.Submit(MakeLogisticsPlan("P1"));
        const auto countStores = [&world] {
            return static_cast<std::size_t>(
                std::ranges::count_if(world.trace, [](const std::string& line) { return line.starts_with("store"); }));
        };
        const bool bReached = world.TryRun([&countStores, nth] { return countStores() >= nth; });
        world.store.bFails = true;
        static_cast<void>(world.TryRun([&countStores, nth] { return countStores() > nth; }));
        world.store.bFails = false;
        REQUIRE(world.TryRun());
        CHECK(world.violations == Lines{});
        CHECK(world.GetReportsOf("P1").size() == 14);
        CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
        CHECK(world.store.GetState().outbox.empty());
        if (!bReached)
        {
            return;
        }
    }
}

TEST_CASE("6.14 A failed job fails its step and its plan at once, and nothing else is reported")
{
    PlanWorld world;
    world.Connect();
    world.GetRobot("CR01").failingJobs.insert("P1-b3");
    world.Submit(MakeControlPlan("P1"));
    REQUIRE(world.TryRun());
    const Lines reports = world.GetReportsOf("P1");
    REQUIRE(reports.size() > 3);
    CHECK(Lines(reports.end() - 3, reports.end()) == Lines{"Job 1 P1-b3 Failed", "Step 1 Failed", "Plan Failed"});
    const auto summary = world.engine->GetPlanOrNull("P1");
    CHECK(summary->stepNo == 1);
    CHECK(summary->jobID == "P1-b3");
    CHECK(world.GetRobot("CR01").GetOccupied() == Lines{"D-CHG02"});
}

TEST_CASE("6.5 A plan is cancelled while it is pending and before its first arrival; after that it continues")
{
    PlanWorld world;
    world.Submit(MakeLogisticsPlan("P1"));
    world.Control(EPlanControl::Cancel, "P1", 5);
    CHECK(world.replies.at(5).bAccepted);
    CHECK(world.GetReportsOf("P1") == Lines{"Plan Cancelled", "CancelResult Success"});

    world.Connect();
    world.Submit(MakeLogisticsPlan("P2"));
    REQUIRE(TryRunUntil(world, "P2", "Step 1 InProgress"));
    world.Control(EPlanControl::Cancel, "P2");
    REQUIRE(world.TryRun());
    CHECK(
        world.GetReportsOf("P2")
        == Lines{
            "Plan InProgress",
            "Step 1 Dispatched",
            "Step 1 InProgress",
            "Plan Cancelled",
            "CancelResult Success"});
    CHECK(world.GetRobot("LR01").GetOccupied() == Lines{"D-CHG01"});

    world.Submit(MakeLogisticsPlan("P3"));
    REQUIRE(TryRunUntil(world, "P3", "Job 1 P3-a4 Instructed"));
    world.Control(EPlanControl::Cancel, "P3");
    CHECK(Contains(world.GetReportsOf("P3"), "CancelResult Failed"));
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P3").back() == "Plan Completed");
}

TEST_CASE("6.6 Abort lets the running job end: the job, the plan and the result are reported, nothing else")
{
    PlanWorld world;
    BeginPlan(world, MakeControlPlan("P1"), "Job 2 P1-f3 InProgress");
    const std::size_t before = world.GetReportsOf("P1").size();
    world.Control(EPlanControl::Abort, "P1");
    REQUIRE(world.TryRun());
    const Lines reports = world.GetReportsOf("P1");
    CHECK(
        Lines(reports.begin() + static_cast<std::ptrdiff_t>(before), reports.end())
        == Lines{"Job 2 P1-f3 Completed", "Plan Aborted", "AbortResult Success"});
}

TEST_CASE("6.5 to 6.8 A control that cannot be carried out has a result report with the reason")
{
    PlanWorld world;
    world.Connect();
    world.Control(EPlanControl::Abort, "P9", 1);
    CHECK_FALSE(world.replies.at(1).bAccepted);
    CHECK(world.GetReportsOf("P9") == Lines{"AbortResult Failed"});

    world.Submit(MakeLogisticsPlan("P1"));
    world.Control(EPlanControl::Resume, "P1", 2);
    CHECK(world.replies.at(2).bAccepted);
    CHECK(world.GetReportsOf("P1") == Lines{"ResumeResult Failed"});
    REQUIRE(world.TryRun());
    world.Control(EPlanControl::Cancel, "P1", 3);
    CHECK(world.replies.at(3).bAccepted);
    CHECK(world.GetReportsOf("P1").back() == "CancelResult Failed");
}

TEST_CASE("5.9 Carriers are listed at the index of their port; a load into a taken port is reported if it is allowed")
{
    EngineOptions options = ACS::Testing::MakeTestOptions(false);
    options.dispatch.bLoadsIntoTakenPorts = true;
    PlanWorld world(1, options, ACS::Testing::MakeTestSite());
    world.Connect();
    Plan plan = MakeControlPlan("P1");
    plan.steps[0].jobs[0].to = "AMR.TP02";
    plan.steps[1].jobs[0].from = "AMR.TP02.MP02";
    plan.steps[2].jobs.pop_back();
    world.Submit(plan);
    REQUIRE(TryRunUntil(world, "P1", "Job 1 P1-cd Completed"));
    CHECK(
        world.engine->GetRobotStatuses()[1].carrierIDs
        == std::vector<std::optional<std::string>>{std::nullopt, "TRAY_01", std::nullopt});
    REQUIRE(TryRunUntil(world, "P1", "Job 1 P1-b3 Completed"));
    CHECK(world.engine->GetActiveAlarms().size() == 1);
    FinishPlan(world);
    CHECK(
        world.store.GetState().carriers.back().carrierIDs
        == std::vector<std::optional<std::string>>{std::nullopt, "TRAY_02", std::nullopt});
}

TEST_CASE("Plans of a higher priority begin first, equal priorities in the order of acceptance")
{
    PlanWorld world;
    Plan low = MakeLogisticsPlan("P1");
    low.priority = 1;
    Plan none = MakeLogisticsPlan("P2");
    none.priority.reset();
    Plan high = MakeLogisticsPlan("P3");
    high.priority = 5;
    Plan later = MakeLogisticsPlan("P4");
    later.priority = 5;
    for (const Plan& plan : {none, low, high, later})
    {
        world.Submit(plan);
    }
    const std::vector<PlanSummary> queue = world.engine->GetActivePlans();
    CHECK(queue[0].planID == "P3");
    CHECK(queue[3].planID == "P2");
    world.Connect();
    REQUIRE(world.TryRun());
    Lines ends;
    for (const std::string& line : world.GetTraceOf("report "))
    {
        if (line.ends_with("Plan Completed"))
        {
            ends.push_back(line.substr(0, 2));
        }
    }
    CHECK(ends == Lines{"P3", "P4", "P1", "P2"});
}

TEST_CASE("A robot is used after it has reported a place on the map; a lost one is Disconnected")
{
    PlanWorld world;
    world.Submit(MakeLogisticsPlan("P1"));
    world.Raise("LR01", LinkChanged{true});
    StateChanged lost;
    lost.lastNodeID = "off the map";
    world.Raise("LR01", lost);
    REQUIRE(world.TryRun());
    CHECK(world.engine->GetRobotStatuses()[0].status == ERobotStatus::Init);
    CHECK(world.GetReportsOf("P1").empty());
    world.Connect();
    REQUIRE(TryRunUntil(world, "P1", "Step 1 InProgress"));
    world.Raise("LR01", LinkChanged{false});
    CHECK(world.engine->GetRobotStatuses()[0].status == ERobotStatus::Disconnected);
    CHECK(world.engine->GetActiveAlarms().front().errorCode == "ACS-1002");
    world.Raise("LR01", LinkChanged{true});
    CHECK(world.engine->GetActiveAlarms().empty());
    FinishPlan(world);
}

TEST_CASE("5.8 The error of a robot is reported when it is set and when it is cleared; a heavy one keeps work away")
{
    PlanWorld world;
    world.Connect();
    StateChanged state;
    state.lastNodeID = "D-CHG01";
    state.errors = {{"AGV-motor", EAlarmLevel::Heavy, "hot"}};
    world.Raise("LR01", state);
    world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(world.TryRun());
    CHECK(world.engine->GetRobotStatuses()[0].status == ERobotStatus::Error);
    CHECK(world.GetReportsOf("P1").empty());
    state.errors.clear();
    world.Raise("LR01", state);
    CHECK(world.GetReportsOf("-") == Lines{"Error AGV-motor set", "Error AGV-motor cleared"});
    FinishPlan(world);
}

TEST_CASE("A job that takes longer than its limit has failed")
{
    EngineOptions options = MakeTestOptions(false);
    options.actions.at("CassetteLoad").timeout = std::chrono::milliseconds(1);
    PlanWorld world(1, options, MakeTestSite());
    world.Connect();
    world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1").back() == "Plan Failed");
    CHECK(Contains(world.trace, "command LR01 CancelJob"));
}

TEST_CASE("A robot whose job exceeded its limit neither drives nor works before the job has ended")
{
    EngineOptions options = MakeTestOptions(false);
    options.actions.at("CassetteLoad").timeout = std::chrono::milliseconds(1);
    PlanWorld world(1, options, MakeTestSite());
    world.Connect();
    world.GetRobot("LR01").bIgnoresJobCancel = true;
    Plan next = MakeLogisticsPlan("P2");
    next.steps.erase(next.steps.begin());
    world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(TryRunUntil(world, "P1", "Plan Failed"));
    const std::size_t drives = world.GetRobot("LR01").drives;
    world.Submit(next);
    std::size_t left = 2; // the dispatching, and that the job has begun
    REQUIRE(world.TryRun([&left] { return left-- == 0; }));
    CHECK(world.GetRobot("LR01").doneJobs.empty());
    CHECK(world.GetRobot("LR01").drives == drives);
    CHECK(world.engine->GetRobotStatuses()[0].status == ERobotStatus::Working);
    CHECK(world.GetReportsOf("P1").back() == "Plan Failed");
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P2").back() == "Plan Completed");
}

TEST_CASE("5.8 After a restart alarms that no other input can clear are cleared")
{
    PlanWorld world;
    world.bAcknowledges = false;
    Alarm gone;
    gone.robotID = "LR77";
    gone.errorCode = "AGV-motor";
    Alarm store;
    store.robotID = "ACS";
    store.errorCode = "ACS-1005";
    REQUIRE(world.store.Append({{AlarmSet{gone}, AlarmSet{store}}}).has_value());
    world.Restart(MakeTestOptions(false), MakeTestSite());
    BeginPlan(world, MakeLogisticsPlan("P1"), "Job 1 P1-a4 InProgress");
    EngineOptions changed = MakeTestOptions(false);
    changed.actions.erase("CassetteUnload");
    world.Restart(changed, MakeTestSite());
    world.Connect();
    REQUIRE(world.engine->GetActiveAlarms().size() == 1);
    CHECK(world.engine->GetActiveAlarms().front().errorCode == "ACS-1001");
    REQUIRE(world.TryRun());
    world.Restart(MakeTestOptions(false), MakeTestSite());
    world.Connect();
    world.Ask(SetCarriers{"LR01", {std::nullopt}, 0}); // what P1 loaded before
    world.Submit(MakeControlPlan("P2"));
    world.Submit(MakeLogisticsPlan("P3"));
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P3").back() == "Plan Completed");
    CHECK(world.engine->GetActiveAlarms().empty());
}

TEST_CASE("After a restart plans that no longer fit the site fail with an alarm, and reports are kept for replay")
{
    PlanWorld world;
    world.bAcknowledges = false;
    world.Connect();
    world.Submit(MakeLogisticsPlan("P1"));
    world.Submit(MakeLogisticsPlan("P2"));
    REQUIRE(TryRunUntil(world, "P1", "Job 1 P1-a4 InProgress"));
    const std::vector<OutboxEntry> before = world.engine->GetUnacknowledged();
    CHECK(before.size() == 5);
    EngineOptions changed = MakeTestOptions(false);
    changed.robots.front().robotID = *ACS::Core::RobotID::Parse("LR07");
    changed.robots.front().ports = *ACS::Core::ParseLocationRange("LR07.CP01");
    world.Restart(changed, MakeTestSite());
    const std::vector<OutboxEntry> after = world.engine->GetUnacknowledged();
    REQUIRE(after.size() == before.size() + 4);
    CHECK(std::equal(before.begin(), before.end(), after.begin()));
    const Lines reports = world.GetReportsOf("P1");
    CHECK(
        Lines(reports.end() - 4, reports.end())
        == Lines{"Error ACS-1001 set", "Job 1 P1-a4 Failed", "Step 1 Failed", "Plan Failed"});
    CHECK(world.engine->GetActivePlans().front().planID == "P2");
    CHECK(world.engine->GetPlanOrNull("P1")->state == EPlanState::Failed);
}
