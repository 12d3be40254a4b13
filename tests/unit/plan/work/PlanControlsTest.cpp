#include "Catch.hpp"
#include "fixtures/EngineParts.hpp"
#include "fixtures/PlanWorld.hpp"

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS::Testing;  // NOLINT(google-build-using-namespace): its fixtures

namespace
{

/// Whether each control that has ended in this call was successful, in order.
std::vector<bool> ListResults(const CallOutcome& outcome)
{
    std::vector<bool> results;
    for (const ControlResultReport& report : outcome.ListReports<ControlResultReport>())
    {
        results.push_back(report.bSucceeded);
    }
    return results;
}

CallOutcome RequestControl(EngineParts& parts, EPlanControl control, const std::string& transactionID = {})
{
    parts.engine.call.Begin();
    parts.controls.Control(ControlPlan{control, "P1", {}, 7, transactionID});
    return parts.Collect();
}

} // namespace

TEST_CASE("PlanControls: a queued plan is cancelled, held and resumed at once")
{
    EngineParts parts;
    ActivePlan& plan = parts.AddLoad();
    parts.Discard();
    CHECK(ListResults(RequestControl(parts, EPlanControl::Resume)) == std::vector{false});
    CHECK(ListResults(RequestControl(parts, EPlanControl::Pause)) == std::vector{true});
    CHECK(plan.record.progress.state == EPlanState::Paused);
    CHECK(parts.engine.plans.GetQueue().empty());
    CHECK(ListResults(RequestControl(parts, EPlanControl::Resume)) == std::vector{true});
    CHECK(plan.record.progress.state == EPlanState::Pending);
    CHECK(parts.engine.plans.GetQueue().size() == 1);
    CHECK(ListResults(RequestControl(parts, EPlanControl::Cancel)) == std::vector{true});
    CHECK(plan.record.progress.state == EPlanState::Cancelled);
}

TEST_CASE("PlanControls: a driving robot must confirm that its drive is cancelled")
{
    EngineParts parts;
    ActivePlan& plan = parts.BeginDriveToLoad();
    const CallOutcome outcome = RequestControl(parts, EPlanControl::Cancel);
    CHECK(outcome.ListCommands<CancelDrive>() == std::vector{CancelDrive{parts.lr.drive->driveID}});
    CHECK(outcome.GetDelayOrNull(EEngineTimer::ControlConfirm) == parts.engine.options.controls.cancelTimeout);
    CHECK(ListResults(outcome).empty());
    CHECK(plan.record.progress.state == EPlanState::InProgress);
    // Aborting it as well ends the cancellation, and commands nothing again.
    const CallOutcome aborting = RequestControl(parts, EPlanControl::Abort);
    CHECK(ListResults(aborting) == std::vector{false});
    CHECK(aborting.ListCommands<CancelDrive>().empty());
    CHECK(ListResults(RequestControl(parts, EPlanControl::Pause)) == std::vector{false});
    parts.controls.OnControlTimeout(parts.lr);
    CHECK(ListResults(parts.Collect()) == std::vector{false});
    CHECK(plan.record.progress.state == EPlanState::InProgress);
    CHECK_FALSE(plan.record.progress.control.has_value());
    CHECK(parts.lr.drive->cancellation == ECancellation::Late);
}

TEST_CASE("PlanControls: the option decides how long a plan can be cancelled")
{
    EngineOptions options = MakeTestOptions(false);
    SECTION("not after dispatch")
    {
        options.controls.cancelUntil = ECancelWindow::Dispatch;
        EngineParts parts(options);
        parts.BeginDriveToLoad();
        CHECK(ListResults(RequestControl(parts, EPlanControl::Cancel)) == std::vector{false});
        CHECK_FALSE(parts.lr.drive->IsCancelling());
    }
    SECTION("not after the arrival")
    {
        EngineParts parts(options);
        ActivePlan& plan = parts.BeginDriveToLoad();
        plan.record.progress.bArrived = true;
        CHECK(ListResults(RequestControl(parts, EPlanControl::Cancel)) == std::vector{false});
    }
    SECTION("after the arrival, before the first job")
    {
        options.controls.cancelUntil = ECancelWindow::FirstJob;
        EngineParts parts(options);
        ActivePlan& plan = parts.BeginDriveToLoad();
        plan.record.progress.bArrived = true;
        CHECK(RequestControl(parts, EPlanControl::Cancel).ListCommands<CancelDrive>().size() == 1);
    }
}

TEST_CASE("PlanControls: an abort waits for the running job, or drops it")
{
    EngineOptions options = MakeTestOptions(false);
    options.controls.bAbortStopsJob = GENERATE(false, true);
    EngineParts parts(options);
    ActivePlan& plan = parts.BeginLoad();
    const CallOutcome outcome = RequestControl(parts, EPlanControl::Abort);
    if (options.controls.bAbortStopsJob)
    {
        CHECK(outcome.ListCommands<CancelJob>().size() == 1);
        CHECK(ListResults(outcome) == std::vector{true});
    }
    else
    {
        CHECK(outcome.ListActions<CommandRobot>().empty());
        CHECK(plan.record.progress.state == EPlanState::InProgress);
        parts.jobs.OnJobFinished(parts.lr, JobFinished{"P1-a4"});
        CHECK(ListResults(parts.Collect()) == std::vector{true});
    }
    CHECK(plan.record.progress.state == EPlanState::Aborted);
}

TEST_CASE("PlanControls: a pause lasts from the state that shows it to the state that shows its end")
{
    EngineParts parts;
    ActivePlan& plan = parts.BeginLoad();
    CallOutcome outcome = RequestControl(parts, EPlanControl::Pause);
    CHECK(outcome.ListCommands<Pause>().size() == 1);
    CHECK(outcome.GetDelayOrNull(EEngineTimer::ControlConfirm) == parts.engine.options.controls.pauseTimeout);
    CHECK(plan.record.progress.state == EPlanState::InProgress);
    parts.lr.view.state->bPaused = true;
    parts.controls.UpdatePause(parts.lr, false, false);
    outcome = parts.Collect();
    CHECK(ListResults(outcome) == std::vector{true});
    CHECK(outcome.IsTimerCancelled(EEngineTimer::ControlConfirm));
    CHECK(plan.record.progress.state == EPlanState::Paused);
    outcome = RequestControl(parts, EPlanControl::Resume);
    CHECK(outcome.ListCommands<Resume>().size() == 1);
    CHECK(plan.record.progress.state == EPlanState::Paused);
    parts.lr.view.state->bPaused = false;
    parts.controls.UpdatePause(parts.lr, false, true);
    CHECK(ListResults(parts.Collect()) == std::vector{true});
    CHECK(plan.record.progress.state == EPlanState::InProgress);
}

TEST_CASE("PlanControls: a plan whose job became unresolved during a pause has no time limit after it")
{
    EngineOptions options = MakeTestOptions(false);
    options.actions["CassetteLoad"].timeout = std::chrono::minutes(1);
    EngineParts parts(options);
    ActivePlan& plan = parts.BeginLoad();
    parts.jobs.OnJobStarted(parts.lr, JobStarted{"P1-a4"});
    RequestControl(parts, EPlanControl::Pause);
    parts.lr.view.state->bPaused = true;
    parts.controls.UpdatePause(parts.lr, false, false);
    parts.jobs.OnJobUnknown(parts.lr, JobUnknown{"P1-a4"});
    REQUIRE(parts.lr.job.IsUnresolved());
    RequestControl(parts, EPlanControl::Resume);
    parts.lr.view.state->bPaused = false;
    parts.controls.UpdatePause(parts.lr, false, true);
    CHECK(plan.record.progress.state == EPlanState::InProgress);
    CHECK_FALSE(parts.Collect().GetDelayOrNull(EEngineTimer::JobTimeout).has_value());
}

TEST_CASE("PlanControls: a pause that is not shown in time has failed, and the robot resumes")
{
    EngineParts parts;
    ActivePlan& plan = parts.BeginLoad();
    RequestControl(parts, EPlanControl::Pause);
    parts.controls.OnControlTimeout(parts.lr);
    const CallOutcome outcome = parts.Collect();
    CHECK(ListResults(outcome) == std::vector{false});
    CHECK(outcome.ListCommands<Resume>().size() == 1);
    CHECK(plan.record.progress.state == EPlanState::InProgress);
}

TEST_CASE("PlanControls: a repeated request has a reply and no second result, a new one has its own")
{
    EngineParts parts;
    ActivePlan& plan = parts.BeginDriveToLoad();
    RequestControl(parts, EPlanControl::Cancel, "1");
    CHECK(RequestControl(parts, EPlanControl::Cancel, "1").ListActions<ReplyCommand>().front().bAccepted);
    CHECK(plan.record.progress.controlCount == 1);
    RequestControl(parts, EPlanControl::Cancel, "2");
    CHECK(plan.record.progress.controlCount == 2);
}

TEST_CASE(
    "PlanControls: while the store fails no new control is accepted, and the answer to one that took effect waits")
{
    EngineParts parts;
    ActivePlan& plan = parts.BeginDriveToLoad();
    RequestControl(parts, EPlanControl::Cancel, "1");
    parts.engine.backlog.OnFailed();
    CHECK(RequestControl(parts, EPlanControl::Cancel, "1").ListActions<ReplyCommand>().front().bAccepted);
    CHECK_FALSE(RequestControl(parts, EPlanControl::Abort, "2").ListActions<ReplyCommand>().front().bAccepted);
    CHECK(plan.record.progress.control == EPlanControl::Cancel);
    parts.engine.call.unstoredControlIDs.insert("Cancel 1");
    CHECK(RequestControl(parts, EPlanControl::Cancel, "1").ListActions<ReplyCommand>().empty());
    const std::vector<ReplyCommand> withheld = parts.engine.backlog.CollectWithheld();
    REQUIRE(withheld.size() == 1);
    CHECK(withheld.front().bAccepted);
}
