#include "Catch.hpp"
#include "VehicleSessionFixture.hpp"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ACS::VDA5050::Test
{

namespace
{

using Maps = std::vector<std::string>;

std::vector<ActionParameter> MakeMapParameters(const char* mapID, const char* mapVersion)
{
    return {
        {"mapId", Core::JsonText::FromString(mapID)},
        {"mapVersion", Core::JsonText::FromString(mapVersion)},
        {"mapDownloadLink", Core::JsonText::FromString("https://maps")}};
}

std::vector<ActionParameter> MakePose(double x, double theta, const char* mapID = "floor")
{
    return {
        {"x", Core::JsonText::FromNumber(x)},
        {"y", Core::JsonText::FromNumber(0.0)},
        {"theta", Core::JsonText::FromNumber(theta)},
        {"mapId", Core::JsonText::FromString(mapID)},
        {"lastNodeId", Core::JsonText::FromString("N7")}};
}

void SetMaps(VehicleSessionFixture& bench, std::vector<MapState> maps)
{
    VehicleActions out;
    bench.GetSession().OnMaps(std::move(maps), bench.GetNow(), out);
}

std::vector<MapState> MakeMaps()
{
    return {
        MapState{"floor", "1", EMapStatus::Enabled, {}},
        MapState{"floor", "2", EMapStatus::Disabled, {}},
        MapState{"roof", "1", EMapStatus::Enabled, {}}};
}

/// "floor 1 +" for an enabled map, "-" for a disabled one.
Maps ListMaps(const StateMessage& state)
{
    Maps maps;
    for (const MapState& map : state.maps.value_or(std::vector<MapState>()))
    {
        const char* status = map.mapStatus == EMapStatus::Enabled ? " +" : " -";
        maps.push_back(map.mapID + " " + map.mapVersion + status);
    }
    return maps;
}

} // namespace

TEST_CASE("5.7 enableMap, downloadMap and deleteMap: what they change, and why they fail")
{
    struct Case
    {
        const char* actionType;
        const char* mapID;
        const char* mapVersion;
        bool bFails;
        Maps after;
    };
    const Maps unchanged{"floor 1 +", "floor 2 -", "roof 1 +"};
    const std::vector<Case> cases{
        {"enableMap", "floor", "2", false, {"floor 1 -", "floor 2 +", "roof 1 +"}},
        {"enableMap", "floor", "1", false, unchanged},
        {"enableMap", "floor", "9", true, unchanged},
        {"enableMap", "cellar", "1", true, unchanged},
        {"downloadMap", "floor", "3", false, {"floor 1 +", "floor 2 -", "roof 1 +", "floor 3 -"}},
        {"downloadMap", "cellar", "1", false, {"floor 1 +", "floor 2 -", "roof 1 +", "cellar 1 -"}},
        {"downloadMap", "floor", "2", true, unchanged},
        {"deleteMap", "floor", "2", false, {"floor 1 +", "roof 1 +"}},
        {"deleteMap", "floor", "1", true, unchanged},
        {"deleteMap", "cellar", "1", true, unchanged},
    };
    for (const Case& change : cases)
    {
        CAPTURE(change.actionType, change.mapID, change.mapVersion);
        VehicleSessionFixture bench(VehicleSessionFixture::MakeOptionsOfStandard());
        SetMaps(bench, MakeMaps());
        std::vector<ActionParameter> parameters = MakeMapParameters(change.mapID, change.mapVersion);
        if (std::string_view(change.actionType) != "downloadMap")
        {
            parameters.pop_back();
        }
        bench.Instant(change.actionType, "m1", parameters);
        CHECK(bench.GetStartedActions().empty() == change.bFails);
        if (!change.bFails)
        {
            bench.Status("m1", EActionStatus::Running);
            CHECK(ListMaps(bench.GetSession().GetState()) == unchanged); // only what is usable is shown
            bench.Status("m1", EActionStatus::Finished);
        }
        CHECK(bench.GetStatus("m1") == (change.bFails ? EActionStatus::Failed : EActionStatus::Finished));
        CHECK(bench.HasError(ErrorTypes::INSTANT_ACTION_ERROR) == change.bFails);
        CHECK(ListMaps(bench.GetSession().GetState()) == change.after);
    }
}

TEST_CASE("5.7 A download that fails leaves the maps as they are")
{
    VehicleSessionFixture bench(VehicleSessionFixture::MakeOptionsOfStandard());
    SetMaps(bench, MakeMaps());
    bench.Instant("downloadMap", "m1", MakeMapParameters("cellar", "1"));
    bench.Status("m1", EActionStatus::Running);
    bench.Status("m1", EActionStatus::Failed);
    CHECK(bench.GetSession().GetState().maps == MakeMaps());
}

TEST_CASE("5.7 enableMap on a node: enabled when the node is reached, failed where the map is not there")
{
    for (const char* mapVersion : {"2", "9"})
    {
        const bool bThere = std::string_view(mapVersion) == "2";
        VehicleSessionFixture bench(VehicleSessionFixture::MakeOptionsOfStandard());
        SetMaps(bench, MakeMaps());
        OrderMessage order = MakeOrder(2, 2);
        order.nodes[1].actions.push_back(MakeAction("m1", EBlockingType::Hard, "enableMap"));
        order.nodes[1].actions[0].actionParameters = {
            {"mapId", Core::JsonText::FromString("floor")},
            {"mapVersion", Core::JsonText::FromString(mapVersion)}};
        bench.Order(order);
        bench.Reach(2);
        if (bThere)
        {
            bench.Status("m1", EActionStatus::Running);
            bench.Status("m1", EActionStatus::Finished);
            CHECK(ListMaps(bench.GetSession().GetState()) == Maps{"floor 1 -", "floor 2 +", "roof 1 +"});
        }
        CHECK(bench.GetStatus("m1") == (bThere ? EActionStatus::Finished : EActionStatus::Failed));
        CHECK(bench.HasError(ErrorTypes::ACTION_ERROR) == !bThere);
        CHECK(Pick<OrderCompleted>(bench.GetOutput()).size() == 1);
    }
}

TEST_CASE("7 An order with a map that is not on the vehicle is rejected; one with a DISABLED map is accepted")
{
    struct Case
    {
        const char* mapID;
        bool bTaken;
    };
    const std::vector<Case> cases{{"floor", true}, {"cellar", false}, {"attic", true}};
    for (const Case& map : cases)
    {
        CAPTURE(map.mapID);
        VehicleSessionFixture bench;
        std::vector<MapState> maps = MakeMaps();
        maps.push_back(MapState{"attic", "1", EMapStatus::Disabled, {}});
        SetMaps(bench, maps);
        OrderMessage order = MakeOrder(2, 2);
        order.nodes[1].nodePosition->mapID = map.mapID;
        bench.Order(order);
        CHECK(bench.GetSession().GetState().orderID.empty() != map.bTaken);
        CHECK(bench.HasError(ErrorTypes::ORDER_ERROR) != map.bTaken);
    }
    VehicleSessionFixture empty;
    SetMaps(empty, {});
    empty.Order(MakeOrder(2, 2));
    CHECK(empty.HasError(ErrorTypes::ORDER_ERROR));
}

TEST_CASE("5.7 initPosition sets pose, map and last node; it fails for an invalid pose and while an order runs")
{
    struct Case
    {
        const char* name;
        std::vector<ActionParameter> pose;
        bool bOrderRuns;
        bool bFails;
    };
    const std::vector<Case> cases{
        {"a pose", MakePose(42.0, 1.5), false, false},
        {"theta beyond pi", MakePose(42.0, 4.0), false, true},
        {"a map that is not there", MakePose(42.0, 1.5, "cellar"), false, true},
        {"an order runs", MakePose(42.0, 1.5), true, true},
    };
    for (const Case& pose : cases)
    {
        CAPTURE(pose.name);
        VehicleSessionFixture bench(VehicleSessionFixture::MakeOptionsOfStandard());
        SetMaps(bench, MakeMaps());
        if (pose.bOrderRuns)
        {
            bench.Order(MakeOrder(2, 2));
        }
        bench.Instant("initPosition", "i1", pose.pose);
        CHECK(bench.GetStartedActions().empty() == pose.bFails);
        if (!pose.bFails)
        {
            bench.Status("i1", EActionStatus::Running);
            bench.Status("i1", EActionStatus::Finished);
        }
        const StateMessage state = bench.GetSession().GetState();
        CHECK(bench.GetStatus("i1") == (pose.bFails ? EActionStatus::Failed : EActionStatus::Finished));
        CHECK(state.lastNodeID == (pose.bFails ? "N0" : "N7"));
        CHECK(state.agvPosition->x == (pose.bFails ? 0.0 : 42.0));
        CHECK(state.agvPosition->theta == (pose.bFails ? 0.0 : 1.5));
    }
}

TEST_CASE("5.7 initPosition on a node changes pose and map; the order defines the node")
{
    VehicleSessionFixture bench(VehicleSessionFixture::MakeOptionsOfStandard());
    OrderMessage order = MakeOrder(2, 2);
    order.nodes[1].actions.push_back(MakeAction("i1", EBlockingType::Hard, "initPosition"));
    order.nodes[1].actions[0].actionParameters = MakePose(3.0, 0.5, "roof");
    bench.Order(order);
    bench.Reach(2);
    bench.Status("i1", EActionStatus::Running);
    bench.Status("i1", EActionStatus::Finished);
    CHECK(bench.GetSession().GetState().agvPosition->mapID == "roof");
    CHECK(bench.GetSession().GetState().lastNodeID == "N1");
    CHECK(bench.GetSession().GetState().lastNodeSequenceID == 2);
}

TEST_CASE("5.7 initPosition that ends after an order has come leaves the last node to the order")
{
    VehicleSessionFixture bench(VehicleSessionFixture::MakeOptionsOfStandard());
    SetMaps(bench, MakeMaps());
    const bool bUpdate = GENERATE(false, true);
    CAPTURE(bUpdate);
    OrderBuilder builder = MakeBuilder(3);
    OrderMessage order = *builder.MakeOrder(2, 0);
    if (bUpdate)
    {
        bench.Order(std::exchange(order, *builder.MakeUpdate(3, 0)));
        bench.Reach(2, true);
    }
    bench.Instant("initPosition", "i1", MakePose(42.0, 1.5));
    bench.Status("i1", EActionStatus::Running);
    bench.Order(order);
    if (GENERATE(false, true))
    {
        bench.Reach(bUpdate ? 4 : 2, true);
    }
    const StateMessage before = bench.GetSession().GetState();
    bench.Status("i1", EActionStatus::Finished);
    const StateMessage after = bench.GetSession().GetState();
    CHECK(bench.GetStatus("i1") == EActionStatus::Finished);
    CHECK(after.lastNodeID == before.lastNodeID);
    CHECK(after.lastNodeSequenceID == before.lastNodeSequenceID);
    CHECK(after.agvPosition == before.agvPosition);
    CHECK(after.nodeStates == before.nodeStates);
}

} // namespace ACS::VDA5050::Test
