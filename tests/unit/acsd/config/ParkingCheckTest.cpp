#include "config/ParkingCheck.hpp"

#include "Catch.hpp"
#include "config/MapFixture.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Acsd::Test
{

namespace
{

/// A one-way loop L1, L2, L3, L4 of vehicles "lr", 4 m between its nodes. Spurs of 2 m, in both directions, lead to the docks A of
/// L1, B of L2, C of L3 and D of L4, each with a station of its name. LR01 parks on D, LR02 on C.
struct ParkingFixture : MapFixture
{
    ParkingFixture()
    {
        AddNode("L1", 0, 0);
        AddNode("L2", 4, 0);
        AddNode("L3", 4, 4);
        AddNode("L4", 0, 4);
        for (const auto& [from, to] : {std::pair("L1", "L2"), {"L2", "L3"}, {"L3", "L4"}, {"L4", "L1"}})
        {
            AddEdge(from, to);
        }
        AddSpur("A", "L1", 0, -2);
        AddSpur("B", "L2", 4, -2);
        AddSpur("C", "L3", 4, 6);
        AddSpur("D", "L4", 0, 6);
        AddRobot("LR01", "lr", "D");
        AddRobot("LR02", "lr", "C");
    }

    void AddSpur(const std::string& name, const std::string& lane, double x, double y)
    {
        AddNode(name, x, y);
        AddStation(name);
        AddEdge(lane, name);
        AddEdge(name, lane);
    }

    /// It starts on its parking position.
    void AddRobot(const std::string& name, const std::string& vehicleTypeID, const std::string& parkingNode)
    {
        MapFixture::AddRobot(name, vehicleTypeID, parkingNode).homeStationID = "st-" + parkingNode;
    }

    void Remove(const std::string& edgeID)
    {
        std::erase_if(edges, [&edgeID](const Planning::SiteEdge& edge) { return edge.edgeID == edgeID; });
    }

    [[nodiscard]] std::vector<std::string> Find() const
    {
        const Planning::SiteMap site = MakeSite();
        return FindParkingFaults(options, site);
    }
};

using Lines = std::vector<std::string>;

} // namespace

TEST_CASE_METHOD(ParkingFixture, "Parking positions that are reached from every station have no warning")
{
    CHECK(Find().empty());
}

TEST_CASE_METHOD(
    ParkingFixture,
    "A parking position that cannot be reached is reported, also if the robot starts there")
{
    Remove("L4-D");
    CHECK(Find() == Lines{"robots.LR01: its parking position st-D cannot be reached; it may block other robots"});
    Restrict("L3-C", true, false);
    CHECK(
        Find()
        == Lines{
            "robots.LR01: its parking position st-D cannot be reached; it may block other robots",
            "robots.LR02: its parking position st-C cannot be reached with a load; it may block other robots"});
}

TEST_CASE_METHOD(ParkingFixture, "The charger of a robot without home is its parking position")
{
    options.robots[0].chargingStationID = std::exchange(options.robots[0].homeStationID, std::nullopt);
    Remove("L4-D");
    CHECK(Find() == Lines{"robots.LR01: its parking position st-D cannot be reached; it may block other robots"});
}

TEST_CASE_METHOD(ParkingFixture, "A parking position is not reported if there is no other station")
{
    stations.erase(stations.begin(), stations.begin() + 3);
    options.robots.pop_back();
    Remove("L4-D");
    CHECK(Find().empty());
}

TEST_CASE_METHOD(ParkingFixture, "A charger that is entered without a load only is reported as such")
{
    AddSpur("E", "L2", 6, 0);
    options.robots.front().chargingStationID = "st-E";
    CHECK(Find().empty());
    Restrict("L2-E", true, false);
    Restrict("E-L2", true, GENERATE(false, true));
    CHECK(
        Find()
        == Lines{
            "robots.LR01: its charging station st-E cannot be reached with a load; with a low battery it may block "
            "other robots"});
}

TEST_CASE_METHOD(ParkingFixture, "A station from which no route leads to a parking position is reported with the load")
{
    Restrict("B-L2", true, false);
    SECTION("with a load")
    {
        CHECK(
            Find()
            == Lines{"robots.LR01, robots.LR02: no route leads from st-B to their parking positions with a load; they "
                     "may block other robots if a job fails there"});
    }
    SECTION("without a load")
    {
        Restrict("B-L2", false, true);
        options.robots.pop_back();
        CHECK(
            Find()
            == Lines{"robots.LR01: no route leads from st-B to its parking position st-D without a load; it may block "
                     "other robots if a job fails there"});
    }
    SECTION("at all, though other stations reach it")
    {
        Remove("B-L2");
        Remove("A-L1");
        options.robots.pop_back();
        CHECK(
            Find()
            == Lines{"robots.LR01: no route leads from st-A, st-B to its parking position st-D; it may block other "
                     "robots"});
    }
}

TEST_CASE_METHOD(
    ParkingFixture,
    "A station that a robot cannot enter, or that is the place of another one, need not be left")
{
    SECTION("it may not use the node")
    {
        Remove("B-L2");
        nodes[5].rules[0].vehicleTypeID = "cr";
        CHECK(Find().empty());
    }
    SECTION("no edge leads there")
    {
        Remove("B-L2");
        Remove("L2-B");
        CHECK(Find().empty());
    }
    SECTION("another robot parks there")
    {
        Remove("C-L3");
        Remove("L3-C");
        AddEdge("L3", "C");
        CHECK(Find().empty());
    }
}

TEST_CASE_METHOD(ParkingFixture, "A parking position within the clearance of a lane that others must use is reported")
{
    options.clearance = 1.99;
    CHECK(Find().empty());
    options.clearance = 2;
    const std::string end = ", within traffic.clearance (2.00 m): while LR0";
    const Lines lines{
        "robots.LR01: its parking position st-D is 2.00 m from the node L4" + end
            + "1 is there, no other vehicle enters L4",
        "robots.LR02: its parking position st-C is 2.00 m from the node L3" + end
            + "2 is there, no other vehicle enters L3"};
    CHECK(Find() == lines);
    SECTION("also of a charger that is not the parking position")
    {
        options.robots[0].chargingStationID = "st-A";
        CHECK(
            Find()
            == Lines{
                lines[0],
                "robots.LR01: its charging station st-A is 2.00 m from the node L1" + end
                    + "1 is there, no other vehicle enters L1",
                lines[1]});
    }
    SECTION("but not if there is a way around it")
    {
        AddEdge("L2", "L4"); // past L3
        AddNode("L5", -4, 4);
        AddEdge("L3", "L5"); // past L4
        AddEdge("L5", "L1");
        AddEdge("L2", "L5"); // past both
        CHECK(Find().empty());
    }
    SECTION("nor if it is on another map")
    {
        nodes[7].mapID = "upstairs";
        CHECK(Find() == Lines{lines[1]});
    }
    SECTION("nor if there is no other robot")
    {
        options.robots.pop_back();
        CHECK(Find().empty());
    }
    SECTION("nor if the others are of a type that does not drive there")
    {
        for (const std::size_t node : {0U, 1U, 4U, 5U})
        {
            nodes[node].rules.push_back({"cr", std::nullopt});
        }
        options.robots[1].vehicleTypeID = "cr";
        options.robots[1].homeStationID = "st-A";
        options.clearance = 0;
        CHECK(Find().size() == 1); // it cannot be reached
        options.clearance = 2;
        CHECK(
            Find().back()
            == "robots.LR02: its parking position st-A is 2.00 m from the node L1, within traffic.clearance (2.00 m): "
               "while LR02 is there, no other vehicle enters L1");
        CHECK(Find().size() == 2);
    }
}

TEST_CASE_METHOD(ParkingFixture, "A parking position on a node that others must use is reported")
{
    AddStation("L4");
    SECTION("on the lane")
    {
        options.robots[0].homeStationID = "st-L4";
        CHECK(
            Find()
            == Lines{
                "robots.LR01: its parking position st-L4 is on the node L4, which routes of others use: while LR01 "
                "is there, no other vehicle enters L4"});
    }
    SECTION("on the dock of another station")
    {
        stations.push_back({"st-E", {"D"}});
        CHECK(
            Find()
            == Lines{
                "robots.LR01: its parking position st-D is on the node D, which routes of others use: while LR01 is "
                "there, no other vehicle enters D"});
    }
}

TEST_CASE_METHOD(ParkingFixture, "A spur that leads to a parking position only may be within the clearance")
{
    Remove("L4-D");
    Remove("D-L4");
    AddNode("S", 0, 5);
    AddEdge("L4", "S");
    AddEdge("S", "L4");
    AddEdge("S", "D");
    AddEdge("D", "S");
    options.clearance = 1;
    CHECK(Find().empty());
    AddSpur("E", "S", -2, 5); // others pass the spur to E
    CHECK(
        Find()
        == Lines{"robots.LR01: its parking position st-D is 1.00 m from the node S, within traffic.clearance (1.00 m): "
                 "while LR01 is there, no other vehicle enters S"});
}

TEST_CASE_METHOD(ParkingFixture, "The number of warnings about closed lanes is limited")
{
    for (int i = 10; i < 50; ++i)
    {
        const std::string name = std::to_string(i);
        AddNode("M" + name, 4.0 * i, 0);
        AddEdge(i == 10 ? "L1" : "M" + std::to_string(i - 1), "M" + name);
        AddSpur("E" + name, "M" + name, 4.0 * i, 2);
        AddRobot("LR" + name, "lr", "E" + name);
    }
    AddEdge("M49", "L2");
    options.clearance = 2;
    const Lines lines = Find();
    REQUIRE(lines.size() > 20);
    CHECK(lines.size() <= 22);
    CHECK(lines.back() == "traffic.clearance: the parking positions of further robots were not checked");
}

TEST_CASE_METHOD(ParkingFixture, "Robots that start apart from their parking position are checked for what they enter")
{
    AddNode("X", 40, 0);
    AddSpur("Y", "X", 40, 4);
    AddEdge("X", "L1"); // no way back
    CHECK(Find().empty());
    Remove("Y-X");
    CHECK(Find().empty()); // no robot enters it
    options.robots[1].startNodeID = "X";
    CHECK(
        Find()
        == Lines{"robots.LR02: no route leads from st-Y to its parking position st-C; it may block other robots"});
}

} // namespace ACS::Acsd::Test
