#include "traffic/Traffic.hpp"

#include "Catch.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace

namespace
{

using Nodes = std::vector<std::size_t>;

/// A corridor 0-1-2-3-4, driven both ways, with a spur on each end (5 on 0, 6 on 4), one in the middle (7 on 2), and a
/// second node 8 that is 0.3 m from node 3 and has no edge.
SiteMap MakeCorridor()
{
    const std::vector<SiteNodeRule> rules{{"lr", std::nullopt}};
    std::vector<SiteNode> nodes;
    const std::vector<std::pair<double, double>>
        places{{0, 0}, {2, 0}, {4, 0}, {6, 0}, {8, 0}, {0, 2}, {8, 2}, {4, 2}, {6, 0.3}};
    for (std::size_t i = 0; i < places.size(); ++i)
    {
        nodes.push_back({std::to_string(i), places[i].first, places[i].second, "floor", rules});
    }
    SiteEdgeRule rule;
    rule.vehicleTypeID = "lr";
    std::vector<SiteEdge> edges;
    const std::vector<std::pair<int, int>> pairs{{0, 1}, {1, 2}, {2, 3}, {3, 4}, {0, 5}, {4, 6}, {2, 7}};
    for (const auto& [from, to] : pairs)
    {
        const std::string left = std::to_string(from);
        const std::string right = std::to_string(to);
        edges.push_back({fmt::format("{}>{}", left, right), left, right, {rule}});
        edges.push_back({fmt::format("{}>{}", right, left), right, left, {rule}});
    }
    return *SiteMap::Create(std::move(nodes), std::move(edges), {});
}

/// Robot 0 on its parking position 5, robot 1 on 6.
Traffic MakeTraffic(double clearance = 0)
{
    Traffic traffic(MakeCorridor(), clearance);
    const Nodes homes{5, 6};
    for (std::size_t robot = 0; robot < homes.size(); ++robot)
    {
        traffic.AddRobot("lr", homes[robot]);
        REQUIRE(traffic.TryStand(robot, homes[robot]));
        traffic.SetMovable(robot, true);
    }
    return traffic;
}

Nodes GetHeld(const Traffic& traffic, std::size_t robot)
{
    return {traffic.GetHeld(robot).begin(), traffic.GetHeld(robot).end()};
}

} // namespace

TEST_CASE("Traffic: nodes are granted up to the first that another robot holds, and released as they are passed")
{
    Traffic traffic = MakeTraffic();
    CHECK(traffic.Extend(0, Nodes{0, 1, 2, 7}) == 4);
    CHECK(GetHeld(traffic, 0) == Nodes{5, 0, 1, 2, 7});
    CHECK(traffic.Extend(1, Nodes{4, 3, 2, 1}) == 2);
    CHECK(traffic.Extend(1, Nodes{2, 1}) == 0);
    CHECK(traffic.GetBlockers() == Nodes{0});
    traffic.Pass(0, 4);
    CHECK(GetHeld(traffic, 0) == Nodes{7});
    CHECK(traffic.GetHolderOrNull(2) == std::nullopt);
    CHECK(traffic.GetHolderOrNull(7) == 0);
}

TEST_CASE("Traffic: robots may meet in a corridor where each can retreat, and drive no further there")
{
    Traffic traffic = MakeTraffic();
    REQUIRE(traffic.Extend(0, Nodes{0, 1}) == 2);
    traffic.Pass(0, 2);
    CHECK(traffic.Extend(1, Nodes{4, 3, 2}) == 3);
    CHECK(traffic.Extend(0, Nodes{2}) == 0);
    CHECK(traffic.GetBlockers() == Nodes{1});
}

TEST_CASE("Traffic: a grant after which the state is not safe is refused, all others are given")
{
    // Robot 0 is on 5 and has the parking position 6. Robot 1 is on 6, has 7, and must enter it first.
    Traffic traffic(MakeCorridor(), 0);
    traffic.AddRobot("lr", 6);
    traffic.AddRobot("lr", 7);
    REQUIRE(traffic.TryStand(0, 5));
    REQUIRE(traffic.TryStand(1, 6));
    traffic.SetMovable(0, true);
    traffic.SetMovable(1, true);
    // Robot 0 on 2 or beyond would block robot 1 from 7, and robot 1 would block robot 0 from 6.
    REQUIRE(traffic.Extend(0, Nodes{0, 1}) == 2);
    traffic.Pass(0, 2);
    CHECK(traffic.Extend(0, Nodes{2}) == 0);
    CHECK(traffic.GetBlockers() == Nodes{1});
    CHECK(traffic.Extend(1, Nodes{4, 3, 2, 7}) == 4);
    traffic.Pass(1, 4);
    CHECK(traffic.Extend(0, Nodes{2, 3, 4, 6}) == 4);
}

TEST_CASE("Traffic: a robot that cannot move is an obstacle, and no robot drives where it would be cut off by it")
{
    Traffic traffic = MakeTraffic();
    traffic.AddRobot("lr", 7);
    REQUIRE(traffic.TryStand(2, 7));
    traffic.SetMovable(2, true);
    REQUIRE(traffic.Extend(2, Nodes{2, 3}) == 2);
    traffic.Pass(2, 2);
    traffic.SetMovable(2, false);
    CHECK_FALSE(traffic.CanServe(0, 4));
    CHECK(traffic.CanServe(0, 2));
    CHECK(traffic.CanServe(1, 4));
    CHECK_FALSE(traffic.CanServe(1, 7));
    // Robot 0 may drive up to it and retreat.
    CHECK(traffic.Extend(0, Nodes{0, 1, 2, 3}) == 3);
    traffic.SetMovable(2, true);
    CHECK(traffic.CanServe(0, 4));
}

TEST_CASE("Traffic: a lost robot holds the nodes that it entered without a reservation, unless another robot has them")
{
    Traffic traffic = MakeTraffic();
    REQUIRE(traffic.Extend(0, Nodes{0}) == 1);
    CHECK(traffic.TryOverrun(0, Nodes{1, 2}));
    CHECK(GetHeld(traffic, 0) == Nodes{5, 0, 1, 2});
    REQUIRE(traffic.Extend(1, Nodes{4, 3}) == 2);
    CHECK_FALSE(traffic.TryOverrun(0, Nodes{3}));
    CHECK_FALSE(traffic.TryStand(0, 3));
    CHECK(GetHeld(traffic, 0) == Nodes{5, 0, 1, 2});
}

TEST_CASE("Traffic: a robot that is stationary between two nodes holds both until it has passed the first")
{
    Traffic traffic = MakeTraffic();
    REQUIRE(traffic.Extend(0, Nodes{0, 1, 2}) == 3);
    traffic.Pass(0, 1);
    REQUIRE(traffic.TryStand(0, 0, Nodes{1}));
    CHECK(traffic.GetHolderOrNull(1) == 0);
    CHECK(traffic.GetHolderOrNull(2) == std::nullopt);
    CHECK(traffic.Extend(1, Nodes{4, 3, 2, 1}) == 3);
    CHECK(traffic.Extend(0, Nodes{1}) == 1);
    traffic.Pass(0, 1);
    CHECK(traffic.GetHolderOrNull(0) == std::nullopt);
    CHECK(traffic.GetHolderOrNull(1) == 0);
}

TEST_CASE("Traffic: nodes whose distance is less than the clearance exclude each other")
{
    for (const double clearance : {0.0, 0.5})
    {
        Traffic traffic = MakeTraffic(clearance);
        traffic.AddRobot("lr", std::nullopt);
        REQUIRE(traffic.TryStand(2, 8));
        CHECK(traffic.IsNear(3, 8) == (clearance > 0));
        CHECK(traffic.Extend(1, Nodes{4, 3}) == (clearance > 0 ? 1 : 2));
    }
}

TEST_CASE("Traffic: released nodes and a robot that recovers change the count of freed nodes")
{
    Traffic traffic = MakeTraffic();
    REQUIRE(traffic.Extend(0, Nodes{0, 1}) == 2);
    const std::uint64_t before = traffic.GetFreedCount();
    CHECK(traffic.Extend(1, Nodes{0}) == 0);
    CHECK(traffic.GetFreedCount() == before);
    traffic.Pass(0, 1);
    CHECK(traffic.GetFreedCount() > before);
    const std::uint64_t passed = traffic.GetFreedCount();
    traffic.SetMovable(1, false);
    CHECK(traffic.GetFreedCount() > passed);
}
