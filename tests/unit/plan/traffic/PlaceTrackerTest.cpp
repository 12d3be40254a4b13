#include "Catch.hpp"
#include "fixtures/EngineParts.hpp"
#include "fixtures/PlanWorld.hpp"

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS::Testing;  // NOLINT(google-build-using-namespace): its fixtures

TEST_CASE("PlaceTracker: a robot holds the node that it reports, and no other")
{
    EngineParts parts;
    parts.PutOn(parts.lr, "D-A01.CP01");
    CHECK(parts.lr.place.node == parts.FindNode("D-A01.CP01"));
    CHECK(parts.lr.place.position == "A01.CP01");
    CHECK(parts.places.GetTraffic().GetHolderOrNull(parts.FindNode("D-A01.CP01")) == 0U);
    CHECK_FALSE(parts.places.GetTraffic().GetHolderOrNull(parts.FindNode("D-CHG01")).has_value());
    parts.Discard();
    const std::uint64_t changes = parts.places.GetStandingChanges();
    parts.places.Place(parts.lr);
    CHECK(parts.places.GetStandingChanges() == changes);
    CHECK_FALSE(parts.engine.transaction.IsDispatchNeeded());
    parts.PutOn(parts.lr, "L03");
    CHECK(parts.lr.place.position == "A01.CP01");
    CHECK(parts.places.GetStandingChanges() == changes + 1);
    CHECK(parts.engine.transaction.IsDispatchNeeded());
}

TEST_CASE("PlaceTracker: a robot on the node of another one has no position, with an alarm until it moves")
{
    EngineParts parts;
    parts.PutOn(parts.cr, "D-A01.CP01");
    parts.PutOn(parts.lr, "D-CHG01");
    parts.Discard();
    parts.lr.view.state->lastNodeID = "D-A01.CP01";
    parts.places.Place(parts.lr);
    CHECK_FALSE(parts.lr.place.bPlaced);
    CHECK(parts.lr.GetUnavailability() == EUnavailability::Place);
    CHECK(parts.places.GetTraffic().GetHolderOrNull(parts.FindNode("D-A01.CP01")) == 1U);
    CHECK(parts.Collect().ListSetAlarms() == std::vector<std::string>{"ACS-1003"});
    parts.PutOn(parts.lr, "D-A01.CP02");
    CHECK(parts.Collect().ListClearedAlarms() == std::vector<std::string>{"ACS-1003"});
}

TEST_CASE("PlaceTracker: the alarm names the node that another robot holds, not one that is only near it")
{
    EngineOptions options = MakeTestOptions(false);
    options.clearance = 1;
    EngineParts parts(options);
    parts.PutOn(parts.cr, "L05");
    parts.PutOn(parts.lr, "L03");
    parts.Discard();
    parts.lr.view.state->heldNodeIDs = {"L04", "L05"};
    parts.places.Place(parts.lr);
    CHECK_FALSE(parts.lr.place.bPlaced);
    const std::vector<AlarmSet> alarms = parts.Collect().ListChanges<AlarmSet>();
    REQUIRE(alarms.size() == 1);
    CHECK(alarms.front().alarm.message.find("node L05, which is reserved for CR01") != std::string::npos);
}

TEST_CASE("PlaceTracker: an unknown node is an alarm of a robot that had a position")
{
    EngineParts parts;
    parts.lr.view.bOnline = true;
    parts.lr.view.state = StateChanged{};
    parts.places.Place(parts.lr);
    CHECK(parts.Collect().ListSetAlarms().empty());
    parts.PutOn(parts.lr, "D-A01.CP01");
    parts.Discard();
    parts.lr.view.state->lastNodeID = "elsewhere";
    parts.places.Place(parts.lr);
    CHECK(parts.Collect().ListSetAlarms() == std::vector<std::string>{"ACS-1003"});
    CHECK_FALSE(parts.lr.place.bPlaced);
    CHECK(parts.places.GetTraffic().GetHolderOrNull(parts.FindNode("D-A01.CP01")) == 0U);
}

TEST_CASE("PlaceTracker: a robot that lost its position keeps its node, also in the store while it is disconnected")
{
    EngineParts parts;
    parts.PutOn(parts.lr, "D-A01.CP01");
    parts.lr.view.state->lastNodeID.clear();
    parts.places.Place(parts.lr);
    REQUIRE_FALSE(parts.lr.place.bPlaced);
    parts.lr.view.state.reset();
    CHECK(parts.places.ListNodes(parts.lr) == std::vector<std::string>{"D-A01.CP01"});
    CHECK(parts.places.GetTraffic().GetHolderOrNull(parts.FindNode("D-A01.CP01")) == 0U);
}

TEST_CASE("PlaceTracker: a very long unknown node is shortened in the alarm")
{
    EngineParts parts;
    parts.PutOn(parts.lr, "D-A01.CP01");
    parts.Discard();
    parts.lr.view.state->lastNodeID = std::string(10'000, 'n');
    parts.places.Place(parts.lr);
    const std::vector<AlarmSet> alarms = parts.Collect().ListChanges<AlarmSet>();
    REQUIRE(alarms.size() == 1);
    CHECK(alarms.front().alarm.message.find(std::string(200, 'n') + "...") != std::string::npos);
    CHECK(alarms.front().alarm.message.size() < 400);
}

TEST_CASE("PlaceTracker: a robot that forgets its node keeps it while it is on the node or on an edge of it")
{
    EngineParts parts;
    parts.PutOn(parts.lr, "L03");
    const SiteNode& own = parts.engine.site.GetNodes()[parts.FindNode("L03")];
    const SiteNode& next = parts.engine.site.GetNodes()[parts.FindNode("L04")];
    StateChanged& state = *parts.lr.view.state;
    state.lastNodeID.clear();
    state.bPoseKnown = true;
    state.x = own.x;
    state.y = own.y;
    parts.places.Place(parts.lr);
    CHECK(parts.lr.place.bPlaced);
    state.x = own.x + 0.7 * (next.x - own.x);
    state.y = own.y + 0.7 * (next.y - own.y);
    parts.places.Place(parts.lr);
    CHECK(parts.lr.place.bPlaced);
    CHECK(parts.lr.place.node == parts.FindNode("L03"));
    CHECK(parts.places.GetTraffic().GetHolderOrNull(parts.FindNode("L04")) == 0U);
    SECTION("it has been carried away")
    {
        state.x = own.x + 100.0;
    }
    SECTION("its position is unknown")
    {
        state.bPoseKnown = false;
    }
    parts.places.Place(parts.lr);
    CHECK_FALSE(parts.lr.place.bPlaced);
}

TEST_CASE("PlaceTracker: the nodes of a foreign order are kept free and stored")
{
    EngineParts parts;
    parts.PutOn(parts.lr, "L03");
    parts.lr.view.state->heldNodeIDs = {"L04", "L05"};
    parts.places.Place(parts.lr);
    CHECK(parts.places.GetTraffic().GetHolderOrNull(parts.FindNode("L05")) == 0U);
    CHECK(parts.places.ListNodes(parts.lr) == std::vector<std::string>{"L03", "L04", "L05"});
    parts.lr.view.state->heldNodeIDs.clear();
    parts.places.Place(parts.lr);
    CHECK_FALSE(parts.places.GetTraffic().GetHolderOrNull(parts.FindNode("L05")).has_value());
}

TEST_CASE(
    "PlaceTracker: a robot that lost its drive and its pose keeps the nodes ahead of the node with which it comes back")
{
    EngineParts parts;
    const Traffic& traffic = parts.places.GetTraffic();
    parts.PutOn(parts.lr, "L03");
    parts.lr.place.aheadNodes = {parts.FindNode("L04"), parts.FindNode("L05"), parts.FindNode("L06")};
    parts.lr.view.bHadPose = true;
    parts.lr.view.state->bPoseKnown = false;
    parts.lr.view.state->lastNodeID = "L04";
    parts.places.Place(parts.lr);
    CHECK(parts.places.ListNodes(parts.lr) == std::vector<std::string>{"L04", "L05", "L06"});
    CHECK(traffic.GetHolderOrNull(parts.FindNode("L06")) == 0U);
    CHECK_FALSE(traffic.GetHolderOrNull(parts.FindNode("L03")).has_value());
    const SiteNode& node = parts.engine.site.GetNodes()[parts.FindNode("L04")];
    parts.lr.view.state->bPoseKnown = true;
    parts.lr.view.state->x = node.x;
    parts.lr.view.state->y = node.y;
    parts.places.Place(parts.lr);
    CHECK(parts.places.ListNodes(parts.lr) == std::vector<std::string>{"L04"});
    CHECK_FALSE(traffic.GetHolderOrNull(parts.FindNode("L05")).has_value());
}

TEST_CASE("PlaceTracker: a robot that lost its drive and still moves keeps the nodes ahead of each node that it passes")
{
    EngineParts parts;
    parts.PutOn(parts.lr, "L03");
    parts.lr.place.aheadNodes = {parts.FindNode("L04"), parts.FindNode("L05"), parts.FindNode("L06")};
    parts.lr.view.state->bDriving = true;
    parts.lr.view.state->lastNodeID = "L05";
    parts.places.Place(parts.lr);
    CHECK(parts.places.ListNodes(parts.lr) == std::vector<std::string>{"L05", "L06"});
}

TEST_CASE("PlaceTracker: possible nodes are reserved until another robot is there or the robot is off the floor")
{
    EngineParts parts;
    const Traffic& traffic = parts.places.GetTraffic();
    parts.lr.place.possibleNodes = {parts.FindNode("L03"), parts.FindNode("L04")};
    parts.places.ReservePossibleNodes();
    CHECK(parts.places.ListNodes(parts.lr) == std::vector<std::string>{"L03", "L04"});
    CHECK(traffic.GetHolderOrNull(parts.FindNode("L03")) == 0U);
    parts.PutOn(parts.cr, "L03");
    CHECK(traffic.GetHolderOrNull(parts.FindNode("L03")) == 1U);
    CHECK(parts.lr.place.possibleNodes == std::vector<std::size_t>{parts.FindNode("L04")});
    parts.Discard();
    parts.places.ForgetPossibleNodes(parts.lr);
    CHECK_FALSE(traffic.GetHolderOrNull(parts.FindNode("L04")).has_value());
    CHECK(parts.lr.changes.IsWorkMarked());
    CHECK(parts.engine.transaction.IsDispatchNeeded());
}

TEST_CASE("PlaceTracker: a robot that cannot drive is an obstacle")
{
    EngineParts parts;
    parts.PutOn(parts.lr, "D-CHG01");
    CHECK(parts.places.GetTraffic().IsMovable(0));
    parts.Discard();
    const std::uint64_t changes = parts.places.GetStandingChanges();
    parts.places.NoteMovable(parts.lr);
    CHECK(parts.places.GetStandingChanges() == changes);
    parts.lr.view.state->bSafetyStop = true;
    parts.places.NoteMovable(parts.lr);
    CHECK_FALSE(parts.places.GetTraffic().IsMovable(0));
    CHECK(parts.places.GetStandingChanges() == changes + 1);
    CHECK(parts.engine.transaction.IsDispatchNeeded());
}
