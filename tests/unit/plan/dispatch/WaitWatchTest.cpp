#include "Catch.hpp"
#include "fixtures/EngineParts.hpp"
#include "fixtures/PlanWorld.hpp"

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS::Testing;  // NOLINT(google-build-using-namespace): its fixtures
using namespace std::chrono_literals;

namespace
{

/// LR01 is at the end of its base on its way to the load of P1, and waits for CR01 on CHG03. Its wait has begun.
void BeginWait(EngineParts& parts)
{
    parts.PutOn(parts.cr, "D-CHG03");
    parts.BeginDriveToLoad();
    parts.lr.drive->bConfirmed = true;
    parts.lr.drive->releasedCount = 1;
    parts.lr.drive->grantedCount = 1;
    parts.lr.search.blockers = {parts.cr.index};
    parts.watch.UpdateWait(parts.lr);
}

void Expire(EngineParts& parts)
{
    parts.Discard();
    parts.Advance(300s);
    parts.watch.OnWaitDue(parts.lr);
}

} // namespace

TEST_CASE(
    "WaitWatch: a robot that waits for one without progress raises an alarm with its plan, and progress clears it")
{
    EngineParts parts;
    BeginWait(parts);
    CHECK(parts.Collect().GetDelayOrNull(EEngineTimer::DriveWait) == 300s);
    parts.Advance(10s);
    parts.watch.UpdateWait(parts.lr);
    CHECK_FALSE(parts.Collect().GetDelayOrNull(EEngineTimer::DriveWait).has_value());
    Expire(parts);
    const auto alarms = parts.Collect().ListChanges<AlarmSet>();
    REQUIRE(alarms.size() == 1);
    CHECK(alarms.front().alarm.errorCode == "ACS-1015");
    CHECK(alarms.front().alarm.level == EAlarmLevel::Light);
    CHECK(alarms.front().alarm.planID == "P1");
    CHECK(alarms.front().alarm.stepNo == 1);
    CHECK(
        alarms.front().alarm.message
        == "No progress for 300 s: LR01 waits for node L01 on its route: there it could close the way of CR01.");
    parts.watch.UpdateWait(parts.lr);
    CHECK(parts.Collect().ListClearedAlarms().empty());
    parts.lr.drive->grantedCount = 2;
    parts.watch.UpdateWait(parts.lr);
    CHECK(parts.Collect().ListClearedAlarms() == std::vector<std::string>{"ACS-1015"});
}

TEST_CASE("WaitWatch: a robot that moves again before the time limit raises no alarm")
{
    EngineParts parts;
    BeginWait(parts);
    parts.lr.drive->grantedCount = 2;
    parts.watch.UpdateWait(parts.lr);
    CHECK(parts.Collect().IsTimerCancelled(EEngineTimer::DriveWait));
    Expire(parts);
    CHECK(parts.Collect().ListSetAlarms().empty());
}

TEST_CASE(
    "WaitWatch: while a robot for which it waits makes progress there is no alarm, and the time restarts afterwards")
{
    EngineParts parts;
    BeginWait(parts);
    parts.BeginDrive(parts.cr, "D-CHG02");
    Expire(parts);
    parts.watch.UpdateWaits();
    const CallOutcome outcome = parts.Collect();
    CHECK(outcome.ListSetAlarms().empty());
    CHECK_FALSE(outcome.GetDelayOrNull(EEngineTimer::DriveWait).has_value());
    parts.coordinator.EndDrive(parts.cr);
    parts.watch.UpdateWaits();
    CHECK(parts.Collect().GetDelayOrNull(EEngineTimer::DriveWait) == 300s);
    Expire(parts);
    CHECK(parts.Collect().ListSetAlarms() == std::vector<std::string>{"ACS-1015"});
}

TEST_CASE("WaitWatch: a paused plan raises no alarm, and the time restarts when it is resumed")
{
    EngineParts parts;
    BeginWait(parts);
    parts.lr.planOrNull->record.progress.state = EPlanState::Paused;
    SECTION("after the time limit")
    {
        Expire(parts);
        CHECK(parts.Collect().ListSetAlarms().empty());
        parts.cr.changes.MarkWork();
        parts.watch.UpdateWaits();
        CHECK_FALSE(parts.Collect().GetDelayOrNull(EEngineTimer::DriveWait).has_value());
        parts.lr.planOrNull->record.progress.state = EPlanState::InProgress;
        parts.watch.UpdateWaits();
        CHECK(parts.Collect().GetDelayOrNull(EEngineTimer::DriveWait) == 300s);
    }
    SECTION("before")
    {
        parts.Discard();
        parts.watch.UpdateWait(parts.lr);
        CHECK(parts.Collect().IsTimerCancelled(EEngineTimer::DriveWait));
    }
}

TEST_CASE("WaitWatch: a timeout of 0 disables the alarm")
{
    EngineOptions options = MakeTestOptions(false);
    options.waitTimeout = 0ms;
    EngineParts parts(options);
    BeginWait(parts);
    CHECK_FALSE(parts.Collect().GetDelayOrNull(EEngineTimer::DriveWait).has_value());
}
