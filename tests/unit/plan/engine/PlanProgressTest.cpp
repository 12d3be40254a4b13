#include "fixtures/PlanWorldSteps.hpp"

#include <utility>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using ACS::Testing::BeginPlan;
using ACS::Testing::FinishPlan;
using ACS::Testing::Lines;
using ACS::Testing::MakeLogisticsPlan;
using ACS::Testing::MakeTestOptions;
using ACS::Testing::MakeTestSite;
using ACS::Testing::MakeWorld;
using ACS::Testing::PausePlan;
using ACS::Testing::PlanWorld;
using ACS::Testing::RestartEngine;
using ACS::Testing::TryRunFor;
using ACS::Testing::TryRunUntil;

namespace
{

using namespace std::chrono_literals;

const Alarm* FindAlarmOrNull(const PlanWorld& world, std::string_view errorCode, std::string_view robotID)
{
    const std::vector<Alarm>& alarms = world.engine->GetActiveAlarms();
    const auto found = std::ranges::find_if(alarms, [errorCode, robotID](const Alarm& alarm) {
        return alarm.errorCode == errorCode && alarm.robotID == robotID;
    });
    return found == alarms.end() ? nullptr : &*found;
}

const Alarm* FindStallOrNull(const PlanWorld& world, std::string_view robotID = "LR01")
{
    return FindAlarmOrNull(world, "ACS-1009", robotID);
}

/// Of LR02.
const Alarm* FindWaitOrNull(const PlanWorld& world)
{
    return FindAlarmOrNull(world, "ACS-1015", "LR02");
}

bool TryRunUntilStall(PlanWorld& world)
{
    return world.TryRun([&world] { return FindStallOrNull(world) != nullptr; });
}

/// LR01 accepts its drive to A01.CP01 for P1 and stays where it is.
void BeginStuck(PlanWorld& world)
{
    world.GetRobot("LR01").bStuck = true;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Step 1 Dispatched");
}

/// Frees the robot, as an operator on the site would.
void Unstick(PlanWorld& world)
{
    world.GetRobot("LR01").bStuck = false;
    world.Operate("LR01", Pause{});
    world.Operate("LR01", Resume{});
}

/// LR01 stays where it is on its way to a station for P1, and LR02 waits for it with P2.
void BeginWaitFor(PlanWorld& world)
{
    Plan first = MakeLogisticsPlan("P1");
    first.steps[0].position = "A01.CP05";
    first.steps[0].jobs[0].from = "A01.CP05";
    BeginPlan(world, first, "Step 1 InProgress");
    REQUIRE(world.TryRun([&world] { return world.GetRobot("LR01").GetOccupied().front() == "L04"; }));
    world.GetRobot("LR01").bStuck = true;
    Plan second = MakeLogisticsPlan("P2");
    second.steps[0].position = "A01.CP06";
    second.steps[0].jobs[0].from = "A01.CP06";
    second.steps[0].carrierIDs = {"CASSETTE_02"};
    second.steps[1].carrierIDs = {"CASSETTE_02"};
    second.steps[1].position = "A02.CP04"; // both plans may begin
    second.steps[1].jobs[0].to = "A02.CP04";
    world.Submit(second);
    REQUIRE(world.TryRun());
}

std::string GetReason(const PlanWorld& world)
{
    const std::optional<WaitReason> reason = world.engine->GetWaitReasonOrNull("P1");
    return reason.has_value() ? reason->message : std::string();
}

} // namespace

TEST_CASE(
    "drive.stall_timeout: a robot that accepts its drive and stays where it is raises ACS-1009 until it passes a node")
{
    PlanWorld world;
    BeginStuck(world);
    const auto begun = world.GetNow().steady;
    CHECK(GetReason(world).empty());
    REQUIRE(TryRunUntilStall(world));
    CHECK(world.GetNow().steady - begun >= 60s);
    CHECK(world.GetNow().steady - begun < 63s);
    const Alarm alarm = *FindStallOrNull(world);
    CHECK(alarm.level == EAlarmLevel::Light);
    CHECK(alarm.planID == "P1");
    CHECK(alarm.stepNo == 1);
    CHECK(alarm.message == "Robot stalled: node L01 not reached for 60 s. Check the robot.");
    CHECK(GetReason(world) == "LR01 stalled: node L01 not reached for 60 s. Check the robot.");
    Unstick(world);
    FinishPlan(world);
    const Lines reports = world.GetReportsOf("P1");
    CHECK(std::ranges::count(reports, "Error ACS-1009 set") == 1);
    CHECK(std::ranges::count(reports, "Error ACS-1009 cleared") == 1);
    CHECK(std::ranges::find(reports, "Error ACS-1009 cleared") < std::ranges::find(reports, "Step 1 Completed"));
}

TEST_CASE("drive.stall_timeout: a drive that never reaches its robot raises ACS-1009 until the robot confirms it")
{
    PlanWorld world;
    world.GetRobot("LR01").bDeaf = true;
    world.Connect();
    world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(TryRunUntilStall(world));
    CHECK(GetReason(world) == "LR01 stalled: drive to node L01 not confirmed for 60 s. Check the robot.");
    world.Raise("LR01", NodePassed{world.driveIDs.at("LR01"), "D-CHG01"});
    CHECK(FindStallOrNull(world) == nullptr);
    CHECK(GetReason(world).empty());
}

TEST_CASE("drive.stall_timeout: 0 disables the alarm")
{
    PlanWorld world = MakeWorld([](EngineOptions& options) { options.stallTimeout = 0ms; });
    BeginStuck(world);
    REQUIRE(world.TryRun());
    CHECK(FindStallOrNull(world) == nullptr);
}

TEST_CASE("drive.stall_timeout: the limit of a long edge is three times its drive time")
{
    const SiteMap site = MakeTestSite();
    std::vector<SiteNode> nodes = site.GetNodes();
    for (SiteNode& node : nodes)
    {
        node.x *= 120;
        node.y *= 120; // at 1.2 m/s
    }
    PlanWorld world(1, MakeTestOptions(false), *SiteMap::Create(nodes, site.GetEdges(), site.GetStations()));
    BeginStuck(world);
    const auto begun = world.GetNow().steady;
    REQUIRE(TryRunUntilStall(world));
    CHECK(world.GetNow().steady - begun >= 300s);
    CHECK(world.GetNow().steady - begun < 303s);
}

TEST_CASE("drive.stall_timeout: a robot that waits at the end of its base raises no alarm, the one that blocks it does")
{
    PlanWorld world(1, MakeTestOptions(true), MakeTestSite());
    BeginWaitFor(world);
    CHECK(world.GetReportsOf("P2").back() == "Step 1 InProgress");
    world.PublishState("LR02");
    const std::optional<WaitReason> reason = world.engine->GetWaitReasonOrNull("P2");
    REQUIRE(reason.has_value());
    CHECK(reason->message.ends_with("blocked by LR01."));
    CHECK(FindStallOrNull(world, "LR01") != nullptr);
    CHECK(FindStallOrNull(world, "LR02") == nullptr);
    CHECK(FindWaitOrNull(world) == nullptr);
}

TEST_CASE("drive.wait_timeout: a robot that waits for one that cannot move raises ACS-1015 until it drives")
{
    PlanWorld world(1, MakeTestOptions(true), MakeTestSite());
    BeginWaitFor(world);
    world.PublishState("LR02");
    world.Raise("LR01", LinkChanged{false});
    const auto begun = world.GetNow().steady;
    REQUIRE(world.TryRun([&world] { return FindWaitOrNull(world) != nullptr; }));
    CHECK(world.GetNow().steady - begun >= 300s);
    CHECK(world.GetNow().steady - begun < 303s);
    CHECK(FindWaitOrNull(world)->planID == "P2");
    CHECK(
        FindWaitOrNull(world)->message
        == "No progress for 300 s: LR02 waits for node L05 on its route, blocked by LR01.");
    world.Raise("LR01", LinkChanged{true});
    world.PublishState("LR01");
    Unstick(world);
    REQUIRE(world.TryRun([&world] { return FindWaitOrNull(world) == nullptr; }));
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P2").back() == "Plan Completed");
}

TEST_CASE("drive.stall_timeout: a paused plan raises no alarm, and the timer starts again when it is resumed")
{
    PlanWorld world;
    BeginStuck(world);
    REQUIRE(TryRunFor(world, 1s));
    PausePlan(world);
    REQUIRE(world.TryRun());
    CHECK(FindStallOrNull(world) == nullptr);
    world.Advance(10min);
    world.Control(EPlanControl::Resume, "P1");
    REQUIRE(TryRunUntil(world, "P1", "ResumeResult Success"));
    CHECK(FindStallOrNull(world) == nullptr);
    const auto resumed = world.GetNow().steady;
    REQUIRE(TryRunUntilStall(world));
    CHECK(world.GetNow().steady - resumed >= 60s);
}

TEST_CASE("drive.stall_timeout: a disconnect clears the alarm, and the timer starts again after the reconnect")
{
    PlanWorld world;
    BeginStuck(world);
    REQUIRE(TryRunUntilStall(world));
    world.Raise("LR01", LinkChanged{false});
    CHECK(FindStallOrNull(world) == nullptr);
    CHECK(GetReason(world) == "LR01: no connection.");
    REQUIRE(world.TryRun());
    CHECK(FindStallOrNull(world) == nullptr);
    world.Raise("LR01", LinkChanged{true});
    const auto back = world.GetNow().steady;
    REQUIRE(TryRunUntilStall(world));
    CHECK(world.GetNow().steady - back == 60s);
}

TEST_CASE("drive.stall_timeout: the alarm ends with the drive, and an operator cannot clear it before")
{
    PlanWorld world;
    BeginStuck(world);
    REQUIRE(TryRunUntilStall(world));
    world.Ask(ClearAlarms{"LR01", "ACS-1009", {}, {}, 0});
    CHECK(FindStallOrNull(world) != nullptr);
    world.Control(EPlanControl::Abort, "P1");
    REQUIRE(TryRunUntil(world, "P1", "Plan Aborted"));
    CHECK(FindStallOrNull(world) == nullptr);
}

TEST_CASE("drive.stall_timeout: after a restart the drive and the timer begin again")
{
    PlanWorld world;
    BeginStuck(world);
    REQUIRE(TryRunUntilStall(world));
    RestartEngine(world);
    CHECK(FindStallOrNull(world) == nullptr);
    CHECK(world.GetReportsOf("P1").back() == "Error ACS-1009 cleared");
    const auto restarted = world.GetNow().steady;
    REQUIRE(TryRunUntilStall(world));
    CHECK(world.GetNow().steady - restarted >= 60s);
    Unstick(world);
    FinishPlan(world);
    CHECK(FindStallOrNull(world) == nullptr);
}

TEST_CASE("A plan whose robot is unavailable has a wait reason, also while the robot drives or works")
{
    const auto [begun, what] = GENERATE(
        std::pair<std::string, std::string>{"Step 1 InProgress", "drives"},
        std::pair<std::string, std::string>{"Job 1 P1-a4 InProgress", "works"});
    CAPTURE(what);
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), begun);
    CHECK(GetReason(world).empty());
    StateChanged state;
    state.lastNodeID = world.GetRobot("LR01").GetOccupied().front();
    state.errors.push_back({"AGV-motor", EAlarmLevel::Heavy, "hot"});
    world.Raise("LR01", state);
    CHECK(GetReason(world) == "LR01: error AGV-motor.");
    state.errors.clear();
    state.bSafetyStop = true;
    world.Raise("LR01", state);
    CHECK(GetReason(world) == "LR01: emergency or protective stop.");
    state.bSafetyStop = false;
    state.bAutomatic = false;
    world.Raise("LR01", state);
    CHECK(GetReason(world) == "LR01: not in automatic mode.");
}
