#include "Catch.hpp"
#include "fixtures/EngineParts.hpp"
#include "fixtures/PlanWorld.hpp"

#include <algorithm>
#include <set>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS::Testing;  // NOLINT(google-build-using-namespace): its fixtures

TEST_CASE("WaitReasons: queued plans have a position and a reason for each robot that is not free for them")
{
    EngineParts parts(MakeTestOptions(true));
    parts.AddLoad();
    parts.Add(MakeLogisticsPlan("P2"));
    parts.PutOn(parts.lr, "D-CHG01");
    const std::vector<WaitReason> reasons = parts.waits.GetWaitReasons();
    REQUIRE(reasons.size() == 2);
    CHECK(reasons[0].planID == "P1");
    CHECK(reasons[0].queuePosition == 1U);
    CHECK(reasons[1].queuePosition == 2U);
    REQUIRE(reasons[0].robots.size() == 1);
    CHECK(reasons[0].robots.front().robotID == "LR02");
    CHECK(parts.waits.GetWaitReasonOrNull("P2") == reasons[1]);
    CHECK_FALSE(parts.waits.GetWaitReasonOrNull("P3").has_value());
    parts.lr.ports.Correct({"OTHER"});
    const std::optional<WaitReason> taken = parts.waits.GetWaitReasonOrNull("P1");
    REQUIRE(taken.has_value());
    CHECK(taken->robots.size() == 2);
    CHECK(taken->message != reasons[0].message);
}

TEST_CASE("WaitReasons: a reason that affects all plans precedes one that affects one plan")
{
    EngineParts parts;
    parts.AddLoad();
    parts.PutOn(parts.lr, "D-CHG01");
    const auto describe = [&parts] {
        return parts.waits.GetWaitReasonOrNull("P1").value_or(WaitReason()).message;
    };
    std::set<std::string> messages{describe()};
    parts.engine.startup.Begin(true);
    CHECK(messages.insert(describe()).second);
    parts.engine.backlog.OnFailed();
    CHECK(messages.insert(describe()).second);
    parts.tsc.SwitchTSC(ControlTSC{true, 0});
    CHECK(messages.insert(describe()).second);
}

TEST_CASE("WaitReasons: a plan whose robot makes progress has no reason")
{
    EngineParts parts;
    parts.BeginDriveToLoad();
    CHECK_FALSE(parts.waits.GetWaitReasonOrNull("P1").has_value());
    SECTION("its robot cannot be reached")
    {
        parts.lr.view.bOnline = false;
        CHECK(parts.waits.GetWaitReasonOrNull("P1").has_value());
    }
    SECTION("that it was begun is not stored")
    {
        parts.lr.planOrNull->bUnstored = true;
        CHECK(parts.waits.GetWaitReasonOrNull("P1").has_value());
    }
    SECTION("its robot has stalled")
    {
        parts.stalls.UpdateStall(parts.lr);
        parts.stalls.OnDriveStall(parts.lr);
        CHECK(parts.waits.GetWaitReasonOrNull("P1").has_value());
    }
    SECTION("its robot is at the end of its base")
    {
        parts.lr.drive->passed = parts.lr.drive->releasedCount - 1;
        CHECK(parts.waits.GetWaitReasonOrNull("P1").has_value());
    }
}

TEST_CASE("WaitReasons: a robot that lost its drive while it drove has a reason until it has stopped")
{
    EngineParts parts;
    parts.PutOn(parts.lr, "D-A01.CP01");
    parts.BeginDrive(parts.lr, "D-CHG01");
    parts.lr.drive->bConfirmed = true;
    parts.lr.view.state->bDriving = true;
    parts.coordinator.EndDrive(parts.lr);
    parts.AddLoad();
    REQUIRE_FALSE(parts.lr.IsFree());
    const std::optional<WaitReason> stopping = parts.waits.GetWaitReasonOrNull("P1");
    REQUIRE(stopping.has_value());
    CHECK(std::ranges::any_of(stopping->robots, [](const RobotUnavailability& robot) {
        return robot.robotID == "LR01" && robot.reason == "is coming to a stop";
    }));
}

TEST_CASE("WaitReasons: a paused plan and an unresolved job have a reason, a running job has none")
{
    EngineParts parts;
    ActivePlan& plan = parts.BeginLoad();
    CHECK_FALSE(parts.waits.DescribeBegunOrNull(plan).has_value());
    parts.jobs.OnJobUnresolved(parts.lr, JobUnresolved{"P1-a4", "restarted"});
    const std::optional<WaitReason> unresolved = parts.waits.DescribeBegunOrNull(plan);
    REQUIRE(unresolved.has_value());
    CHECK_FALSE(unresolved->queuePosition.has_value());
    parts.engine.transaction.ChangePlan(plan, EPlanState::Paused, {});
    const std::optional<WaitReason> paused = parts.waits.DescribeBegunOrNull(plan);
    REQUIRE(paused.has_value());
    CHECK(paused->message != unresolved->message);
}
