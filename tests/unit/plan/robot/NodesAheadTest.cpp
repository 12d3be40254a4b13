#include "robot/NodesAhead.hpp"

#include "Catch.hpp"

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace

namespace
{

using Indices = std::vector<std::size_t>;

/// Three nodes, 10 m apart on the x axis. The first edge may have a corridor.
SiteMap MakeLine(const std::optional<SiteCorridor>& corridorOrNull = std::nullopt)
{
    std::vector<SiteNode> nodes(3);
    for (std::size_t i = 0; i < nodes.size(); ++i)
    {
        nodes[i].nodeID = std::string(1, static_cast<char>('A' + i));
        nodes[i].x = 10.0 * static_cast<double>(i);
    }
    return *SiteMap::Create(nodes, {{"A>B", "A", "B", {}, corridorOrNull}, {"B>C", "B", "C", {}}}, {});
}

StateChanged MakeStopped(double x, double y = 0)
{
    StateChanged state;
    state.bPoseKnown = true;
    state.x = x;
    state.y = y;
    return state;
}

Indices Find(const std::optional<StateChanged>& stateOrNull)
{
    const Indices ahead{1, 2};
    return FindNodesAhead(MakeLine(), stateOrNull, 0, ahead);
}

} // namespace

TEST_CASE("FindNodesAhead: a robot that drives or is disconnected keeps all nodes ahead")
{
    StateChanged driving = MakeStopped(0);
    driving.bDriving = true;
    CHECK(Find(driving) == Indices{1, 2});
    CHECK(Find(std::nullopt) == Indices{1, 2});
}

TEST_CASE("FindNodesAhead: a robot that is stationary on its node keeps none")
{
    CHECK(Find(MakeStopped(0.4)).empty());
    CHECK(FindNodesAhead(MakeLine(), MakeStopped(5), 0, {}).empty());
}

TEST_CASE("FindNodesAhead: a robot that is stationary between two nodes keeps these")
{
    CHECK(Find(MakeStopped(5)) == Indices{1});
    CHECK(Find(MakeStopped(15)) == Indices{1, 2});
}

TEST_CASE("FindNodesAhead: a robot away from the route, or without a pose, keeps none")
{
    CHECK(Find(MakeStopped(5, 0.6)).empty());
    StateChanged lost = MakeStopped(5);
    lost.bPoseKnown = false;
    CHECK(Find(lost).empty());
}

TEST_CASE(
    "A robot that is stationary on a curve keeps the nodes of the edge, although it is far from the straight line")
{
    std::vector<SiteNode> nodes(3);
    for (std::size_t i = 0; i < nodes.size(); ++i)
    {
        nodes[i].nodeID = std::string(1, static_cast<char>('A' + i));
        nodes[i].x = 10.0 * static_cast<double>(i);
        nodes[i].rules = {{"lr", {}}};
    }
    SiteEdgeRule bent;
    bent.vehicleTypeID = "lr";
    bent.trajectory = ACS::Core::Nurbs{2, {0, 0, 0, 1, 1, 1}, {{0, 0, {}}, {5, 8, {}}, {10, 0, {}}}};
    const SiteMap map = *SiteMap::Create(nodes, {{"A>B", "A", "B", {bent}}, {"B>C", "B", "C", {}}}, {});
    const Indices ahead{1, 2};
    CHECK(FindNodesAhead(map, MakeStopped(5, 4), 0, ahead) == Indices{1});
    CHECK(FindNodesAhead(map, MakeStopped(5, -4), 0, ahead).empty());
    CHECK(FindNodesAhead(map, MakeStopped(15, 4), 0, ahead).empty());
    CHECK(FindNodesBeside(map, MakeStopped(5, 4), 0) == Indices{1});
    CHECK(FindNodesBeside(map, MakeStopped(5, 4), 1) == Indices{0});
}

TEST_CASE(
    "FindNodesBeside: a robot off its node whose route is unknown is between it and a neighbour, in either direction")
{
    const SiteMap line = MakeLine();
    CHECK(FindNodesBeside(line, MakeStopped(0), 0).empty());
    CHECK(FindNodesBeside(line, MakeStopped(0.5), 0).empty()); // within the deviation of a drive
    CHECK(FindNodesBeside(line, MakeStopped(0.6), 0) == Indices{1});
    CHECK(FindNodesBeside(line, MakeStopped(5), 0) == Indices{1});
    CHECK(FindNodesBeside(line, MakeStopped(5), 1) == Indices{0});
    CHECK(FindNodesBeside(line, MakeStopped(15), 1) == Indices{2});
    CHECK(FindNodesBeside(line, MakeStopped(5, 0.6), 0).empty());
    StateChanged driving = MakeStopped(5);
    driving.bDriving = true;
    CHECK(FindNodesBeside(line, driving, 0).empty());
}

TEST_CASE("A robot that is stationary beside the line, in the corridor of the edge, keeps the nodes of the edge")
{
    const Indices ahead{1, 2};
    const StateChanged beside = MakeStopped(8, 1);
    const SiteMap narrow = MakeLine();
    CHECK(FindNodesAhead(narrow, beside, 0, ahead).empty());
    CHECK(FindNodesBeside(narrow, beside, 0).empty());
    const SiteMap wide = MakeLine(SiteCorridor{0.7, 1.5});
    CHECK(FindNodesAhead(wide, beside, 0, ahead) == Indices{1});
    CHECK(FindNodesBeside(wide, beside, 0) == Indices{1});
    CHECK(FindNodesBeside(wide, beside, 1) == Indices{0});
    CHECK(FindNodesAhead(wide, MakeStopped(8, 2.1), 0, ahead).empty());
    CHECK(FindNodesAhead(wide, MakeStopped(15, 1), 0, ahead).empty());
}

TEST_CASE("A robot that is stationary beside a curve, in the corridor of the edge, keeps the nodes of the edge")
{
    SiteEdgeRule bent;
    bent.vehicleTypeID = "lr";
    bent.trajectory = ACS::Core::Nurbs{2, {0, 0, 0, 1, 1, 1}, {{0, 0, {}}, {5, 8, {}}, {10, 0, {}}}};
    std::vector<SiteNode> nodes(2);
    nodes[0].nodeID = "A";
    nodes[0].rules = {{"lr", {}}};
    nodes[1] = nodes[0];
    nodes[1].nodeID = "B";
    nodes[1].x = 10;
    const SiteMap map = *SiteMap::Create(nodes, {{"A>B", "A", "B", {bent}, SiteCorridor{1.5, 1.5}}}, {});
    CHECK(FindNodesAhead(map, MakeStopped(5, 9.5), 0, Indices{1}) == Indices{1});
    CHECK(FindNodesBeside(map, MakeStopped(5, 9.5), 0) == Indices{1});
    CHECK(FindNodesAhead(map, MakeStopped(5, 10.5), 0, Indices{1}).empty());
}
