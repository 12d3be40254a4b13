#include "Catch.hpp"
#include "fixtures/EngineParts.hpp"
#include "fixtures/PlanWorld.hpp"

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS::Testing;  // NOLINT(google-build-using-namespace): its fixtures

TEST_CASE("EngineTransaction: a changed state is stored with its report, and collected once")
{
    EngineParts parts;
    ActivePlan& plan = parts.AddLoad();
    parts.Discard();
    static_cast<void>(parts.engine.plans.CollectProgress());
    parts.engine.transaction.ChangePlan(plan, EPlanState::InProgress, "Begun.");
    const CallOutcome outcome = parts.Collect();
    const auto stored = outcome.ListChanges<ReportAdded>();
    const auto sent = outcome.ListActions<SendReport>();
    REQUIRE(stored.size() == 1);
    REQUIRE(sent.size() == 1);
    CHECK(stored.front().entry == sent.front().entry);
    CHECK(outcome.ListReports<PlanReport>() == std::vector{PlanReport{"P1", EPlanState::InProgress, "Begun."}});
    CHECK(parts.engine.plans.CollectProgress().size() == 1);
    CHECK(parts.Collect().actions.empty());
    CHECK(parts.Collect().changes.empty());
}

TEST_CASE("EngineTransaction: the job of a step without jobs is not reported")
{
    EngineParts parts;
    Plan plan = MakeControlPlan("P1");
    plan.steps[1].jobs.clear();
    plan.steps.resize(2);
    parts.engine.options.actions.at("MemoryPickAndPlace").bJobsRequired = false;
    ActivePlan& active = parts.Add(plan);
    active.step = 1;
    parts.Discard();
    parts.engine.transaction.ChangeJob(active, EJobState::Instructed, {});
    CHECK(parts.Collect().actions.empty());
    active.step = 0;
    parts.engine.transaction.ChangeJob(active, EJobState::Instructed, {});
    CHECK(parts.Collect().ListReports<JobReport>().size() == 1);
}

TEST_CASE("EngineTransaction: an alarm is reported when it is set and when it is cleared")
{
    EngineParts parts;
    const Alarm alarm = MakeLinkAlarm("LR01", "Connection lost.");
    parts.engine.transaction.RaiseAlarm(alarm);
    parts.engine.transaction.RaiseAlarm(alarm);
    CallOutcome outcome = parts.Collect();
    CHECK(outcome.ListReports<ErrorReport>() == std::vector{ErrorReport{alarm, true}});
    CHECK(outcome.ListChanges<AlarmSet>().size() == 1);
    parts.engine.transaction.ClearAlarm(alarm);
    parts.engine.transaction.ClearAlarm(alarm);
    outcome = parts.Collect();
    CHECK(outcome.ListReports<ErrorReport>() == std::vector{ErrorReport{alarm, false}});
    CHECK(outcome.ListChanges<AlarmCleared>().size() == 1);
}

TEST_CASE(
    "EngineTransaction: the outbox alarm is set when no plan has room, and cleared below nine tenths of this limit")
{
    EngineOptions options = MakeTestOptions(false);
    options.maximumReports = 100;
    EngineParts parts(options);
    const auto acknowledge = [&parts](std::size_t count) {
        while (parts.engine.outbox.GetUnacknowledged().size() > count)
        {
            REQUIRE(parts.engine.outbox.TryRemove(parts.engine.outbox.GetUnacknowledged().front().sequence));
        }
        parts.engine.transaction.WatchOutbox();
    };
    for (int i = 0; i < 79; ++i)
    {
        parts.engine.transaction.AddReport(PlanReport{});
    }
    parts.engine.transaction.WatchOutbox();
    CHECK(parts.Collect().ListSetAlarms().empty());
    parts.engine.transaction.AddReport(PlanReport{});
    parts.engine.transaction.WatchOutbox();
    CHECK(parts.Collect().ListSetAlarms() == std::vector<std::string>{"ACS-1020"});
    acknowledge(73); // one of them is the alarm
    CHECK(parts.Collect().ListClearedAlarms().empty());
    acknowledge(72);
    CHECK(parts.Collect().ListClearedAlarms() == std::vector<std::string>{"ACS-1020"});
}

TEST_CASE("EngineTransaction: a command has the work of its robot stored")
{
    EngineParts parts;
    static_cast<void>(parts.lr.changes.TryUnmarkWork());
    parts.engine.transaction.Command(parts.lr, Pause{});
    CHECK(parts.lr.changes.IsWorkMarked());
    CHECK_FALSE(parts.cr.changes.IsWorkMarked());
    CHECK(parts.Collect().ListActions<CommandRobot>() == std::vector{CommandRobot{"LR01", Pause{}}});
}

TEST_CASE("EngineTransaction: a dispatch is begun once for all requests before it")
{
    EngineParts parts;
    EngineTransaction& transaction = parts.engine.transaction;
    CHECK_FALSE(transaction.TryBeginDispatch());
    transaction.RequestDispatch();
    transaction.RequestDispatch();
    CHECK(transaction.IsDispatchNeeded());
    CHECK(transaction.TryBeginDispatch());
    CHECK_FALSE(transaction.TryBeginDispatch());
}
