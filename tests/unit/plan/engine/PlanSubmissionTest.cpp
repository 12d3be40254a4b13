#include "engine/PlanSubmission.hpp"

#include "Catch.hpp"
#include "fixtures/EngineParts.hpp"
#include "fixtures/PlanWorld.hpp"

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS::Testing;  // NOLINT(google-build-using-namespace): its fixtures

namespace
{

struct SubmissionParts : EngineParts
{
    PlanSubmission submission{engine, tsc, waits};

    using EngineParts::EngineParts;

    CallOutcome SubmitPlanOf(const std::string& planID, const std::string& transactionID = {})
    {
        engine.call.Begin();
        submission.Submit(SubmitPlan{MakeLogisticsPlan(planID), 7, transactionID});
        return Collect();
    }

    [[nodiscard]] bool IsAccepted(const std::string& planID)
    {
        const auto replies = SubmitPlanOf(planID).ListActions<ReplyCommand>();
        REQUIRE(replies.size() == 1);
        return replies.front().bAccepted;
    }
};

} // namespace

TEST_CASE("PlanSubmission: an accepted plan is stored and queued, and its dispatch is timed")
{
    SubmissionParts parts;
    Plan plan = MakeLogisticsPlan("P1");
    std::swap(plan.steps[0], plan.steps[1]);
    parts.submission.Submit(SubmitPlan{plan, 7, "1"});
    const CallOutcome outcome = parts.Collect();
    const auto added = outcome.ListChanges<PlanAdded>();
    REQUIRE(added.size() == 1);
    CHECK(added.front().record.plan == MakeLogisticsPlan("P1"));
    CHECK(added.front().record.transactionID == "1");
    CHECK(outcome.GetDelayOrNull(EEngineTimer::Dispatch).has_value());
    CHECK(outcome.ListActions<ReplyCommand>().front().bAccepted);
    CHECK(parts.engine.plans.GetQueue().size() == 1);
    CHECK(parts.engine.plans.FindNextStoredOrNull(nullptr) == nullptr);
}

TEST_CASE("PlanSubmission: a planID is accepted once, and the same request is answered as before")
{
    SubmissionParts parts;
    parts.SubmitPlanOf("P1", "1");
    CallOutcome outcome = parts.SubmitPlanOf("P1", "1");
    CHECK(outcome.ListActions<ReplyCommand>().front().bAccepted);
    CHECK(outcome.changes.empty());
    CHECK(parts.engine.call.repeatedPlanIDs.at(7) == "P1");
    outcome = parts.SubmitPlanOf("P1", "2");
    CHECK_FALSE(outcome.ListActions<ReplyCommand>().front().bAccepted);
    CHECK(outcome.changes.empty());
    CHECK(parts.engine.call.repeatedPlanIDs.empty());
}

TEST_CASE("PlanSubmission: while a refusal waits plans are refused, and the plan that may be stored waits too")
{
    SubmissionParts parts;
    parts.engine.backlog.Withhold({6, false, "disk"});
    parts.engine.backlog.NoteUnknown("P1");
    CallOutcome outcome = parts.SubmitPlanOf("P2");
    REQUIRE(outcome.ListActions<ReplyCommand>().size() == 1);
    CHECK_FALSE(outcome.ListActions<ReplyCommand>().front().bAccepted);
    CHECK(outcome.changes.empty());
    outcome = parts.SubmitPlanOf("P1");
    CHECK(outcome.actions.empty());
    CHECK(outcome.changes.empty());
    CHECK(parts.engine.backlog.CollectWithheld().size() == 2);
    CHECK(parts.IsAccepted("P1"));
}

TEST_CASE("PlanSubmission: the option lets the planID of a finished plan be used again")
{
    EngineOptions options = MakeTestOptions(false);
    options.bFinishedIDsReused = GENERATE(false, true);
    SubmissionParts parts(options);
    parts.work.EndPlan(parts.AddLoad(), EPlanState::Aborted, {});
    parts.Discard();
    CHECK(parts.IsAccepted("P1") == options.bFinishedIDsReused);
}

TEST_CASE("PlanSubmission: plans are refused at each limit")
{
    EngineOptions options = MakeTestOptions(false);
    SECTION("unfinished plans")
    {
        options.maximumPlans = 2;
        SubmissionParts parts(options);
        CHECK(parts.IsAccepted("P1"));
        CHECK(parts.IsAccepted("P2"));
        CHECK_FALSE(parts.IsAccepted("P3"));
    }
    SECTION("reports that are not acknowledged")
    {
        options.maximumReports = 60; // the plan can cause 15, alarms and controls have 6 each
        SubmissionParts parts(options);
        CHECK(parts.IsAccepted("P1"));
        CHECK(parts.IsAccepted("P2"));
        for (int i = 0; i < 3; ++i)
        {
            parts.engine.transaction.AddReport(PlanReport{});
        }
        CHECK(parts.IsAccepted("P3"));
        CHECK_FALSE(parts.IsAccepted("P4"));
    }
    SECTION("a paused TSC, if the options refuse plans then")
    {
        options.bTscPausedAcceptsPlans = GENERATE(false, true);
        SubmissionParts parts(options);
        parts.tsc.SwitchTSC(ControlTSC{true, 0});
        parts.Discard();
        CHECK(parts.IsAccepted("P1") == options.bTscPausedAcceptsPlans);
    }
}

TEST_CASE("PlanSubmission: Pending is reported once, after the plan is stored and while it is pending")
{
    EngineOptions options = MakeTestOptions(false);
    options.bInitialPendingReported = true;
    SubmissionParts parts(options);
    CHECK(parts.SubmitPlanOf("P1").ListReports<PlanReport>().empty());
    parts.SubmitPlanOf("P2");
    parts.work.EndPlan(*parts.engine.plans.FindActiveOrNull("P2"), EPlanState::Aborted, {});
    parts.Discard();
    parts.submission.ReportAccepted();
    const auto reports = parts.Collect().ListReports<PlanReport>();
    REQUIRE(reports.size() == 1);
    CHECK(reports.front().planID == "P1");
    CHECK(reports.front().state == EPlanState::Pending);
    parts.submission.ReportAccepted();
    CHECK(parts.Collect().actions.empty());
}

TEST_CASE("PlanSubmission: a planID is not used again while a robot has a job of its former plan")
{
    EngineOptions options = MakeTestOptions(false);
    options.bFinishedIDsReused = true;
    SubmissionParts parts(options);
    ActivePlan& plan = parts.BeginLoad();
    parts.work.DropJob(parts.lr);
    parts.work.FailPlan(plan, "test");
    REQUIRE(parts.lr.job.IsOverdue());
    parts.Discard();
    const auto replies = parts.SubmitPlanOf("P1").ListActions<ReplyCommand>();
    REQUIRE(replies.size() == 1);
    CHECK_FALSE(replies.front().bAccepted);
    CHECK(replies.front().message.find("LR01") != std::string::npos);
    CHECK(parts.IsAccepted("P2"));
    parts.jobs.OnJobFailed(parts.lr, JobFailed{"P1-a4", "cancelled"});
    CHECK(parts.IsAccepted("P1"));
}
