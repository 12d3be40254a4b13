#include "Catch.hpp"
#include "fixtures/PlanWorld.hpp"
#include <acs/plan/Router.hpp>

#include <fmt/format.h>

#include <string>
#include <vector>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace

namespace
{

SiteEdge MakeEdge(std::string edgeID, std::string from, std::string to, double speed)
{
    SiteEdgeRule rule;
    rule.vehicleTypeID = "lr";
    rule.maxSpeed = speed;
    return {std::move(edgeID), std::move(from), std::move(to), {rule}};
}

SiteNode MakeNode(std::string nodeID, double x, double y)
{
    return {std::move(nodeID), x, y, "", {{"lr", std::nullopt}}};
}

std::vector<std::string> GetNodeIDs(const std::optional<Route>& routeOrNull)
{
    std::vector<std::string> nodeIDs;
    for (const RouteNode& node : routeOrNull.value_or(Route{}).nodes)
    {
        nodeIDs.push_back(node.nodeID);
    }
    return nodeIDs;
}

} // namespace

TEST_CASE("Routes: the route takes the least time, not the least distance, and the faster of two edges")
{
    const SiteMap site = *SiteMap::Create(
        {MakeNode("A", 0, 0), MakeNode("B", 10, 0), MakeNode("C", 5, 5)},
        {MakeEdge("slow", "A", "B", 0.1),
         MakeEdge("up", "A", "C", 1),
         MakeEdge("down", "C", "B", 1),
         MakeEdge("downFast", "C", "B", 2)},
        {});
    const Router router(site);
    const std::optional<Route> route = router.FindRouteOrNull("lr", "A", "B");
    CHECK(GetNodeIDs(route) == std::vector<std::string>{"A", "C", "B"});
    REQUIRE(route->edges.size() == 2);
    CHECK(route->edges[1].edgeID == "downFast");
    CHECK(route->travelSeconds == Approx(7.0711 * 1.5).epsilon(0.001));
    CHECK(router.FindRouteOrNull("lr", "A", "A")->nodes.size() == 1);
}

TEST_CASE("Routes: there is none against a one-way edge, for another vehicle type or to an unknown node")
{
    const SiteMap site =
        *SiteMap::Create({MakeNode("A", 0, 0), MakeNode("B", 10, 0)}, {MakeEdge("E", "A", "B", 1)}, {});
    const Router router(site);
    CHECK(router.FindRouteOrNull("lr", "A", "B").has_value());
    CHECK_FALSE(router.FindRouteOrNull("lr", "B", "A").has_value());
    CHECK_FALSE(router.FindRouteOrNull("cr", "A", "B").has_value());
    CHECK_FALSE(router.FindRouteOrNull("lr", "A", "Z").has_value());
}

TEST_CASE("Routes: no route enters a blocked node or uses a blocked edge, but one may begin on a blocked node")
{
    const SiteMap site = *SiteMap::Create(
        {MakeNode("A", 0, 0), MakeNode("B", 10, 0), MakeNode("C", 5, 5)},
        {MakeEdge("direct", "A", "B", 1), MakeEdge("up", "A", "C", 1), MakeEdge("down", "C", "B", 1)},
        {});
    Router router(site);
    CHECK(GetNodeIDs(router.FindRouteOrNull("lr", "A", "B")) == std::vector<std::string>{"A", "B"});
    router.SetBlocked({true, false, false}, {true, false, false});
    CHECK(GetNodeIDs(router.FindRouteOrNull("lr", "A", "B")) == std::vector<std::string>{"A", "C", "B"});
    router.SetBlocked({false, false, true}, {true, false, false});
    CHECK_FALSE(router.FindRouteOrNull("lr", "A", "B").has_value());
    CHECK_FALSE(router.FindRouteOrNull("lr", "A", "C").has_value());
    CHECK(router.FindRouteOrNull("lr", "C", "B").has_value());
    router.SetBlocked({false, false, false}, {false, false, false});
    CHECK(GetNodeIDs(router.FindRouteOrNull("lr", "A", "B")) == std::vector<std::string>{"A", "B"});
}

TEST_CASE("Routes: a route avoids excluded nodes except its first and last")
{
    const SiteMap site = *SiteMap::Create(
        {MakeNode("A", 0, 0), MakeNode("B", 5, 0), MakeNode("C", 5, 5), MakeNode("D", 10, 0)},
        {MakeEdge("AB", "A", "B", 1),
         MakeEdge("BD", "B", "D", 1),
         MakeEdge("AC", "A", "C", 1),
         MakeEdge("CD", "C", "D", 1)},
        {});
    const Router router(site);
    CHECK(GetNodeIDs(router.FindRouteOrNull("lr", "A", "D")) == std::vector<std::string>{"A", "B", "D"});
    const auto isB = [](std::size_t node) {
        return node == 1;
    };
    CHECK(
        GetNodeIDs(router.FindRouteOrNull("lr", ELoad::Empty, "A", "D", isB))
        == std::vector<std::string>{"A", "C", "D"});
    const auto isAny = [](std::size_t) {
        return true;
    };
    CHECK_FALSE(router.FindRouteOrNull("lr", ELoad::Empty, "A", "D", isAny).has_value());
    CHECK(
        GetNodeIDs(router.FindRouteOrNull("lr", ELoad::Empty, "A", "B", isAny)) == std::vector<std::string>{"A", "B"});
}

TEST_CASE("Routes: an edge with a load restriction is used by vehicles with a permitted load only")
{
    const auto restrict = [](SiteEdge edge, bool bUnloaded, bool bLoaded) {
        edge.rules.front().loadRestriction = SiteLoadRestriction{bUnloaded, bLoaded};
        return edge;
    };
    const SiteMap site = *SiteMap::Create(
        {MakeNode("A", 0, 0), MakeNode("B", 5, 1), MakeNode("C", 5, 3), MakeNode("D", 5, 9), MakeNode("E", 10, 0)},
        {restrict(MakeEdge("AB", "A", "B", 1), true, false),
         MakeEdge("BE", "B", "E", 1),
         restrict(MakeEdge("AC", "A", "C", 1), false, true),
         MakeEdge("CE", "C", "E", 1),
         restrict(MakeEdge("AE", "A", "E", 10), false, false),
         MakeEdge("AD", "A", "D", 1),
         MakeEdge("DE", "D", "E", 1)},
        {});
    const Router router(site);
    const auto find = [&router](ELoad load) {
        return GetNodeIDs(router.FindRouteOrNull("lr", load, "A", "E", {}));
    };
    CHECK(find(ELoad::Empty) == std::vector<std::string>{"A", "B", "E"});
    CHECK(find(ELoad::Loaded) == std::vector<std::string>{"A", "C", "E"});
    CHECK(find(ELoad::Unknown) == std::vector<std::string>{"A", "D", "E"});
    CHECK(GetNodeIDs(router.FindRouteOrNull("lr", "A", "E")) == find(ELoad::Unknown));
    const auto isOpen = [&router](ELoad load, std::size_t target) {
        return router.FindQuickestStartOrNull("lr", load, std::vector<std::size_t>{0}, target).has_value();
    };
    CHECK(isOpen(ELoad::Empty, 1));
    CHECK_FALSE(isOpen(ELoad::Loaded, 1));
    CHECK_FALSE(isOpen(ELoad::Empty, 2));
    CHECK(isOpen(ELoad::Loaded, 2));
}

TEST_CASE("Routes: of several starts the one with the fastest route to the target, along one-way edges")
{
    const SiteMap site = *SiteMap::Create(
        {MakeNode("A", 0, 0), MakeNode("B", 10, 0), MakeNode("C", 5, 5), MakeNode("D", 50, 0)},
        {MakeEdge("AB", "A", "B", 0.5), MakeEdge("CB", "C", "B", 1), MakeEdge("BD", "B", "D", 10)},
        {});
    const Router router(site);
    const auto find = [&router](std::vector<std::size_t> starts, std::size_t target) {
        return router.FindQuickestStartOrNull("lr", ELoad::Empty, starts, target);
    };
    CHECK(find({0, 2}, 1)->nodeIndex == 2);
    CHECK(find({0, 2}, 1)->travelSeconds == Approx(7.0711).epsilon(0.001));
    CHECK(find({0}, 3)->travelSeconds == Approx(24.0));
    CHECK(find({3, 1}, 1)->travelSeconds == 0.0);
    CHECK_FALSE(find({3}, 0).has_value());
    CHECK_FALSE(find({}, 0).has_value());
    CHECK_FALSE(router.FindQuickestStartOrNull("cr", ELoad::Empty, std::vector<std::size_t>{0}, 1).has_value());
    CHECK(router.FindQuickestStartOrNull("cr", ELoad::Empty, std::vector<std::size_t>{1}, 1)->nodeIndex == 1);
}

TEST_CASE("Routes: the cost of a search depends on the length of the route, not on the size of the site or the starts")
{
    constexpr int NODES = 2000;
    std::vector<SiteNode> nodes;
    std::vector<SiteEdge> edges;
    for (int i = 0; i < NODES; ++i)
    {
        nodes.push_back(MakeNode(std::to_string(i), i, 0));
        if (i > 0)
        {
            edges.push_back(MakeEdge(fmt::format("{}+", i), std::to_string(i - 1), std::to_string(i), 1));
            edges.push_back(MakeEdge(fmt::format("{}-", i), std::to_string(i), std::to_string(i - 1), 1));
        }
    }
    const SiteMap site = *SiteMap::Create(std::move(nodes), std::move(edges), {});
    const Router router(site);
    REQUIRE(router.FindRouteOrNull("lr", "1000", "1010").has_value());
    CHECK(router.CountVisitedNodes() <= 21);

    std::vector<std::size_t> starts;
    for (std::size_t i = 0; i < 100; ++i)
    {
        starts.push_back(20 * i);
    }
    const std::uint64_t before = router.CountVisitedNodes();
    CHECK(router.FindQuickestStartOrNull("lr", ELoad::Empty, starts, 1005)->nodeIndex == 1000);
    CHECK(router.CountVisitedNodes() - before <= 12);
    // All of them together cost at most one search of the whole site: the times to a target are cached.
    for (const std::size_t start : starts)
    {
        CHECK(router.FindQuickestStartOrNull("lr", ELoad::Empty, std::vector<std::size_t>{start}, 1005).has_value());
    }
    CHECK(router.CountVisitedNodes() - before <= NODES);
}

TEST_CASE("Sites: of several stations on one node the first is the station of the node")
{
    const SiteMap site = *SiteMap::Create(
        {MakeNode("A", 0, 0), MakeNode("B", 10, 0), MakeNode("C", 20, 0)},
        {},
        {{"A01.CP01", {"A"}}, {"A01.CP02", {"B", "A"}}, {"A01.CP03", {"B"}}});
    CHECK(site.FindStationAtOrNull("A")->stationID == "A01.CP01");
    CHECK(site.FindStationAtOrNull("B")->stationID == "A01.CP02");
    CHECK(site.FindStationAtOrNull("C") == nullptr);
    CHECK(site.FindStationAtOrNull("D") == nullptr);
}

TEST_CASE("Routes: turning takes time if the map has a rotation speed, and a route has each node once")
{
    // Down a staircase or around the corner: the same length, but four turns more.
    std::vector<SiteEdge> edges{
        MakeEdge("AB", "A", "B", 1),
        MakeEdge("BC", "B", "C", 1),
        MakeEdge("CD", "C", "D", 1),
        MakeEdge("DE", "D", "E", 1),
        MakeEdge("AF", "A", "F", 0.99),
        MakeEdge("FE", "F", "E", 0.99)};
    const std::vector<SiteNode> nodes{
        MakeNode("A", 0, 0),
        MakeNode("B", 1, 0),
        MakeNode("C", 1, 1),
        MakeNode("D", 2, 1),
        MakeNode("E", 2, 2),
        MakeNode("F", 0, 2)};
    const SiteMap still = *SiteMap::Create(nodes, edges, {});
    CHECK(Router(still).FindRouteOrNull("lr", "A", "E")->nodes.size() == 5);
    for (SiteEdge& edge : edges)
    {
        edge.rules.front().maxRotationSpeed = 0.5;
    }
    const SiteMap turning = *SiteMap::Create(nodes, edges, {});
    const std::optional<Route> route = Router(turning).FindRouteOrNull("lr", "A", "E");
    CHECK(GetNodeIDs(route) == std::vector<std::string>{"A", "F", "E"});
    CHECK(route->travelSeconds == Approx(4 / 0.99 + 1.5708 / 0.5).epsilon(0.001));
}

TEST_CASE("Routes: a node counts as reached within half of the distance to the nearest other node on its map")
{
    std::vector<SiteNode> nodes{
        MakeNode("A", 0, 0),
        MakeNode("B", 0.9, 0),
        MakeNode("C", 5, 0),
        MakeNode("D", 5, 0.2),
        MakeNode("E", 5, 0.2)};
    nodes[3].mapID = "upstairs";
    const SiteMap site = *SiteMap::Create(nodes, {MakeEdge("e1", "A", "B", 1), MakeEdge("e2", "B", "C", 1)}, {});
    const std::optional<Route> route = Router(site).FindRouteOrNull("lr", "A", "C");
    REQUIRE(GetNodeIDs(route) == std::vector<std::string>{"A", "B", "C"});
    CHECK(route->nodes[0].allowedDeviation == Approx(0.45));
    CHECK(route->nodes[1].allowedDeviation == Approx(0.45));
    CHECK(route->nodes[2].allowedDeviation == Approx(0.1));
    const SiteMap apart = *SiteMap::Create({nodes[0], nodes[2], nodes[3]}, {MakeEdge("e", "A", "C", 1)}, {});
    CHECK(Router(apart).FindRouteOrNull("lr", "A", "C")->nodes[1].allowedDeviation == 0.5);
}
