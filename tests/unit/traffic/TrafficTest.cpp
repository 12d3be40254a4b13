#include "traffic/Traffic.hpp"

#include "Catch.hpp"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>
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

enum class EUse
{
    Always,
    Empty,
    Loaded,
};

struct Way
{
    std::size_t from = 0;
    std::size_t to = 0;
    EUse use = EUse::Always;
};

/// Each way in both directions.
std::vector<Way> MakeBothWays(std::vector<Way> ways)
{
    const std::size_t count = ways.size();
    for (std::size_t i = 0; i < count; ++i)
    {
        ways.push_back({ways[i].to, ways[i].from, ways[i].use});
    }
    return ways;
}

/// Nodes in a row.
SiteMap MakeNodes(std::size_t count, const std::vector<Way>& ways)
{
    std::vector<SiteNode> nodes;
    for (std::size_t i = 0; i < count; ++i)
    {
        nodes.push_back({std::to_string(i), static_cast<double>(i), 0, "floor", {{"lr", std::nullopt}}});
    }
    std::vector<SiteEdge> edges;
    for (const Way& way : ways)
    {
        SiteEdgeRule rule;
        rule.vehicleTypeID = "lr";
        rule.loadRestriction = SiteLoadRestriction{way.use != EUse::Loaded, way.use != EUse::Empty};
        const std::string from = std::to_string(way.from);
        const std::string to = std::to_string(way.to);
        edges.push_back({fmt::format("{}>{}", from, to), from, to, {rule}});
    }
    return *SiteMap::Create(std::move(nodes), std::move(edges), {});
}

/// Four nodes in a row.
SiteMap MakeRow(const std::vector<Way>& ways)
{
    return MakeNodes(4, ways);
}

/// Robot 0 on its parking position 0; robot 1 on node 3, from where it cannot park.
Traffic MakeRestricted(const std::vector<Way>& ways)
{
    Traffic traffic(MakeRow(ways), 0);
    traffic.AddRobot("lr", 0);
    traffic.AddRobot("lr", std::nullopt);
    REQUIRE(traffic.TryStand(0, 0));
    REQUIRE(traffic.TryStand(1, 3));
    traffic.SetMovable(0, true);
    return traffic;
}

Nodes GetHeld(const Traffic& traffic, std::size_t robot)
{
    return {traffic.GetHeld(robot).begin(), traffic.GetHeld(robot).end()};
}

/// Adds a movable robot for each parking position.
void PlaceRobots(Traffic& traffic, const Nodes& homes, const Nodes& places)
{
    for (std::size_t robot = 0; robot < homes.size(); ++robot)
    {
        traffic.AddRobot("lr", homes[robot]);
        REQUIRE(traffic.TryStand(robot, places[robot]));
        traffic.SetMovable(robot, true);
    }
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
    // Robot 0 is on 0 and has the parking position 6. Robot 1 is on 6, has 7, and must enter it first. Robot 2 has 5.
    Traffic traffic(MakeCorridor(), 0);
    const Nodes homes{6, 7, 5};
    const Nodes places{0, 6, 5};
    PlaceRobots(traffic, homes, places);
    // Robot 0 on 2 or beyond would block robot 1 from 7, and robot 1 would block robot 0 from 6.
    REQUIRE(traffic.Extend(0, Nodes{1}) == 1);
    traffic.Pass(0, 1);
    CHECK(traffic.Extend(0, Nodes{2}) == 0);
    CHECK(traffic.GetBlockers() == Nodes{1});
    CHECK(traffic.Extend(1, Nodes{4, 3, 2, 7}) == 4);
    traffic.Pass(1, 4);
    CHECK(traffic.Extend(0, Nodes{2, 3, 4, 6}) == 4);
}

TEST_CASE(
    "Traffic: a robot may drive where it can wait beside the lane, even if it cannot park, and others leave that place free")
{
    // As before, but node 5 is a refuge: robot 0 waits there while robot 1 parks.
    Traffic traffic(MakeCorridor(), 0);
    traffic.AddRobot("lr", 6);
    traffic.AddRobot("lr", 7);
    REQUIRE(traffic.TryStand(0, 0));
    REQUIRE(traffic.TryStand(1, 6));
    traffic.SetMovable(0, true);
    traffic.SetMovable(1, true);
    CHECK(traffic.Extend(0, Nodes{1, 2}) == 2);
    CHECK_FALSE(traffic.FindRefugeOrNull(0) == 6);
    CHECK(traffic.FindRefugeOrNull(0) == 5);
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
    traffic.HoldPossible(0, Nodes{3});
    REQUIRE(traffic.TryStand(1, 4));
    REQUIRE(traffic.GetHolderOrNull(3) == 0);
    CHECK(traffic.TryOverrun(0, Nodes{3}));
    CHECK(GetHeld(traffic, 0) == Nodes{5, 0, 1, 2, 3});
    traffic.Pass(0, 4);
    CHECK(traffic.GetHolderOrNull(3) == 0);
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

TEST_CASE(
    "Traffic: a robot between two nodes is granted the second one, whatever is on the way to its parking position")
{
    // Lane 0-1-2-3-4-5 with the parking positions 6, 7 and 8 on 5. Robot 1 is in the way of robot 0, and 0 in that of 2.
    const std::vector<Way> ways = MakeBothWays({{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}, {5, 6}, {5, 7}, {5, 8}});
    Traffic traffic(MakeNodes(9, ways), 0);
    PlaceRobots(traffic, Nodes{6, 7, 8}, Nodes{1, 4, 0});
    traffic.AddRobot("lr", 0); // so that 0 is no refuge
    REQUIRE(traffic.TryStand(0, 1, {}, Nodes{2}));
    traffic.SetHeading(0, 2);
    CHECK(traffic.Extend(0, Nodes{2, 3}) == 2);
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

TEST_CASE("Traffic: a robot drives only where it could park with a load as well as without")
{
    for (const EUse shortcut : {EUse::Always, EUse::Empty, EUse::Loaded})
    {
        // The only other way back from 2 is over 3.
        Traffic traffic = MakeRestricted({{0, 1}, {1, 0}, {1, 2}, {2, 1, shortcut}, {2, 3}, {3, 1}});
        CHECK(traffic.Extend(0, Nodes{1, 2}) == (shortcut == EUse::Always ? 2 : 1));
        CHECK(traffic.CanServe(0, 2) == (shortcut == EUse::Always));
    }
}

TEST_CASE("Traffic: a station that is entered with a load and left without one needs a route from there without a load")
{
    Traffic open = MakeRestricted({{0, 1}, {1, 0}, {1, 2, EUse::Loaded}, {2, 1, EUse::Empty}});
    CHECK(open.Extend(0, Nodes{1, 2}) == 2);
    CHECK(open.CanServe(0, 2));
    Traffic blocked = MakeRestricted({{0, 1}, {1, 0}, {1, 2, EUse::Loaded}, {2, 3, EUse::Empty}, {3, 1}});
    CHECK_FALSE(blocked.CanServe(0, 2));
    CHECK(blocked.CanServe(0, 1));
    CHECK(blocked.Extend(0, Nodes{1, 2}) == 1);
}

TEST_CASE("Traffic: a robot that can reach its parking position with one load only has no guarantee")
{
    for (const EUse home : {EUse::Always, EUse::Empty, EUse::Loaded})
    {
        Traffic traffic = MakeRestricted({{0, 1}, {1, 0, home}, {1, 2}, {2, 3}, {3, 1}});
        CHECK(traffic.Extend(0, Nodes{1, 2}) == (home == EUse::Always ? 1 : 2));
    }
}

TEST_CASE("Traffic: a node is a dead end only if it is one with and without a load")
{
    const auto isSpur = [](const std::vector<Way>& ways) {
        return MakeRestricted(ways).IsSpur("lr", 2);
    };
    CHECK(isSpur({{1, 2}, {2, 1}}));
    CHECK(isSpur({{1, 2}, {2, 1}, {0, 1, EUse::Empty}}));
    CHECK_FALSE(isSpur({{1, 2}, {2, 1}, {2, 3, EUse::Loaded}}));
    CHECK_FALSE(isSpur({{1, 2}, {2, 1}, {3, 2, EUse::Empty}}));
    CHECK_FALSE(isSpur({{1, 2}, {2, 1, EUse::Loaded}}));
}

TEST_CASE("Traffic: a robot between two nodes leaves from the second one, unless another robot is there")
{
    Traffic traffic = MakeRestricted({{0, 1}, {1, 0}, {1, 2}, {2, 3}, {3, 1}});
    REQUIRE(traffic.TryStand(0, 1, {}, Nodes{2, 3}));
    CHECK(traffic.CanServe(0, 1));
    traffic.SetHeading(0, 3);
    CHECK(traffic.CanServe(0, 1));
    traffic.SetHeading(0, 2);
    CHECK_FALSE(traffic.CanServe(0, 1)); // the way back is by node 3
    traffic.SetHeading(0, std::nullopt);
    CHECK(traffic.CanServe(0, 1));
}

TEST_CASE("Traffic: a robot between two nodes is granted no node from which it cannot park")
{
    Traffic traffic(MakeRow({{0, 1}, {1, 0}, {1, 2}, {2, 1}, {2, 3}}), 0);
    traffic.AddRobot("lr", 0);
    traffic.SetMovable(0, true);
    REQUIRE(traffic.TryStand(0, 1, {}, Nodes{2}));
    traffic.SetHeading(0, 2);
    CHECK(traffic.Extend(0, Nodes{2, 3}) == 1);
    CHECK(GetHeld(traffic, 0) == Nodes{1, 2});
}

TEST_CASE("Traffic: a node that a robot holds and is to pass again is granted after it has passed it")
{
    Traffic traffic = MakeRestricted({{0, 1}, {1, 0}, {1, 2}, {2, 1}});
    REQUIRE(traffic.TryStand(0, 1));
    CHECK(traffic.Extend(0, Nodes{2, 1, 0}) == 1);
    traffic.Pass(0, 1);
    CHECK(traffic.Extend(0, Nodes{1, 0}) == 2);
    CHECK(GetHeld(traffic, 0) == Nodes{2, 1, 0});
}

TEST_CASE("Traffic: a blocked node is not granted, and a robot beyond it does not stop one that can park around it")
{
    Traffic traffic = MakeTraffic();
    REQUIRE(traffic.TryStand(0, 3)); // its parking position 5 is beyond node 2
    std::vector<bool> blocked(9, false);
    blocked[2] = true;
    traffic.SetBlocked(blocked, std::vector<bool>(14, false));
    CHECK(traffic.Extend(0, Nodes{2, 1}) == 0);
    CHECK(traffic.IsRefusedForBlocks());
    CHECK(traffic.GetBlockers().empty());
    CHECK(traffic.Extend(1, Nodes{4}) == 1); // from its parking position 6, to which it can return
    CHECK_FALSE(traffic.IsRefusedForBlocks());
    CHECK(traffic.Extend(0, Nodes{4}) == 0);
    traffic.SetBlocked(std::vector<bool>(9, false), std::vector<bool>(14, false));
    CHECK(traffic.Extend(0, Nodes{2, 1}) == 2);
}

TEST_CASE("Traffic: a robot is not granted nodes from where blocks cut off its parking position")
{
    Traffic traffic = MakeTraffic();
    std::vector<bool> blocked(14, false);
    blocked[3] = true; // the edge from 2 to 1
    traffic.SetBlocked(std::vector<bool>(9, false), blocked);
    traffic.AddRobot("lr", 7);
    CHECK(traffic.Extend(0, Nodes{0, 1}) == 2);
    CHECK(traffic.Extend(0, Nodes{2}) == 0);
    CHECK(traffic.IsRefusedForBlocks());
}

TEST_CASE(
    "Traffic: where blocks cut off its parking position, a robot may use a refuge, but serves only what its stand-in allows")
{
    Traffic traffic = MakeTraffic();
    std::vector<bool> blocked(14, false);
    blocked[3] = true; // the edge from 2 to 1
    traffic.SetBlocked(std::vector<bool>(9, false), blocked);
    CHECK(traffic.Extend(0, Nodes{0, 1, 2}) == 3);
    traffic.Pass(0, 3);
    CHECK(traffic.FindRefugeOrNull(0) == 7); // beside node 2
    CHECK_FALSE(traffic.CanServe(0, 7));
    traffic.SetStandIn(0, 7);
    CHECK(traffic.CanServe(0, 7));
    CHECK(traffic.Extend(0, Nodes{7}) == 1);
}

TEST_CASE("Traffic: while there are blocks, the state stays safe for the time after them")
{
    Traffic traffic = MakeTraffic();
    REQUIRE(traffic.TryStand(0, 4)); // parks by 3, 2, 1 and 0
    traffic.AddRobot("lr", 7);       // so that it is no refuge
    REQUIRE(traffic.TryStand(1, 7)); // parks by 2, 3 and 4, after robot 0
    std::vector<bool> blocked(9, false);
    blocked[0] = true;
    traffic.SetBlocked(blocked, std::vector<bool>(14, false));
    CHECK(traffic.Extend(1, Nodes{2}) == 0); // none of the two could ever park
    CHECK(traffic.GetBlockers() == Nodes{0});
    CHECK_FALSE(traffic.IsRefusedForBlocks());
}

TEST_CASE("Traffic: no robot takes the refuge that another one needs")
{
    // Lane 0-1-2-3-4 with spurs 5 on 0, 6 and 9 on 4, 7 and 8 on 2. Robots 0 and 1 are in each other's way to their parking positions 6
    // and 5: one of them must wait in 7, because 8 and 9 have robots of their own.
    const std::vector<Way> ways =
        MakeBothWays({{0, 1}, {1, 2}, {2, 3}, {3, 4}, {0, 5}, {4, 6}, {2, 7}, {2, 8}, {4, 9}});
    Traffic traffic(MakeNodes(10, ways), 0);
    const Nodes homes{6, 5, 9};
    const Nodes places{1, 3, 8};
    PlaceRobots(traffic, homes, places);
    traffic.AddRobot("lr", 8); // it is elsewhere
    // Robot 2 could not leave 7 any more.
    CHECK(traffic.Extend(2, Nodes{2, 7}) == 0);
    CHECK(traffic.Extend(0, Nodes{2, 7}) == 2);
    traffic.Pass(0, 2);
    CHECK(traffic.Extend(1, Nodes{2, 1, 0, 5}) == 4);
}

TEST_CASE("Traffic: no robot takes as its refuge where another one parks during a block")
{
    // As above. Robot 0 cannot get to 9 and parks in 7; after it robot 1 can go to 6.
    const std::vector<Way> ways =
        MakeBothWays({{0, 1}, {1, 2}, {2, 3}, {3, 4}, {0, 5}, {4, 6}, {2, 7}, {2, 8}, {4, 9}});
    const SiteMap site = MakeNodes(10, ways);
    Traffic traffic(site, 0);
    PlaceRobots(traffic, Nodes{9, 6}, Nodes{3, 1});
    traffic.AddRobot("lr", 5); // they are elsewhere
    traffic.AddRobot("lr", 8);
    std::vector<bool> blocked(site.GetNodes().size(), false);
    blocked[9] = true;
    traffic.SetBlocked(blocked, std::vector<bool>(site.GetEdges().size(), false));
    traffic.SetStandIn(0, 7);
    CHECK(traffic.Extend(1, Nodes{2, 7}) == 0);
}

TEST_CASE("Traffic: a dead end within the clearance of a lane, or without a way back, is no refuge")
{
    for (const double clearance : {0.0, 2.5})
    {
        Traffic traffic = MakeTraffic(clearance);
        REQUIRE(traffic.TryStand(0, 2));
        CHECK(traffic.FindRefugeOrNull(0) == (clearance > 0 ? std::nullopt : std::optional<std::size_t>(7)));
    }
    for (const bool bBack : {false, true})
    {
        std::vector<Way> ways{{0, 1}, {1, 0}, {1, 2}, {2, 3}, {3, 2}};
        if (bBack)
        {
            ways.push_back({2, 1});
        }
        Traffic traffic = MakeRestricted(ways);
        REQUIRE(traffic.TryStand(1, 2));
        REQUIRE(traffic.TryStand(0, 1));
        REQUIRE(traffic.TryStand(1, 0)); // on the parking position of robot 0
        CHECK(traffic.FindRefugeOrNull(0) == (bBack ? std::optional<std::size_t>(3) : std::nullopt));
    }
}

TEST_CASE("Traffic: a robot stops before it closes the way of the robot at its target")
{
    Traffic traffic = MakeTraffic();
    CHECK(traffic.CountBeforeWayOut(1, Nodes{4, 3, 2, 1, 0, 5}, 7) == 6); // 7 is free
    REQUIRE(traffic.TryStand(0, 7));                                      // its way to 5 begins with 2
    CHECK(traffic.CountBeforeWayOut(1, Nodes{4, 3, 2, 7}, 7) == 2);
    CHECK(traffic.CountBeforeWayOut(1, Nodes{4}, 7) == 1);
}
