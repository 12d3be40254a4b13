#include "Catch.hpp"
#include "fixtures/EngineParts.hpp"
#include "fixtures/PlanWorld.hpp"

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS::Testing;  // NOLINT(google-build-using-namespace): its fixtures
using namespace std::chrono_literals;

TEST_CASE("PlanWork: a plan that fails before its robot has accepted a command is reported as started first")
{
    EngineParts parts;
    parts.PutOn(parts.lr, "D-CHG01");
    ActivePlan& plan = parts.AddLoad();
    parts.assignment.Offer(plan, parts.lr);
    parts.Discard();
    parts.work.FailPlan(plan, "no route");
    const auto reports = parts.Collect().ListReports<PlanReport>();
    REQUIRE(reports.size() == 2);
    CHECK(reports[0].state == EPlanState::InProgress);
    CHECK(reports[1].state == EPlanState::Failed);
}

TEST_CASE("PlanWork: work begins with one arrival and the job's command, with its limit")
{
    EngineOptions options = MakeTestOptions(false);
    options.actions.at("CassetteLoad").timeout = 90s;
    EngineParts parts(options);
    parts.PutOn(parts.lr, "D-A01.CP01");
    ActivePlan& plan = parts.AddLoad();
    parts.assignment.Offer(plan, parts.lr);
    parts.Discard();
    parts.work.BeginWork(parts.lr);
    parts.work.MarkArrived(parts.lr);
    const CallOutcome outcome = parts.Collect();
    const auto statuses = outcome.ListActions<RobotStatusChanged>();
    REQUIRE(statuses.size() == 1);
    CHECK(statuses.front().status.status == ERobotStatus::Arrival);
    const auto jobs = outcome.ListCommands<StartJob>();
    REQUIRE(jobs.size() == 1);
    CHECK(jobs.front().jobID == "P1-a4");
    CHECK(jobs.front().from == "A01.CP01");
    CHECK(jobs.front().to == "LR01.CP01");
    CHECK(jobs.front().carrierID == "CASSETTE_01");
    CHECK_FALSE(jobs.front().commandID.empty());
    CHECK(outcome.GetDelayOrNull(EEngineTimer::JobTimeout) == 90s);
    CHECK(plan.record.progress.bArrived);
    CHECK(plan.record.progress.steps[0].state == EStepState::InProgress);
    CHECK(GetJobState(plan) == EJobState::Instructed);
}

TEST_CASE("PlanWork: a job names the node where the robot was placed, which need not be reported")
{
    EngineParts parts;
    parts.PutOn(parts.lr, "D-A01.CP01");
    parts.lr.view.state->lastNodeID.clear();
    parts.assignment.Offer(parts.AddLoad(), parts.lr);
    parts.Discard();
    parts.work.BeginWork(parts.lr);
    const auto jobs = parts.Collect().ListCommands<StartJob>();
    REQUIRE(jobs.size() == 1);
    CHECK(jobs.front().nodeID == "D-A01.CP01");
}

TEST_CASE("PlanWork: no job begins before the plan is stored as begun, nor without its tray")
{
    EngineParts parts;
    SECTION("not stored")
    {
        parts.PutOn(parts.lr, "D-A01.CP01");
        ActivePlan& plan = parts.AddLoad();
        parts.assignment.Offer(plan, parts.lr);
        parts.assignment.Start(plan);
        plan.bUnstored = true;
        parts.work.BeginWork(parts.lr);
        CHECK(plan.record.progress.bArrived);
        CHECK(parts.lr.activity == EActivity::Waits);
    }
    SECTION("no tray")
    {
        Plan plan = MakeControlPlan("P1");
        plan.steps = {plan.steps[1]};
        parts.PutOn(parts.cr, "D-A01.SET01");
        parts.assignment.Offer(parts.Add(plan), parts.cr);
        parts.work.BeginWork(parts.cr);
        CHECK(parts.cr.activity == EActivity::Waits);
    }
    CHECK(parts.Collect().ListCommands<StartJob>().empty());
}

TEST_CASE("PlanWork: the end of a job moves its carrier and begins the next step, or ends the plan")
{
    EngineParts parts;
    ActivePlan& plan = parts.BeginLoad();
    parts.jobs.OnJobStarted(parts.lr, JobStarted{"P1-a4"});
    parts.work.EndJob(parts.lr, {});
    CHECK(parts.Collect().ListChanges<CarriersChanged>().size() == 1);
    CHECK(plan.record.progress.steps[0].state == EStepState::Completed);
    CHECK(plan.record.progress.steps[1].state == EStepState::Dispatched);
    CHECK(parts.lr.job.GetOrNull() == nullptr);
    parts.PutOn(parts.lr, "D-A02.CP03");
    parts.work.BeginWork(parts.lr);
    parts.jobs.OnJobStarted(parts.lr, JobStarted{"P1-b2"});
    parts.Discard();
    parts.work.EndJob(parts.lr, {});
    CHECK(plan.record.progress.state == EPlanState::Completed);
    CHECK(parts.lr.planOrNull == nullptr);
    CHECK(parts.lr.activity == EActivity::Idle);
    CHECK(parts.engine.plans.FindActiveOrNull("P1") == nullptr);
    CHECK(parts.engine.plans.FindFinishedOrNull("P1") != nullptr);
    CHECK(parts.engine.transaction.IsDispatchNeeded());
}

TEST_CASE("PlanWork: a job that was interrupted does not count for the time of its station")
{
    EngineParts parts;
    ActivePlan& plan = parts.BeginLoad();
    parts.jobs.OnJobStarted(parts.lr, JobStarted{"P1-a4"});
    const double before = parts.engine.jobTimes.GetSeconds("A01.CP01");
    SECTION("its outcome was unknown")
    {
        parts.work.SuspendJob(parts.lr, "the connection was lost");
    }
    SECTION("its plan was paused")
    {
        parts.answers.Ask(plan, EPlanControl::Pause, EControlOrigin::MCS);
        parts.work.ConfirmPause(parts.lr);
    }
    parts.Advance(std::chrono::hours(3));
    parts.work.EndJob(parts.lr, {});
    CHECK(parts.engine.jobTimes.GetSeconds("A01.CP01") == before);
}

TEST_CASE("PlanWork: a plan that is being paused begins nothing after its job")
{
    EngineParts parts;
    ActivePlan& plan = parts.BeginLoad();
    parts.jobs.OnJobStarted(parts.lr, JobStarted{"P1-a4"});
    parts.answers.Ask(plan, EPlanControl::Pause, EControlOrigin::MCS);
    parts.Discard();
    parts.work.EndJob(parts.lr, {});
    CHECK(plan.record.progress.state == EPlanState::Paused);
    CHECK(plan.record.progress.steps[1].state == EStepState::Pending);
    CHECK(plan.next == EContinuation::Step);
    const auto results = parts.Collect().ListReports<ControlResultReport>();
    REQUIRE(results.size() == 1);
    CHECK(results.front().bSucceeded);
}

TEST_CASE("PlanWork: a failed plan reports its job, its step and then itself")
{
    EngineParts parts;
    ActivePlan& plan = parts.BeginLoad();
    parts.work.FailPlan(plan, "The gripper is empty.");
    const auto reports = parts.Collect().ListActions<SendReport>();
    REQUIRE(reports.size() == 3);
    CHECK(std::holds_alternative<JobReport>(reports[0].entry.report));
    CHECK(std::holds_alternative<StepReport>(reports[1].entry.report));
    CHECK(std::holds_alternative<PlanReport>(reports[2].entry.report));
    CHECK(plan.record.progress.steps[0].jobs[0] == EJobState::Failed);
    CHECK(plan.record.progress.steps[0].state == EStepState::Failed);
    CHECK(plan.record.progress.steps[1].state == EStepState::Pending);
    CHECK(plan.record.progress.state == EPlanState::Failed);
    CHECK(parts.lr.planOrNull == nullptr);
}

TEST_CASE("PlanWork: a dropped job keeps its robot until its end, with an alarm if it had begun")
{
    EngineParts parts;
    const bool bBegun = GENERATE(false, true);
    parts.BeginLoad();
    if (bBegun)
    {
        parts.jobs.OnJobStarted(parts.lr, JobStarted{"P1-a4"});
    }
    parts.Discard();
    parts.work.DropJob(parts.lr);
    const CallOutcome outcome = parts.Collect();
    CHECK(outcome.ListCommands<CancelJob>() == std::vector{CancelJob{"P1-a4"}});
    CHECK(outcome.GetDelayOrNull(EEngineTimer::JobEnd) == parts.engine.options.controls.jobEndTimeout);
    CHECK(outcome.ListSetAlarms().size() == (bBegun ? 1U : 0U));
    parts.work.EndByControl(*parts.lr.planOrNull, EPlanControl::Abort);
    CHECK(parts.lr.job.IsOverdue());
    CHECK(parts.lr.GetUnavailability() == EUnavailability::Occupied);
}
