#include "Catch.hpp"
#include "dispatch/QueuePass.hpp"
#include "fixtures/EngineParts.hpp"
#include "fixtures/PlanWorld.hpp"

#include <algorithm>
#include <set>
#include <string>

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

TEST_CASE("WaitReasons: a robot that is kept for a plan of higher priority has this reason until the plan has a robot")
{
    EngineParts parts(MakeTestOptions(true));
    parts.BeginDriveToLoad();
    parts.PutOn(parts.engine.fleet[2], "D-CHG03");
    const auto add = [&parts](const std::string& planID, const std::string& from, const std::string& to, int priority) {
        Plan plan = MakeLogisticsPlan(planID);
        plan.priority = priority;
        plan.steps[0].position = from;
        plan.steps[0].jobs[0] = {planID + "-load", from, "AMR.CP01"};
        plan.steps[1].position = to;
        plan.steps[1].jobs[0] = {planID + "-unload", "AMR.CP01", to};
        parts.Add(std::move(plan));
    };
    add("P2", "A01.CP01", "A02.CP04", 10);
    add("P3", "A01.CP05", "A01.CP04", 5);
    const auto pass = [&parts] {
        FreeRobots free(parts.engine.fleet);
        QueuePass queue(parts.engine, parts.coordinator.GetVisits(), parts.dispatcher, free);
        return queue.FindNextOrNull();
    };
    const auto describe = [&parts](const std::string& planID) {
        const std::optional<WaitReason> reason = parts.waits.GetWaitReasonOrNull(planID);
        REQUIRE(reason.has_value());
        const auto found = std::ranges::find(reason->robots, "LR02", &RobotUnavailability::robotID);
        return found == reason->robots.end() ? std::string() : found->reason;
    };
    CHECK_FALSE(pass().has_value());
    CHECK(describe("P2").empty());
    CHECK(describe("P3") == "kept for plan P2, which is before it in the queue");
    CHECK(parts.waits.GetWaitReasonOrNull("P3")->message == "No suitable robot is free.");
    parts.engine.plans.FindActiveOrNull("P2")->record.plan.priority = 5; // as if P2 waited for its station only
    parts.engine.options.queueOvertaking = std::chrono::milliseconds(0);
    CHECK(pass().has_value());
    CHECK(describe("P3").empty());
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
