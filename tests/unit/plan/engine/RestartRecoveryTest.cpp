#include "engine/RestartRecovery.hpp"

#include "Catch.hpp"
#include "fixtures/EngineParts.hpp"
#include "fixtures/PlanWorld.hpp"

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS::Testing;  // NOLINT(google-build-using-namespace): its fixtures
using namespace std::chrono_literals;

namespace
{

struct RecoveryParts : EngineParts
{
    using EngineParts::EngineParts;

    RestartRecovery recovery{engine, tsc, answers, places, status, work};
};

/// What a store holds of plan P1 and its robot LR01.
StoredState StoreWork(const EngineParts& parts, const ActivePlan& plan)
{
    RobotWorkChanged work = parts.lr.work.Make("LR01");
    if (const StartJob* jobOrNull = parts.lr.job.GetOrNull(); jobOrNull != nullptr)
    {
        work.job = *jobOrNull;
    }
    work.nodeIDs = parts.places.ListNodes(parts.lr);
    StoredState stored;
    stored.plans = {plan.record};
    stored.robotWorks = {work};
    return stored;
}

} // namespace

TEST_CASE("RestartRecovery: plans are queued again, finished ones are history")
{
    RecoveryParts parts;
    StoredState stored;
    {
        EngineParts before;
        stored.plans = {before.AddLoad().record, before.Add(MakeLogisticsPlan("P2")).record};
        stored.plans.front().progress.state = EPlanState::Completed;
    }
    parts.recovery.Restore(stored);
    CHECK(parts.engine.plans.FindFinishedOrNull("P1") != nullptr);
    const ActivePlan* const firstOrNull = parts.engine.plans.FindNextStoredOrNull(nullptr);
    REQUIRE(firstOrNull != nullptr);
    CHECK(firstOrNull->record.plan.planID == "P2");
    CHECK(parts.engine.plans.FindNextStoredOrNull(firstOrNull) == nullptr);
    CHECK(parts.Collect().GetDelayOrNull(EEngineTimer::Dispatch).has_value());
}

TEST_CASE(
    "RestartRecovery: the history keeps the plans that ended last, also if the wall clock was set back between them")
{
    EngineOptions options = MakeTestOptions(false);
    options.finishedPlansKept = 1;
    RecoveryParts parts(options);
    StoredState stored;
    EngineParts before;
    stored.plans = {before.Add(MakeLogisticsPlan("P1")).record, before.Add(MakeLogisticsPlan("P2")).record};
    for (PlanRecord& record : stored.plans)
    {
        const bool bFirst = record.plan.planID == "P2"; // accepted last, ended first
        record.progress.state = EPlanState::Completed;
        record.progress.storedAt = std::chrono::minutes(bFirst ? 1 : 2);
        record.progress.endedAt = record.acceptedAt + std::chrono::hours(bFirst ? 1 : 0);
    }
    parts.recovery.Restore(stored);
    CHECK(parts.engine.plans.FindFinishedOrNull("P1") != nullptr);
    CHECK(parts.engine.plans.FindFinishedOrNull("P2") == nullptr);
}

TEST_CASE("RestartRecovery: a plan stays with its robot, which is asked for the outcome of its job")
{
    RecoveryParts parts;
    EngineParts before;
    const ActivePlan& plan = before.BeginLoad();
    const StartJob job = *before.lr.job.GetOrNull();
    parts.recovery.Restore(StoreWork(before, plan));
    REQUIRE(parts.lr.planOrNull != nullptr);
    CHECK(parts.lr.activity == EActivity::Works);
    CHECK(parts.lr.job.IsRecovering());
    const auto commands = parts.Collect().ListCommands<RecoverJob>();
    REQUIRE(commands.size() == 1);
    CHECK(commands.front().job == job);
}

TEST_CASE(
    "RestartRecovery: carriers of ports that are no longer configured raise an alarm, and the record has the present ports")
{
    RecoveryParts parts;
    StoredState stored;
    stored.carriers = {{"LR01", {"C1"}, {"LR01.CP09"}}};
    parts.recovery.Restore(stored);
    const CallOutcome outcome = parts.Collect();
    CHECK(parts.lr.ports.GetCarriers() == CarrierIDs{std::string(UNKNOWN_CARRIER)});
    CHECK(outcome.ListSetAlarms() == std::vector<std::string>{"ACS-1004"});
    const std::vector<CarriersChanged> records = outcome.ListChanges<CarriersChanged>();
    CHECK(
        records
        == std::vector{CarriersChanged{"LR01", {std::string(UNKNOWN_CARRIER), "C1"}, {"LR01.CP01", "LR01.CP09"}}});

    RecoveryParts again;
    stored.carriers = records;
    again.recovery.Restore(stored);
    CHECK(again.Collect().ListChanges<CarriersChanged>().empty());
    CHECK(again.lr.ports.GetCarriers() == CarrierIDs{std::string(UNKNOWN_CARRIER)});
}

TEST_CASE("RestartRecovery: a resolved job is asked for when the job after it is resolved too")
{
    RecoveryParts parts;
    EngineParts before;
    const ActivePlan& plan = before.BeginLoad();
    StoredState stored = StoreWork(before, plan);
    StartJob earlier = *before.lr.job.GetOrNull();
    earlier.jobID = "P0-a1";
    earlier.progressToken = "5 5 0";
    stored.robotWorks.front().resolvedJob = earlier;
    stored.plans.front().progress.steps.front().jobs.front() = EJobState::InProgress;
    parts.recovery.Restore(stored);
    parts.Discard(); // the job after it is asked for
    parts.work.EndJob(parts.lr, {});
    const auto commands = parts.Collect().ListCommands<RecoverJob>();
    REQUIRE(commands.size() == 1);
    CHECK(commands.front().job == earlier);
}

TEST_CASE("RestartRecovery: the job of a plan that is over is overdue")
{
    RecoveryParts parts;
    EngineParts before;
    const ActivePlan& plan = before.BeginLoad();
    StoredState stored = StoreWork(before, plan);
    stored.plans.front().progress.state = EPlanState::Aborted;
    parts.recovery.Restore(stored);
    CHECK(parts.lr.planOrNull == nullptr);
    CHECK(parts.lr.job.IsOverdue("P1-a4"));
    const CallOutcome outcome = parts.Collect();
    CHECK(outcome.ListCommands<RecoverJob>().size() == 1);
    CHECK(outcome.ListCommands<CancelJob>().size() == 1);
    CHECK(outcome.GetDelayOrNull(EEngineTimer::JobEnd).has_value());
}

TEST_CASE(
    "RestartRecovery: a resolved job is asked for at once, or after the robot has reported the end of a later one")
{
    RecoveryParts parts;
    EngineParts before;
    const ActivePlan& plan = before.BeginLoad();
    StoredState stored = StoreWork(before, plan);
    stored.robotWorks.front().resolvedJob = *before.lr.job.GetOrNull();
    stored.robotWorks.front().resolvedJob->jobID = "P0-a4";
    const bool bLater = GENERATE(false, true);
    if (bLater)
    {
        parts.recovery.Restore(stored);
        const auto commands = parts.Collect().ListCommands<RecoverJob>();
        REQUIRE(commands.size() == 1);
        CHECK(commands.front().job.jobID == "P1-a4");
        parts.jobs.OnJobUnknown(parts.lr, JobUnknown{"P1-a4"});
    }
    else
    {
        stored.robotWorks.front().job.reset();
        parts.recovery.Restore(stored);
    }
    const CallOutcome outcome = parts.Collect();
    REQUIRE(outcome.ListCommands<RecoverJob>().size() == 1);
    CHECK(outcome.ListCommands<RecoverJob>().front().job == stored.robotWorks.front().resolvedJob);
    REQUIRE(outcome.ListCommands<CancelJob>().size() == 1);
    CHECK(outcome.ListCommands<CancelJob>().front().jobID == "P0-a4");
    parts.jobs.OnJobFinished(parts.lr, JobFinished{"P0-a4"});
    CHECK(parts.lr.job.GetResolvedOrNull() == nullptr);
}

TEST_CASE("RestartRecovery: a plan whose robot is no longer configured fails with an alarm")
{
    RecoveryParts parts;
    EngineParts before;
    StoredState stored;
    stored.plans = {before.BeginLoad().record};
    stored.plans.front().progress.robotID = "LR09";
    parts.recovery.Restore(stored);
    const PlanRecord* recordOrNull = parts.engine.plans.FindFinishedOrNull("P1");
    REQUIRE(recordOrNull != nullptr);
    CHECK(recordOrNull->progress.state == EPlanState::Failed);
    CHECK(parts.Collect().ListSetAlarms() == std::vector<std::string>{"ACS-1001"});
}

TEST_CASE(
    "RestartRecovery: a plan whose robot can no longer execute it fails with an alarm, although another one could")
{
    RecoveryParts parts;
    StoredState stored;
    stored.plans = {parts.Add(MakeControlPlan("P1")).record};
    stored.plans.front().progress.state = EPlanState::InProgress;
    stored.plans.front().progress.robotID = "LR01";
    RecoveryParts restarted;
    restarted.recovery.Restore(stored);
    CHECK(restarted.lr.planOrNull == nullptr);
    const PlanRecord* recordOrNull = restarted.engine.plans.FindFinishedOrNull("P1");
    REQUIRE(recordOrNull != nullptr);
    CHECK(recordOrNull->progress.state == EPlanState::Failed);
    CHECK(recordOrNull->progress.message.find("LR01 can no longer execute it") != std::string::npos);
    CHECK(restarted.Collect().ListSetAlarms() == std::vector<std::string>{"ACS-1001"});
}

TEST_CASE("RestartRecovery: an open control is confirmed again")
{
    RecoveryParts parts;
    EngineParts before;
    ActivePlan& plan = before.BeginDriveToLoad();
    plan.record.progress.control = GENERATE(EPlanControl::Cancel, EPlanControl::Pause);
    parts.recovery.Restore(StoreWork(before, plan));
    CHECK(parts.lr.planOrNull->record.progress.controlCount == 1);
    CHECK(parts.lr.control.bConfirming);
    CHECK(parts.Collect().GetDelayOrNull(EEngineTimer::ControlConfirm).has_value());
    const bool bCancels = plan.record.progress.control == EPlanControl::Cancel;
    CHECK(parts.lr.control.bStandstillAwaited == bCancels);
    CHECK(parts.lr.control.pause.IsPaused() != bCancels);
}

TEST_CASE("RestartRecovery: work is held until every robot that is in service has reported")
{
    RecoveryParts parts;
    EngineParts before;
    const ActivePlan& plan = before.BeginDriveToLoad();
    StoredState stored = StoreWork(before, plan);
    stored.robotWorks.front().nodeIDs = {"L03"};
    stored.robotsInMaintenance = {"CR01"};
    parts.recovery.Restore(stored);
    CHECK(parts.engine.startup.IsHoldingWork());
    CHECK(parts.Collect().GetDelayOrNull(EEngineTimer::Startup) == parts.engine.options.restartWait);
    parts.recovery.UpdateStartup();
    CHECK(parts.engine.startup.IsHoldingWork());
    parts.PutOn(parts.lr, "L03");
    parts.Discard();
    parts.recovery.UpdateStartup();
    CHECK_FALSE(parts.engine.startup.IsHoldingWork());
    CHECK(parts.engine.transaction.IsDispatchNeeded());
    const CallOutcome outcome = parts.Collect();
    CHECK(outcome.IsTimerCancelled(EEngineTimer::Startup));
    CHECK(outcome.ListActions<TscStateChanged>() == std::vector{TscStateChanged{ETscState::Auto}});
}

TEST_CASE("RestartRecovery: after the wait each missing robot has an alarm, and its nodes stay reserved")
{
    RecoveryParts parts;
    EngineParts before;
    const ActivePlan& plan = before.BeginDriveToLoad();
    StoredState stored = StoreWork(before, plan);
    stored.robotWorks.front().nodeIDs = {"L03"};
    parts.recovery.Restore(stored);
    parts.cr.view.bOnline = true;
    parts.Discard();
    parts.recovery.OnStartupDue();
    CHECK(parts.Collect().ListSetAlarms() == std::vector<std::string>{"ACS-1002", "ACS-1003"});
    CHECK(parts.places.GetTraffic().GetHolderOrNull(parts.FindNode("L03")) == parts.lr.index);
}

TEST_CASE("RestartRecovery: without a wait no work is held, and a missing robot is an alarm after 30 s")
{
    RecoveryParts parts;
    parts.engine.options.restartWait = 0ms;
    EngineParts before;
    StoredState stored = StoreWork(before, before.BeginDriveToLoad());
    stored.robotWorks.front().nodeIDs = {"L03"};
    parts.recovery.Restore(stored);
    CHECK_FALSE(parts.engine.startup.IsHoldingWork());
    CHECK(parts.Collect().GetDelayOrNull(EEngineTimer::Startup) == 30s);
    parts.PutOn(parts.lr, "L03");
    parts.Discard();
    parts.recovery.UpdateStartup();
    CHECK_FALSE(parts.Collect().IsTimerCancelled(EEngineTimer::Startup));
    parts.recovery.OnStartupDue();
    CHECK(parts.Collect().ListSetAlarms() == std::vector<std::string>{"ACS-1002"});
}

TEST_CASE("RestartRecovery: the alarm of a robot that has never connected states where it is expected")
{
    RecoveryParts parts;
    parts.engine.options.robots[0].connectionHint = "It is expected on uagv/v2/ACS/LR01/connection.";
    parts.recovery.Restore({});
    parts.Discard();
    parts.recovery.OnStartupDue();
    static_cast<void>(parts.Collect());
    const std::vector<Alarm>& alarms = parts.engine.alarms.GetAlarms();
    REQUIRE(alarms.size() == 2);
    CHECK(
        alarms[0].message
        == "The robot has not connected since the start of the ACS. Check the robot and its network. It is expected on "
           "uagv/v2/ACS/LR01/connection.");
    CHECK(
        alarms[1].message
        == "The robot has not connected since the start of the ACS. Check the robot and its network.");
}

TEST_CASE("RestartRecovery: alarms of robots that are gone and of drives are cleared")
{
    RecoveryParts parts;
    StoredState stored;
    stored.alarms = {
        MakeLinkAlarm("LR09", {}),
        MakeAlarm("LR01", ALARM_STALL, EAlarmLevel::Light, {}),
        MakeAlarm("LR01", ALARM_PORT, EAlarmLevel::Light, {}),
        MakeAlarm("LR01", ALARM_CHARGE, EAlarmLevel::Light, {}), // it has no charger
        MakeAlarm(OWN_ROBOT_ID, ALARM_STORE, EAlarmLevel::Heavy, {})};
    parts.recovery.Restore(stored);
    CHECK(parts.Collect().ListClearedAlarms() == std::vector<std::string>{"ACS-1002", "ACS-1009", "ACS-1010"});
    CHECK(parts.engine.alarms.GetAlarms().size() == 2);
    CHECK(parts.engine.backlog.IsFailing());
}
