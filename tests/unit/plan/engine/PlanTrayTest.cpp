#include "fixtures/PlanWorldSteps.hpp"

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using ACS::Testing::FinishPlan;
using ACS::Testing::MakeControlPlan;
using ACS::Testing::MakeWorld;
using ACS::Testing::PlanWorld;
using ACS::Testing::TryRunUntil;

namespace
{

/// A memory to the set and another one back, with the trays of TP01 and TP02.
Plan MakeMemoryPlan(const std::string& robot = "AMR")
{
    return {
        "P1",
        "",
        1,
        {{1,
          "MemoryPickAndPlace",
          "A01.SET01",
          {},
          {{"J1", robot + ".TP01.MP03", "A01.SET01.MP01"}, {"J2", "A01.SET01.MP02", robot + ".TP02.MP25"}}}}};
}

void SetTrays(PlanWorld& world, const std::string& robotID, std::vector<std::optional<std::string>> carrierIDs)
{
    world.Ask(SetCarriers{robotID, std::move(carrierIDs), 77});
    REQUIRE(world.replies.at(77).bAccepted);
}

std::string GetOnlyReason(const PlanWorld& world)
{
    const std::optional<WaitReason> reason = world.engine->GetWaitReasonOrNull("P1");
    REQUIRE(reason.has_value());
    REQUIRE(reason->robots.size() == 1);
    return reason->robots.front().reason;
}

} // namespace

TEST_CASE("A plan whose memory job needs a tray waits until the tray is on record on the robot's port")
{
    PlanWorld world;
    world.Connect();
    world.Submit(MakeMemoryPlan());
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1").empty());
    CHECK(GetOnlyReason(world) == "CR01.TP01 has no tray for CR01.TP01.MP03");
    SetTrays(world, "CR01", {"TRAY_01", {}, "TRAY_03"});
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1").empty());
    CHECK(GetOnlyReason(world) == "CR01.TP02 has no tray for CR01.TP02.MP25");
    SetTrays(world, "CR01", {"TRAY_01", "UNKNOWN", "TRAY_03"}); // An unknown tray is sufficient.
    FinishPlan(world);
}

TEST_CASE("A memory job is assigned to the robot that has its tray")
{
    for (const std::string owner : {"CR01", "CR02"})
    {
        PlanWorld world(1, true);
        world.Connect();
        SetTrays(world, owner, {"TRAY_01", "TRAY_02", {}});
        world.Submit(MakeMemoryPlan());
        FinishPlan(world);
        CHECK(world.engine->GetPlanOrNull("P1")->robotID == owner);
    }
}

TEST_CASE("A memory job finds the tray that its plan has loaded before, and not one that it has unloaded")
{
    PlanWorld world;
    world.Connect();
    Plan plan = MakeControlPlan("P1");
    SECTION("loaded before")
    {
        world.Submit(plan);
        FinishPlan(world);
    }
    SECTION("unloaded before")
    {
        std::swap(plan.steps[1], plan.steps[2]);
        plan.steps[1].stepNo = 2;
        plan.steps[2].stepNo = 3;
        world.Submit(plan);
        REQUIRE(world.TryRun());
        CHECK(world.GetReportsOf("P1").empty());
        CHECK(GetOnlyReason(world) == "CR01.TP01 has no tray for CR01.TP01.MP01");
    }
}

TEST_CASE("A robot whose tray was removed during its drive waits at the set with a reason until the tray is on record")
{
    PlanWorld world;
    world.Connect();
    SetTrays(world, "CR01", {"TRAY_01", "TRAY_02", {}});
    world.Submit(MakeMemoryPlan());
    REQUIRE(TryRunUntil(world, "P1", "Step 1 InProgress"));
    SetTrays(world, "CR01", {{}, "TRAY_02", {}});
    REQUIRE(world.TryRun());
    const std::string reason =
        "CR01.TP01 has no tray for CR01.TP01.MP03: load the tray by hand, then correct the record of the robot's ports.";
    CHECK(world.engine->GetWaitReasonOrNull("P1")->message == reason);
    CHECK(world.engine->GetRobotStatuses()[1].status == ERobotStatus::Working);
    CHECK(world.engine->GetRobotStatuses()[1].message == reason);
    CHECK(world.GetRobot("CR01").commandedJobs.empty());
    SetTrays(world, "CR01", {"TRAY_01", {}, {}});
    REQUIRE(TryRunUntil(world, "P1", "Job 1 J1 Completed"));
    REQUIRE(world.TryRun());
    CHECK(world.GetRobot("CR01").doneJobs == std::vector<std::string>{"J1"});
    SetTrays(world, "CR01", {"TRAY_01", "TRAY_02", {}});
    FinishPlan(world);
}

TEST_CASE("An action that moves a carrier empties the robot's port in its from and fills the one in its to")
{
    PlanWorld world = MakeWorld([](EngineOptions& options) {
        ActionRule rule = options.actions.at("TrayUnload");
        rule.effect = EActionEffect::Move;
        options.actions["TrayAway"] = rule;
        rule.from = EPlaceRule::FixedTray;
        rule.to = EPlaceRule::RobotTray;
        options.actions["TrayHere"] = rule;
        rule.from = EPlaceRule::RobotTray;
        options.actions["TrayOver"] = rule;
    });
    world.Connect();
    const auto submit = [&world](const std::string& planID, const Job& job, const std::string& action) {
        world.Submit({planID, "", 1, {{1, action, "A01.CP01", {}, {job}}}}, 5);
    };
    submit("P1", {"J1", "A01.CP01.TP01", "AMR.TP01"}, "TrayHere");
    REQUIRE(world.TryRun());
    const auto getTrays = [&world] {
        return world.engine->GetRobotStatuses()[1].carrierIDs;
    };
    using Trays = std::vector<std::optional<std::string>>;
    CHECK(getTrays() == Trays{"UNKNOWN", {}, {}});
    SetTrays(world, "CR01", {"TRAY_01", {}, {}});
    submit("P2", {"J1", "AMR.TP01", "AMR.TP03"}, "TrayOver");
    REQUIRE(world.TryRun());
    CHECK(getTrays() == Trays{{}, {}, "TRAY_01"}); // it is still the same tray
    submit("P3", {"J1", "AMR.TP03", "A01.CP01.TP02"}, "TrayAway");
    REQUIRE(world.TryRun());
    CHECK(getTrays() == Trays{{}, {}, {}});
    CHECK(world.engine->GetActiveAlarms().empty());

    SetTrays(world, "CR01", {"TRAY_01", {}, "TRAY_03"});
    submit("P4", {"J1", "AMR.TP01", "AMR.TP03"}, "TrayOver");
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P4").empty());
    CHECK(world.engine->GetWaitReasonOrNull("P4")->robots.front().reason == "CR01.TP03 is taken by TRAY_03");
}

TEST_CASE("4.1 A plan that moves two carriers onto one port is refused")
{
    PlanWorld world = MakeWorld([](EngineOptions& options) {
        ActionRule rule = options.actions.at("TrayLoad");
        rule.effect = EActionEffect::Move;
        rule.from = EPlaceRule::RobotTray;
        options.actions["TrayOver"] = rule;
    });
    Plan plan{"P1", "", 1, {{1, "TrayOver", "A01.CP01", {}, {{"J1", "AMR.TP01", "AMR.TP03"}}}}};
    plan.steps[0].jobs.push_back({"J2", "AMR.TP02", "AMR.TP03"});
    world.Submit(plan, 1);
    CHECK_FALSE(world.replies.at(1).bAccepted);
    CHECK(world.replies.at(1).message.find("steps[0].jobs[1].to") != std::string::npos);
    plan.steps[0].jobs[1].from = "AMR.TP03";
    plan.steps[0].jobs[1].to = "AMR.TP01"; // and back
    world.Submit(plan, 2);
    CHECK(world.replies.at(2).bAccepted);
}
