#include "Catch.hpp"
#include "fixtures/EngineParts.hpp"
#include "fixtures/PlanWorld.hpp"

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS::Testing;  // NOLINT(google-build-using-namespace): its fixtures

TEST_CASE("JobOutcomes: the start of the present job is reported once")
{
    EngineParts parts;
    ActivePlan& plan = parts.BeginLoad();
    parts.jobs.OnJobStarted(parts.lr, JobStarted{"another"});
    CHECK(GetJobState(plan) == EJobState::Instructed);
    parts.jobs.OnJobStarted(parts.lr, JobStarted{"P1-a4"});
    parts.jobs.OnJobStarted(parts.lr, JobStarted{"P1-a4"});
    CHECK(GetJobState(plan) == EJobState::InProgress);
    CHECK(parts.Collect().ListReports<JobReport>().size() == 1);
}

TEST_CASE("JobOutcomes: the end of a job includes its start")
{
    EngineParts parts;
    ActivePlan& plan = parts.BeginLoad();
    parts.jobs.OnJobFinished(parts.lr, JobFinished{"another"});
    CHECK(parts.Collect().actions.empty());
    parts.jobs.OnJobFinished(parts.lr, JobFinished{"P1-a4"});
    const auto reports = parts.Collect().ListReports<JobReport>();
    REQUIRE(reports.size() == 2);
    CHECK(reports[0].state == EJobState::InProgress);
    CHECK(reports[1].state == EJobState::Completed);
    CHECK(plan.step == 1);
    CHECK(parts.lr.ports.FindCarrierOrNull("CASSETTE_01").has_value());
}

TEST_CASE("JobOutcomes: a failed job fails its plan and moves no carrier")
{
    EngineParts parts;
    ActivePlan& plan = parts.BeginLoad();
    parts.jobs.OnJobFailed(parts.lr, JobFailed{"P1-a4", "the gripper is empty"});
    CHECK(plan.record.progress.state == EPlanState::Failed);
    CHECK_FALSE(parts.lr.ports.FindCarrierOrNull("CASSETTE_01").has_value());
    CHECK(parts.lr.IsFree());
}

TEST_CASE("JobOutcomes: the robot of a job that took too long is free after the job's end")
{
    EngineParts parts;
    ActivePlan& plan = parts.BeginLoad();
    parts.jobs.OnJobTimeout(parts.lr);
    CHECK(parts.Collect().ListCommands<CancelJob>().size() == 1);
    CHECK(plan.record.progress.state == EPlanState::Failed);
    CHECK_FALSE(parts.lr.IsFree());
    SECTION("it was done after all: its carrier has moved")
    {
        parts.jobs.OnJobFinished(parts.lr, JobFinished{"P1-a4"});
        CHECK(parts.lr.ports.FindCarrierOrNull("CASSETTE_01").has_value());
        CHECK(parts.Collect().IsTimerCancelled(EEngineTimer::JobEnd));
        CHECK(parts.lr.IsFree());
    }
    SECTION("it was cancelled")
    {
        parts.jobs.OnJobFailed(parts.lr, JobFailed{"P1-a4", "cancelled"});
        CHECK_FALSE(parts.lr.ports.FindCarrierOrNull("CASSETTE_01").has_value());
        CHECK(parts.lr.IsFree());
    }
    SECTION("its end is not reported: an operator decides")
    {
        parts.jobs.OnJobEndTimeout(parts.lr);
        CHECK(parts.Collect().ListSetAlarms() == std::vector<std::string>{"ACS-1008"});
        CHECK(parts.lr.job.IsUnresolved());
        parts.jobs.OnJobEndTimeout(parts.lr);
        CHECK(parts.Collect().actions.empty());
        CHECK_FALSE(parts.lr.IsFree());
    }
}

TEST_CASE("JobOutcomes: a job that the robot never had is repeated under its commandID, unless it had begun")
{
    EngineParts parts;
    ActivePlan& plan = parts.BeginLoad();
    const std::string commandID = parts.lr.job.GetOrNull()->commandID;
    SECTION("not begun")
    {
        parts.jobs.OnJobUnknown(parts.lr, JobUnknown{"P1-a4"});
        CHECK(parts.lr.job.GetOrNull() == nullptr);
        parts.Discard();
        parts.work.BeginWork(parts.lr);
        const auto jobs = parts.Collect().ListCommands<StartJob>();
        REQUIRE(jobs.size() == 1);
        CHECK(jobs.front().commandID == commandID);
    }
    SECTION("not begun, and the plan is to be aborted")
    {
        parts.answers.Ask(plan, EPlanControl::Abort, EControlOrigin::MCS);
        parts.jobs.OnJobUnknown(parts.lr, JobUnknown{"P1-a4"});
        CHECK(plan.record.progress.state == EPlanState::Aborted);
    }
    SECTION("begun")
    {
        parts.jobs.OnJobStarted(parts.lr, JobStarted{"P1-a4"});
        parts.jobs.OnJobUnknown(parts.lr, JobUnknown{"P1-a4"});
        CHECK(parts.lr.job.IsUnresolved());
    }
}

TEST_CASE("JobOutcomes: a job that begins again counts as begun only after its new command has begun")
{
    EngineParts parts;
    parts.BeginLoad();
    parts.jobs.OnJobStarted(parts.lr, JobStarted{"P1-a4"});
    parts.work.RepeatJob(parts.lr, {});
    parts.work.BeginWork(parts.lr);
    const std::string commandID = parts.lr.job.GetOrNull()->commandID;
    parts.Discard();
    SECTION("the robot never had the new command")
    {
        parts.jobs.OnJobUnknown(parts.lr, JobUnknown{"P1-a4"});
        CHECK(parts.Collect().ListSetAlarms().empty());
        parts.work.BeginWork(parts.lr);
        const auto jobs = parts.Collect().ListCommands<StartJob>();
        REQUIRE(jobs.size() == 1);
        CHECK(jobs.front().commandID == commandID);
    }
    SECTION("it has begun again")
    {
        parts.jobs.OnJobStarted(parts.lr, JobStarted{"P1-a4"});
        parts.jobs.OnJobUnknown(parts.lr, JobUnknown{"P1-a4"});
        CHECK(parts.lr.job.IsUnresolved());
    }
    SECTION("acsd was restarted: it is not known whether it has begun again")
    {
        parts.lr.job.BeginRecovery();
        parts.jobs.OnJobUnknown(parts.lr, JobUnknown{"P1-a4"});
        CHECK(parts.lr.job.IsUnresolved());
    }
}

TEST_CASE("JobOutcomes: an unresolved job waits for the operator, whatever the robot reports later")
{
    EngineParts parts;
    ActivePlan& plan = parts.BeginLoad();
    parts.jobs.OnJobUnresolved(parts.lr, JobUnresolved{"P1-a4", "restarted"});
    CHECK(parts.Collect().ListSetAlarms() == std::vector<std::string>{"ACS-1008"});
    parts.jobs.OnJobUnresolved(parts.lr, JobUnresolved{"P1-a4", "restarted"});
    parts.jobs.OnJobStarted(parts.lr, JobStarted{"P1-a4"});
    parts.jobs.OnJobFinished(parts.lr, JobFinished{"P1-a4"});
    parts.jobs.OnJobFailed(parts.lr, JobFailed{"P1-a4", "no"});
    CHECK(parts.Collect().actions.empty());
    CHECK(GetJobState(plan) == EJobState::Instructed);
    CHECK(parts.lr.job.IsUnresolved());
}

TEST_CASE("JobOutcomes: a rejected job is commanded again under its commandID when the robot may be sent one")
{
    EngineParts parts;
    ActivePlan& plan = parts.BeginLoad();
    const std::string commandID = parts.lr.job.GetOrNull()->commandID;
    parts.jobs.OnJobRejected(parts.lr, JobRejected{"another", "no route"});
    CHECK(parts.lr.job.GetOrNull() != nullptr);
    parts.jobs.OnJobRejected(parts.lr, JobRejected{"P1-a4", "no route"});
    CHECK(plan.record.progress.state == EPlanState::InProgress);
    CHECK(GetJobState(plan) == EJobState::Instructed);
    CHECK(parts.lr.activity == EActivity::Waits);
    CHECK(parts.lr.GetUnavailability() == EUnavailability::Rejecting);
    parts.rejections.OnRetryDue(parts.lr);
    parts.Discard();
    parts.work.BeginWork(parts.lr);
    const auto jobs = parts.Collect().ListCommands<StartJob>();
    REQUIRE(jobs.size() == 1);
    CHECK(jobs.front().commandID == commandID);
    parts.jobs.OnJobStarted(parts.lr, JobStarted{"P1-a4"});
    CHECK(parts.lr.view.rejections.GetCount() == 0);
}

TEST_CASE("JobOutcomes: an interrupted job is repeated once under another commandID, then an operator resolves it")
{
    EngineParts parts;
    ActivePlan& plan = parts.BeginLoad();
    const std::string commandID = parts.lr.job.GetOrNull()->commandID;
    parts.jobs.OnJobStarted(parts.lr, JobStarted{"P1-a4"});
    parts.Discard();
    parts.jobs.OnJobInterrupted(parts.lr, JobInterrupted{"P1-a4", "manual mode"});
    parts.work.BeginWork(parts.lr);
    const CallOutcome repeated = parts.Collect();
    REQUIRE(repeated.ListCommands<StartJob>().size() == 1);
    CHECK(repeated.ListCommands<StartJob>().front().commandID != commandID);
    CHECK(repeated.ListReports<JobReport>().empty());
    CHECK(GetJobState(plan) == EJobState::InProgress);
    SECTION("it is interrupted again")
    {
        parts.jobs.OnJobInterrupted(parts.lr, JobInterrupted{"P1-a4", "manual mode"});
        CHECK(parts.lr.job.IsUnresolved());
        CHECK(parts.Collect().ListChanges<AlarmSet>().front().alarm.errorCode == "ACS-1008");
        CHECK(plan.record.progress.state == EPlanState::InProgress);
    }
    SECTION("it is done, and the next job may be interrupted too")
    {
        parts.jobs.OnJobFinished(parts.lr, JobFinished{"P1-a4"});
        CHECK(plan.step == 1);
        CHECK_FALSE(plan.repetition.bInterrupted);
    }
}

TEST_CASE("JobOutcomes: a job that is rejected or interrupted while its plan is aborted ends the plan")
{
    EngineParts parts;
    ActivePlan& plan = parts.BeginLoad();
    parts.controls.Control(ControlPlan{EPlanControl::Abort, "P1", {}, 7, {}});
    SECTION("rejected")
    {
        parts.jobs.OnJobRejected(parts.lr, JobRejected{"P1-a4", "no route"});
    }
    SECTION("interrupted")
    {
        parts.jobs.OnJobInterrupted(parts.lr, JobInterrupted{"P1-a4", "manual mode"});
    }
    CHECK(plan.record.progress.state == EPlanState::Aborted);
}

TEST_CASE("JobOutcomes: the time limit of a job does not end while its robot is in manual mode")
{
    EngineOptions options = MakeTestOptions(false);
    options.actions["CassetteLoad"].timeout = std::chrono::minutes(1);
    EngineParts parts(options);
    ActivePlan& plan = parts.BeginLoad();
    parts.lr.view.state->bAutomatic = false;
    parts.jobs.OnJobTimeout(parts.lr);
    CHECK(plan.record.progress.state == EPlanState::InProgress);
    CHECK(parts.Collect().GetDelayOrNull(EEngineTimer::JobTimeout) == std::chrono::minutes(1));
    parts.lr.view.state->bAutomatic = true;
    parts.jobs.OnJobTimeout(parts.lr);
    CHECK(plan.record.progress.state == EPlanState::Failed);
}
