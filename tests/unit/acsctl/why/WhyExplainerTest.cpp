#include "why/WhyExplainer.hpp"

#include "Catch.hpp"
#include "why/ExplanationView.hpp"
#include "WhyFixture.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

namespace Acsctl = ACS::Acsctl;
using namespace ACS::Acsctl::Test; // NOLINT(google-build-using-namespace): its fixture

TEST_CASE("A line on which everything moves needs no attention")
{
    WhyFixture line;
    line.AddPlan("P1", "InProgress").robotID = "LR01";
    const auto explanation = line.Make().ExplainAll();
    CHECK_FALSE(explanation.NeedsAttention());
    CHECK(PrintText(explanation) == "Nothing is in the way: 1 plans and 1 robots, none of which waits.\n");
}

TEST_CASE("The causes of a plan that waits lead over its robots to their plans")
{
    WhyFixture line;
    line.snapshot.robots[0].planID = "P1";
    Acsctl::PlanInfo& busy = line.AddPlan("P1", "Paused");
    busy.robotID = "LR01";
    line.AddWaitingPlan("P2", "No suitable robot is free", {{"LR01", "busy with plan P1"}});
    const auto explanation = line.Make().ExplainPlan(*line.Make().FindPlanOrNull("P2"));
    CHECK(explanation.NeedsAttention());
    CHECK(
        PrintText(explanation)
        == "Plan P2 does not move for 5 min: it is Pending, at position 1 of the queue.\n"
           "  No suitable robot is free.\n"
           "  Robot LR01: busy with plan P1.\n"
           "    Its plan P1 does not move either.\n"
           "      Plan P1 is paused.\n"
           "        Remedy: When it may continue: acsctl resume P1\n");
}

TEST_CASE("Plans that wait for each other are each explained once")
{
    WhyFixture line;
    line.snapshot.robots[0].planID = "P1";
    line.AddRobot("LR02", "Moving").planID = "P2";
    line.AddWaitingPlan("P1", "Waiting for N2, reserved by LR02.", {{"LR02", "on N2"}}).robotID = "LR01";
    line.AddWaitingPlan("P2", "Waiting for N1, reserved by LR01.", {{"LR01", "on N1"}}).robotID = "LR02";
    const std::string text = PrintText(line.Make().ExplainPlan(line.snapshot.plans[0]));
    CHECK(text.find("Waiting for N2") == text.rfind("Waiting for N2"));
    CHECK(text.find("Waiting for N1") != std::string::npos);
}

TEST_CASE("An alarm is explained with its cause and remedy, an unresolved job with its command")
{
    WhyFixture line;
    Acsctl::AlarmInfo alarm = MakeAlarm("LR01", "ACS-1008", "Job outcome unknown");
    alarm.cause = "A restart";
    alarm.remedy = "Check the carrier";
    alarm.planID = "P1";
    alarm.jobID = "J1";
    line.snapshot.alarms.push_back(alarm);
    alarm.errorCode = "ACS-1002";
    alarm.title = "Robot disconnected";
    alarm.planID.reset();
    line.snapshot.alarms.push_back(alarm);
    line.AddWaitingPlan("P1", "Job J1 is unresolved.").robotID = "LR01";
    const std::string text = PrintText(line.Make().ExplainPlan(line.snapshot.plans[0]));
    CHECK_THAT(
        text,
        Catch::Contains("Heavy alarm ACS-1008 Job outcome unknown of LR01.\n    Cause: A restart.\n"
                        "    Remedy: Check the carrier.\n"
                        "    Remedy: If it was done: acsctl resolve P1 J1 done\n"
                        "    Remedy: If it failed: acsctl resolve P1 J1 failed\n"
                        "    Remedy: If nothing was moved: acsctl resolve P1 J1 again\n"));
    CHECK_THAT(text, Catch::Contains("Heavy alarm ACS-1002 Robot disconnected of LR01."));
}

TEST_CASE("A blocked place is a cause where the plan works and where its robot drives")
{
    WhyFixture line;
    line.site.blocked = {
        {"station", "A01", "wet floor", std::nullopt},
        {"node", "N9", std::nullopt, std::nullopt},
        {"edge", "E1", "", std::nullopt},
        {"node", "N7", std::nullopt, std::nullopt},
        {"node", "FAR", std::nullopt, std::nullopt}};
    line.site.stations = {{"B02", {"N7"}}};
    line.site.edges = {{"E1", "N1", "N2"}};
    Acsctl::RobotInfo& robot = line.snapshot.robots[0];
    robot.node = "N1";
    robot.route = {{"N2", true}, {"N9", false}};
    Acsctl::PlanInfo& plan = line.AddWaitingPlan("P1", "No route.");
    plan.robotID = "LR01";
    plan.steps = {{1, "", "A01", "Pending", {}, {}}, {2, "", "B02", "Pending", {}, {}}};
    const std::string text = PrintText(line.Make().ExplainPlan(plan));
    CHECK_THAT(text, Catch::Contains("Station A01 is blocked: wet floor."));
    CHECK_THAT(text, Catch::Contains("Node N9 is blocked."));
    CHECK_THAT(text, Catch::Contains("Edge E1 is blocked."));
    CHECK_THAT(text, Catch::Contains("Node N7 is blocked."));
    CHECK_THAT(text, Catch::Contains("acsctl unblock node N7"));
    CHECK_THAT(text, !Catch::Contains("FAR"));
    line.snapshot.plans[0].steps[0].status = "Completed";
    CHECK_THAT(PrintText(line.Make().ExplainPlan(line.snapshot.plans[0])), !Catch::Contains("A01"));
}

TEST_CASE("A blocked edge that a wait reason names is a cause of the plan")
{
    WhyFixture line;
    for (const char* edgeID : {"E1", "E12"})
    {
        Acsctl::BlockInfo& block = line.site.blocked.emplace_back();
        block.kind = "edge";
        block.id = edgeID;
    }
    const Acsctl::PlanInfo plan =
        line.AddWaitingPlan("P1", "No suitable robot is free", {{"LR01", "edge E12 is blocked: wet floor"}});
    const std::string text = PrintText(line.Make().ExplainPlan(plan));
    CHECK_THAT(text, Catch::Contains("Edge E12 is blocked"));
    CHECK_THAT(text, Catch::Contains("acsctl unblock edge E12"));
    CHECK_THAT(text, !Catch::Contains("unblock edge E1\n"));
}

TEST_CASE("What stops acsd itself comes first")
{
    WhyFixture line;
    line.snapshot.status.bReady = false;
    line.snapshot.status.notReadyReasons = {"The MCS is not connected"};
    line.snapshot.status.links = {{"mcs", false, "refused", std::nullopt}, {"mqtt", true, std::nullopt, std::nullopt}};
    line.snapshot.status.tsc = "Paused";
    line.AddWaitingPlan("P1", "The TSC is Paused.");
    const auto explanation = line.Make().ExplainAll();
    REQUIRE(explanation.findings.size() == 2);
    CHECK(explanation.findings[0].subject == Acsctl::ESubject::Acsd);
    CHECK(explanation.findings[0].causes.size() == 3);
    const std::string text = PrintText(explanation);
    CHECK_THAT(text, Catch::Contains("The link mcs is down: refused."));
    CHECK_THAT(text, !Catch::Contains("mqtt"));
    CHECK_THAT(text, Catch::Contains("acsctl tsc resume"));
}

TEST_CASE("A TSC that is Paused until the robots have reported is not to be resumed")
{
    WhyFixture line;
    line.snapshot.status.tsc = "Paused";
    line.snapshot.status.tscReason = "Not all robots have reported their positions since the restart.";
    line.AddWaitingPlan("P1", *line.snapshot.status.tscReason);
    const std::string text = PrintText(line.Make().ExplainAll());
    CHECK_THAT(
        text,
        Catch::Contains("The TSC is Paused: Not all robots have reported their positions since the restart."));
    CHECK_THAT(text, Catch::Contains("Wait, at most restart.wait"));
    CHECK_THAT(text, !Catch::Contains("tsc resume"));
}

TEST_CASE("A plan is explained with the links that are down; a refused registration has its own remedy")
{
    WhyFixture line;
    const std::string refusal = "connected, not registered: mcs: unknown ACS";
    line.snapshot.status.links = {
        {"mcs", false, refusal, std::nullopt},
        {"mqtt", false, "no connection: mqtt", std::nullopt}};
    line.snapshot.status.notReadyReasons = {refusal, "no connection: mqtt", "the store cannot be written"};
    const Acsctl::PlanInfo plan = line.AddWaitingPlan("P1", "No suitable robot is free.");
    const std::string text = PrintText(line.Make().ExplainPlan(plan));
    CHECK_THAT(text, Catch::Contains("The link mcs is down: connected, not registered: mcs: unknown ACS."));
    CHECK_THAT(text, Catch::Contains("it must accept the registration of this ACS"));
    CHECK_THAT(text, Catch::Contains("Check the MQTT broker and the network to it."));
    const auto explanation = line.Make().ExplainAll();
    CHECK(explanation.findings[0].causes.size() == 3); // each link once, and the store
    CHECK_THAT(PrintText(explanation), Catch::Contains("acsd is not ready: the store cannot be written."));
}

TEST_CASE("An unfinished plan is explained with the alarm of a store that fails")
{
    WhyFixture line;
    Acsctl::AlarmInfo alarm = MakeAlarm("ACS", "ACS-1005", "Store failing");
    alarm.message = "Plans cannot be stored: /var/acsd.db: expected free space";
    alarm.cause = "The disk is full";
    alarm.remedy = "Free space";
    line.snapshot.alarms.push_back(alarm);
    alarm.errorCode = "ACS-1021"; // refuses nothing
    line.snapshot.alarms.push_back(alarm);
    Acsctl::PlanInfo plan = line.AddWaitingPlan("P1", "The store is failing.");
    const std::string text = PrintText(line.Make().ExplainPlan(plan));
    CHECK_THAT(
        text,
        Catch::Contains(
            "Heavy alarm ACS-1005 Store failing of acsd: Plans cannot be stored: /var/acsd.db: expected free space.\n"
            "    Cause: The disk is full.\n    Remedy: Free space.\n"));
    CHECK_THAT(text, !Catch::Contains("ACS-1021"));
    plan.status = "Completed";
    CHECK_THAT(PrintText(line.Make().ExplainPlan(plan)), !Catch::Contains("ACS-1005"));
}

TEST_CASE("A report that the MCS has refused is explained with its plan, and for acsd without need of attention")
{
    WhyFixture line;
    line.snapshot.status.refusedReports = {3, Acsctl::RefusedReport{"JobReport", "P1", "unknown job", false}};
    const Acsctl::PlanInfo plan = line.AddPlan("P1", "InProgress");
    const Acsctl::PlanInfo other = line.AddPlan("P2", "InProgress");
    const std::string refused =
        "The MCS has refused reports (3 since the start of acsd), last a JobReport of plan P1: unknown job.";
    CHECK_THAT(PrintText(line.Make().ExplainPlan(plan)), Catch::Contains(refused));
    CHECK_THAT(PrintText(line.Make().ExplainPlan(plan)), Catch::Contains("Correct the plan in the MCS"));
    CHECK_THAT(PrintText(line.Make().ExplainPlan(other)), !Catch::Contains("refused"));
    const auto explanation = line.Make().ExplainAll();
    CHECK_THAT(PrintText(explanation), Catch::Contains(refused));
    CHECK_FALSE(explanation.NeedsAttention());
}

TEST_CASE("A plan that has ended does not move, and needs no attention")
{
    WhyFixture line;
    Acsctl::PlanInfo plan;
    plan.planID = "P1";
    plan.status = "Failed";
    plan.endedAt = "2026-11-27T23:00:00.000Z";
    plan.message = "Job J1 failed";
    const auto explanation = line.Make().ExplainPlan(plan);
    CHECK_FALSE(explanation.NeedsAttention());
    CHECK(
        PrintText(explanation)
        == "Plan P1 does not move because it has ended: Failed at 2026-11-27T23:00:00.000Z: Job J1 failed.\n");
}

TEST_CASE("A robot that cannot be used needs attention")
{
    WhyFixture line;
    CHECK_FALSE(line.Make().ExplainRobot(line.snapshot.robots[0]).NeedsAttention());
    line.snapshot.robots[0].bMaintenance = true;
    CHECK_THAT(
        PrintText(line.Make().ExplainRobot(line.snapshot.robots[0])),
        Catch::Contains("acsctl maintenance LR01 off"));
    line.snapshot.robots[0].bMaintenance = false;
    line.snapshot.robots[0].status = "Disconnected";
    CHECK(line.Make().ExplainAll().NeedsAttention());
}

TEST_CASE("A robot is explained with the links that are down, a store that fails and the TSC")
{
    WhyFixture line;
    const auto explain = [&line] {
        return line.Make().ExplainRobot(line.snapshot.robots[0]);
    };
    line.snapshot.status.links = {{"mcs", true, std::nullopt, std::nullopt}, {"mqtt", false, "refused", std::nullopt}};
    CHECK_THAT(PrintText(explain()), Catch::Contains("The link mqtt is down: refused."));
    CHECK(explain().NeedsAttention());
    line.snapshot.status.links.clear();

    line.snapshot.alarms.push_back(MakeAlarm("ACS", "ACS-1005", "Store failing"));
    CHECK_THAT(PrintText(explain()), Catch::Contains("Heavy alarm ACS-1005 Store failing of acsd."));
    CHECK(explain().NeedsAttention());
    line.snapshot.alarms.clear();

    line.snapshot.status.tsc = "Paused";
    CHECK_THAT(PrintText(explain()), Catch::Contains("acsctl tsc resume"));
    CHECK(explain().NeedsAttention());
    line.AddPlan("P1", "InProgress").robotID = "LR01"; // its work continues
    line.snapshot.robots[0].planID = "P1";
    CHECK_FALSE(explain().NeedsAttention());
    line.snapshot.status.refusedReports = {1, Acsctl::RefusedReport{"JobReport", "P1", "unknown job", false}};
    CHECK_THAT(PrintText(explain()), Catch::Contains("The MCS has refused reports"));
    CHECK_FALSE(explain().NeedsAttention());
    line.snapshot.plans.clear();
    line.AddWaitingPlan("P1", "The TSC is Paused.").robotID = "LR01";
    const std::string text = PrintText(explain());
    CHECK(text.find("acsctl tsc resume") == text.rfind("acsctl tsc resume"));
}

TEST_CASE("The robots that a wait reason names are explained with their alarms and plans")
{
    WhyFixture line;
    line.snapshot.robots[0].planID = "P1";
    Acsctl::RobotInfo& blocker = line.AddRobot("LR02", "Disconnected");
    blocker.planID = "P2";
    line.snapshot.alarms.push_back(MakeAlarm("LR02", "ACS-1002", "Robot disconnected"));
    line.AddRobot("LR03", "Moving").planID = "P3";
    line.AddPlan("P3", "InProgress").robotID = "LR03";
    Acsctl::PlanInfo& plan = line.AddPlan("P1", "InProgress");
    plan.robotID = "LR01";
    plan.waits = Acsctl::WaitsInfo{"LR01 waits for node L05 on its route, blocked by LR02 and LR03.", {}, {}, {}};
    Acsctl::PlanInfo& other = line.AddPlan("P2", "InProgress");
    other.robotID = "LR02";
    other.waits = Acsctl::WaitsInfo{"LR02: no connection.", {}, {}, {}};
    CHECK(
        PrintText(line.Make().ExplainPlan(*line.Make().FindPlanOrNull("P1")))
        == "Plan P1 does not move: it is InProgress on LR01.\n"
           "  LR01 waits for node L05 on its route, blocked by LR02 and LR03.\n"
           "  Robot LR02: Disconnected with plan P2.\n"
           "    Heavy alarm ACS-1002 Robot disconnected of LR02.\n"
           "    Its plan P2 does not move either.\n"
           "      LR02: no connection.\n"
           "      Its robot LR02: see robot LR02 above.\n"
           "  Robot LR03: Moving with plan P3.\n");
}

TEST_CASE("A robot without a plan that waits for another one is available, and the other one is explained")
{
    WhyFixture line;
    line.snapshot.robots[0].reason = "LR01 waits for LR02 to clear its route.";
    line.AddRobot("LR02", "Idle").reason = "battery 12 % is below 20 %";
    line.snapshot.robots[1].position = "A01.CP02";
    CHECK(
        PrintText(line.Make().ExplainRobot(line.snapshot.robots[0]))
        == "Robot LR01 needs attention: it is Idle, without a plan.\n"
           "  LR01 waits for LR02 to clear its route.\n"
           "  Robot LR02: battery 12 % is below 20 %.\n");
}

TEST_CASE("The number of causes is bounded by the plans and robots, however they wait for each other")
{
    constexpr std::size_t COUNT = 300;
    const bool bNamed = GENERATE(false, true);
    WhyFixture line;
    line.snapshot.robots.clear();
    std::vector<Acsctl::RobotReason> reasons;
    for (std::size_t i = 0; i < COUNT; ++i)
    {
        const std::string next = "P" + std::to_string((i + 1) % COUNT);
        reasons.push_back({"R" + std::to_string(i), "busy with plan " + next});
        line.AddRobot(reasons.back().robotID, "Moving").planID = next;
    }
    for (std::size_t i = 0; i < COUNT; ++i)
    {
        const std::string named = "R" + std::to_string(i) + " waits for R" + std::to_string((i + 7) % COUNT) + ".";
        line.AddWaitingPlan(
                "P" + std::to_string(i),
                bNamed ? named : "No suitable robot is free.",
                bNamed ? std::vector<Acsctl::RobotReason>() : reasons)
            .robotID = reasons[i].robotID;
    }
    const auto count = [](const Acsctl::Explanation& explanation) {
        std::size_t causes = 0;
        for (const Acsctl::Finding& finding : explanation.findings)
        {
            causes += finding.causes.size();
        }
        return causes;
    };
    const Acsctl::Explanation all = line.Make().ExplainAll();
    CHECK(all.findings.size() == 2 * COUNT);
    CHECK(count(all) < 8 * COUNT);
    CHECK(count(line.Make().ExplainPlan(line.snapshot.plans[0])) < 8 * COUNT);
    CHECK(count(line.Make().ExplainRobot(line.snapshot.robots[0])) < 8 * COUNT);
}

TEST_CASE("What was explained above is referred to in one line")
{
    WhyFixture line;
    line.snapshot.robots[0].planID = "A0";
    line.AddRobot("LR02", "Stopped");
    Acsctl::AlarmInfo alarm;
    alarm.robotID = "LR02";
    alarm.errorCode = "ACS-1002";
    alarm.level = "heavy";
    alarm.title = "Robot disconnected";
    line.snapshot.alarms.push_back(alarm);
    Acsctl::BlockInfo& block = line.site.blocked.emplace_back();
    block.kind = "edge";
    block.id = "E1";
    line.AddPlan("A0", "Paused").robotID = "LR01";
    const std::vector<Acsctl::RobotReason> reasons{{"LR01", "busy with plan A0"}, {"LR02", "no connection"}};
    line.AddWaitingPlan("P1", "The edge E1 is blocked.", reasons);
    line.AddWaitingPlan("P2", "No suitable robot is free.", reasons);
    line.AddWaitingPlan("P3", "No suitable robot is free.", {reasons[1]});
    CHECK(PrintText(line.Make().ExplainAll()) == R"(acsd needs attention.
  Edge E1 is blocked.
    Remedy: When it is free: acsctl unblock edge E1

Plan A0 does not move: it is Paused on LR01.
  Plan A0 is paused.
    Remedy: When it may continue: acsctl resume A0

Plan P1 does not move for 5 min: it is Pending, at position 1 of the queue.
  The edge E1 is blocked.
  Robot LR01: busy with plan A0. See plan A0 above.
  Robot LR02: no connection.
    Heavy alarm ACS-1002 Robot disconnected of LR02.
  Edge E1 is blocked: see above.

Plan P2 does not move for 5 min: it is Pending, at position 1 of the queue.
  No suitable robot is free.
  The reasons of its 2 robots are those of plan P1: see above.

Plan P3 does not move for 5 min: it is Pending, at position 1 of the queue.
  No suitable robot is free.
  Robot LR02: no connection. See robot LR02 above.

Robot LR01 needs attention: it is Idle with plan A0.
  Its plan A0 waits: see plan A0 above.

Robot LR02 needs attention: it is Stopped, without a plan.
  See robot LR02 above.
)");
}

TEST_CASE("A state that the wait reason has is not repeated")
{
    WhyFixture line;
    line.snapshot.robots[0].status = "Disconnected";
    line.AddWaitingPlan("P1", "LR01: no connection.").robotID = "LR01";
    Acsctl::PlanInfo paused = line.snapshot.plans[0];
    CHECK(
        PrintText(line.Make().ExplainPlan(paused))
        == "Plan P1 does not move for 5 min: it is Pending on LR01, at position 1 of the queue.\n"
           "  LR01: no connection.\n");
    line.snapshot.robots[0].status = "Idle";
    paused.status = "Paused";
    paused.waits->queuePosition.reset();
    paused.waits->message = "The plan is paused by the operator.";
    CHECK(
        PrintText(line.Make().ExplainPlan(paused))
        == "Plan P1 does not move for 5 min: it is Paused on LR01.\n"
           "  Plan P1 is paused by the operator.\n"
           "    Remedy: When it may continue: acsctl resume P1\n");
}

TEST_CASE("The explanation as JSON has the same findings")
{
    WhyFixture line;
    line.AddWaitingPlan("P\"1", "No.");
    CHECK(
        Acsctl::MakeExplanationText(line.Make().ExplainAll())
        == R"({"needsAttention":true,"findings":[{"subject":"plan","id":"P\"1","text":"Plan P\"1 does not move for 5 min: it is )"
           R"(Pending, at position 1 of the queue.","needsAttention":true,"causes":[{"depth":0,"text":"No.","cause":null,"remedy":[]}]}]})");
}
