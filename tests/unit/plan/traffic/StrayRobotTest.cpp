#include "Catch.hpp"
#include "fixtures/EngineParts.hpp"

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS::Testing;  // NOLINT(google-build-using-namespace): its fixtures

TEST_CASE("TrafficCoordinator: the node that a robot reports without a grant is reserved until it is on another one")
{
    EngineParts parts;
    parts.BeginDriveToLoad();
    REQUIRE(parts.coordinator.TryAdvance(parts.lr, 1));
    parts.lr.drive->bTaken = true;
    const auto report = [&parts](const std::string& nodeID) {
        parts.lr.view.state->lastNodeID = nodeID;
        parts.coordinator.VerifyRoute(parts.lr);
    };
    const auto getHolder = [&parts](const std::string& nodeID) {
        return parts.places.GetTraffic().GetHolderOrNull(parts.FindNode(nodeID));
    };
    report("D-A01.CP02");
    CHECK(getHolder("D-A01.CP02") == 0U);
    SECTION("it is back")
    {
        report("L02");
        CHECK_FALSE(getHolder("D-A01.CP02").has_value());
        CHECK(getHolder("L02") == 0U);
    }
    SECTION("it passes a node of its route")
    {
        REQUIRE(parts.coordinator.TryAdvance(parts.lr, 1));
        CHECK_FALSE(getHolder("D-A01.CP02").has_value());
    }
    SECTION("it is on another node off its route")
    {
        parts.Discard();
        report("D-A01.CP03");
        CHECK(parts.engine.transaction.IsDispatchNeeded()); // others may enter the former one
        CHECK_FALSE(getHolder("D-A01.CP02").has_value());
        CHECK(getHolder("D-A01.CP03") == 0U);
    }
    SECTION("it is beyond its grant")
    {
        report("D-A01.CP01");
        CHECK_FALSE(getHolder("D-A01.CP02").has_value());
        CHECK(getHolder("D-A01.CP01") == 0U);
        CHECK(parts.coordinator.TryAdvance(parts.lr, 4));
        CHECK(getHolder("D-A01.CP01") == 0U);
    }
    SECTION("it does not know")
    {
        report("");
        CHECK(getHolder("D-A01.CP02") == 0U);
    }
    SECTION("its drive ends before it has reported another one")
    {
        parts.lr.view.state.reset(); // it is disconnected
        parts.coordinator.EndDrive(parts.lr);
        CHECK(getHolder("D-A01.CP02") == 0U);
        parts.PutOn(parts.lr, "L01");
        CHECK_FALSE(getHolder("D-A01.CP02").has_value());
    }
    SECTION("another robot holds it")
    {
        report("L01");
        parts.PutOn(parts.cr, "D-A01.CP02");
        report("D-A01.CP02");
        CHECK(getHolder("D-A01.CP02") == 1U);
        parts.PutOn(parts.cr, "D-CHG02");
        CHECK(getHolder("D-A01.CP02") == 0U);
    }
}

TEST_CASE(
    "TrafficCoordinator: a robot whose drive ends is where its last state shows it, and else on the last node passed")
{
    EngineParts parts;
    parts.BeginDriveToLoad();
    REQUIRE(parts.coordinator.TryAdvance(parts.lr, 1));
    parts.lr.drive->bTaken = true;
    const std::size_t stray = parts.FindNode("D-A01.CP02");
    const auto report = [&parts](const std::string& nodeID) {
        parts.lr.view.state->lastNodeID = nodeID;
        parts.coordinator.VerifyRoute(parts.lr);
    };
    const auto end = [&parts] {
        parts.Discard();
        parts.coordinator.EndDrive(parts.lr);
        return parts.Collect();
    };
    SECTION("it was carried to a free node")
    {
        report("D-A01.CP02");
        CHECK(end().ListClearedAlarms() == std::vector<std::string>{"ACS-1003"});
        CHECK(parts.lr.place.bPlaced);
        CHECK(parts.lr.place.node == stray);
        CHECK(parts.places.GetTraffic().ListReserved(0) == std::vector<std::size_t>{stray});
    }
    SECTION("it was carried to the node of another robot")
    {
        parts.PutOn(parts.cr, "D-A01.CP02");
        report("D-A01.CP02");
        CHECK(end().ListClearedAlarms().empty());
        CHECK_FALSE(parts.lr.place.bPlaced);
    }
    SECTION("it was carried away and has forgotten its last node")
    {
        report("");
        static_cast<void>(end());
        CHECK(parts.lr.place.node == parts.FindNode("L01"));
    }
    SECTION("its last state is from before the node that it passed last")
    {
        report("L01");
        REQUIRE(parts.coordinator.TryAdvance(parts.lr, 2));
        static_cast<void>(end());
        CHECK(parts.lr.place.node == parts.FindNode("L02"));
    }
    SECTION("it had an alarm off its route, and has passed a node of it since")
    {
        report("D-A01.CP02");
        REQUIRE(parts.coordinator.TryAdvance(parts.lr, 2));
        CHECK(end().ListClearedAlarms() == std::vector<std::string>{"ACS-1003"});
        CHECK(parts.lr.place.node == parts.FindNode("L02"));
    }
}
