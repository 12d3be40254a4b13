#include "Catch.hpp"
#include "fixtures/PlanWorld.hpp"

#include <functional>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using ACS::Testing::MakeControlPlan;
using ACS::Testing::MakeLogisticsPlan;
using ACS::Testing::PlanWorld;

TEST_CASE("4.1 A faulty plan is refused with a message that names the field")
{
    struct Case
    {
        std::string name;
        std::function<void(Plan&)> spoil;
        std::string said;
    };

    const std::vector<Case> cases{
        {"no planId", [](Plan& plan) { plan.planID.clear(); }, "planId"},
        {"a long planId", [](Plan& plan) { plan.planID.assign(129, 'x'); }, "planId"},
        {"a line break in the planId",
         [](Plan& plan) { plan.planID += '\n'; },
         "planId: expected an id without control"},
        {"an escape in a jobId", [](Plan& plan) { plan.steps[0].jobs[0].jobID += '\x1b'; }, "steps[0].jobs[0].jobId"},
        {"a tab in a carrierId",
         [](Plan& plan) { plan.steps[0].carrierIDs = {"C\t"}; },
         "steps[0].carrierIds[0]: expected an id without control"},
        {"no steps", [](Plan& plan) { plan.steps.clear(); }, "steps"},
        {"stepNo 0", [](Plan& plan) { plan.steps[0].stepNo = 0; }, "steps[0].stepNo"},
        {"a stepNo twice", [](Plan& plan) { plan.steps[1].stepNo = 1; }, "steps[1].stepNo"},
        {"no jobId", [](Plan& plan) { plan.steps[0].jobs[0].jobID.clear(); }, "steps[0].jobs[0].jobId"},
        {"a jobId twice",
         [](Plan& plan) { plan.steps[1].jobs[0].jobID = plan.steps[0].jobs[0].jobID; },
         "steps[1].jobs[0].jobId"},
        {"an unknown action", [](Plan& plan) { plan.steps[0].action = "Fly"; }, "steps[0].action"},
        {"a position that is no location", [](Plan& plan) { plan.steps[0].position = "here"; }, "steps[0].position"},
        {"a position off the map", [](Plan& plan) { plan.steps[0].position = "A09.CP01"; }, "steps[0].position"},
        {"a from off the map", [](Plan& plan) { plan.steps[0].jobs[0].from = "A01.CP77"; }, "steps[0].jobs[0].from"},
        {"a from at another place than the step's",
         [](Plan& plan) { plan.steps[0].jobs[0].from = "A01.CP02"; },
         "steps[0].jobs[0].from: expected a place within reach of A01.CP01, the step's position"},
        {"a to at another place than the step's",
         [](Plan& plan) { plan.steps[1].jobs[0].to = "A02.CP04"; },
         "steps[1].jobs[0].to: expected a place within reach of A02.CP03, the step's position"},
        {"a set's memory place from where no set is",
         [](Plan& plan) {
             plan.steps = {{1, "MemoryPickAndPlace", "A01.CP01", {}, {{"J", "AMR.TP01.MP01", "A01.SET01.MP01"}}}};
         },
         "steps[0].jobs[0].to: expected a place within reach of A01.CP01, the step's position"},
        {"a load into a port that is loaded already",
         [](Plan& plan) {
             plan.steps[0].jobs.push_back({"again", "A01.CP01", "AMR.CP01"});
         },
         "steps[0].jobs[1].to: expected a port that no earlier job loads"},
        {"an unload of a port that is unloaded already",
         [](Plan& plan) {
             plan.steps[1].jobs.push_back({"again", "AMR.CP01", "A02.CP03"});
         },
         "steps[1].jobs[1].from: expected a port that no earlier job unloads"},
        {"no from", [](Plan& plan) { plan.steps[0].jobs[0].from.reset(); }, "steps[0].jobs[0].from"},
        {"a to of the wrong kind", [](Plan& plan) { plan.steps[0].jobs[0].to = "A01.CP02"; }, "steps[0].jobs[0].to"},
        {"a port that no robot has", [](Plan& plan) { plan.steps[0].jobs[0].to = "AMR.CP09"; }, "AMR.CP09"},
        {"an unknown robot", [](Plan& plan) { plan.steps[0].jobs[0].to = "RBT01.CP01"; }, "RBT01"},
        {"a robot of the other type", [](Plan& plan) { plan.steps[0].jobs[0].to = "CR01.CP01"; }, "CR01"},
        {"a load without jobs", [](Plan& plan) { plan.steps[0].jobs.clear(); }, "steps[0].jobs"},
        {"both robot types",
         [](Plan& plan) {
             plan.steps[1] = MakeControlPlan("x").steps[0];
             plan.steps[1].stepNo = 2;
         },
         "steps[1].action"},
    };
    for (const Case& wrong : cases)
    {
        INFO(wrong.name);
        PlanWorld world;
        Plan plan = MakeLogisticsPlan("P1");
        wrong.spoil(plan);
        world.Submit(plan, 7);
        CHECK_FALSE(world.replies.at(7).bAccepted);
        CHECK(world.replies.at(7).message.find(wrong.said) != std::string::npos);
        INFO(world.replies.at(7).message);
        CHECK(world.store.GetState().plans.empty());
        CHECK(world.engine->GetActivePlans().empty());
    }
}

TEST_CASE("4.1 A plan that names two robots is refused, one that names a robot is assigned to it")
{
    PlanWorld world(1, true);
    Plan mixed = MakeLogisticsPlan("P1");
    mixed.steps[0].jobs[0].to = "LR01.CP01";
    mixed.steps[1].jobs[0].from = "LR02.CP01";
    world.Submit(mixed, 1);
    CHECK_FALSE(world.replies.at(1).bAccepted);

    Plan pinned = MakeLogisticsPlan("P2");
    pinned.steps[0].jobs[0].to = "LR02.CP01";
    world.Connect();
    world.Submit(pinned, 2);
    REQUIRE(world.TryRun());
    CHECK(world.engine->GetPlanOrNull("P2")->robotID == "LR02");
    CHECK(world.GetRobot("LR01").drives == 0);
}

TEST_CASE("4.1 A plan that no robot can do is refused with each robot's reason, others are assigned to one that can")
{
    EngineOptions options = ACS::Testing::MakeTestOptions(true);
    options.robots.front().rejectedActions = {{"CassetteLoad", "its gripper is too small"}};
    PlanWorld world(1, options, ACS::Testing::MakeTestSite());
    world.Connect();
    world.Submit(MakeLogisticsPlan("P1"), 1);
    REQUIRE(world.TryRun());
    CHECK(world.engine->GetPlanOrNull("P1")->robotID == "LR02");

    Plan pinned = MakeLogisticsPlan("P2");
    pinned.steps[0].action = "cassetteload";
    pinned.steps[0].jobs[0].to = "LR01.CP01";
    world.Submit(pinned, 2);
    CHECK_FALSE(world.replies.at(2).bAccepted);
    CHECK(
        world.replies.at(2).message.find("LR01 cannot do CassetteLoad: its gripper is too small") != std::string::npos);
}

TEST_CASE("4.1 A port may be loaded again after an unload, and while it is taken by option")
{
    Plan plan = MakeLogisticsPlan("P1");
    Step again = plan.steps[0];
    again.stepNo = 3;
    again.jobs[0].jobID = "again";
    EngineOptions options = ACS::Testing::MakeTestOptions(false);
    SECTION("After an unload")
    {
        plan.steps.push_back(again);
    }
    SECTION("By option")
    {
        options.dispatch.bLoadsIntoTakenPorts = true;
        plan.steps[0].jobs.push_back(again.jobs[0]);
    }
    PlanWorld world(1, options, ACS::Testing::MakeTestSite());
    world.Submit(plan, 1);
    CHECK(world.replies.at(1).bAccepted);
}

TEST_CASE("4.1 A place outside the step's position is refused unless the reach of that position lists its station")
{
    const SiteMap site = ACS::Testing::MakeTestSite();
    std::vector<SiteStation> stations = site.GetStations();
    // A node in common does not bring a place within reach, nor does the area of a set.
    std::ranges::find(stations, "A01.CP02", &SiteStation::stationID)->nodeIDs.emplace_back("D-A01.CP01");
    Plan cassette = MakeLogisticsPlan("P1");
    cassette.steps[0].jobs[0].from = "A01.CP02";
    Plan tray = MakeControlPlan("P2");
    tray.steps[0].jobs[1].from = "A01.CP02.TP01";
    Plan memory = MakeControlPlan("P3");
    memory.steps[1].jobs[1].to = "SET02.MP07";
    const std::vector<std::pair<Plan, std::string>> plans{
        {cassette,
         "steps[0].jobs[0].from: expected a place within reach of A01.CP01, the step's position "
         "(stations.\"A01.CP01\".reach does not list A01.CP02), found A01.CP02"},
        {tray, "(stations.\"A01.CP01\".reach does not list A01.CP02), found A01.CP02.TP01"},
        {memory, "(stations.\"A01.SET01\".reach does not list A01.SET02), found SET02.MP07"}};
    for (const auto& [plan, refusal] : plans)
    {
        for (const bool bListed : {false, true})
        {
            INFO(plan.planID << (bListed ? " listed" : ""));
            EngineOptions options = ACS::Testing::MakeTestOptions(false);
            options.reach["A01.CP02"] = {"A01.CP01"}; // this does not extend the reach of A01.CP01
            options.reach["A01.SET02"] = {"A01.SET01"};
            if (bListed)
            {
                options.reach["A01.CP01"] = {"A01.CP03", "A01.CP02"};
                options.reach["A01.SET01"] = {"A01.SET02"};
            }
            PlanWorld world(1, options, *SiteMap::Create(site.GetNodes(), site.GetEdges(), stations));
            world.Submit(plan, 1);
            INFO(world.replies.at(1).message);
            CHECK(world.replies.at(1).bAccepted == bListed);
            CHECK((bListed || world.replies.at(1).message.find(refusal) != std::string::npos));
        }
    }
}

TEST_CASE("4.1 Absent, null and superfluous places, lower case, gaps and any order of steps are accepted")
{
    PlanWorld world;
    Plan plan;
    plan.planID = "P1";
    plan.steps = {
        {7, "Start", "A01.SET01", {}, {{"J2", "ignored", ""}}},
        {3, "opensetcover", "a01.set1", {}, {}},
        {5, "MemoryPickAndPlace", "SET02", {}, {{"J1", "AMR.TP01.MP01", "SET02.MP05"}}}};
    world.Connect();
    world.Ask(SetCarriers{"CR01", {"TRAY_01", {}, {}}, 2});
    world.Submit(plan, 1);
    REQUIRE(world.replies.at(1).bAccepted);
    CHECK(world.engine->GetPlanOrNull("P1")->currentAction == "OpenSetCover");
    REQUIRE(world.TryRun());
    CHECK(
        world.GetReportsOf("P1")
        == std::vector<std::string>{
            "Plan InProgress",
            "Step 3 Dispatched",
            "Step 3 InProgress",
            "Step 3 Completed",
            "Step 5 Dispatched",
            "Step 5 InProgress",
            "Job 5 J1 Instructed",
            "Job 5 J1 InProgress",
            "Job 5 J1 Completed",
            "Step 5 Completed",
            "Step 7 Dispatched",
            "Step 7 InProgress",
            "Job 7 J2 Instructed",
            "Job 7 J2 InProgress",
            "Job 7 J2 Completed",
            "Step 7 Completed",
            "Plan Completed"});
}

TEST_CASE("6.4 A planId that was used is refused, and so is a plan for a full queue")
{
    EngineOptions options = ACS::Testing::MakeTestOptions(false);
    options.maximumPlans = 2;
    PlanWorld world(1, options, ACS::Testing::MakeTestSite());
    world.Submit(MakeLogisticsPlan("P1"), 1);
    world.Submit(MakeLogisticsPlan("P1"), 2);
    world.Submit(MakeLogisticsPlan("P2"), 3);
    world.Submit(MakeLogisticsPlan("P3"), 4);
    CHECK(world.replies.at(1).bAccepted);
    CHECK(world.replies.at(2).message.find("Duplicated Plan") != std::string::npos);
    CHECK(world.replies.at(3).bAccepted);
    CHECK(world.replies.at(4).message.find("Queue Full") != std::string::npos);
    world.Connect();
    REQUIRE(world.TryRun());
    world.Submit(MakeLogisticsPlan("P1"), 5);
    CHECK_FALSE(world.replies.at(5).bAccepted);
}

TEST_CASE("Options that do not fit the site are all reported together")
{
    EngineOptions options = ACS::Testing::MakeTestOptions(false);
    CHECK(FindErrors(options, ACS::Testing::MakeTestSite()).empty());
    options.robots[0].vehicleTypeID = "zeppelin";
    options.robots[1].homeStationID = "CHG99";
    options.robots[1].startNodeID = "nowhere";
    options.places.push_back(*ACS::Core::Location::Parse("A77.CP01.TP01"));
    options.places.push_back(*ACS::Core::Location::Parse("A77.CP01.TP02"));
    options.reach["A01.CP01"] = {"A01.CP02", "A77.CP02"};
    options.reach["A77.CP03"] = {"A01.CP01"};
    const std::vector<ACS::Core::Error> errors = FindErrors(options, ACS::Testing::MakeTestSite());
    REQUIRE(errors.size() == 6);
    CHECK(errors[0].path == "robots.LR01.vehicle_type");
    CHECK(errors[1].path == "robots.CR01.start_node");
    CHECK(errors[2].path == "robots.CR01.home");
    CHECK(errors[3].path == "site.ports");
    CHECK(errors[3].found == "A77.CP01.TP01");
    CHECK(errors[4].path == "stations.\"A01.CP01\".reach");
    CHECK(errors[4].found == "A77.CP02");
    CHECK(errors[5].path == "stations.\"A77.CP03\".reach");
    CHECK(errors[5].found == "A77.CP03");
}

TEST_CASE("Homes within the clearance of each other are refused, for only one robot could be there")
{
    EngineOptions options = ACS::Testing::MakeTestOptions(true);
    const SiteMap site = ACS::Testing::MakeTestSite();
    options.clearance = 0.9;
    CHECK(FindErrors(options, site).empty());
    options.clearance = 1;
    const std::vector<ACS::Core::Error> errors = FindErrors(options, site);
    REQUIRE(errors.size() == 2);
    CHECK(errors[0].path == "robots.CR01.home");
    CHECK(errors[0].expected.find("from CHG01, the home or charging station of LR01") != std::string::npos);
    CHECK(errors[0].found == "CHG02, 1.00 m from it");
    CHECK(errors[1].path == "robots.CR02.home");
}
