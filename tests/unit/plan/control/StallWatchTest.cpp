#include "Catch.hpp"
#include "fixtures/EngineParts.hpp"
#include "fixtures/PlanWorld.hpp"

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS::Testing;  // NOLINT(google-build-using-namespace): its fixtures
using namespace std::chrono_literals;

TEST_CASE("StallWatch: a drive without progress raises an alarm with its plan, and progress clears it")
{
    EngineParts parts;
    parts.BeginDriveToLoad();
    parts.stalls.UpdateStall(parts.lr);
    CHECK(parts.Collect().GetDelayOrNull(EEngineTimer::DriveStall) == parts.engine.options.stallTimeout);
    parts.Advance(60s);
    static_cast<void>(parts.lr.changes.TryUnmarkStatus());
    parts.stalls.OnDriveStall(parts.lr);
    CHECK(parts.stalls.IsStalled(parts.lr));
    CHECK_FALSE(parts.stalls.IsStalled(parts.cr));
    CHECK(parts.lr.changes.IsStatusMarked());
    const auto alarms = parts.Collect().ListChanges<AlarmSet>();
    REQUIRE(alarms.size() == 1);
    CHECK(alarms.front().alarm.errorCode == "ACS-1009");
    CHECK(alarms.front().alarm.level == EAlarmLevel::Light);
    CHECK(alarms.front().alarm.planID == "P1");
    CHECK(alarms.front().alarm.stepNo == 1);
    parts.lr.drive->bTaken = true;
    parts.stalls.UpdateStall(parts.lr);
    CHECK_FALSE(parts.stalls.IsStalled(parts.lr));
    CHECK(parts.Collect().ListClearedAlarms() == std::vector<std::string>{"ACS-1009"});
}

TEST_CASE("StallWatch: the limit is at least three times the time of the edge ahead")
{
    EngineParts parts;
    parts.BeginDriveToLoad();
    parts.lr.drive->route.edges.front().length = 120;
    parts.lr.drive->route.edges.front().maxSpeed = 1.2;
    parts.stalls.UpdateStall(parts.lr);
    const std::optional<ACS::Core::Duration> delay = parts.Collect().GetDelayOrNull(EEngineTimer::DriveStall);
    REQUIRE(delay.has_value());
    CHECK(*delay >= 300s);
}

TEST_CASE("StallWatch: a robot that is paused or offline is not watched")
{
    EngineParts parts;
    parts.BeginDriveToLoad();
    parts.stalls.UpdateStall(parts.lr);
    parts.Discard();
    SECTION("paused")
    {
        parts.lr.control.pause.Pause();
    }
    SECTION("offline")
    {
        parts.lr.view.bOnline = false;
    }
    parts.stalls.UpdateStall(parts.lr);
    CHECK(parts.Collect().IsTimerCancelled(EEngineTimer::DriveStall));
    parts.stalls.OnDriveStall(parts.lr);
    CHECK_FALSE(parts.stalls.IsStalled(parts.lr));
    CHECK(parts.Collect().ListSetAlarms().empty());
}

TEST_CASE("StallWatch: a job that the robot does not begin raises an alarm until it begins")
{
    EngineParts parts;
    parts.BeginLoad();
    parts.stalls.UpdateStall(parts.lr);
    CHECK(parts.Collect().GetDelayOrNull(EEngineTimer::DriveStall) == parts.engine.options.stallTimeout);
    parts.Advance(60s);
    parts.stalls.OnDriveStall(parts.lr);
    const auto alarms = parts.Collect().ListChanges<AlarmSet>();
    REQUIRE(alarms.size() == 1);
    CHECK(alarms.front().alarm.errorCode == "ACS-1009");
    CHECK(alarms.front().alarm.message == "Robot stalled: job P1-a4 not confirmed for 60 s. Check the robot.");
    const std::optional<WaitReason> reason = parts.waits.GetWaitReasonOrNull("P1");
    REQUIRE(reason.has_value());
    CHECK(reason->message == "LR01 stalled: job P1-a4 not confirmed for 60 s. Check the robot.");
    parts.jobs.OnJobStarted(parts.lr, JobStarted{"P1-a4"});
    parts.stalls.UpdateStall(parts.lr);
    CHECK(parts.Collect().ListClearedAlarms() == std::vector<std::string>{"ACS-1009"});
}

TEST_CASE("StallWatch: a timeout of 0 disables the alarm")
{
    EngineOptions options = MakeTestOptions(false);
    options.stallTimeout = 0ms;
    EngineParts parts(options);
    parts.BeginDriveToLoad();
    parts.stalls.UpdateStall(parts.lr);
    CHECK_FALSE(parts.Collect().GetDelayOrNull(EEngineTimer::DriveStall).has_value());
}

TEST_CASE("StallWatch: a robot at the end of its base waits for others")
{
    EngineParts parts;
    parts.BeginDriveToLoad();
    parts.stalls.UpdateStall(parts.lr);
    parts.Discard();
    parts.lr.drive->bTaken = true;
    parts.lr.drive->passed = parts.lr.drive->releasedCount - 1;
    parts.stalls.UpdateStall(parts.lr);
    CHECK(parts.Collect().IsTimerCancelled(EEngineTimer::DriveStall));
}
