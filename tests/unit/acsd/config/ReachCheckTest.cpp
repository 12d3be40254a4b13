#include "config/ReachCheck.hpp"

#include "Catch.hpp"
#include "config/MapFixture.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Acsd::Test
{

namespace
{

/// A map with a start S of the robot LR01 ("lr") and docks A, B and C, each of the station of its name.
struct ReachFixture : MapFixture
{
    ReachFixture()
    {
        AddNode("S");
        for (const char* const name : {"A", "B", "C"})
        {
            AddNode(name);
            AddStation(name);
            AddEdge("S", name);
            AddEdge(name, "S");
        }
        AddRobot("LR01", "lr", "S");
    }

    void AddNode(const std::string& nodeID)
    {
        MapFixture::AddNode(nodeID, 3.0 * static_cast<double>(nodes.size()), 0);
    }

    [[nodiscard]] std::vector<std::string> Find() const
    {
        const Planning::SiteMap site = MakeSite();
        return FindUnreachableStations(options, site, site);
    }
};

using Lines = std::vector<std::string>;

} // namespace

TEST_CASE_METHOD(ReachFixture, "A map on which robots reach all stations with and without a load has no warning")
{
    CHECK(Find().empty());
    Restrict("S-A", true, false); // from B and C it is reached with a load too
    AddEdge("B", "A");
    CHECK(Find().empty());
}

TEST_CASE_METHOD(ReachFixture, "A station without edges for a vehicle type is reported with the type and the reason")
{
    GetEdge("S-A").rules[0].vehicleTypeID = "other";
    CHECK(
        Find()
        == Lines{
            "site.map: lr cannot reach the station st-A, because no edge with properties for this vehicle type ends "
            "at its nodes"});
    AddNode("X");
    AddEdge("X", "A"); // and no edge to X
    CHECK(
        Find()
        == Lines{
            "site.map: lr cannot reach the station st-A, because no edges with properties for this vehicle type lead "
            "there from the start_node of its robots"});
}

TEST_CASE_METHOD(ReachFixture, "A station that load restrictions close, or close for one load, is reported")
{
    Restrict("S-A", true, false);
    Restrict("S-B", false, true);
    Restrict("S-C", false, false);
    CHECK(
        Find()
        == Lines{
            "site.map: lr cannot reach the station st-A with a load, because edges have a loadRestriction",
            "site.map: lr cannot reach the station st-B without a load, because edges have a loadRestriction",
            "site.map: lr cannot reach the station st-C, because edges have a loadRestriction"});
}

TEST_CASE_METHOD(ReachFixture, "A station behind an edge for loaded vehicles is reached from where they are loaded")
{
    AddNode("D");
    stations.push_back({"st-D", {"D"}});
    AddEdge("A", "D");
    AddEdge("D", "A");
    Restrict("A-D", false, true); // and without a load from D itself, where the load is put down
    CHECK(
        Find()
        == Lines{"site.map: lr cannot reach the station st-D without a load, because edges have a loadRestriction"});
    AddEdge("D", "B");
    AddNode("E");
    stations.push_back({"st-E", {"E"}});
    AddEdge("D", "E");
    Restrict("D-E", true, false); // only after the load was put down on D
    CHECK(Find().size() == 2);
}

TEST_CASE_METHOD(ReachFixture, "An edge that a factsheet closes is the reason why a station is not reached")
{
    const Planning::SiteMap open = MakeSite();
    GetEdge("S-A").rules.clear();
    CHECK(
        FindUnreachableStations(options, open, MakeSite())
        == Lines{
            "site.map: lr cannot reach the station st-A, because the factsheet of a robot closes edges of the map, "
            "see above"});
}

TEST_CASE_METHOD(
    ReachFixture,
    "Stations that are not meant for a vehicle type, or reached from a neighbour, are not reported")
{
    SECTION("the type may not use its nodes")
    {
        nodes[1].rules.clear();
        CHECK(Find().empty());
    }
    SECTION("it is the parking position of another type")
    {
        for (Planning::SiteNode& node : nodes)
        {
            node.rules.push_back({"cr", std::nullopt});
        }
        AddRobot("CR01", "cr", "A");
        options.robots.back().homeStationID = "st-A";
        GetEdge("S-A").rules.clear();
        const Lines lines = Find();
        CHECK(std::ranges::none_of(lines, [](const std::string& line) { return line.find("lr cannot") != line.npos; }));
        CHECK(lines.size() == 2); // cr has no edges: it stays on st-A
    }
    SECTION("a robot on a neighbour works there")
    {
        GetEdge("S-A").rules.clear();
        options.reach["st-B"] = {"st-A"};
        CHECK(Find().empty());
    }
}

TEST_CASE_METHOD(ReachFixture, "Robots of a type that start in different places share the stations")
{
    edges.clear();
    AddEdge("S", "A");
    AddRobot("LR02", "lr", "B");
    AddEdge("B", "C");
    CHECK(Find().empty());
}

TEST_CASE_METHOD(ReachFixture, "The number of warnings about a large map is limited")
{
    for (int i = 0; i < 1'000; ++i)
    {
        const std::string name = "N" + std::to_string(i);
        AddNode(name);
        stations.push_back({"st-" + name, {name}});
        AddEdge(i % 2 == 0 ? "S" : "N" + std::to_string(i - 1), name);
        AddEdge(name, "S");
    }
    for (int i = 0; i < 9; ++i)
    {
        const std::string type = "type-" + std::to_string(i);
        for (Planning::SiteNode& node : nodes)
        {
            node.rules.push_back({type, std::nullopt});
        }
        AddRobot("LR1" + std::to_string(i), type, "N" + std::to_string(i));
    }
    const Planning::SiteMap site = MakeSite();
    const Lines lines = FindUnreachableStations(options, site, site);
    REQUIRE(lines.size() == MOST_REACH_WARNINGS);
    CHECK(lines.front().starts_with("site.map: type-0 cannot reach the station st-A, "));
    // Each type has no edges and reaches the station of its start only.
    CHECK(lines.back() == "site.map: " + std::to_string(9 * 1'002 - 19) + " more stations cannot be reached");
}

} // namespace ACS::Acsd::Test
