#include "fixtures/PlanWorldSteps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using ACS::Testing::BeginPlan;
using ACS::Testing::FinishPlan;
using ACS::Testing::GetCarrierOrNull;
using ACS::Testing::MakeLogisticsPlan;
using ACS::Testing::PlanWorld;
using ACS::Testing::RestartEngine;
using ACS::Testing::TryRunUntil;

namespace
{

using Carriers = std::vector<std::optional<std::string>>;
using Loads = std::vector<PortLoad>;

/// Sets what the sensors of LR01 show from now on.
void Show(PlanWorld& world, bool bLoaded, const std::string& carrierID = {})
{
    world.GetRobot("LR01").loads = Loads{{"LR01.CP01", bLoaded, carrierID}};
    world.PublishState("LR01");
}

void SetCarrier(PlanWorld& world, std::optional<std::string> carrierIDOrNull)
{
    world.Ask(SetCarriers{"LR01", {std::move(carrierIDOrNull)}, 77});
    REQUIRE(world.replies.at(77).bAccepted);
}

/// The text of the alarm about reported loads; empty: it is not set.
std::string GetAlarm(const PlanWorld& world)
{
    const std::vector<Alarm>& alarms = world.engine->GetActiveAlarms();
    const auto found = std::ranges::find(alarms, "ACS-1011", &Alarm::errorCode);
    if (found == alarms.end())
    {
        return {};
    }
    CHECK(found->level == EAlarmLevel::Light);
    CHECK(found->robotID == "LR01");
    return found->message;
}

std::string MakeAlarm(const std::string& differences)
{
    return "Reported loads differ from the record: " + differences
        + ". The record now has the reported loads, except carriers reported at two ports. Check the ports, then correct the "
          "record or clear the alarm.";
}

Plan MakeLoadPlan()
{
    Plan plan = MakeLogisticsPlan("P1");
    plan.steps.pop_back();
    return plan;
}

} // namespace

TEST_CASE("Reported loads replace the record, and a difference is an alarm until the expected carrier is back")
{
    PlanWorld world;
    world.Connect();
    SetCarrier(world, "CASSETTE_01");
    Show(world, true, "CASSETTE_01");
    CHECK(GetAlarm(world).empty());
    Show(world, true, "CASSETTE_09");
    CHECK(GetCarrierOrNull(world) == "CASSETTE_09");
    CHECK(world.store.GetState().carriers.back().carrierIDs == Carriers{"CASSETTE_09"});
    CHECK(GetAlarm(world) == MakeAlarm("LR01.CP01: expected CASSETTE_01, reported CASSETTE_09"));
    Show(world, true, "CASSETTE_09");
    CHECK(GetAlarm(world) == MakeAlarm("LR01.CP01: expected CASSETTE_01, reported CASSETTE_09"));
    Show(world, false);
    CHECK(GetCarrierOrNull(world) == std::nullopt);
    REQUIRE(world.TryRun());
    CHECK(GetAlarm(world) == MakeAlarm("LR01.CP01: expected CASSETTE_01, reported no carrier"));
    Show(world, true, "CASSETTE_01");
    CHECK(GetCarrierOrNull(world) == "CASSETTE_01");
    CHECK(GetAlarm(world).empty());
    CHECK(
        world.GetReportsOf("-")
        == std::vector<std::string>{
            "Error ACS-1011 set",
            "Error ACS-1011 cleared",
            "Error ACS-1011 set",
            "Error ACS-1011 cleared"});
}

TEST_CASE("A robot that shows another carrier in each state sets the alarm at once and updates it at most every 10 s")
{
    PlanWorld world;
    world.Connect();
    SetCarrier(world, "CASSETTE_01");
    const auto showAll = [&world] {
        for (int number = 10; number < 30; ++number)
        {
            Show(world, true, fmt::format("CASSETTE_{}", number));
        }
    };
    const auto asked = world.GetNow().steady;
    showAll();
    CHECK(GetAlarm(world) == MakeAlarm("LR01.CP01: expected CASSETTE_01, reported CASSETTE_10"));
    CHECK(GetCarrierOrNull(world) == "CASSETTE_29");
    REQUIRE(world.TryRun([&world] { return world.GetReportsOf("-").size() > 1; }));
    CHECK(world.GetNow().steady - asked == std::chrono::seconds(10));
    CHECK(GetAlarm(world) == MakeAlarm("LR01.CP01: expected CASSETTE_01, reported CASSETTE_29"));
    showAll();
    CHECK(GetAlarm(world) == MakeAlarm("LR01.CP01: expected CASSETTE_01, reported CASSETTE_29"));
    REQUIRE(world.TryRun());
    CHECK(
        world.GetReportsOf("-")
        == std::vector<std::string>{"Error ACS-1011 set", "Error ACS-1011 cleared", "Error ACS-1011 set"});
}

TEST_CASE("A carrier that appears and disappears clears the alarm at once and sets it again at most every 10 s")
{
    PlanWorld world;
    world.Connect();
    SetCarrier(world, "CASSETTE_01");
    for (int number = 0; number < 20; ++number)
    {
        Show(world, false);
        Show(world, true, "CASSETTE_01");
    }
    CHECK(GetAlarm(world).empty());
    CHECK(world.GetReportsOf("-").size() == 2);
    Show(world, false);
    CHECK(GetAlarm(world).empty());
    REQUIRE(world.TryRun());
    CHECK(GetAlarm(world) == MakeAlarm("LR01.CP01: expected CASSETTE_01, reported no carrier"));
    CHECK(world.GetReportsOf("-").size() == 3);
}

TEST_CASE("A carrier that a robot shows at two ports is evidence for neither: the record stays, the alarm names both")
{
    PlanWorld world;
    world.Connect();
    world.Ask(SetCarriers{"CR01", {"TRAY_01", "TRAY_02", {}}, 1});
    const auto show = [&world](Loads loads) {
        world.GetRobot("CR01").loads = std::move(loads);
        world.PublishState("CR01");
    };
    const auto getMessages = [&world] {
        Carriers messages;
        for (const Alarm& alarm : world.engine->GetActiveAlarms())
        {
            messages.emplace_back(alarm.message);
        }
        return messages;
    };
    show({{"CR01.TP01", true, "TRAY_01"}, {"CR01.TP02", true, "TRAY_02"}, {"CR01.TP03", true, "TRAY_01"}});
    CHECK(world.engine->GetRobotStatuses()[1].carrierIDs == Carriers{"TRAY_01", "TRAY_02", "UNKNOWN"});
    CHECK(
        getMessages()
        == Carriers{
            MakeAlarm("CR01.TP01: expected TRAY_01, reported TRAY_01, also at CR01.TP03; CR01.TP03: expected no "
                      "carrier, reported TRAY_01, also at CR01.TP01")});
    show({{"CR01.TP01", true, "TRAY_02"}, {"CR01.TP02", true, "TRAY_02"}, {"CR01.TP03", false, {}}});
    CHECK(world.engine->GetRobotStatuses()[1].carrierIDs == Carriers{"TRAY_01", "TRAY_02", {}});
    REQUIRE(world.TryRun());
    CHECK(
        getMessages()
        == Carriers{MakeAlarm("CR01.TP01: expected TRAY_01, reported TRAY_02, also at CR01.TP02; CR01.TP02: expected "
                              "TRAY_02, reported TRAY_02, also at CR01.TP01")});
    show({{"CR01.TP01", true, "TRAY_01"}, {"CR01.TP02", true, "TRAY_02"}, {"CR01.TP03", false, {}}});
    CHECK(getMessages().empty());
    CHECK(world.engine->GetRobotStatuses()[1].carrierIDs == Carriers{"TRAY_01", "TRAY_02", {}});
}

TEST_CASE("A loaded port without an id keeps the carrier on record, or has an unknown one")
{
    PlanWorld world;
    world.Connect();
    Show(world, true);
    CHECK(GetCarrierOrNull(world) == "UNKNOWN");
    CHECK(GetAlarm(world) == MakeAlarm("LR01.CP01: expected no carrier, reported UNKNOWN"));
    SetCarrier(world, "CASSETTE_01");
    CHECK(GetAlarm(world).empty());
    Show(world, true);
    CHECK(GetCarrierOrNull(world) == "CASSETTE_01");
    SetCarrier(world, "UNKNOWN");
    Show(world, true, "CASSETTE_02"); // No difference: the unknown carrier has an id now.
    CHECK(GetCarrierOrNull(world) == "CASSETTE_02");
    CHECK(GetAlarm(world).empty());
    Show(world, true, std::string(MAXIMUM_ID_LENGTH + 1, 'C')); // ids that no carrier can have
    Show(world, true, "CASSETTE\n03");
    CHECK(GetCarrierOrNull(world) == "CASSETTE_02");
    CHECK(GetAlarm(world).empty());
    Show(world, false);
    Show(world, true); // a sensor that flickered
    CHECK(GetCarrierOrNull(world) == "CASSETTE_02");
    CHECK(GetAlarm(world).empty());
}

TEST_CASE("A robot that reports no loads keeps its record, and so does a port that it does not report")
{
    PlanWorld world;
    world.Connect();
    SetCarrier(world, "CASSETTE_01");
    world.PublishState("LR01");
    CHECK(GetCarrierOrNull(world) == "CASSETTE_01");
    world.GetRobot("LR01").loads = Loads{};
    world.PublishState("LR01");
    CHECK(GetCarrierOrNull(world) == "CASSETTE_01");
    world.GetRobot("LR01").loads = Loads{{"LR01.CP07", true, "CASSETTE_02"}};
    world.PublishState("LR01");
    CHECK(GetCarrierOrNull(world) == "CASSETTE_01");
    CHECK(GetAlarm(world).empty());
}

TEST_CASE("While a job uses a port, loads reported there are no difference, also just before and after its end")
{
    PlanWorld world;
    world.GetRobot("LR01").loads = Loads{{"LR01.CP01", false, {}}};
    BeginPlan(world, MakeLogisticsPlan("P1"), "Job 1 P1-a4 InProgress");
    Show(world, true, "CASSETTE_01");
    CHECK(GetAlarm(world).empty());
    REQUIRE(TryRunUntil(world, "P1", "Job 1 P1-a4 Completed"));
    CHECK(GetCarrierOrNull(world) == "CASSETTE_01");
    REQUIRE(TryRunUntil(world, "P1", "Job 2 P1-b2 InProgress"));
    Show(world, false);
    FinishPlan(world);
    Show(world, false);
    CHECK(GetCarrierOrNull(world) == std::nullopt);
    CHECK(world.engine->GetActiveAlarms().empty());
}

TEST_CASE("After a job the robot's loads are compared: another carrier, or a carrier although the job failed")
{
    PlanWorld world;
    world.GetRobot("LR01").loads = Loads{{"LR01.CP01", false, {}}};
    const bool bFails = GENERATE(false, true);
    if (bFails)
    {
        world.GetRobot("LR01").failingJobs.insert("P1-a4");
    }
    BeginPlan(world, MakeLoadPlan(), "Job 1 P1-a4 InProgress");
    world.GetRobot("LR01").loads = Loads{{"LR01.CP01", true, "CASSETTE_09"}};
    REQUIRE(world.TryRun());
    CHECK(GetCarrierOrNull(world) == "CASSETTE_09");
    CHECK(
        GetAlarm(world)
        == MakeAlarm(
            fmt::format("LR01.CP01: expected {}, reported CASSETTE_09", bFails ? "no carrier" : "CASSETTE_01")));
}

TEST_CASE("A job at one port of the robot does not hide a difference at another port")
{
    PlanWorld world;
    world.Connect();
    world.Ask(SetCarriers{"CR01", {"TRAY_01", "TRAY_02", {}}, 1});
    world.Submit({"P1", "", 1, {{1, "TrayUnload", "A01.CP01", {"TRAY_01"}, {{"J1", "AMR.TP01", "A01.CP01.TP01"}}}}});
    REQUIRE(TryRunUntil(world, "P1", "Job 1 J1 InProgress"));
    world.GetRobot("CR01").loads = Loads{{"CR01.TP01", false, {}}, {"CR01.TP02", false, {}}, {"CR01.TP03", false, {}}};
    world.PublishState("CR01");
    CHECK(world.engine->GetRobotStatuses()[1].carrierIDs == Carriers{"TRAY_01", {}, {}});
    REQUIRE(world.engine->GetActiveAlarms().size() == 1);
    CHECK(
        world.engine->GetActiveAlarms().front().message
        == MakeAlarm("CR01.TP02: expected TRAY_02, reported no carrier"));
    REQUIRE(world.TryRun());
    CHECK(world.engine->GetRobotStatuses()[1].carrierIDs == Carriers{{}, {}, {}});
}

TEST_CASE("Loads reported at the port of a running job are no evidence about another port")
{
    PlanWorld world;
    world.Connect();
    world.Ask(SetCarriers{"CR01", {"TRAY_01", "TRAY_02", {}}, 1});
    world.Submit({"P1", "", 1, {{1, "TrayUnload", "A01.CP01", {"TRAY_01"}, {{"J1", "AMR.TP01", "A01.CP01.TP01"}}}}});
    REQUIRE(TryRunUntil(world, "P1", "Job 1 J1 InProgress"));
    world.GetRobot("CR01").loads = Loads{{"CR01.TP01", true, "TRAY_02"}, {"CR01.TP02", true, "TRAY_02"}};
    world.PublishState("CR01");
    CHECK(world.engine->GetActiveAlarms().empty());
    CHECK(world.engine->GetRobotStatuses()[1].carrierIDs == Carriers{"TRAY_01", "TRAY_02", {}});
}

TEST_CASE("A port whose job is unresolved is not compared before the operator resolves the job")
{
    PlanWorld world;
    world.GetRobot("LR01").loads = Loads{{"LR01.CP01", false, {}}};
    BeginPlan(world, MakeLoadPlan(), "Job 1 P1-a4 InProgress");
    world.GetRobot("LR01").unresolvedReason = "it was switched off";
    world.GetRobot("LR01").loads = Loads{{"LR01.CP01", true, "CASSETTE_01"}};
    RestartEngine(world);
    CHECK(GetAlarm(world).empty());
    CHECK(GetCarrierOrNull(world) == std::nullopt);
    world.ResolveJob("P1", "P1-a4", EJobResolution::Done);
    REQUIRE(world.TryRun());
    CHECK(GetCarrierOrNull(world) == "CASSETTE_01");
    CHECK(world.engine->GetActiveAlarms().empty());
}

TEST_CASE("The alarm about reported loads is cleared by the operator or the next job at the port; a restart keeps it")
{
    PlanWorld world;
    world.Connect();
    SetCarrier(world, "CASSETTE_01");
    Show(world, false);
    CHECK_FALSE(GetAlarm(world).empty());
    RestartEngine(world);
    CHECK_FALSE(GetAlarm(world).empty());
    CHECK(GetCarrierOrNull(world) == std::nullopt);
    SECTION("cleared")
    {
        world.Ask(ClearAlarms{"LR01", "ACS-1011", {}, {}, 1});
        CHECK(world.replies.at(1).message == "1 cleared; 0 set again because the cause remains.");
        Show(world, false);
        CHECK(GetAlarm(world).empty());
    }
    SECTION("a job")
    {
        BeginPlan(world, MakeLoadPlan(), "Job 1 P1-a4 InProgress");
        Show(world, true);
        FinishPlan(world);
        CHECK(GetAlarm(world).empty());
        CHECK(GetCarrierOrNull(world) == "CASSETTE_01");
    }
}

TEST_CASE("Reported loads are published at once, and plans that waited for the carrier begin")
{
    PlanWorld world;
    world.Connect();
    SetCarrier(world, "CASSETTE_09");
    world.Submit({"P1", "", 1, {{1, "CassetteUnload", "A01.CP02", {"CASSETTE_01"}, {{"J1", "AMR.CP01", "A01.CP02"}}}}});
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1").empty());
    const std::size_t statuses = world.GetTraceOf("status LR01 ").size();
    Show(world, true, "CASSETTE_01");
    CHECK(world.GetTraceOf("status LR01 ").size() > statuses);
    REQUIRE(TryRunUntil(world, "P1", "Job 1 J1 InProgress"));
    world.GetRobot("LR01").loads = Loads{{"LR01.CP01", false, {}}};
    FinishPlan(world);
}
