#include "fixtures/PlanWorldSteps.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using ACS::Testing::Lines;
using ACS::Testing::MakeControlPlan;
using ACS::Testing::MakeLogisticsPlan;
using ACS::Testing::MakeTestOptions;
using ACS::Testing::MakeTestSite;
using ACS::Testing::MakeWorld;
using ACS::Testing::PlanWorld;
using ACS::Testing::TryRunUntil;

namespace
{

Plan MakeUnloadPlan(const std::string& planID, const std::string& carrierID, const std::string& port = "AMR.CP01")
{
    return {planID, "", 1, {{1, "CassetteUnload", "A01.CP02", {carrierID}, {{planID + "-u", port, "A01.CP02"}}}}};
}

Plan MakeLoadPlan(const std::string& planID, const std::string& carrierID)
{
    return {planID, "", 1, {{1, "CassetteLoad", "A01.CP01", {carrierID}, {{planID + "-l", "A01.CP01", "AMR.CP01"}}}}};
}

Plan MakeTransport(const std::string& planID, std::int32_t priority, const std::string& from)
{
    Plan plan = MakeLogisticsPlan(planID);
    plan.priority = priority;
    plan.steps[0].position = from;
    plan.steps[0].jobs[0].from = from;
    plan.steps[1].position = from == "A01.CP01" ? "A02.CP03" : "A02.CP04";
    plan.steps[1].jobs[0].to = plan.steps[1].position;
    return plan;
}

void SetCarrier(PlanWorld& world, const std::string& robotID, std::optional<std::string> carrierIDOrNull)
{
    world.Ask(SetCarriers{robotID, {std::move(carrierIDOrNull)}, 77});
    REQUIRE(world.replies.at(77).bAccepted);
}

std::string GetRobotOf(const PlanWorld& world, const std::string& planID)
{
    return world.engine->GetPlanOrNull(planID)->robotID.value_or("");
}

std::string GetReason(const PlanWorld& world, const std::string& planID, const std::string& robotID)
{
    const std::optional<WaitReason> reason = world.engine->GetWaitReasonOrNull(planID);
    REQUIRE(reason.has_value());
    for (const RobotUnavailability& robot : reason->robots)
    {
        if (robot.robotID == robotID)
        {
            return robot.reason;
        }
    }
    return {};
}

} // namespace

TEST_CASE("Carrier continuity: an unload is assigned to the robot that has the carrier, not to a nearer one")
{
    for (const std::string owner : {"LR01", "LR02"})
    {
        PlanWorld world(1, true);
        world.Connect();
        SetCarrier(world, owner, "CASSETTE_07");
        world.Submit(MakeUnloadPlan("P1", "CASSETTE_07"));
        REQUIRE(world.TryRun());
        CHECK(GetRobotOf(world, "P1") == owner);
        CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
        CHECK(world.engine->GetActiveAlarms().empty());
    }
}

TEST_CASE("Carrier continuity: the carrier that one plan loads is unloaded by the next, also after a restart")
{
    PlanWorld world(1, true);
    world.Connect();
    world.Submit(MakeLoadPlan("P1", "CASSETTE_07"));
    REQUIRE(world.TryRun());
    const std::string owner = GetRobotOf(world, "P1");
    world.Restart(ACS::Testing::MakeTestOptions(true), ACS::Testing::MakeTestSite());
    world.Connect();
    world.Submit(MakeUnloadPlan("P2", "CASSETTE_07"));
    REQUIRE(world.TryRun());
    CHECK(GetRobotOf(world, "P2") == owner);
    CHECK(world.engine->GetActiveAlarms().empty());
}

TEST_CASE("Carrier continuity: a plan whose carrier is elsewhere waits, and the wait reason names the place")
{
    PlanWorld world(1, true);
    world.Connect();
    SetCarrier(world, "LR01", "CASSETTE_07");
    world.Submit(MakeUnloadPlan("P1", "CASSETTE_07", "LR02.CP01"));
    world.Submit(MakeUnloadPlan("P2", "CASSETTE_08", "LR01.CP01"));
    REQUIRE(world.TryRun());
    CHECK(GetReason(world, "P1", "LR02") == "CASSETTE_07 is on LR01.CP01");
    CHECK(GetReason(world, "P2", "LR01") == "LR01.CP01 holds CASSETTE_07, not CASSETTE_08");
    SetCarrier(world, "LR01", std::nullopt);
    REQUIRE(world.TryRun());
    // No robot is known to have it any more: it may have been loaded by hand.
    CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
    CHECK(world.GetReportsOf("P2").back() == "Plan Completed");
}

TEST_CASE("Carrier continuity: a carrier that is not on record is unloaded first where an unknown carrier is")
{
    PlanWorld world(1, true);
    world.Connect();
    SetCarrier(world, "LR02", "UNKNOWN");
    world.Submit(MakeUnloadPlan("P1", "CASSETTE_07"));
    REQUIRE(world.TryRun());
    CHECK(GetRobotOf(world, "P1") == "LR02");
}

TEST_CASE("An unload of another carrier than the one on record is reported, unless the record has an unknown carrier")
{
    for (const std::string known : {"CASSETTE_99", "UNKNOWN"})
    {
        PlanWorld world;
        world.Connect();
        world.Submit(MakeUnloadPlan("P1", "CASSETTE_07"));
        REQUIRE(TryRunUntil(world, "P1", "Step 1 InProgress"));
        SetCarrier(world, "LR01", known);
        REQUIRE(TryRunUntil(world, "P1", "Plan Completed"));
        const std::vector<Alarm>& alarms = world.engine->GetActiveAlarms();
        REQUIRE(alarms.size() == (known == "UNKNOWN" ? 0U : 1U));
        if (!alarms.empty())
        {
            CHECK(alarms.front().errorCode == "ACS-1004");
            CHECK(
                alarms.front().message
                == "CASSETTE_07 was unloaded from LR01.CP01, but the record has CASSETTE_99 there. Check the port and correct the record.");
        }
    }
}

TEST_CASE("A load into a port that is taken is assigned to another robot or waits, unless the option allows it")
{
    for (const bool bTries : {false, true})
    {
        PlanWorld world =
            MakeWorld([bTries](EngineOptions& options) { options.dispatch.bLoadsIntoTakenPorts = bTries; });
        world.Connect();
        SetCarrier(world, "LR01", "CASSETTE_07");
        world.Submit(MakeLoadPlan("P1", "CASSETTE_08"));
        REQUIRE(world.TryRun());
        if (bTries)
        {
            CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
            REQUIRE(world.engine->GetActiveAlarms().size() == 1);
            CHECK(world.engine->GetActiveAlarms().front().errorCode == "ACS-1004");
            continue;
        }
        CHECK(world.GetReportsOf("P1").empty());
        CHECK(GetReason(world, "P1", "LR01") == "LR01.CP01 is taken by CASSETTE_07");
        SetCarrier(world, "LR01", std::nullopt);
        REQUIRE(world.TryRun());
        CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
    }
    PlanWorld world(1, true);
    world.Connect();
    SetCarrier(world, "LR01", "CASSETTE_07");
    world.Submit(MakeLoadPlan("P1", "CASSETTE_08"));
    REQUIRE(world.TryRun());
    CHECK(GetRobotOf(world, "P1") == "LR02");
}

TEST_CASE("A plan that unloads a port before it loads it may find the port taken")
{
    PlanWorld world;
    world.Connect();
    SetCarrier(world, "LR01", "CASSETTE_07");
    Plan plan = MakeUnloadPlan("P1", "CASSETTE_07");
    Step load = MakeLoadPlan("P1", "CASSETTE_08").steps.front();
    load.stepNo = 2;
    plan.steps.push_back(load);
    world.Submit(plan);
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
    CHECK(world.engine->GetRobotStatuses().front().carrierIDs.front() == "CASSETTE_08");
}

TEST_CASE("Wait reasons of all plans: a long queue has lists of robots at its head only, a single plan always")
{
    constexpr std::size_t CANDIDATES = 2;
    constexpr std::size_t LISTED = MAXIMUM_LISTED_ROBOTS / CANDIDATES;
    EngineOptions options = MakeTestOptions(true);
    options.maximumPlans = LISTED + 2;
    PlanWorld world(1, options, MakeTestSite());
    for (std::size_t i = 0; i < options.maximumPlans; ++i)
    {
        world.Submit(MakeLogisticsPlan("P" + std::to_string(i)));
    }
    const std::vector<WaitReason> reasons = world.engine->GetWaitReasons();
    REQUIRE(reasons.size() == options.maximumPlans);
    CHECK(
        std::ranges::count(reasons, CANDIDATES, [](const WaitReason& reason) { return reason.robots.size(); })
        == LISTED);
    CHECK(reasons[LISTED - 1].robots.size() == CANDIDATES);
    CHECK(reasons[LISTED].robots.empty());
    WaitReason last = *world.engine->GetWaitReasonOrNull(reasons.back().planID);
    CHECK(last.robots.size() == CANDIDATES);
    last.robots.clear();
    CHECK(last == reasons.back());
}

TEST_CASE("Wait reason: the position in the queue, and for each suitable robot why it is not used")
{
    PlanWorld world(1, true);
    world.Submit(MakeLogisticsPlan("P1"));
    CHECK(GetReason(world, "P1", "LR01") == "no connection");
    world.Connect();
    REQUIRE(TryRunUntil(world, "P1", "Plan InProgress"));
    const std::string busy = GetRobotOf(world, "P1");
    const std::string other = busy == "LR01" ? "LR02" : "LR01";
    world.Raise(other, LinkChanged{false});
    world.Submit(MakeLogisticsPlan("P2"));
    world.Submit(MakeLogisticsPlan("P3"));
    const WaitReason reason = *world.engine->GetWaitReasonOrNull("P3");
    CHECK(reason.queuePosition == 2);
    CHECK(reason.message == "No suitable robot is free.");
    CHECK(reason.robots.size() == 2);
    CHECK(GetReason(world, "P3", busy) == "busy with plan P1");
    CHECK(GetReason(world, "P3", other) == "no connection");
    world.SwitchTSC(true);
    CHECK(world.engine->GetWaitReasonOrNull("P2")->message == "The TSC is Pausing: no plan is started.");
    CHECK(world.engine->GetWaitReasons().back().planID == "P3");
    CHECK_FALSE(world.engine->GetWaitReasonOrNull("P9").has_value());
}

TEST_CASE("Wait reason: a plan that is held or paused, and one whose robot cannot continue")
{
    PlanWorld world;
    world.Connect();
    world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(TryRunUntil(world, "P1", "Job 1 P1-a4 InProgress"));
    CHECK_FALSE(world.engine->GetWaitReasonOrNull("P1").has_value());
    world.Submit(MakeLogisticsPlan("P2"));
    world.Control(EPlanControl::Pause, "P2");
    CHECK(world.engine->GetWaitReasonOrNull("P2")->message == "The plan is held in the queue by PausePlan.");
    world.Raise("LR01", LinkChanged{false});
    CHECK(world.engine->GetWaitReasonOrNull("P1")->message == "LR01: no connection.");
}

TEST_CASE("5.9 The position while a robot drives is the last station, the next station or none, by option")
{
    for (const EMovingPosition moving : {EMovingPosition::Last, EMovingPosition::Target, EMovingPosition::None})
    {
        PlanWorld world = MakeWorld([moving](EngineOptions& options) { options.movingPosition = moving; });
        world.Connect();
        world.Submit(MakeLogisticsPlan("P1"));
        REQUIRE(TryRunUntil(world, "P1", "Step 1 InProgress"));
        const std::string position = world.engine->GetRobotStatuses().front().position;
        CHECK(
            position
            == (moving == EMovingPosition::Last ? "CHG01" : (moving == EMovingPosition::Target ? "A01.CP01" : "")));
        REQUIRE(TryRunUntil(world, "P1", "Job 1 P1-a4 InProgress"));
        CHECK(world.engine->GetRobotStatuses().front().position == "A01.CP01");
    }
}

TEST_CASE("A robot that loses its drive while it moves keeps the nodes ahead until its position is known")
{
    PlanWorld world;
    ACS::Testing::BeginPlan(world, MakeLogisticsPlan("P1"), "Step 1 InProgress");
    REQUIRE(world.TryRun([&world] { return world.GetRobot("LR01").GetOccupied().front() == "L01"; }));
    Plan second = MakeControlPlan("P2");
    second.steps[0].position = "A01.CP02"; // not where LR01 drives to
    for (Job& job : second.steps[0].jobs)
    {
        job.from->replace(0, 8, "A01.CP02");
    }
    world.Submit(second);
    static_cast<void>(ACS::Testing::TryRunFor(world, std::chrono::milliseconds(1)));
    StateChanged state;
    state.lastNodeID = "L01";
    state.bPoseKnown = true;
    state.bDriving = true;
    world.Raise("LR01", state);
    const std::size_t line = world.trace.size();
    world.Raise("LR01", DriveRejected{world.GetRobot("LR01").GetDriveID(), "the vehicle lost the order"});
    CHECK(world.GetReportsOf("P1").back() == "Step 1 InProgress");
    CHECK(ACS::Testing::FindLine(world, "command CR01", line) == world.trace.size()); // it waits at L02
    state.x = 0.9;
    state.bDriving = false;
    world.Raise("LR01", state);
    CHECK(ACS::Testing::FindLine(world, "command CR01", line) == world.trace.size());
    state.x = 0;
    world.Raise("LR01", state);
    CHECK(ACS::Testing::FindLine(world, "command CR01", line) < world.trace.size());
}

TEST_CASE("A plan whose station is taken lets plans of its priority begin before it, and keeps its robot from others")
{
    for (const std::int32_t priority : {10, 5})
    {
        INFO("priority " << priority);
        PlanWorld world(1, true);
        world.Connect();
        world.Submit(MakeTransport("P1", 10, "A01.CP01"));
        REQUIRE(TryRunUntil(world, "P1", "Plan InProgress"));
        world.Submit(MakeTransport("P2", 10, "A01.CP01"));
        world.Submit(MakeTransport("P3", priority, "A01.CP05"));
        REQUIRE(world.TryRun());
        const std::size_t second = ACS::Testing::FindLine(world, "report P2 Plan InProgress", 0);
        const std::size_t third = ACS::Testing::FindLine(world, "report P3 Plan InProgress", 0);
        CHECK((third < second) == (priority == 10));
        for (const char* const planID : {"P1", "P2", "P3"})
        {
            CHECK(world.GetReportsOf(planID).back() == "Plan Completed");
        }
        CHECK(world.violations == Lines{});
    }
}

TEST_CASE("Wait reason: a plan that waits for its station names the robot that uses it, or the plan before it")
{
    PlanWorld world(1, true);
    world.Connect();
    world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(TryRunUntil(world, "P1", "Plan InProgress"));
    Plan second = MakeTransport("P2", 10, "A01.CP01");
    second.steps[1].position = "A02.CP04";
    second.steps[1].jobs[0].to = "A02.CP04";
    world.Submit(second);
    static_cast<void>(ACS::Testing::TryRunFor(world, std::chrono::milliseconds(1)));
    CHECK(
        world.engine->GetWaitReasonOrNull("P2")->message
        == GetRobotOf(world, "P1")
            + " uses station A01.CP01 for plan P1. The plan starts when it can arrive there afterwards.");
    world.Submit(MakeTransport("P3", 10, "A01.CP05"));
    static_cast<void>(ACS::Testing::TryRunFor(world, std::chrono::milliseconds(1)));
    CHECK(
        world.engine->GetWaitReasonOrNull("P3")->message
        == "Plan P2 is before it in the queue and uses station A02.CP04 too.");
    CHECK(world.engine->GetWaitReasons().back() == *world.engine->GetWaitReasonOrNull("P3"));
    REQUIRE(world.TryRun());
    for (const char* const planID : {"P1", "P2", "P3"})
    {
        CHECK(world.GetReportsOf(planID).back() == "Plan Completed");
    }
    CHECK(world.violations == Lines{});
}
