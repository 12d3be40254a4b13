#include "Catch.hpp"
#include "fixtures/EngineParts.hpp"
#include "fixtures/PlanWorld.hpp"

#include <algorithm>
#include <utility>
#include <vector>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS::Testing;  // NOLINT(google-build-using-namespace): its fixtures

TEST_CASE("TrafficCoordinator: a drive begins with the length of the base")
{
    EngineParts parts;
    parts.PutOn(parts.lr, "D-CHG01");
    parts.assignment.Offer(parts.AddLoad(), parts.lr);
    parts.Discard();
    REQUIRE(parts.coordinator.TryDrive(parts.lr) == EDriveAttempt::Begun);
    const CallOutcome outcome = parts.Collect();
    const auto drives = outcome.ListCommands<Drive>();
    REQUIRE(drives.size() == 1);
    CHECK(drives.front().releasedCount == 3);
    CHECK(drives.front().route.nodes.size() == 5);
    CHECK(outcome.GetDelayOrNull(EEngineTimer::DriveExtension) == parts.engine.options.extensionDelay);
    CHECK(parts.lr.drive->driveID == drives.front().driveID);
    CHECK(parts.lr.drive->goal == EDriveGoal::Step);
    CHECK(parts.lr.drive->grantedCount == 4);
    CHECK(parts.places.GetTraffic().GetHolderOrNull(parts.FindNode("L03")) == 0U);
    CHECK_FALSE(parts.places.GetTraffic().GetHolderOrNull(parts.FindNode("D-A01.CP01")).has_value());
}

TEST_CASE("TrafficCoordinator: a robot does not set out for a place that another one has")
{
    EngineParts parts;
    parts.PutOn(parts.lr, "D-CHG01");
    parts.PutOn(parts.cr, "D-A01.CP01");
    parts.assignment.Offer(parts.AddLoad(), parts.lr);
    parts.Discard();
    CHECK(parts.coordinator.TryDrive(parts.lr) == EDriveAttempt::Waits);
    CHECK(parts.lr.search.blockers == std::vector<std::size_t>{1});
    CHECK(parts.Collect().ListCommands<Drive>().empty());
    parts.PutOn(parts.cr, "D-CHG02");
    CHECK(parts.coordinator.TryDrive(parts.lr) == EDriveAttempt::Begun);
}

TEST_CASE("TrafficCoordinator: a robot at its target has retreated")
{
    EngineParts parts;
    parts.PutOn(parts.lr, "D-CHG01");
    parts.lr.parking.retreatNode = parts.FindNode("D-CHG01");
    CHECK(parts.coordinator.TryDrive(parts.lr) == EDriveAttempt::AtTarget);
    CHECK_FALSE(parts.lr.parking.retreatNode.has_value());
}

TEST_CASE("TrafficCoordinator: a robot that lost its drive while it drove is nowhere before it has stopped")
{
    EngineParts parts;
    parts.PutOn(parts.lr, "D-A01.CP01");
    const SiteNode& dock = parts.engine.site.GetNodes()[parts.FindNode("D-A01.CP01")];
    parts.lr.view.state->x = dock.x;
    parts.lr.view.state->y = dock.y;
    parts.lr.view.state->bPoseKnown = true;
    parts.BeginDrive(parts.lr, "D-CHG01");
    parts.lr.drive->bConfirmed = true;
    parts.lr.view.state->bDriving = true; // it has reported nothing since it set out
    parts.coordinator.EndDrive(parts.lr);
    parts.assignment.Offer(parts.AddLoad(), parts.lr); // from A01.CP01
    CHECK(parts.coordinator.TryDrive(parts.lr) == EDriveAttempt::Waits);
    parts.lr.view.state->bDriving = false;
    SECTION("it has not left")
    {
        parts.places.Place(parts.lr);
        CHECK(parts.coordinator.TryDrive(parts.lr) == EDriveAttempt::AtTarget);
    }
    SECTION("it has left")
    {
        parts.lr.view.state->y -= 0.7;
        parts.places.Place(parts.lr);
        CHECK(parts.coordinator.TryDrive(parts.lr) == EDriveAttempt::Begun);
        CHECK(parts.lr.drive->route.nodes[1].nodeID == "L03");
    }
}

TEST_CASE("TrafficCoordinator: the base is extended as the robot passes nodes, and not while it is cancelling")
{
    EngineParts parts;
    parts.BeginDriveToLoad();
    parts.coordinator.ExtendBase(parts.lr);
    CHECK(parts.Collect().ListCommands<ExtendDrive>() == std::vector{ExtendDrive{parts.lr.drive->driveID, 4}});
    REQUIRE(parts.coordinator.TryAdvance(parts.lr, 1));
    CHECK_FALSE(parts.places.GetTraffic().GetHolderOrNull(parts.FindNode("D-CHG01")).has_value());
    parts.lr.drive->cancellation = ECancellation::Awaited;
    parts.coordinator.ExtendBase(parts.lr);
    CHECK(parts.Collect().ListCommands<ExtendDrive>().empty());
    parts.lr.drive->cancellation = ECancellation::None;
    parts.lr.view.state->bAutomatic = false;
    parts.coordinator.ExtendBase(parts.lr);
    CHECK(parts.Collect().ListCommands<ExtendDrive>().empty());
    parts.lr.view.state->bAutomatic = true;
    parts.coordinator.ExtendBase(parts.lr);
    CHECK(parts.Collect().ListCommands<ExtendDrive>() == std::vector{ExtendDrive{parts.lr.drive->driveID, 5}});
}

TEST_CASE("TrafficCoordinator: a robot may pass a free node without a grant, and not that of another robot")
{
    EngineParts parts;
    parts.BeginDriveToLoad();
    REQUIRE(parts.lr.drive->grantedCount == 4);
    SECTION("free")
    {
        CHECK(parts.coordinator.TryAdvance(parts.lr, 4));
        CHECK(parts.lr.drive->grantedCount == 5);
        CHECK(parts.lr.place.node == parts.FindNode("D-A01.CP01"));
        CHECK(parts.places.GetTraffic().GetHolderOrNull(parts.FindNode("D-A01.CP01")) == 0U);
        CHECK(parts.Collect().ListSetAlarms().empty());
    }
    SECTION("of another robot")
    {
        parts.PutOn(parts.cr, "D-A01.CP01");
        parts.Discard();
        CHECK_FALSE(parts.coordinator.TryAdvance(parts.lr, 4));
        CHECK(parts.lr.drive->passed == 0);
        CHECK(parts.Collect().ListSetAlarms() == std::vector<std::string>{"ACS-1003"});
        SECTION("until that has left it")
        {
            parts.PutOn(parts.cr, "D-CHG02");
            parts.Discard();
            CHECK(parts.places.GetTraffic().GetHolderOrNull(parts.FindNode("D-A01.CP01")) == 0U);
            CHECK(parts.coordinator.TryAdvance(parts.lr, 4));
            CHECK(parts.Collect().ListClearedAlarms() == std::vector<std::string>{"ACS-1003"});
        }
        SECTION("and a node that it has entered after it is kept free")
        {
            parts.lr.drive->grantedCount = 3; // L03 is the first node beyond
            parts.places.GetTraffic().Shorten(0, 3);
            parts.PutOn(parts.cr, "L03");
            CHECK_FALSE(parts.coordinator.TryAdvance(parts.lr, 4));
            CHECK(parts.places.GetTraffic().GetHolderOrNull(parts.FindNode("D-A01.CP01")) == 0U);
        }
        SECTION("until the drive ends")
        {
            parts.coordinator.EndDrive(parts.lr);
            CHECK(parts.Collect().ListClearedAlarms() == std::vector<std::string>{"ACS-1003"});
        }
    }
}

TEST_CASE(
    "TrafficCoordinator: a robot that reports a node off its route has an alarm until it is back, also after its drive")
{
    EngineParts parts;
    parts.BeginDriveToLoad();
    REQUIRE(parts.coordinator.TryAdvance(parts.lr, 1));
    parts.lr.drive->bTaken = true;
    parts.Discard();
    const auto report = [&parts](const std::string& nodeID) {
        parts.lr.view.state->lastNodeID = nodeID;
        parts.coordinator.VerifyRoute(parts.lr);
        return parts.Collect();
    };
    CHECK(report("L02").ListSetAlarms().empty());
    CHECK(report("").ListSetAlarms().empty()); // it does not know
    CHECK(report("D-A02.CP01").ListSetAlarms() == std::vector<std::string>{"ACS-1003"});
    CHECK(report("D-A02.CP01").ListSetAlarms().empty()); // is set already
    SECTION("it reports a very long one")
    {
        CHECK(report("L02").ListClearedAlarms() == std::vector<std::string>{"ACS-1003"});
        const std::vector<AlarmSet> alarms = report(std::string(10'000, 'n')).ListChanges<AlarmSet>();
        REQUIRE(alarms.size() == 1);
        CHECK(alarms.front().alarm.message.size() < 400);
    }
    SECTION("it is back")
    {
        CHECK(report("L02").ListClearedAlarms() == std::vector<std::string>{"ACS-1003"});
    }
    SECTION("its drive ends")
    {
        parts.coordinator.EndDrive(parts.lr);
        CHECK(parts.Collect().ListClearedAlarms().empty()); // the node is not on the map
        CHECK_FALSE(parts.lr.place.bPlaced);
        parts.PutOn(parts.lr, "D-A01.CP02");
        CHECK(parts.Collect().ListClearedAlarms() == std::vector<std::string>{"ACS-1003"});
    }
}

TEST_CASE("TrafficCoordinator: a robot that waits for others does not wait for the blocks of another robot")
{
    EngineParts parts;
    parts.BeginDriveToLoad();
    REQUIRE(parts.coordinator.TryAdvance(parts.lr, 1));
    parts.PutOn(parts.cr, "D-A01.CP01"); // the target of the drive, which closes its way out
    Traffic& traffic = parts.places.GetTraffic();
    std::vector<bool> blocked(parts.engine.site.GetNodes().size(), false);
    const std::vector<bool> edges(parts.engine.site.GetEdges().size(), false);
    const std::size_t next = parts.FindNode("L03");
    blocked[next] = true;
    traffic.SetBlocked(blocked, edges);
    CHECK(traffic.Extend(parts.cr.index, std::vector{next}) == 0);
    CHECK(traffic.IsRefusedForBlocks());
    blocked[next] = false;
    traffic.SetBlocked(blocked, edges);
    parts.coordinator.ExtendBase(parts.lr);
    CHECK(parts.lr.search.blockers == std::vector{parts.cr.index});
    CHECK(parts.lr.search.block.empty());
}

TEST_CASE("TrafficCoordinator: a drive that the robot has not taken yet has no route that it could have left")
{
    EngineParts parts;
    parts.BeginDriveToLoad();
    parts.Discard();
    parts.lr.view.state->lastNodeID = "D-A02.CP01";
    parts.coordinator.VerifyRoute(parts.lr);
    CHECK(parts.Collect().ListSetAlarms().empty());
}

TEST_CASE("TrafficCoordinator: a drive that has ended leaves its nodes to others")
{
    EngineParts parts;
    parts.BeginDriveToLoad();
    REQUIRE(parts.coordinator.TryAdvance(parts.lr, 1));
    parts.Discard();
    parts.coordinator.EndDrive(parts.lr);
    CHECK_FALSE(parts.lr.drive.has_value());
    CHECK(parts.lr.place.heldNodes == std::vector<std::size_t>{parts.FindNode("L01")});
    CHECK_FALSE(parts.places.GetTraffic().GetHolderOrNull(parts.FindNode("L02")).has_value());
    CHECK(parts.Collect().IsTimerCancelled(EEngineTimer::DriveExtension));
    CHECK(parts.engine.transaction.IsDispatchNeeded());
}

TEST_CASE("TrafficCoordinator: the nodes of a reroute are granted before the drive is cancelled")
{
    EngineParts parts;
    parts.BeginDriveToLoad();
    REQUIRE(parts.coordinator.TryAdvance(parts.lr, 3));
    parts.Discard();
    std::optional<PlannedRoute> route = parts.coordinator.PlanRouteOrNull(parts.lr, parts.FindNode("D-A01.CP02"), {});
    REQUIRE(route.has_value());
    REQUIRE(parts.coordinator.TryReroute(parts.lr, *route, false));
    CHECK(parts.lr.drive->IsCancelling());
    CHECK(parts.places.GetTraffic().GetHolderOrNull(parts.FindNode("L04")) == 0U);
    const CallOutcome outcome = parts.Collect();
    CHECK(outcome.ListCommands<CancelDrive>() == std::vector{CancelDrive{parts.lr.drive->driveID}});
    CHECK(outcome.GetDelayOrNull(EEngineTimer::ControlConfirm) == parts.engine.options.controls.cancelTimeout);
    SECTION("a robot that keeps its drive releases them")
    {
        parts.coordinator.AbandonReroute(parts.lr);
        CHECK_FALSE(parts.lr.drive->reroute.has_value());
        CHECK_FALSE(parts.lr.drive->IsCancelling());
        CHECK_FALSE(parts.places.GetTraffic().GetHolderOrNull(parts.FindNode("L04")).has_value());
        CHECK(parts.places.GetTraffic().GetHolderOrNull(parts.FindNode("L03")) == 0U);
    }
    SECTION("a robot that has stopped continues along them")
    {
        parts.coordinator.EndDrive(parts.lr);
        parts.coordinator.BeginReroute(parts.lr, *route, false);
        REQUIRE(parts.lr.drive.has_value());
        CHECK(parts.lr.drive->nodes == route->nodes);
        CHECK(parts.Collect().ListCommands<Drive>().size() == 1);
    }
}

TEST_CASE(
    "TrafficCoordinator: a rejected drive to the parking position is repeated, with a delay that doubles up to 64-fold")
{
    EngineParts parts;
    parts.PutOn(parts.lr, "D-A01.CP01");
    for (const int factor : {1, 2, 4, 8, 16, 32, 64, 64})
    {
        parts.coordinator.RefuseHome(parts.lr, "LR01 has no route");
        CHECK(parts.lr.parking.bRefused);
        CHECK(parts.Collect().GetDelayOrNull(EEngineTimer::HomeRetry) == parts.engine.options.homeRetry * factor);
        parts.coordinator.OnHomeRetry(parts.lr);
        CHECK_FALSE(parts.lr.parking.bRefused);
    }
}

TEST_CASE("TrafficCoordinator: a robot that waits gets another route when its load changes")
{
    EngineParts parts(MakeTestOptions(false), MakeRestrictedSite({true, false}));
    parts.PutOn(parts.lr, "D-CHG01");
    parts.PutOn(parts.cr, "D-A01.CP06");
    Plan plan = MakeLogisticsPlan("P1");
    plan.steps.front().position = "A01.CP06";
    plan.steps.front().jobs.front().from = "A01.CP06";
    parts.assignment.Offer(parts.Add(plan), parts.lr);
    const std::size_t around = parts.FindNode("AROUND");
    const auto isAround = [&parts, around] {
        return std::ranges::count(parts.lr.search.plannedRoute->nodes, around) > 0;
    };
    REQUIRE(parts.coordinator.TryDrive(parts.lr) == EDriveAttempt::Waits);
    CHECK_FALSE(isAround());
    parts.lr.ports.Correct({"C1"});
    REQUIRE(parts.coordinator.TryDrive(parts.lr) == EDriveAttempt::Waits);
    CHECK(isAround());
}

TEST_CASE("TrafficCoordinator: a detour that was found for another load is not used")
{
    EngineParts parts(MakeTestOptions(false), MakeRestrictedSite({true, false}));
    const std::size_t dock = parts.FindNode("D-A01.CP06");
    const std::size_t around = parts.FindNode("AROUND");
    parts.PutOn(parts.lr, "D-CHG01");
    Plan plan = MakeLogisticsPlan("P1");
    plan.steps.front().position = "A01.CP06";
    plan.steps.front().jobs.front().from = "A01.CP06";
    parts.assignment.Offer(parts.Add(plan), parts.lr);
    parts.PutOn(parts.cr, "AROUND");
    parts.lr.search.detour = parts.coordinator.PlanRouteOrNull(parts.lr, dock, {});
    parts.lr.search.detourTarget = dock;
    parts.lr.search.detourLoad = ELoad::Empty;
    parts.lr.search.detourAt = parts.places.GetStandingChanges();
    parts.lr.ports.Correct({"C1"});
    REQUIRE(parts.coordinator.TryDrive(parts.lr) == EDriveAttempt::Begun);
    CHECK(std::ranges::count(parts.lr.drive->nodes, around) == 1);
}

TEST_CASE("TrafficCoordinator: a drive is not extended along an edge that the robot may not use with a new load")
{
    for (const bool bRestricted : {false, true})
    {
        EngineParts parts(MakeTestOptions(false), MakeRestrictedSite({true, !bRestricted}));
        parts.PutOn(parts.lr, "D-CHG01");
        parts.BeginDrive(parts.lr, "D-A01.CP06");
        REQUIRE(parts.lr.drive->nodes.size() == 10);
        REQUIRE(parts.coordinator.TryAdvance(parts.lr, 3));
        parts.lr.ports.Correct({"C1"});
        parts.coordinator.ExtendBase(parts.lr);
        CHECK(parts.lr.drive->grantedCount == (bRestricted ? 6 : 10)); // L05 is the sixth node
    }
}

TEST_CASE("TrafficCoordinator: a reroute that was planned for another load is not begun")
{
    for (const bool bChanged : {false, true})
    {
        EngineParts parts(MakeTestOptions(false), MakeRestrictedSite({true, false}));
        parts.PutOn(parts.lr, "D-CHG01");
        const std::optional<PlannedRoute> route =
            parts.coordinator.PlanRouteOrNull(parts.lr, parts.FindNode("D-A01.CP06"), {});
        REQUIRE(route.has_value());
        parts.lr.ports.Correct({bChanged ? std::optional<std::string>("C1") : std::nullopt});
        parts.coordinator.BeginReroute(parts.lr, *route, false);
        CHECK(parts.lr.drive.has_value() != bChanged);
    }
}

TEST_CASE("TrafficCoordinator: a robot between two nodes stays on its lane where another way to its end is quicker")
{
    const SiteMap usual = MakeTestSite();
    std::vector<SiteNode> nodes = usual.GetNodes();
    std::vector<SiteEdge> edges = usual.GetEdges();
    std::vector<SiteEdgeRule>& slow = std::ranges::find(edges, "L05>L06", &SiteEdge::edgeID)->rules;
    const std::vector<SiteEdgeRule> rules = slow;
    for (SiteEdgeRule& rule : slow)
    {
        rule.maxSpeed = 0.1;
    }
    SiteNode around = *usual.FindNodeOrNull("L05");
    around.nodeID = "AROUND";
    around.x = 4.5;
    around.y = -2;
    nodes.push_back(around);
    edges.push_back({"L05>AROUND", "L05", "AROUND", rules});
    edges.push_back({"AROUND>L06", "AROUND", "L06", rules});
    EngineParts parts(
        MakeTestOptions(false),
        *SiteMap::Create(std::move(nodes), std::move(edges), usual.GetStations()));
    parts.PutOn(parts.lr, "L05");
    StateChanged& state = *parts.lr.view.state;
    state.bPoseKnown = true;
    state.x = 4.6;
    state.y = 0;
    parts.places.Place(parts.lr);
    REQUIRE(parts.lr.place.heading == parts.FindNode("L06"));
    const auto route = parts.coordinator.PlanRouteOrNull(parts.lr, parts.FindNode("D-A01.CP06"), {});
    REQUIRE(route.has_value());
    CHECK(route->nodes[1] == parts.FindNode("L06"));
}

TEST_CASE("TrafficCoordinator: a robot that has left its target and has no way back is not at its target")
{
    const bool bRestricted = GENERATE(false, true);
    const SiteMap usual = MakeTestSite();
    std::vector<SiteEdge> edges = usual.GetEdges();
    for (SiteEdgeRule& rule : std::ranges::find(edges, "L03>D-A01.CP01", &SiteEdge::edgeID)->rules)
    {
        rule.loadRestriction = SiteLoadRestriction{!bRestricted, true}; // the robot is empty
    }
    EngineParts parts(
        MakeTestOptions(false),
        *SiteMap::Create(usual.GetNodes(), std::move(edges), usual.GetStations()));
    parts.PutOn(parts.lr, "D-A01.CP01");
    StateChanged& state = *parts.lr.view.state;
    state.bPoseKnown = true;
    state.x = parts.engine.site.FindNodeOrNull("D-A01.CP01")->x;
    state.y = 0.4;
    parts.places.Place(parts.lr);
    REQUIRE(parts.lr.place.heading == parts.FindNode("L03"));
    parts.assignment.Offer(parts.AddLoad(), parts.lr);
    CHECK(parts.coordinator.TryDrive(parts.lr) == (bRestricted ? EDriveAttempt::NoRoute : EDriveAttempt::Begun));
    CHECK(parts.lr.drive.has_value() != bRestricted);
}

TEST_CASE("TrafficCoordinator: an assigned parking position is not within the clearance of another one")
{
    EngineOptions options = MakeTestOptions(false);
    options.clearance = 1;
    options.robots.back().homeStationID.reset();
    EngineParts parts(options);
    REQUIRE(parts.cr.parking.parkingNode.has_value());
    CHECK_FALSE(parts.places.GetTraffic().IsNear(*parts.cr.parking.parkingNode, parts.FindNode("D-CHG01")));
}

TEST_CASE(
    "TrafficCoordinator: a robot that is stationary between two nodes continues on its lane, if its route allows it")
{
    EngineParts parts;
    parts.BeginDriveToLoad();
    parts.lr.drive->bConfirmed = true;
    REQUIRE(parts.coordinator.TryAdvance(parts.lr, 1));
    const SiteNode& node = *parts.engine.site.FindNodeOrNull("L01");
    const SiteNode& next = *parts.engine.site.FindNodeOrNull("L02");
    StateChanged& state = *parts.lr.view.state;
    state.lastNodeID = "L01";
    state.bPoseKnown = true;
    state.x = (node.x + next.x) / 2;
    state.y = (node.y + next.y) / 2;
    parts.coordinator.EndDrive(parts.lr);
    REQUIRE(parts.lr.place.aheadNodes == std::vector<std::size_t>{parts.FindNode("L02")});
    parts.Discard();
    SECTION("to its step")
    {
        REQUIRE(parts.coordinator.TryDrive(parts.lr) == EDriveAttempt::Begun);
        const auto drives = parts.Collect().ListCommands<Drive>();
        REQUIRE(drives.size() == 1);
        const std::vector<RouteNode>& nodes = drives.front().route.nodes;
        CHECK(nodes[0].nodeID == "L01");
        CHECK(nodes[1].nodeID == "L02");
        CHECK(nodes[0].allowedDeviation > GetDistance(node, next) / 2);
        CHECK(nodes[1].allowedDeviation == RouteNode{}.allowedDeviation);
        CHECK(drives.front().route.edges.size() + 1 == nodes.size());
    }
    SECTION("to a place that it has passed: round the loop")
    {
        const auto route = parts.coordinator.PlanRouteOrNull(parts.lr, parts.FindNode("D-CHG01"), {});
        REQUIRE(route.has_value());
        CHECK(std::ranges::count(route->nodes, parts.FindNode("L01")) == 2);
        CHECK(route->nodes[1] == parts.FindNode("L02"));
        CHECK(route->nodes.back() == parts.FindNode("D-CHG01"));
    }
    SECTION("to its home, which it has just left")
    {
        parts.lr.planOrNull = nullptr;
        parts.lr.parking.homeNode = parts.FindNode("L01");
        CHECK(std::ranges::count(parts.waiting.ListAwayFromHome(), &parts.lr) == 1);
        CHECK(parts.waiting.IsWaiting(parts.lr));
    }
    SECTION("to the node that it has left")
    {
        parts.lr.parking.retreatNode = parts.FindNode("L01");
        CHECK(parts.coordinator.TryDrive(parts.lr) == EDriveAttempt::Begun);
        CHECK(parts.lr.drive->nodes.back() == parts.FindNode("L01"));
    }
}
