#include "Catch.hpp"
#include "fixtures/EngineParts.hpp"
#include "fixtures/PlanWorld.hpp"

#include <fmt/format.h>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS::Testing;  // NOLINT(google-build-using-namespace): its fixtures

TEST_CASE("ControlAnswers: each request of an open control has one result")
{
    EngineParts parts;
    ActivePlan& plan = parts.AddLoad();
    parts.Discard();
    parts.answers.Ask(plan, EPlanControl::Pause, EControlOrigin::MCS);
    plan.record.progress.controlCount = 3;
    parts.answers.Answer(plan, true, "Paused.");
    CHECK(
        parts.Collect().ListReports<ControlResultReport>()
        == std::vector(3, ControlResultReport{EPlanControl::Pause, "P1", true, "Paused."}));
    parts.answers.Answer(plan, true, "Paused.");
    CHECK(parts.Collect().actions.empty());
}

TEST_CASE("ControlAnswers: a repetition has the control and the transactionID of one of the last 64 requests")
{
    EngineParts parts;
    ActivePlan& plan = parts.AddLoad();
    const ControlPlan request{EPlanControl::Pause, "P1", {}, 0, "4711"};
    CHECK_FALSE(parts.answers.IsRepetition(request));
    parts.answers.Remember(plan.record.progress, request);
    CHECK(parts.answers.IsRepetition(request));
    CHECK_FALSE(parts.answers.IsRepetition(ControlPlan{EPlanControl::Resume, "P1", {}, 0, "4711"}));
    parts.answers.Remember(plan.record.progress, ControlPlan{EPlanControl::Pause, "P1", {}, 0, {}});
    CHECK_FALSE(parts.answers.IsRepetition(ControlPlan{EPlanControl::Pause, "P1", {}, 0, {}}));
    for (int i = 0; i < 63; ++i)
    {
        parts.answers.Remember(
            plan.record.progress,
            ControlPlan{EPlanControl::Pause, "P1", {}, 0, fmt::format("other {}", i)});
    }
    CHECK(parts.answers.IsRepetition(request));
    parts.answers.Remember(plan.record.progress, ControlPlan{EPlanControl::Pause, "P1", {}, 0, "one more"});
    CHECK_FALSE(parts.answers.IsRepetition(request));
}

TEST_CASE("ControlAnswers: a control of an unknown plan is refused, of a finished plan it fails")
{
    EngineOptions options = MakeTestOptions(false);
    options.controls.bResultAfterRefusal = GENERATE(true, false);
    EngineParts parts(options);
    parts.work.EndPlan(parts.AddLoad(), EPlanState::Aborted, {});
    parts.Discard();
    parts.answers.RefuseControl(ControlPlan{EPlanControl::Cancel, "P2", {}, 7, "1"});
    CallOutcome outcome = parts.Collect();
    REQUIRE(outcome.ListActions<ReplyCommand>().size() == 1);
    CHECK_FALSE(outcome.ListActions<ReplyCommand>().front().bAccepted);
    CHECK(outcome.ListReports<ControlResultReport>().size() == (options.controls.bResultAfterRefusal ? 1U : 0U));
    parts.answers.RefuseControl(ControlPlan{EPlanControl::Cancel, "P1", {}, 8, "2"});
    outcome = parts.Collect();
    REQUIRE(outcome.ListActions<ReplyCommand>().size() == 1);
    CHECK(outcome.ListActions<ReplyCommand>().front().bAccepted);
    REQUIRE(outcome.ListReports<ControlResultReport>().size() == 1);
    CHECK_FALSE(outcome.ListReports<ControlResultReport>().front().bSucceeded);
    CHECK(parts.answers.IsRepetition(ControlPlan{EPlanControl::Cancel, "P1", {}, 9, "2"}));
}

TEST_CASE("ControlAnswers: the answer stops the timer, and a reroute has its time again")
{
    EngineParts parts;
    ActivePlan& plan = parts.BeginDriveToLoad();
    parts.answers.Ask(plan, EPlanControl::Cancel, EControlOrigin::MCS);
    parts.answers.StartConfirming(parts.lr, std::chrono::seconds(3));
    CHECK(parts.Collect().GetDelayOrNull(EEngineTimer::ControlConfirm) == std::chrono::seconds(3));
    SECTION("without a reroute")
    {
        parts.answers.Answer(plan, false, {});
        const CallOutcome outcome = parts.Collect();
        CHECK(outcome.IsTimerCancelled(EEngineTimer::ControlConfirm));
        CHECK_FALSE(outcome.GetDelayOrNull(EEngineTimer::ControlConfirm).has_value());
        CHECK_FALSE(parts.lr.control.bConfirming);
    }
    SECTION("with a reroute")
    {
        parts.lr.drive->reroute = Reroute{};
        parts.answers.Answer(plan, false, {});
        CHECK(
            parts.Collect().GetDelayOrNull(EEngineTimer::ControlConfirm)
            == parts.engine.options.controls.cancelTimeout);
        CHECK(parts.lr.control.bConfirming);
    }
}

TEST_CASE("ControlAnswers: the robot resumes only from a pause of the engine")
{
    EngineParts parts;
    parts.answers.ReleasePause(parts.lr);
    CHECK(parts.Collect().actions.empty());
    parts.lr.control.pause.Pause();
    parts.answers.ReleasePause(parts.lr);
    parts.answers.ReleasePause(parts.lr);
    CHECK(parts.Collect().ListCommands<Resume>().size() == 1);
}

TEST_CASE("ControlAnswers: a plan leaves its pause to the state that fits whether a robot has it")
{
    EngineParts parts;
    ActivePlan& queued = parts.AddLoad();
    parts.engine.transaction.ChangePlan(queued, EPlanState::Paused, {});
    parts.answers.LeavePause(queued, {});
    CHECK(queued.record.progress.state == EPlanState::Pending);
    parts.PutOn(parts.lr, "D-CHG01");
    parts.assignment.Offer(queued, parts.lr);
    parts.engine.transaction.ChangePlan(queued, EPlanState::Paused, {});
    parts.answers.LeavePause(queued, {});
    CHECK(queued.record.progress.state == EPlanState::InProgress);
}
