#include "Catch.hpp"
#include "fixtures/EngineParts.hpp"
#include "fixtures/PlanWorld.hpp"

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS::Testing;  // NOLINT(google-build-using-namespace): its fixtures

TEST_CASE("TscControl: without work a pause is finished in the call that requests it")
{
    EngineParts parts;
    parts.tsc.SwitchTSC(ControlTSC{true, 7});
    const CallOutcome outcome = parts.Collect();
    CHECK(
        outcome.ListChanges<TscChanged>()
        == std::vector{TscChanged{ETscState::Pausing}, TscChanged{ETscState::Paused}});
    CHECK(
        outcome.ListActions<TscStateChanged>()
        == std::vector{TscStateChanged{ETscState::Pausing}, TscStateChanged{ETscState::Paused}});
    const auto replies = outcome.ListActions<ReplyCommand>();
    REQUIRE(replies.size() == 1);
    CHECK(replies.front().replyToken == 7);
    CHECK(replies.front().bAccepted);
    parts.tsc.SwitchTSC(ControlTSC{true, 8});
    CHECK(parts.Collect().changes.empty());
}

TEST_CASE("TscControl: a pause waits for running plans and for drives")
{
    EngineParts parts;
    ActivePlan& plan = parts.BeginDriveToLoad();
    parts.tsc.SwitchTSC(ControlTSC{true, 7});
    CHECK(parts.tsc.GetState() == ETscState::Pausing);
    CHECK(parts.tsc.CanDriveHome());
    parts.work.EndPlan(plan, EPlanState::Aborted, {});
    parts.tsc.FinishTscPause();
    CHECK(parts.tsc.GetState() == ETscState::Pausing);
    CHECK_FALSE(parts.tsc.CanDriveHome());
    parts.coordinator.EndDrive(parts.lr);
    parts.tsc.FinishTscPause();
    CHECK(parts.tsc.GetState() == ETscState::Paused);
}

TEST_CASE("TscControl: a pause waits for a paused plan that is being resumed or ended")
{
    const EPlanControl control = GENERATE(EPlanControl::Resume, EPlanControl::Cancel, EPlanControl::Abort);
    INFO(GetText(control));
    EngineParts parts;
    ActivePlan& plan = parts.BeginDriveToLoad();
    plan.record.progress.state = EPlanState::Paused;
    plan.record.progress.control = control;
    parts.tsc.SwitchTSC(ControlTSC{true, 7});
    CHECK(parts.tsc.GetState() == ETscState::Pausing);
    plan.record.progress.control.reset(); // the robot did not confirm it
    parts.tsc.FinishTscPause();
    CHECK(parts.tsc.GetState() == ETscState::Paused);
}

TEST_CASE("TscControl: Auto dispatches again")
{
    EngineParts parts;
    parts.tsc.SwitchTSC(ControlTSC{true, 7});
    parts.Discard();
    parts.tsc.SwitchTSC(ControlTSC{false, 8});
    CHECK(parts.tsc.GetState() == ETscState::Auto);
    CHECK(parts.engine.transaction.IsDispatchNeeded());
    CHECK(parts.Collect().ListChanges<TscChanged>() == std::vector{TscChanged{ETscState::Auto}});
}

TEST_CASE("TscControl: a pause survives a restart, and a start may begin with one")
{
    EngineOptions options = MakeTestOptions(false);
    SECTION("Auto stays Auto")
    {
        EngineParts parts(options);
        parts.tsc.RestoreTSC(ETscState::Auto);
        CHECK(parts.tsc.GetState() == ETscState::Auto);
        CHECK(parts.Collect().changes.empty());
    }
    SECTION("a pause that was under way is finished without running plans")
    {
        EngineParts parts(options);
        parts.tsc.RestoreTSC(ETscState::Pausing);
        CHECK(parts.tsc.GetState() == ETscState::Paused);
        CHECK(parts.Collect().ListChanges<TscChanged>() == std::vector{TscChanged{ETscState::Paused}});
    }
    SECTION("the option pauses, and running plans are completed")
    {
        options.bTscStartsPaused = true;
        EngineParts parts(options);
        parts.BeginLoad();
        parts.tsc.RestoreTSC(ETscState::Auto);
        CHECK(parts.tsc.GetState() == ETscState::Pausing);
    }
}

TEST_CASE("TscControl: Auto is shown as Paused while the startup barrier holds work")
{
    EngineParts parts;
    parts.engine.startup.Begin(true);
    CHECK(parts.tsc.GetTscState() == ETscState::Paused);
    CHECK(parts.tsc.GetState() == ETscState::Auto);
    REQUIRE(parts.engine.startup.TryRelease());
    CHECK(parts.tsc.GetTscState() == ETscState::Auto);
}
