#include "fixtures/PlanWorldSteps.hpp"

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS::Testing;  // NOLINT(google-build-using-namespace): its fixtures

namespace
{

/// Of the drive to the station: its nodes.
std::size_t CountDriveNodes(const PlanWorld& world, const std::string& stationID)
{
    const Lines drives = world.GetTraceOf("command LR01 Drive to D-" + stationID + " ");
    REQUIRE(drives.size() == 1);
    return std::stoul(drives.front().substr(drives.front().rfind(' ')));
}

Plan MakeTransport(const std::string& from, const std::string& to)
{
    Plan plan = MakeLogisticsPlan("P1");
    plan.steps[0].position = from;
    plan.steps[0].jobs[0].from = from;
    plan.steps[1].position = to;
    plan.steps[1].jobs[0].to = to;
    return plan;
}

} // namespace

TEST_CASE(
    "Load restriction: a robot with a carrier avoids edges for empty robots, an empty one those for loaded robots")
{
    for (const bool bEmptyOnly : {true, false})
    {
        const SiteMap site = MakeRestrictedSite({bEmptyOnly, !bEmptyOnly});
        // L05>L06 is on the route from CHG01 to A01.CP06, and on that from A01.CP01 to A02.CP03.
        PlanWorld empty(1, MakeTestOptions(false), site);
        BeginPlan(empty, MakeTransport("A01.CP06", "A02.CP03"), "Step 1 Dispatched");
        CHECK(CountDriveNodes(empty, "A01.CP06") == (bEmptyOnly ? 10 : 11));
        FinishPlan(empty);

        PlanWorld loaded(1, MakeTestOptions(false), site);
        BeginPlan(loaded, MakeTransport("A01.CP01", "A02.CP03"), "Step 2 Dispatched");
        CHECK(CountDriveNodes(loaded, "A02.CP03") == (bEmptyOnly ? 10 : 9));
        FinishPlan(loaded);
    }
}

TEST_CASE("Load restriction: a plan fails when its robot has no route with its carrier")
{
    SiteMap site = MakeTestSite();
    std::vector<SiteEdge> edges = site.GetEdges();
    for (SiteEdgeRule& rule : std::ranges::find(edges, "L05>L06", &SiteEdge::edgeID)->rules)
    {
        rule.loadRestriction = SiteLoadRestriction{true, false};
    }
    site = *SiteMap::Create(site.GetNodes(), edges, site.GetStations());
    PlanWorld world(1, MakeTestOptions(false), site);
    BeginPlan(world, MakeTransport("A01.CP01", "A02.CP03"), "Plan Failed");
    CHECK(world.GetTraceOf("command LR01 Drive to D-A02.CP03").empty());
}

TEST_CASE("Load restriction: a robot in maintenance whose plan fails for want of a route stays where it is")
{
    SiteMap site = MakeTestSite();
    std::vector<SiteEdge> edges = site.GetEdges();
    for (SiteEdge& edge : edges)
    {
        if (edge.endNodeID == "D-A02.CP03")
        {
            std::ranges::for_each(edge.rules, [](SiteEdgeRule& rule) {
                rule.loadRestriction = SiteLoadRestriction{true, false};
            });
        }
    }
    site = *SiteMap::Create(site.GetNodes(), edges, site.GetStations());
    PlanWorld world(1, MakeTestOptions(false), site);
    BeginPlan(world, MakeTransport("A01.CP01", "A02.CP03"), "Step 1 InProgress");
    world.Ask(SetMaintenance{"LR01", true, 0});
    REQUIRE(TryRunUntil(world, "P1", "Plan Failed"));
    static_cast<void>(TryRunFor(world, std::chrono::minutes(5)));
    CHECK(world.GetTraceOf("command LR01 Drive to D-CHG01").empty());
}

TEST_CASE("Load restriction: a robot that is loaded on its way is rerouted before the edge that it may not use")
{
    EngineOptions options = MakeTestOptions(false);
    options.baseLength = 1;
    PlanWorld world(1, options, MakeRestrictedSite({true, false}));
    BeginPlan(world, MakeTransport("A01.CP06", "A02.CP03"), "Step 1 Dispatched");
    world.GetRobot("LR01").loads = {{"LR01.CP01", true, "C9"}};
    world.PublishState("LR01");
    const auto getDrives = [&world] {
        return world.GetTraceOf("command LR01 Drive to D-A01.CP06 ");
    };
    REQUIRE(world.TryRun([&getDrives] { return getDrives().size() == 2; }));
    CHECK(world.GetTraceOf("command LR01 CancelDrive").size() == 1);
    CHECK(getDrives().back().ends_with(" of 6")); // L05, AROUND, L06, L07, L08 and the dock
}

TEST_CASE("Load restriction: a robot that is unloaded before the edge that it may not use continues")
{
    SiteMap site = MakeTestSite();
    std::vector<SiteEdge> edges = site.GetEdges();
    for (SiteEdgeRule& rule : std::ranges::find(edges, "L05>L06", &SiteEdge::edgeID)->rules)
    {
        rule.loadRestriction = SiteLoadRestriction{true, false};
    }
    site = *SiteMap::Create(site.GetNodes(), edges, site.GetStations());
    EngineOptions options = MakeTestOptions(false);
    options.baseLength = 1;
    PlanWorld world(1, options, site);
    BeginPlan(world, MakeTransport("A01.CP06", "A02.CP03"), "Step 1 Dispatched");
    world.GetRobot("LR01").loads = {{"LR01.CP01", true, "C9"}};
    world.PublishState("LR01");
    static_cast<void>(TryRunFor(world, std::chrono::minutes(5)));
    world.PublishState("LR01");
    const std::optional<WaitReason> reason = world.engine->GetWaitReasonOrNull("P1");
    REQUIRE(reason.has_value());
    CHECK(reason->message == "LR01 waits: a loaded robot may not use edge L05>L06 of its route.");
    world.GetRobot("LR01").loads = {{"LR01.CP01", false, ""}};
    world.PublishState("LR01");
    CHECK(TryRunUntil(world, "P1", "Step 1 Completed"));
    CHECK(world.GetTraceOf("command LR01 CancelDrive").empty());
}
