#include "engine/StoreGate.hpp"

#include "Catch.hpp"
#include "fixtures/EngineParts.hpp"
#include "fixtures/PlanWorld.hpp"
#include <acs/plan/EPlanningError.hpp>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS::Testing;  // NOLINT(google-build-using-namespace): its fixtures

namespace
{

struct GateParts : EngineParts
{
    StoreGate store{engine, answers, places, work};

    /// The actions of the call, and the changes of its batch.
    CallOutcome CommitCall()
    {
        CallOutcome outcome;
        store.Commit(outcome.actions);
        for (const StorePlans& action : outcome.ListActions<StorePlans>())
        {
            outcome.changes = action.batch.changes;
        }
        return outcome;
    }

    CallOutcome EndStore(const ACS::Core::Result<void>& result)
    {
        CallOutcome outcome;
        store.OnStored(result, engine.transaction.GetNow(), outcome.actions);
        return outcome;
    }

    CallOutcome EndStore(bool bStored)
    {
        return bStored ? EndStore(ACS::Core::Result<void>())
                       : EndStore(ACS::Core::Fail(make_error_code(EPlanningError::StoreFailed)));
    }

    /// The batch may be stored.
    CallOutcome LeaveStore()
    {
        return EndStore(ACS::Core::Fail(make_error_code(EPlanningError::StoreOutcomeUnknown)));
    }

    /// The retry timer expires.
    CallOutcome RetryStore(bool bStored)
    {
        engine.backlog.OnRetryDue();
        BeginCall();
        static_cast<void>(CommitCall());
        return EndStore(bStored);
    }

    void BeginCall()
    {
        engine.plans.BeginCall(engine.transaction.GetNow().steady);
        store.CheckStoreRecovery();
        engine.call.Begin();
    }

    /// The store fails with a report.
    void FailStore()
    {
        engine.transaction.AddReport(PlanReport{});
        static_cast<void>(CommitCall());
        static_cast<void>(EndStore(false));
    }
};

} // namespace

TEST_CASE("StoreGate: actions that depend on a batch are released after it is stored")
{
    GateParts parts;
    parts.engine.transaction.AddReport(PlanReport{"P1", EPlanState::Pending, {}});
    parts.engine.transaction.Command(parts.lr, Pause{});
    const CallOutcome call = parts.CommitCall();
    CHECK(call.actions.size() == 1);
    CHECK(call.ListChanges<ReportAdded>().size() == 1);
    CHECK(parts.store.IsStoring());
    const CallOutcome stored = parts.EndStore(true);
    CHECK_FALSE(parts.store.IsStoring());
    CHECK(stored.ListReports<PlanReport>().size() == 1);
    CHECK(stored.ListCommands<Pause>().size() == 1);
}

TEST_CASE("StoreGate: actions without changes do not wait")
{
    GateParts parts;
    parts.engine.transaction.Reply(7, true, {});
    CHECK(parts.CommitCall().ListActions<ReplyCommand>().size() == 1);
    CHECK_FALSE(parts.store.IsStoring());
}

TEST_CASE("StoreGate: a job is stored with the work of its robot before it is commanded")
{
    GateParts parts;
    parts.BeginLoad();
    parts.lr.changes.MarkWork();
    const auto works = parts.CommitCall().ListChanges<RobotWorkChanged>();
    REQUIRE(works.size() == 1);
    REQUIRE(works.front().job.has_value());
    CHECK(works.front().job->jobID == "P1-a4");
    CHECK(works.front().nodeIDs == std::vector<std::string>{"D-A01.CP01"});
    static_cast<void>(parts.EndStore(true));
    parts.lr.changes.MarkWork();
    CHECK(parts.CommitCall().actions.empty());
}

TEST_CASE("StoreGate: a plan that cannot be stored is refused, and the reports wait")
{
    GateParts parts;
    parts.BeginCall();
    parts.Accept(MakeLogisticsPlan("P1"));
    parts.engine.transaction.Reply(7, true, {});
    static_cast<void>(parts.CommitCall());
    const CallOutcome failed = parts.EndStore(false);
    REQUIRE(failed.ListActions<ReplyCommand>().size() == 1);
    CHECK_FALSE(failed.ListActions<ReplyCommand>().front().bAccepted);
    CHECK(failed.GetDelayOrNull(EEngineTimer::StoreRetry) == parts.engine.options.storeRetry);
    CHECK(failed.ListActions<SendReport>().empty());
    CHECK(parts.engine.plans.GetActive().empty());
    REQUIRE(parts.engine.alarms.GetAlarms().size() == 1);
    CHECK(parts.engine.alarms.GetAlarms().front().errorCode == "ACS-1005");
    CHECK(parts.engine.backlog.CountHeldBack() == 1);
}

TEST_CASE("StoreGate: a plan that may be stored is refused after the next successful write only")
{
    GateParts parts;
    parts.BeginCall();
    parts.Accept(MakeLogisticsPlan("P1"));
    parts.engine.transaction.Reply(7, true, {});
    static_cast<void>(parts.CommitCall());
    CHECK(parts.LeaveStore().ListActions<ReplyCommand>().empty());
    CHECK(parts.engine.plans.GetActive().empty());
    CHECK(parts.engine.backlog.HasWithheld());
    CHECK(parts.engine.backlog.HasUnknown("P1"));
    CHECK_FALSE(parts.engine.backlog.HasUnknown("P2"));
    CHECK(parts.RetryStore(false).ListActions<ReplyCommand>().empty());
    const auto replies = parts.RetryStore(true).ListActions<ReplyCommand>();
    REQUIRE(replies.size() == 1);
    CHECK(replies.front().replyToken == 7);
    CHECK_FALSE(replies.front().bAccepted);
    CHECK_FALSE(parts.engine.backlog.HasWithheld());
    CHECK_FALSE(parts.engine.backlog.HasUnknown("P1"));
}

TEST_CASE("StoreGate: a control that may be stored is refused after the next successful write only")
{
    GateParts parts;
    parts.BeginLoad();
    parts.BeginCall();
    parts.controls.Control(ControlPlan{EPlanControl::Pause, "P1", {}, 7, "1"});
    static_cast<void>(parts.CommitCall());
    CHECK(parts.LeaveStore().ListActions<ReplyCommand>().empty());
    CHECK(parts.RetryStore(true).ListActions<ReplyCommand>().size() == 1);
}

TEST_CASE("StoreGate: the retry stores waiting changes, and the next call clears the alarm")
{
    GateParts parts;
    parts.FailStore();
    parts.BeginCall();
    parts.engine.transaction.AddReport(PlanReport{"P2", EPlanState::Failed, {}});
    parts.engine.transaction.Command(parts.lr, Pause{});
    CallOutcome call = parts.CommitCall();
    CHECK(call.ListActions<StorePlans>().empty());
    CHECK(call.ListCommands<Pause>().size() == 1);
    CHECK(call.ListActions<SendReport>().empty());
    parts.engine.backlog.OnRetryDue();
    parts.BeginCall();
    call = parts.CommitCall();
    CHECK(call.ListChanges<ReportAdded>().size() == 3);
    const CallOutcome stored = parts.EndStore(true);
    CHECK(stored.ListActions<SendReport>().size() == 3);
    CHECK(parts.engine.backlog.IsFailing());
    parts.BeginCall();
    CHECK_FALSE(parts.engine.backlog.IsFailing());
    CHECK(parts.engine.alarms.GetAlarms().empty());
    CHECK(parts.engine.transaction.IsDispatchNeeded());
}

TEST_CASE("StoreGate: the first job of a plan that is not stored as begun is withdrawn")
{
    GateParts parts;
    parts.BeginCall();
    parts.PutOn(parts.lr, "D-A01.CP01");
    ActivePlan& plan = parts.AddLoad();
    parts.Discard(); // the plan itself is stored
    parts.assignment.Offer(plan, parts.lr);
    parts.work.BeginWork(parts.lr);
    const std::string commandID = parts.lr.job.GetOrNull()->commandID;
    static_cast<void>(parts.CommitCall());
    const CallOutcome failed = parts.EndStore(false);
    CHECK(failed.ListCommands<StartJob>().empty());
    CHECK(plan.bUnstored);
    CHECK(plan.repetition.commandID == commandID);
    CHECK(parts.lr.activity == EActivity::Waits);
}

TEST_CASE("StoreGate: a pause of a robot that cannot be stored is refused and withdrawn")
{
    GateParts parts;
    ActivePlan& plan = parts.BeginLoad();
    parts.BeginCall();
    parts.controls.Control(ControlPlan{EPlanControl::Pause, "P1", {}, 7, "1"});
    static_cast<void>(parts.CommitCall());
    const CallOutcome failed = parts.EndStore(false);
    REQUIRE(failed.ListActions<ReplyCommand>().size() == 1);
    CHECK_FALSE(failed.ListActions<ReplyCommand>().front().bAccepted);
    CHECK(failed.ListCommands<Pause>().empty());
    CHECK_FALSE(plan.record.progress.control.has_value());
    CHECK_FALSE(parts.lr.control.pause.IsPaused());
}

TEST_CASE("StoreGate: a pause that cannot be stored leaves a robot paused whose plan was being resumed")
{
    GateParts parts;
    ActivePlan& plan = parts.BeginDriveToLoad();
    plan.record.progress.state = EPlanState::Paused;
    plan.record.progress.control = EPlanControl::Resume;
    parts.lr.control.pause.Resume();
    const bool bShowsPaused = GENERATE(false, true); // then the pause is confirmed at once
    parts.lr.view.state->bPaused = bShowsPaused;
    parts.BeginCall();
    parts.controls.Control(ControlPlan{EPlanControl::Pause, "P1", {}, 7, "1"});
    static_cast<void>(parts.CommitCall());
    const CallOutcome failed = parts.EndStore(false);
    CHECK(failed.ListCommands<Pause>().size() == (bShowsPaused ? 1 : 0));
    CHECK(failed.ListActions<ReplyCommand>().size() == (bShowsPaused ? 0 : 1));
    CHECK(parts.lr.control.pause.IsPaused());
}

TEST_CASE("StoreGate: a control that has taken effect is answered after the next successful write")
{
    GateParts parts;
    ActivePlan& plan = parts.BeginDriveToLoad();
    parts.BeginCall();
    const EControlOrigin origin = GENERATE(EControlOrigin::MCS, EControlOrigin::Operator);
    parts.controls.Control(ControlPlan{EPlanControl::Abort, "P1", {}, 7, "1", origin});
    static_cast<void>(parts.CommitCall());
    const CallOutcome failed = parts.EndStore(false);
    CHECK(failed.ListActions<ReplyCommand>().empty());
    CHECK(failed.ListCommands<CancelDrive>().size() == 1);
    CHECK(plan.record.progress.control == EPlanControl::Abort);
    CHECK(parts.engine.call.unstoredControlIDs.contains("Abort 1"));
    CHECK(parts.RetryStore(false).ListActions<ReplyCommand>().empty());
    const auto replies = parts.RetryStore(true).ListActions<ReplyCommand>();
    REQUIRE(replies.size() == 1);
    CHECK(replies.front().replyToken == 7);
    CHECK(replies.front().bAccepted);
}

TEST_CASE("StoreGate: the receipt of an operator's pause that cannot be stored is withdrawn with it")
{
    GateParts parts;
    parts.BeginLoad();
    parts.BeginCall();
    parts.controls.Control(ControlPlan{EPlanControl::Pause, "P1", {}, 7, {}, EControlOrigin::Operator});
    parts.engine.transaction.Store(ReceiptAdded{{"lee", "pause", "accepted", {}}});
    static_cast<void>(parts.CommitCall());
    const CallOutcome failed = parts.EndStore(false);
    REQUIRE(failed.ListActions<ReplyCommand>().size() == 1);
    CHECK_FALSE(failed.ListActions<ReplyCommand>().front().bAccepted);
    CHECK_FALSE(parts.lr.control.pause.IsPaused());
    CHECK(std::ranges::none_of(parts.engine.backlog.CollectChanges(), [](const StoreChange& change) {
        return std::holds_alternative<ReceiptAdded>(change);
    }));
}

TEST_CASE("StoreGate: acknowledgements are stored together")
{
    GateParts parts;
    parts.engine.transaction.AddReport(PlanReport{});
    parts.engine.transaction.AddReport(PlanReport{});
    static_cast<void>(parts.CommitCall());
    static_cast<void>(parts.EndStore(true));
    for (const std::uint64_t sequence : {1U, 2U, 2U})
    {
        parts.store.Acknowledge(MessageAcknowledged{sequence});
    }
    const CallOutcome call = parts.CommitCall();
    CHECK(call.ListActions<StartEngineTimer>().size() == 1);
    CHECK(call.GetDelayOrNull(EEngineTimer::Acknowledged) == parts.engine.options.acknowledgedDelay);
    parts.store.StoreAcknowledged();
    CHECK(parts.CommitCall().ListChanges<ReportRemoved>() == std::vector{ReportRemoved{1}, ReportRemoved{2}});
}

TEST_CASE("StoreGate: a lost store is reported once")
{
    GateParts parts;
    CallOutcome lost;
    parts.store.OnStoreLost("gone", parts.engine.transaction.GetNow(), lost.actions);
    CHECK(lost.GetDelayOrNull(EEngineTimer::StoreRetry).has_value());
    CHECK(parts.engine.backlog.IsFailing());
    CallOutcome again;
    parts.store.OnStoreLost("gone", parts.engine.transaction.GetNow(), again.actions);
    CHECK(again.actions.empty());
    CHECK(parts.engine.alarms.GetAlarms().size() == 1);
}

TEST_CASE("StoreGate: a store that is lost after a retry is not taken for one that works")
{
    GateParts parts;
    parts.FailStore();
    parts.engine.backlog.OnRetryDue();
    parts.BeginCall();
    static_cast<void>(parts.CommitCall());
    CHECK(parts.EndStore(true).GetDelayOrNull(EEngineTimer::StoreRetry).has_value());
    CallOutcome lost;
    parts.store.OnStoreLost("gone", parts.engine.transaction.GetNow(), lost.actions);
    CHECK(lost.actions.empty());
    parts.BeginCall();
    CHECK(parts.engine.backlog.IsFailing());
    CHECK(parts.engine.alarms.GetAlarms().size() == 1);
    parts.engine.backlog.OnRetryDue();
    parts.engine.transaction.AddReport(PlanReport{});
    CHECK_FALSE(parts.CommitCall().ListActions<StorePlans>().empty());
}

TEST_CASE("StoreGate: a store that failed before the restart is tried also by a call without changes")
{
    GateParts parts;
    parts.engine.alarms.Restore({MakeAlarm(OWN_ROBOT_ID, ALARM_STORE, EAlarmLevel::Heavy, "failed")});
    parts.engine.backlog.RestoreFailing();
    parts.BeginCall();
    CallOutcome call = parts.CommitCall();
    CHECK(call.ListActions<StorePlans>().empty());
    CHECK(call.GetDelayOrNull(EEngineTimer::StoreRetry) == parts.engine.options.storeRetry);
    parts.BeginCall();
    CHECK_FALSE(parts.engine.backlog.IsFailing());
    CHECK(parts.engine.transaction.IsDispatchNeeded());
    CHECK(parts.CommitCall().ListChanges<AlarmCleared>().size() == 1);
    static_cast<void>(parts.EndStore(false));
    CHECK(parts.engine.backlog.IsFailing());
    CHECK(parts.engine.alarms.GetAlarms().size() == 1);
}
