#include "traffic/DeadlockResolver.hpp"

#include "Catch.hpp"
#include "fixtures/EngineParts.hpp"
#include "fixtures/PlanWorld.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS::Testing;  // NOLINT(google-build-using-namespace): its fixtures

namespace
{

/// One two-way lane with a dock at each of its nodes. LR01 parks at its right end, CR01 at its left one.
SiteMap MakeLane()
{
    const std::vector<std::string> stations{"CHG02", "A01.CP03", "A01.CP01", "A01.CP02", "A01.CP04", "CHG01"};
    const SiteMap loop = MakeTestSite();
    SiteEdge edge = loop.GetEdges().front();
    std::vector<SiteNode> nodes;
    std::vector<SiteEdge> edges;
    std::vector<SiteStation> sites;
    const auto connect = [&edges, &edge](const std::string& from, const std::string& to) {
        for (const auto& [start, end] : {std::pair{from, to}, std::pair{to, from}})
        {
            edge.edgeID = fmt::format("{}>{}", start, end);
            edge.startNodeID = start;
            edge.endNodeID = end;
            edges.push_back(edge);
        }
    };
    for (std::size_t i = 0; i < stations.size(); ++i)
    {
        SiteNode node = loop.GetNodes().front();
        node.nodeID = "L" + std::to_string(i);
        node.x = static_cast<double>(i);
        nodes.push_back(node);
        node.nodeID = "D-" + stations[i];
        node.y += 1;
        nodes.push_back(node);
        connect("L" + std::to_string(i), node.nodeID);
        if (i > 0)
        {
            connect("L" + std::to_string(i - 1), "L" + std::to_string(i));
        }
        sites.push_back({stations[i], {node.nodeID}});
    }
    return *SiteMap::Create(std::move(nodes), std::move(edges), std::move(sites));
}

/// The site with an edge that loaded robots may not use.
SiteMap CloseToLoaded(const SiteMap& site, const std::string& edgeID)
{
    std::vector<SiteEdge> edges = site.GetEdges();
    for (SiteEdgeRule& rule : std::ranges::find(edges, edgeID, &SiteEdge::edgeID)->rules)
    {
        rule.loadRestriction = SiteLoadRestriction{true, false};
    }
    return *SiteMap::Create(site.GetNodes(), std::move(edges), site.GetStations());
}

/// LR01 is loaded on its way to the station. It is on this node of its route, where its base ends.
void BeginLoadedDrive(EngineParts& parts, const std::string& stationID, std::size_t routeIndex)
{
    Plan plan = MakeLogisticsPlan("P1");
    plan.steps[0].position = stationID;
    plan.steps[0].jobs[0].from = stationID;
    plan.steps.resize(1);
    parts.assignment.Offer(parts.Add(plan), parts.lr);
    REQUIRE(parts.coordinator.TryDrive(parts.lr) == EDriveAttempt::Begun);
    parts.lr.drive->bConfirmed = true;
    CarrierIDs carriers = parts.lr.ports.GetCarriers();
    carriers.front() = "C9";
    parts.lr.ports.Correct(carriers);
    for (std::size_t i = 1; i <= routeIndex; ++i)
    {
        REQUIRE(parts.coordinator.TryAdvance(parts.lr, i));
        parts.coordinator.ExtendBase(parts.lr);
    }
    REQUIRE(parts.lr.drive->grantedCount == routeIndex + 1);
}

/// Each robot is where the other one has its step.
void Exchange(EngineParts& parts)
{
    Plan plan = MakeControlPlan("P2");
    plan.steps.resize(1);
    plan.steps.front().position = "A01.CP02";
    plan.steps.front().jobs = {{"P2-1", "A01.CP02.TP01", "AMR.TP01"}};
    parts.PutOn(parts.lr, "D-A01.CP02");
    parts.PutOn(parts.cr, "D-A01.CP01");
    parts.assignment.Offer(parts.AddLoad(), parts.lr);
    parts.assignment.Offer(parts.Add(plan), parts.cr);
    REQUIRE(parts.coordinator.TryDrive(parts.lr) == EDriveAttempt::Waits);
    REQUIRE(parts.coordinator.TryDrive(parts.cr) == EDriveAttempt::Waits);
    parts.Discard();
}

} // namespace

TEST_CASE("DeadlockResolver: of two robots that want to exchange places the less urgent one retreats")
{
    EngineParts parts;
    DeadlockResolver resolver(parts.engine, parts.tsc, parts.places, parts.waiting, parts.coordinator);
    Exchange(parts);
    const DeadlockResolver::Round round = resolver.TryResolveDeadlock();
    CHECK(round.bMoved);
    CHECK_FALSE(parts.lr.drive.has_value());
    REQUIRE(parts.cr.drive.has_value());
    CHECK(parts.cr.drive->goal == EDriveGoal::Home);
    CHECK(parts.cr.drive->nodes.back() == parts.FindNode("D-CHG02"));
    CHECK(parts.cr.parking.retreatNode == parts.FindNode("D-CHG02"));
    REQUIRE(parts.cr.search.yield.has_value());
    CHECK(parts.cr.search.yield->leader == parts.lr.index);
    CHECK(parts.Collect().ListCommands<Drive>().size() == 1);
    CHECK_FALSE(resolver.TryResolveDeadlock().bMoved);
}

TEST_CASE("DeadlockResolver: the leader retreats where the other robot cannot")
{
    EngineParts parts;
    DeadlockResolver resolver(parts.engine, parts.tsc, parts.places, parts.waiting, parts.coordinator);
    Exchange(parts);
    parts.cr.parking.bRefused = true;
    CHECK(resolver.TryResolveDeadlock().bMoved);
    CHECK(parts.lr.parking.retreatNode == parts.FindNode("D-CHG01"));
    CHECK_FALSE(parts.cr.drive.has_value());
}

TEST_CASE("DeadlockResolver: the first robot stops yielding where nothing else can be done")
{
    EngineParts parts;
    DeadlockResolver resolver(parts.engine, parts.tsc, parts.places, parts.waiting, parts.coordinator);
    Exchange(parts);
    parts.lr.parking.bRefused = true;
    parts.cr.parking.bRefused = true;
    CHECK(resolver.TryResolveDeadlock().releasedOrNull == nullptr);
    WaitingRobots::YieldTo(parts.lr, parts.cr);
    const DeadlockResolver::Round round = resolver.TryResolveDeadlock();
    CHECK_FALSE(round.bMoved);
    CHECK(round.releasedOrNull == &parts.lr);
    CHECK_FALSE(parts.lr.search.yield.has_value());
}

TEST_CASE("DeadlockResolver: where the nearest refuge is the target of the leader, a robot retreats to the next one")
{
    EngineParts parts(MakeTestOptions(false), MakeLane());
    DeadlockResolver resolver(parts.engine, parts.tsc, parts.places, parts.waiting, parts.coordinator);
    Plan plan = MakeLogisticsPlan("P2");
    plan.steps[0].position = "A01.CP02";
    plan.steps[0].jobs[0].from = "A01.CP02";
    plan.steps.resize(1);
    Plan other = MakeControlPlan("P3");
    other.steps.resize(1);
    // Head on: each has its target behind the other one, and so has its parking position.
    parts.PutOn(parts.lr, "L2");
    parts.PutOn(parts.cr, "L3");
    parts.assignment.Offer(parts.Add(plan), parts.lr);
    parts.assignment.Offer(parts.Add(other), parts.cr);
    REQUIRE(parts.coordinator.TryDrive(parts.lr) == EDriveAttempt::Waits);
    REQUIRE(parts.coordinator.TryDrive(parts.cr) == EDriveAttempt::Waits);
    CHECK(resolver.TryResolveDeadlock().bMoved);
    REQUIRE(parts.cr.drive.has_value());
    CHECK(parts.cr.parking.retreatNode == parts.FindNode("D-A01.CP04"));
}

TEST_CASE("DeadlockResolver: an idle robot in its parking position steps aside")
{
    EngineOptions options = MakeTestOptions(false);
    options.robots[1].startNodeID = "D-A01.CP01";
    options.robots[1].homeStationID = "A01.CP01";
    EngineParts parts(options);
    DeadlockResolver resolver(parts.engine, parts.tsc, parts.places, parts.waiting, parts.coordinator);
    parts.PutOn(parts.lr, "D-CHG01");
    parts.PutOn(parts.cr, "D-A01.CP01");
    parts.assignment.Offer(parts.AddLoad(), parts.lr);
    REQUIRE(parts.coordinator.TryDrive(parts.lr) == EDriveAttempt::Waits);
    parts.Discard();
    SECTION("while robots are driven")
    {
        CHECK(resolver.TryResolveDeadlock().bMoved);
        REQUIRE(parts.cr.drive.has_value());
        CHECK(parts.cr.parking.retreatNode == parts.FindNode("D-A01.CP02"));
    }
    SECTION("but not while it refuses")
    {
        parts.cr.parking.bRefused = true;
        CHECK_FALSE(resolver.TryResolveDeadlock().bMoved);
        CHECK(parts.Collect().actions.empty());
    }
}

TEST_CASE("DeadlockResolver: no robot yields to one whose load closes its only route")
{
    EngineOptions options = MakeTestOptions(false);
    options.baseLength = 1;
    EngineParts parts(options, CloseToLoaded(MakeLane(), "L3>L2"));
    DeadlockResolver resolver(parts.engine, parts.tsc, parts.places, parts.waiting, parts.coordinator);
    parts.PutOn(parts.lr, "D-CHG01");
    parts.PutOn(parts.cr, "L2");
    BeginLoadedDrive(parts, "A01.CP01", 3);
    CHECK(parts.lr.search.block == "a loaded robot may not use edge L3>L2 of its route");
    Plan plan = MakeControlPlan("P2");
    plan.steps.resize(1);
    plan.steps.front().position = "A01.CP02";
    plan.steps.front().jobs = {{"P2-1", "A01.CP02.TP01", "AMR.TP01"}};
    parts.assignment.Offer(parts.Add(plan), parts.cr);
    REQUIRE(parts.coordinator.TryDrive(parts.cr) == EDriveAttempt::Waits);
    CHECK(resolver.TryResolveDeadlock().bMoved);
    CHECK_FALSE(parts.cr.drive.has_value());
    CHECK_FALSE(parts.cr.search.yield.has_value());
    CHECK(parts.lr.drive->IsCancelling()); // it clears the route of the other one
}

TEST_CASE("DeadlockResolver: a robot clears the other route of one whose load closes its present route")
{
    EngineOptions options = MakeTestOptions(false);
    options.baseLength = 1;
    EngineParts parts(options, MakeRestrictedSite({true, false}));
    DeadlockResolver resolver(parts.engine, parts.tsc, parts.places, parts.waiting, parts.coordinator);
    parts.PutOn(parts.lr, "D-CHG01");
    parts.PutOn(parts.cr, "AROUND");
    BeginLoadedDrive(parts, "A01.CP06", 5);
    CHECK(parts.lr.search.block.empty());
    CHECK(resolver.TryResolveDeadlock().bMoved);
    CHECK((parts.cr.drive.has_value() || parts.lr.drive->IsCancelling()));
}

TEST_CASE("DeadlockResolver: a robot whose load closes its route, but not another one, waits for who is at its goal")
{
    EngineOptions options = MakeTestOptions(false);
    options.baseLength = 1;
    EngineParts parts(options, MakeRestrictedSite({true, false}));
    parts.PutOn(parts.lr, "D-CHG01");
    BeginLoadedDrive(parts, "A01.CP06", 5);
    parts.PutOn(parts.cr, "D-A01.CP06");
    parts.coordinator.ExtendBase(parts.lr);
    CHECK(parts.lr.search.block.empty());
    CHECK(parts.lr.search.blockers == std::vector<std::size_t>{parts.cr.index});
}
