#include "fixtures/PlanWorldSteps.hpp"

#include <limits>
#include <utility>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using ACS::Testing::BeginPlan;
using ACS::Testing::Contains;
using ACS::Testing::FindLine;
using ACS::Testing::GetCarrierOrNull;
using ACS::Testing::Lines;
using ACS::Testing::MakeLogisticsPlan;
using ACS::Testing::MakeTestOptions;
using ACS::Testing::MakeTestSite;
using ACS::Testing::MakeWorld;
using ACS::Testing::PlanWorld;
using ACS::Testing::TryRunFor;
using ACS::Testing::TryRunUntil;

namespace
{

using namespace std::chrono_literals;

StateChanged MakeState(const std::string& nodeID)
{
    StateChanged state;
    state.batteryPercent = 80;
    state.lastNodeID = nodeID;
    return state;
}

/// The alarm's level; nullopt: it is not set.
std::optional<EAlarmLevel> GetAlarmOrNull(const PlanWorld& world, std::string_view robotID, std::string_view errorCode)
{
    for (const Alarm& alarm : world.engine->GetActiveAlarms())
    {
        if (alarm.robotID == robotID && alarm.errorCode == errorCode)
        {
            return alarm.level;
        }
    }
    return std::nullopt;
}

/// The load of the plan exceeds its limit and continues.
void LetLoadRunOver(PlanWorld& world)
{
    world.GetRobot("LR01").bIgnoresJobCancel = true;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Job 1 P1-a4 InProgress");
    world.Control(EPlanControl::Abort, "P1");
    REQUIRE(world.engine->GetPlanOrNull("P1")->state == EPlanState::Aborted);
}

PlanWorld MakeDroppingWorld(std::chrono::milliseconds jobEndTimeout)
{
    return MakeWorld([jobEndTimeout](EngineOptions& options) {
        options.controls.bAbortStopsJob = true;
        options.controls.jobEndTimeout = jobEndTimeout;
    });
}

} // namespace

TEST_CASE("A plan that arrives after the store worked for one batch only is not begun before it is stored")
{
    PlanWorld world;
    world.bAcknowledges = false;
    world.Connect();
    world.store.bFails = true;
    world.Submit(MakeLogisticsPlan("P1"), 1);
    CHECK_FALSE(world.replies.at(1).bAccepted);
    world.store.bFails = false;
    REQUIRE(world.TryRun([&world] { return !world.store.GetState().alarms.empty(); }));
    world.store.bFails = true;
    world.Submit(MakeLogisticsPlan("P2"), 2);
    CHECK_FALSE(world.replies.at(2).bAccepted);
    CHECK(world.GetTraceOf("command LR01 ").empty());
    world.PublishState("LR01");
    world.store.bFails = false;
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P2").empty());
    world.Submit(MakeLogisticsPlan("P3"), 3);
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P3").back() == "Plan Completed");
}

TEST_CASE("D-23 A repeated plan that runs is accepted although another plan of the batch could not be stored")
{
    PlanWorld world;
    world.Connect();
    world.Submit(MakeLogisticsPlan("P1"), 1, "T1");
    REQUIRE(TryRunUntil(world, "P1", "Step 1 InProgress"));
    const std::vector<OfferedCommand> both{
        {SubmitPlan{MakeLogisticsPlan("P1"), 2, "T1"}},
        {SubmitPlan{MakeLogisticsPlan("P2"), 3, "T2"}}};
    EngineActions actions;
    world.engine->Handle(both, world.GetNow(), actions);
    REQUIRE(actions.size() == 1);
    REQUIRE(std::holds_alternative<StorePlans>(actions.front()));
    EngineActions instead;
    world.engine->OnStored(
        ACS::Core::Fail(EPlanningError::StoreFailed, "acsd.db", "room", "disk full"),
        world.GetNow(),
        instead);
    std::map<ReplyToken, bool> accepted;
    for (const EngineAction& action : instead)
    {
        if (const auto* replyOrNull = std::get_if<ReplyCommand>(&action); replyOrNull != nullptr)
        {
            accepted.emplace(replyOrNull->replyToken, replyOrNull->bAccepted);
        }
    }
    CHECK(accepted == std::map<ReplyToken, bool>{{2, true}, {3, false}});
}

TEST_CASE("A failing store is retried after a delay and with new plans, not with every input")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Step 1 InProgress");
    world.store.bFails = true;
    world.Submit(MakeLogisticsPlan("P2"), 2);
    const std::size_t attempts = world.store.attempts;
    for (std::size_t i = 0; i < 20; ++i)
    {
        world.GetRobot("CR01").battery = static_cast<double>(30 + i);
        world.PublishState("CR01");
        world.Ask(SetCarriers{"CR01", {"TRAY_" + std::to_string(i), std::nullopt, std::nullopt}, 0});
    }
    CHECK(world.store.attempts == attempts);
    REQUIRE(world.TryRun([&world, attempts] { return world.store.attempts > attempts; }));
    CHECK(world.store.attempts == attempts + 1);
    world.Submit(MakeLogisticsPlan("P3"), 3);
    CHECK(world.store.attempts == attempts + 2);
    CHECK_FALSE(world.replies.at(3).bAccepted);
    world.store.bFails = false;
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
    CHECK(world.violations == Lines{});
}

TEST_CASE("9 cancel.confirm_timeout: a drive that ends by a late cancel begins again, because the plan continues")
{
    PlanWorld world = MakeWorld([](EngineOptions& options) { options.controls.cancelTimeout = 10ms; });
    BeginPlan(world, MakeLogisticsPlan("P1"), "Step 1 InProgress");
    world.GetRobot("LR01").bIgnoresDriveCancel = true;
    world.Control(EPlanControl::Cancel, "P1");
    REQUIRE(TryRunUntil(world, "P1", "CancelResult Failed"));
    world.GetRobot("LR01").bIgnoresDriveCancel = false;
    world.Operate("LR01", CancelDrive{world.driveIDs.at("LR01")});
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
}

TEST_CASE("A drive to the parking position that is rejected is repeated with growing delays until it is accepted")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Job 2 P1-b2 InProgress");
    world.GetRobot("LR01").bRejectDrives = true;
    const std::size_t before = world.GetTraceOf("command LR01 Drive").size();
    static_cast<void>(TryRunFor(world, 1h));
    CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
    const std::size_t asked = world.GetTraceOf("command LR01 Drive").size() - before;
    CHECK(asked > 12);
    CHECK(asked < 20);
    world.GetRobot("LR01").bRejectDrives = false;
    REQUIRE(world.TryRun());
    CHECK(world.GetRobot("LR01").GetOccupied().front() == "D-CHG01");
}

TEST_CASE("A robot at an unknown place is not used, keeps its nodes, and continues when its position is known")
{
    for (const std::string nodeID : {"X99", ""})
    {
        PlanWorld world;
        world.Connect();
        world.Raise("LR01", MakeState(nodeID));
        CHECK(GetAlarmOrNull(world, "LR01", "ACS-1003") == EAlarmLevel::Heavy);
        world.Submit(MakeLogisticsPlan("P1"));
        REQUIRE(world.TryRun());
        CHECK(world.GetReportsOf("P1").empty());
        CHECK(
            world.engine->GetWaitReasonOrNull("P1")->robots.front().reason
            == (nodeID.empty() ? "position unknown: it reports no node" : "position unknown, see ACS-1003"));
        world.Raise("LR01", MakeState("D-CHG01"));
        CHECK(GetAlarmOrNull(world, "LR01", "ACS-1003") == std::nullopt);
        REQUIRE(world.TryRun());
        CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
    }
}

TEST_CASE("A robot whose first state has an unknown node raises the alarm")
{
    PlanWorld world;
    world.Raise("LR01", LinkChanged{true});
    world.Submit(MakeLogisticsPlan("P1"));
    CHECK(world.engine->GetWaitReasonOrNull("P1")->robots.front().reason == "no state received");
    world.Raise("LR01", MakeState("X99"));
    CHECK(GetAlarmOrNull(world, "LR01", "ACS-1003") == EAlarmLevel::Heavy);
    CHECK(world.engine->GetWaitReasonOrNull("P1")->robots.front().reason == "position unknown, see ACS-1003");
    world.Raise("LR01", MakeState("D-CHG01"));
    CHECK(GetAlarmOrNull(world, "LR01", "ACS-1003") == std::nullopt);
}

TEST_CASE("Numbers of a state that are not finite have no effect")
{
    PlanWorld world;
    world.Raise("LR01", LinkChanged{true});
    StateChanged state = MakeState("D-CHG01");
    state.bPoseKnown = true;
    state.batteryPercent = 70;
    world.Raise("LR01", state);
    REQUIRE(world.engine->GetRobotPoses().size() == 1);
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    {
        for (double StateChanged::*const member : {&StateChanged::x, &StateChanged::y, &StateChanged::theta})
        {
            StateChanged broken = state;
            broken.*member = bad;
            world.Raise("LR01", broken);
            CHECK(world.engine->GetRobotPoses().empty());
        }
        StateChanged broken = state;
        broken.batteryPercent = bad;
        world.Raise("LR01", broken);
        CHECK(world.engine->GetRobotPoses().at(0).batteryPercent == 70);
    }
    for (const auto& [reported, expected] : {std::pair{-1e6, 0.0}, {250.0, 100.0}})
    {
        state.batteryPercent = reported;
        world.Raise("LR01", state);
        CHECK(world.engine->GetRobotPoses().at(0).batteryPercent == expected);
    }
}

TEST_CASE("A load that ends after the end of its plan has filled the robot's port")
{
    PlanWorld world = MakeDroppingWorld(60s);
    LetLoadRunOver(world);
    CHECK(GetAlarmOrNull(world, "LR01", "ACS-1007") == EAlarmLevel::Heavy);
    CHECK(GetCarrierOrNull(world) == std::nullopt);
    REQUIRE(world.TryRun());
    CHECK(GetCarrierOrNull(world).has_value());
    CHECK(world.engine->GetActiveAlarms().empty());
    CHECK(world.store.GetState().carriers.front().carrierIDs.front() == GetCarrierOrNull(world));
}

TEST_CASE("A job that exceeds its limit after it began to move something is an alarm until its end is reported")
{
    PlanWorld world =
        MakeWorld([](EngineOptions& options) { options.actions.find("CassetteLoad")->second.timeout = 1ms; });
    world.GetRobot("LR01").bIgnoresJobCancel = true;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Plan Failed");
    const std::size_t set = FindLine(world, "report - Error ACS-1007 set", 0);
    REQUIRE(world.TryRun());
    CHECK(GetCarrierOrNull(world).has_value());
    CHECK(world.engine->GetActiveAlarms().empty());
    static_cast<void>(set);
}

TEST_CASE("A dropped job without a reported end is an alarm until the robot reports it or the operator resolves it")
{
    for (const bool bOperator : {false, true})
    {
        PlanWorld world = MakeDroppingWorld(1ms);
        LetLoadRunOver(world);
        REQUIRE(TryRunFor(world, 1ms));
        REQUIRE(GetAlarmOrNull(world, "LR01", "ACS-1008") == EAlarmLevel::Heavy);
        const auto asks = [](const Alarm& alarm) {
            return alarm.message.ends_with(
                "then answer done (the carrier was moved) or failed (it was not). The robot is available again after that, and "
                "after the end of the program that its arm may run.");
        };
        CHECK(std::ranges::count_if(world.engine->GetActiveAlarms(), asks) == 1); // not again: its plan is over
        if (bOperator)
        {
            world.ResolveJob("P1", "P1-a4", EJobResolution::Again, 8);
            CHECK_FALSE(world.replies.at(8).bAccepted);
            world.ResolveJob("P1", "P1-a4", EJobResolution::Failed, 9);
            CHECK(world.replies.at(9).bAccepted);
            CHECK(GetAlarmOrNull(world, "LR01", "ACS-1008") == std::nullopt);
        }
        REQUIRE(world.TryRun());
        CHECK(GetAlarmOrNull(world, "LR01", "ACS-1008") == std::nullopt);
        CHECK(GetCarrierOrNull(world).has_value() != bOperator);
    }
}

TEST_CASE("6.6 The abort of a job whose robot is offline ends when the operator resolves the job")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Job 1 P1-a4 InProgress");
    world.Control(EPlanControl::Abort, "P1");
    world.ResolveJob("P1", "P1-a4", EJobResolution::Failed, 7);
    CHECK(world.replies.at(7).message == "LR01 is connected and will report the outcome of the job.");
    world.Raise("LR01", LinkChanged{false});
    world.ResolveJob("P1", "P1-a4", EJobResolution::Again, 8);
    CHECK_FALSE(world.replies.at(8).bAccepted);
    world.ResolveJob("P1", "P1-a4", EJobResolution::Failed, 9);
    CHECK(world.replies.at(9).bAccepted);
    CHECK(world.engine->GetPlanOrNull("P1")->state == EPlanState::Failed); // D-17
    CHECK(Contains(world.GetReportsOf("P1"), "AbortResult Failed"));
}

TEST_CASE("A robot is commanded to stop charging before it leaves, also where it leaves without a plan")
{
    PlanWorld world = MakeWorld([](EngineOptions& options) {
        options.robots.front().chargingStationID = "CHG01";
        options.robots.front().homeStationID = "CHG03";
    });
    world.SwitchTSC(true);
    world.Connect();
    world.GetRobot("LR01").battery = 50;
    world.PublishState("LR01");
    REQUIRE(world.TryRun());
    REQUIRE(Contains(world.trace, "command LR01 StartCharging"));
    world.SwitchTSC(false);
    REQUIRE(world.TryRun());
    CHECK(world.GetRobot("LR01").GetOccupied() == Lines{"D-CHG03"});
    const std::size_t stop = FindLine(world, "command LR01 StopCharging", 0);
    CHECK(stop < world.trace.size());
    CHECK(stop < FindLine(world, "command LR01 Drive to D-CHG03 released 3 of 4", 0));
}

TEST_CASE("D-22 pause.mode after_job: the plan is paused also when its job is to be done again")
{
    PlanWorld world = MakeWorld([](EngineOptions& options) { options.controls.bPausesAfterJob = true; });
    BeginPlan(world, MakeLogisticsPlan("P1"), "Job 1 P1-a4 InProgress");
    world.Control(EPlanControl::Pause, "P1");
    world.Raise("LR01", JobUnresolved{"P1-a4", "simulated by the test"});
    CHECK_FALSE(Contains(world.GetReportsOf("P1"), "PauseResult Success"));
    world.ResolveJob("P1", "P1-a4", EJobResolution::Again, 9);
    REQUIRE(world.replies.at(9).bAccepted);
    CHECK(Contains(world.GetReportsOf("P1"), "PauseResult Success"));
    CHECK(world.engine->GetPlanOrNull("P1")->state == EPlanState::Paused);
}

TEST_CASE("Only the running job is unresolved when its robot cannot report its end, whatever the evidence")
{
    PlanWorld world;
    world.GetRobot("LR01").progressToken = "5 5 0";
    BeginPlan(world, MakeLogisticsPlan("P1"), "Job 1 P1-a4 InProgress");
    world.GetRobot("LR01").progressToken = "0 0 0";
    world.Raise("LR01", JobUnresolved{"P1-a4", "simulated by the test"});
    world.ResolveJob("P1", "P1-a4", EJobResolution::Done);
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
}

TEST_CASE("5.8 An error that becomes heavier is reported again, once")
{
    PlanWorld world;
    world.Connect();
    StateChanged state = MakeState("D-CHG01");
    state.errors.push_back({"AGV-motor", EAlarmLevel::Light, "warm"});
    world.Raise("LR01", state);
    CHECK(GetAlarmOrNull(world, "LR01", "AGV-motor") == EAlarmLevel::Light);
    state.errors.push_back({"AGV-motor", EAlarmLevel::Heavy, "hot"});
    world.Raise("LR01", state);
    world.Raise("LR01", state);
    CHECK(GetAlarmOrNull(world, "LR01", "AGV-motor") == EAlarmLevel::Heavy);
    CHECK(world.GetReportsOf("-") == Lines{"Error AGV-motor set", "Error AGV-motor cleared", "Error AGV-motor set"});
}

TEST_CASE("5.2 After a restart with work the TSC is Paused until the robots have reported their positions")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Step 1 InProgress");
    world.Restart(MakeTestOptions(false), MakeTestSite());
    CHECK(world.engine->GetTscState() == ETscState::Paused);
    CHECK(world.engine->GetTscReason() == "Not all robots have reported their positions since the restart.");
    world.Connect();
    CHECK(world.engine->GetTscState() == ETscState::Auto);
    CHECK(world.engine->GetTscReason().empty());
    CHECK(Contains(world.trace, "tsc Auto"));
    world.Restart(MakeTestOptions(false), MakeTestSite());
    world.SwitchTSC(true);
    world.Connect();
    REQUIRE(world.TryRun());
    CHECK(world.engine->GetTscState() == ETscState::Paused);
}

TEST_CASE("9 A robot that is missing after the start is an alarm, after robot.restart_wait")
{
    PlanWorld world;
    world.Restart(MakeTestOptions(false), MakeTestSite());
    CHECK(world.engine->GetTscState() == ETscState::Auto);
    world.Raise("LR01", LinkChanged{true});
    REQUIRE(TryRunFor(world, MakeTestOptions(false).restartWait));
    CHECK(GetAlarmOrNull(world, "LR01", "ACS-1003") == EAlarmLevel::Heavy);
    CHECK(GetAlarmOrNull(world, "CR01", "ACS-1002") == EAlarmLevel::Heavy);
    world.Raise("LR01", MakeState("D-CHG01"));
    world.Raise("CR01", LinkChanged{true});
    CHECK(world.engine->GetActiveAlarms().empty());
}
