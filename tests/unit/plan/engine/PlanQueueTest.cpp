#include "fixtures/PlanWorldSteps.hpp"

#include <algorithm>
#include <functional>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using ACS::Testing::BeginPlan;
using ACS::Testing::FinishPlan;
using ACS::Testing::Lines;
using ACS::Testing::MakeLogisticsPlan;
using ACS::Testing::MakeTestOptions;
using ACS::Testing::MakeTestSite;
using ACS::Testing::MakeWorld;
using ACS::Testing::PausePlan;
using ACS::Testing::PlanWorld;
using ACS::Testing::TryRunUntil;

namespace
{

void Restart(PlanWorld& world, const std::function<void(EngineOptions&)>& change)
{
    EngineOptions options = MakeTestOptions(false);
    change(options);
    world.Restart(options, MakeTestSite());
}

Plan MakePlan(const std::string& planID, std::optional<std::int32_t> priorityOrNull)
{
    Plan plan = MakeLogisticsPlan(planID);
    plan.priority = priorityOrNull;
    return plan;
}

Lines GetQueue(const PlanWorld& world)
{
    Lines planIDs;
    for (const PlanSummary& summary : world.engine->GetActivePlans())
    {
        planIDs.push_back(summary.planID);
    }
    return planIDs;
}

} // namespace

TEST_CASE("D-6 queue.priority_order and queue.default_priority")
{
    for (const bool bLower : {false, true})
    {
        PlanWorld world = MakeWorld([bLower](EngineOptions& options) {
            options.bLowerPriorityFirst = bLower;
            options.defaultPriority = 4;
        });
        world.Submit(MakePlan("P5", 5));
        world.Submit(MakePlan("P3", 3));
        world.Submit(MakePlan("P4", std::nullopt));
        CHECK(GetQueue(world) == (bLower ? Lines{"P3", "P4", "P5"} : Lines{"P5", "P4", "P3"}));
    }
}

TEST_CASE("queue.ageing: a plan that has waited long enough begins before a later one of a higher priority")
{
    for (const int minutes : {0, 5, 20})
    {
        PlanWorld world =
            MakeWorld([minutes](EngineOptions& options) { options.queueAgeing = std::chrono::minutes(minutes); });
        world.Submit(MakePlan("old", 1));
        world.Advance(std::chrono::minutes(16));
        world.Submit(MakePlan("new", 4));
        world.Submit(MakePlan("urgent", 5));
        // 16 minutes of age count as 3.2 priorities at 5 minutes each, and as 0.8 at 20 minutes.
        CHECK(GetQueue(world) == (minutes == 5 ? Lines{"urgent", "old", "new"} : Lines{"urgent", "new", "old"}));
        Restart(world, [minutes](EngineOptions& options) { options.queueAgeing = std::chrono::minutes(minutes); });
        CHECK(GetQueue(world) == (minutes == 5 ? Lines{"urgent", "old", "new"} : Lines{"urgent", "new", "old"}));
    }
}

TEST_CASE("queue.ageing: setting the wall clock changes no order, also over a restart; only time that acsd ran counts")
{
    for (const auto jump : {std::chrono::hours(-24), std::chrono::hours(24 * 365)})
    {
        INFO(jump.count());
        const auto change = [](EngineOptions& options) {
            options.queueAgeing = std::chrono::minutes(5);
        };
        PlanWorld world = MakeWorld(change);
        world.Submit(MakePlan("old", 1));
        world.Submit(MakePlan("paused", 1));
        world.JumpWall(jump);
        world.Submit(MakePlan("same", 1));
        world.Submit(MakePlan("urgent", 2));
        CHECK(GetQueue(world) == Lines{"urgent", "old", "paused", "same"});

        world.Advance(std::chrono::minutes(16));
        world.Control(EPlanControl::Pause, "paused"); // the latest that the store has of the queue's age
        world.JumpWall(-jump);
        Restart(world, change);
        world.JumpWall(jump);
        world.Submit(MakePlan("later", 4)); // younger by 3.2 levels than "old", by 3 levels more urgent
        CHECK(GetQueue(world) == Lines{"paused", "urgent", "old", "same", "later"});
    }
}

TEST_CASE("An operator changes the priority of a waiting plan: the order follows at once and after a restart")
{
    const auto ask = [](PlanWorld& world, const SetPlanPriority& command) {
        const std::optional<std::string> reason = world.engine->GetRejectionReasonOrNull(command);
        world.Ask(command);
        CHECK(world.replies.at(command.replyToken).bAccepted != reason.has_value());
        return world.replies.at(command.replyToken).message;
    };
    for (const int minutes : {0, 5})
    {
        const auto change = [minutes](EngineOptions& options) {
            options.queueAgeing = std::chrono::minutes(minutes);
        };
        PlanWorld world = MakeWorld(change);
        world.Submit(MakePlan("P1", 1), 1, "T1");
        world.Submit(MakePlan("P2", 2));
        world.Submit(MakePlan("P3", std::nullopt));
        CHECK(ask(world, {"P1", 5, 9}) == "Plan P1 has the priority 5.");
        CHECK(ask(world, {"P3", 4, 9}) == "Plan P3 has the priority 4.");
        CHECK(GetQueue(world) == Lines{"P1", "P3", "P2"});
        CHECK(world.engine->GetPlanRecordOrNull("P1")->GetPriorityOrNull() == 5);
        CHECK(world.engine->GetPlanRecordOrNull("P2")->GetPriorityOrNull() == 2);
        world.Submit(MakePlan("P1", 1), 2, "T1"); // a repetition
        CHECK(world.replies.at(2).bAccepted);
        Restart(world, change);
        CHECK(GetQueue(world) == Lines{"P1", "P3", "P2"});
        CHECK(ask(world, {"P1", -7, 9}) == "Plan P1 has the priority -7.");
        CHECK(GetQueue(world) == Lines{"P3", "P2", "P1"});
        world.Control(EPlanControl::Pause, "P1");
        CHECK(
            ask(world, {"P1", 9, 9})
            == "Plan P1 is Paused. Only the priority of a plan that waits in the queue can be changed.");
        world.Control(EPlanControl::Cancel, "P1");
        CHECK(ask(world, {"P1", 9, 9}) == "Plan P1 is already Cancelled.");
        CHECK(ask(world, {"P9", 9, 9}) == "There is no plan P9.");
        world.Connect();
        REQUIRE(TryRunUntil(world, "P3", "Plan InProgress"));
        CHECK(ask(world, {"P3", 9, 9}).starts_with("Plan P3 is InProgress."));
    }
}

TEST_CASE("D-23 A known planId is refused, unless plan.reuse_finished_id is set and its plan has ended")
{
    for (const bool bReused : {false, true})
    {
        PlanWorld world = MakeWorld([bReused](EngineOptions& options) { options.bFinishedIDsReused = bReused; });
        world.Connect();
        world.Submit(MakeLogisticsPlan("P1"), 1);
        world.Submit(MakeLogisticsPlan("P1"), 2);
        CHECK_FALSE(world.replies.at(2).bAccepted);
        REQUIRE(world.TryRun());
        const std::size_t before = world.GetReportsOf("P1").size();
        world.Submit(MakeLogisticsPlan("P1"), 3);
        CHECK(world.replies.at(3).bAccepted == bReused);
        REQUIRE(world.TryRun());
        CHECK(world.GetReportsOf("P1").size() == (bReused ? 2 * before : before));
        REQUIRE(world.store.GetState().plans.size() == 1);
        CHECK(world.store.GetState().plans.front().sequence == (bReused ? 2 : 1));
    }
}

TEST_CASE("D-23 The history of a planId is kept when its next plan could not be stored")
{
    PlanWorld world = MakeWorld([](EngineOptions& options) { options.bFinishedIDsReused = true; });
    world.Connect();
    world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(world.TryRun());
    world.store.bFails = true;
    world.Submit(MakeLogisticsPlan("P1"), 2);
    CHECK_FALSE(world.replies.at(2).bAccepted);
    REQUIRE(world.engine->GetPlanOrNull("P1").has_value());
    CHECK(world.engine->GetPlanOrNull("P1")->state == EPlanState::Completed);
    world.store.bFails = false;
    REQUIRE(world.TryRun());
    REQUIRE(world.store.GetState().plans.size() == 1);
    CHECK(world.store.GetState().plans.front().progress.state == EPlanState::Completed);
}

TEST_CASE("D-24 reports.initial_pending decides whether accepted plans are reported as Pending; refused ones never are")
{
    for (const bool bReported : {false, true})
    {
        PlanWorld world =
            MakeWorld([bReported](EngineOptions& options) { options.bInitialPendingReported = bReported; });
        world.Submit(MakeLogisticsPlan("P1"));
        world.store.bFails = true;
        world.Submit(MakeLogisticsPlan("P2"));
        world.store.bFails = false;
        REQUIRE(world.TryRun());
        CHECK(world.GetReportsOf("P1") == (bReported ? Lines{"Plan Pending"} : Lines{}));
        CHECK(world.GetReportsOf("P2").empty());
    }
}

TEST_CASE("history.keep: the latest finished plans are kept in memory and in the store, also after a restart")
{
    PlanWorld world = MakeWorld([](EngineOptions& options) { options.finishedPlansKept = 3; });
    world.Connect();
    for (const std::string number : {"1", "2", "3", "4", "5"})
    {
        world.Submit(MakeLogisticsPlan("P" + number));
        world.Control(EPlanControl::Cancel, "P" + number);
    }
    REQUIRE(world.TryRun());
    CHECK_FALSE(world.engine->GetPlanOrNull("P2").has_value());
    CHECK(world.engine->GetPlanOrNull("P3").has_value());
    REQUIRE(world.store.GetState().plans.size() == 3);
    CHECK(world.store.GetState().plans.front().plan.planID == "P3");
    Restart(world, [](EngineOptions& options) { options.finishedPlansKept = 1; });
    REQUIRE(world.store.GetState().plans.size() == 1);
    CHECK(world.store.GetState().plans.front().plan.planID == "P5");
    CHECK(world.engine->GetPlanOrNull("P5")->state == EPlanState::Cancelled);
}

TEST_CASE("R15, E82 TSC: Pausing completes what runs and begins nothing, Paused queues plans, Auto begins them")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Step 1 InProgress");
    world.SwitchTSC(true);
    CHECK(world.engine->GetTscState() == ETscState::Pausing);
    world.Submit(MakeLogisticsPlan("P2"), 2);
    CHECK(world.replies.at(2).bAccepted);
    FinishPlan(world);
    CHECK(world.GetReportsOf("P2").empty());
    CHECK(world.GetTraceOf("tsc ") == Lines{"Pausing", "Paused"});
    CHECK(world.GetRobot("LR01").GetOccupied() == Lines{"D-A02.CP03"}); // It does not drive to its parking position.
    world.SwitchTSC(true);
    world.SwitchTSC(false);
    world.SwitchTSC(false);
    CHECK(world.GetTraceOf("tsc ") == Lines{"Pausing", "Paused", "Auto"});
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P2").back() == "Plan Completed");
}

TEST_CASE("E82 TSC: Paused follows at once if nothing runs, and Auto is possible while it is Pausing")
{
    PlanWorld world;
    world.Connect();
    world.SwitchTSC(true);
    CHECK(world.GetTraceOf("tsc ") == Lines{"Pausing", "Paused"});
    world.SwitchTSC(false);
    world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(TryRunUntil(world, "P1", "Plan InProgress"));
    world.SwitchTSC(true);
    world.SwitchTSC(false);
    CHECK(world.GetTraceOf("tsc ") == Lines{"Pausing", "Paused", "Auto", "Pausing", "Auto"});
}

TEST_CASE("E82 TSC: a robot that drives to its parking position keeps it Pausing until it has arrived")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Plan Completed");
    REQUIRE(world.TryRun([&world] { return world.GetRobot("LR01").drives == 3; }));
    world.SwitchTSC(true);
    CHECK(world.GetTraceOf("tsc ") == Lines{"Pausing"});
    REQUIRE(world.TryRun());
    CHECK(world.GetTraceOf("tsc ") == Lines{"Pausing", "Paused"});
    CHECK(world.GetRobot("LR01").GetOccupied() == Lines{"D-CHG01"});
}

TEST_CASE("E82 TSC: a paused plan does not keep it Pausing, and is not resumed before the TSC is Auto")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Step 1 InProgress");
    PausePlan(world);
    world.SwitchTSC(true);
    CHECK(world.engine->GetTscState() == ETscState::Paused);
    world.Control(EPlanControl::Resume, "P1");
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1").back() == "ResumeResult Failed");
    world.SwitchTSC(false);
    world.Control(EPlanControl::Resume, "P1");
    FinishPlan(world);
}

TEST_CASE("E82 TSC: a pause is kept over a restart; with tsc.initial paused every start is Paused")
{
    PlanWorld world;
    world.SwitchTSC(true);
    world.SwitchTSC(false);
    Restart(world, [](EngineOptions&) {});
    CHECK(world.engine->GetTscState() == ETscState::Auto);
    world.SwitchTSC(true);
    Restart(world, [](EngineOptions&) {});
    CHECK(world.engine->GetTscState() == ETscState::Paused);
    world.Connect();
    world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1").empty());
    world.SwitchTSC(false);
    REQUIRE(TryRunUntil(world, "P1", "Plan InProgress"));
    Restart(world, [](EngineOptions& options) { options.bTscStartsPaused = true; });
    CHECK(world.engine->GetTscState() == ETscState::Pausing); // Running plans are completed.
    world.Connect();
    FinishPlan(world);
    CHECK(world.engine->GetTscState() == ETscState::Paused);
    CHECK(world.store.GetState().tscState == ETscState::Paused);
}

TEST_CASE("E82 tsc.paused_accepts_plans: plans that arrive while the TSC is not Auto wait, or are refused")
{
    for (const bool bAccepted : {true, false})
    {
        PlanWorld world =
            MakeWorld([bAccepted](EngineOptions& options) { options.bTscPausedAcceptsPlans = bAccepted; });
        world.SwitchTSC(true);
        world.Submit(MakeLogisticsPlan("P1"), 1);
        CHECK(world.replies.at(1).bAccepted == bAccepted);
    }
}

TEST_CASE("After a restart a plan that was held in the queue is still held, and continues when it is resumed")
{
    PlanWorld world;
    world.Submit(MakeLogisticsPlan("P1"));
    world.Control(EPlanControl::Pause, "P1");
    Restart(world, [](EngineOptions&) {});
    world.Connect();
    REQUIRE(world.TryRun());
    CHECK(world.engine->GetPlanOrNull("P1")->state == EPlanState::Paused);
    world.Control(EPlanControl::Resume, "P1");
    FinishPlan(world);
}

TEST_CASE("9 outbox.max: a plan without room for its reports is refused with an alarm, and nothing is lost")
{
    constexpr std::size_t LIMIT = 20;
    PlanWorld world = MakeWorld([](EngineOptions& options) { options.maximumReports = LIMIT; });
    const auto isFull = [&world] {
        const auto& alarms = world.engine->GetActiveAlarms();
        return std::any_of(alarms.begin(), alarms.end(), [](const Alarm& alarm) {
            return alarm.errorCode == "ACS-1020";
        });
    };
    world.bAcknowledges = false;
    world.Connect();
    world.Submit(MakeLogisticsPlan("P1"), 1);
    REQUIRE(world.TryRun());
    REQUIRE_FALSE(world.GetReportsOf("P1").empty());
    const std::vector<OutboxEntry> waiting = world.engine->GetUnacknowledged();
    CHECK(waiting.size() <= LIMIT);
    CHECK(world.GetReportsOf("P1").back() == "Plan Completed");

    world.Submit(MakeLogisticsPlan("P2"), 2);
    CHECK_FALSE(world.replies.at(2).bAccepted);
    CHECK(world.replies.at(2).message.find("Outbox Full") != std::string::npos);
    CHECK(isFull());

    EngineActions ignored;
    for (const OutboxEntry& entry : waiting)
    {
        world.engine->Handle(PlanCommand(MessageAcknowledged{entry.sequence}), world.GetNow(), ignored);
        if (world.engine->IsStoring())
        {
            world.engine->OnStored({}, world.GetNow(), ignored);
        }
    }
    CHECK_FALSE(isFull());
    world.Submit(MakeLogisticsPlan("P3"), 3);
    CHECK(world.replies.at(3).bAccepted);
}
