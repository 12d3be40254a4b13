#include "robots/LiftingVehicle.hpp"

#include <string>
#include <utility>
#include <vector>

namespace ACS::Acsd::Test
{

namespace
{

/// The text of the only order that was published since.
std::string TakePayload(VehicleFixture& vehicle)
{
    std::string payload;
    for (const VDA5050::MqttMessage& message : std::exchange(vehicle.outputs.messages, {}))
    {
        if (message.topic.ends_with("/order"))
        {
            CHECK(payload.empty());
            payload = message.payload;
        }
    }
    REQUIRE_FALSE(payload.empty());
    return payload;
}

std::string SendOrder(
    const std::string& nodeMembers,
    const std::string& edgeMembers,
    const VDA5050::MasterOptions& options = VehicleFixture::MakeOptions())
{
    VehicleFixture vehicle({}, options);
    vehicle.state.lastNodeID = "N1";
    vehicle.ComeOnline();
    vehicle.Command(MakeMapDrive(nodeMembers, edgeMembers));
    return TakePayload(vehicle);
}

bool Contains(const std::string& text, const std::string& part)
{
    INFO(text);
    INFO(part);
    CHECK(text.find(part) != std::string::npos);
    return text.find(part) != std::string::npos;
}

const std::string LIFT = R"("actions": [
    {"actionType": "lift", "actionDescription": "up", "requirementType": "REQUIRED", "blockingType": "HARD",
     "actionParameters": [{"key": "height", "value": 1.25}, {"key": "name", "value": "a"}, {"key": "count", "value": 3},
       {"key": "slow", "value": true}, {"key": "points", "value": [1, {"x": 2}]}]},
    {"actionType": "beep", "requirementType": "OPTIONAL", "blockingType": "NONE"},
    {"actionType": "look", "requirementType": "CONDITIONAL", "blockingType": "NONE"},
    {"actionType": "wave", "blockingType": "NONE"},
    {"actionType": "lock", "requirementType": "REQUIRED", "blockingType": "SOFT"}])";

} // namespace

TEST_CASE("Map on the wire: the REQUIRED actions of a node are in the order with their parameters, and no others")
{
    const std::string order = SendOrder(LIFT, "");
    Contains(
        order,
        R"("actions":[{"actionType":"lift","actionId":"3f2a7c10-5b6d-4e8f-9a0b-1c2d3e4f-2-0","actionDescription":"up",)"
        R"("blockingType":"HARD","actionParameters":[{"key":"height","value":1.25},{"key":"name","value":"a"},)"
        R"({"key":"count","value":3},{"key":"slow","value":true},{"key":"points","value":[1,{"x":2}]}]},)"
        R"({"actionType":"lock","actionId":"3f2a7c10-5b6d-4e8f-9a0b-1c2d3e4f-2-1","blockingType":"SOFT"}]},)"
        R"({"nodeId":"N3")");
    CHECK(order.find("beep") == std::string::npos);
    CHECK(order.find("look") == std::string::npos);
    CHECK(order.find("wave") == std::string::npos);
}

TEST_CASE("Map on the wire: the REQUIRED actions of an edge are in the order, and no others")
{
    const std::string order = SendOrder("", LIFT);
    Contains(
        order,
        R"("actions":[{"actionType":"lift","actionId":"3f2a7c10-5b6d-4e8f-9a0b-1c2d3e4f-1-0","actionDescription":"up",)");
    Contains(
        order,
        R"({"actionType":"lock","actionId":"3f2a7c10-5b6d-4e8f-9a0b-1c2d3e4f-1-1","blockingType":"SOFT"}]},{"edgeId":"E2")");
    CHECK(order.find("beep") == std::string::npos);
}

TEST_CASE("Map on the wire: the values of parameters, which LIF has as text, have the types of the factsheet")
{
    using VDA5050::EValueDataType;
    VDA5050::AgvAction lift;
    lift.actionType = "lift";
    lift.actionScopes = {VDA5050::EActionScope::Node, VDA5050::EActionScope::Edge};
    lift.actionParameters = {
        {"height", EValueDataType::Number, {}, false},
        {"count", EValueDataType::Integer, {}, false},
        {"slow", EValueDataType::Bool, {}, false},
        {"name", EValueDataType::String, {}, false}};
    VDA5050::MasterOptions options = VehicleFixture::MakeOptions();
    options.factsheet.emplace().protocolFeatures.agvActions = {lift};
    const std::string actions =
        R"("actions": [{"actionType": "lift", "requirementType": "REQUIRED", "blockingType": "HARD", "actionParameters": [
            {"key": "height", "value": "1.25"}, {"key": "count", "value": "3"}, {"key": "slow", "value": "true"},
            {"key": "name", "value": "7"}]}])";
    const std::string expected =
        R"("actionParameters":[{"key":"height","value":1.25},{"key":"count","value":3},{"key":"slow","value":true},)"
        R"({"key":"name","value":"7"}])";
    Contains(SendOrder(actions, "", options), expected);
    Contains(SendOrder("", actions, options), expected);
}

TEST_CASE("Map on the wire: the trajectory and the heights of an edge are in the order")
{
    const std::string order = SendOrder(
        "",
        R"("minHeight": 0.5, "maxHeight": 2.25, "trajectory": {"knotVector": [0, 0, 0, 0, 1, 1, 1, 1],
            "controlPoints": [{"x": 0, "y": 0}, {"x": 0, "y": 3, "weight": 0.5}, {"x": 3, "y": 3}, {"x": 3, "y": 0}]})");
    Contains(order, R"("maxHeight":2.25,"minHeight":0.5,)");
    Contains(
        order,
        R"("trajectory":{"degree":3,"knotVector":[0,0,0,0,1,1,1,1],"controlPoints":[{"x":0,"y":0},)"
        R"({"x":0,"y":3,"weight":0.5},{"x":3,"y":3},{"x":3,"y":0}]},)");
    const std::string straight = SendOrder("", "");
    for (const char* name : {"trajectory", "minHeight", "maxHeight", "corridor", "zoneSetId"})
    {
        CHECK(straight.find(name) == std::string::npos);
    }
}

TEST_CASE("Map on the wire: an edge that is only for vehicles without a load is not in the order of a loaded one")
{
    const Core::Result<Planning::SiteMap> site =
        Planning::DecodeLIF(MakeMap("", R"("loadRestriction": {"unloaded": true, "loaded": false})"));
    REQUIRE(site);
    const Planning::Router router(*site);
    CHECK_FALSE(router.FindRouteOrNull("lr", Planning::ELoad::Loaded, "N1", "N3", {}).has_value());
    VehicleFixture vehicle;
    vehicle.state.lastNodeID = "N1";
    vehicle.ComeOnline();
    vehicle.Command(Planning::Drive{"D", *router.FindRouteOrNull("lr", Planning::ELoad::Empty, "N1", "N3", {}), 2});
    Contains(TakePayload(vehicle), R"("edgeId":"E1")");
}

TEST_CASE(
    "Map on the wire: the corridor of an edge is in the order of a vehicle of 2.1 only, and the zone set in each order")
{
    for (const VDA5050::EVda5050Version version :
         {VDA5050::EVda5050Version::Version210, VDA5050::EVda5050Version::Version200})
    {
        VDA5050::MasterOptions options = VehicleFixture::MakeOptions();
        options.version = version;
        options.zoneSetID = "hall 2";
        VehicleFixture vehicle({}, options);
        vehicle.state.lastNodeID = "N1";
        vehicle.ComeOnline();
        Planning::Drive drive = MakeMapDrive("", "");
        drive.route.edges[0].corridor = Planning::SiteCorridor{0.5, 0.25, false};
        drive.route.edges[1].corridor = Planning::SiteCorridor{1, 2, true};
        vehicle.Command(drive);
        const std::string order = TakePayload(vehicle);
        Contains(order, R"("orderUpdateId":0,"zoneSetId":"hall 2",)");
        if (version == VDA5050::EVda5050Version::Version200)
        {
            CHECK(order.find("corridor") == std::string::npos);
            continue;
        }
        Contains(order, R"("corridor":{"leftWidth":0.5,"rightWidth":0.25,"corridorRefPoint":"KINEMATICCENTER"})");
        Contains(order, R"("corridor":{"leftWidth":1,"rightWidth":2,"corridorRefPoint":"CONTOUR"})");
        vehicle.ShowOrder(*vehicle.codec.Decode<VDA5050::OrderMessage>(order), {"N2", "N3"});
        vehicle.ShowState();
        vehicle.Command(Planning::ExtendDrive{drive.driveID, 3});
        Contains(TakePayload(vehicle), R"("orderUpdateId":1,"zoneSetId":"hall 2",)");
    }
}

TEST_CASE("An order update carries the actions with the ids that the vehicle knows")
{
    VehicleFixture vehicle;
    vehicle.state.lastNodeID = "N1";
    vehicle.ComeOnline();
    const Planning::Drive drive = MakeMapDrive(LIFT, "");
    vehicle.Command(drive);
    const VDA5050::OrderMessage order = vehicle.TakeOrders().at(0);
    vehicle.ShowOrder(order, {"N2", "N3"});
    vehicle.ShowState();
    vehicle.Command(Planning::ExtendDrive{drive.driveID, 3});
    const VDA5050::OrderMessage update = vehicle.TakeOrders().at(0);
    REQUIRE(update.nodes.size() == 2);
    CHECK(update.nodes[0].actions == order.nodes[1].actions);
    CHECK(update.nodes[0].actions.size() == 2);
}

TEST_CASE("A drive ends when its actions have finished")
{
    LiftingVehicle vehicle;
    vehicle.ShowAtNode(VDA5050::EActionStatus::Running);
    vehicle.ShowAtEnd();
    CHECK(vehicle.TakeEvents<Planning::Arrived>().empty());
    vehicle.state.actionStates.back().actionStatus = VDA5050::EActionStatus::Finished;
    vehicle.ShowState();
    CHECK(vehicle.TakeEvents<Planning::Arrived>().size() == 1);
    CHECK(vehicle.TakeEvents<Planning::DriveRejected>().empty());
}

TEST_CASE(
    "A drive whose REQUIRED action fails is cancelled and rejected with the reason, and the next one repeats the action")
{
    LiftingVehicle vehicle;
    vehicle.ShowAtNode(VDA5050::EActionStatus::Running);
    vehicle.state.actionStates.back().actionStatus = VDA5050::EActionStatus::Failed;
    vehicle.state.actionStates.back().resultDescription = "jammed";
    vehicle.ShowState();
    CHECK(vehicle.adapter.GetSession().GetOrderPhase() == VDA5050::EOrderPhase::Cancelling);
    CHECK(vehicle.TakeEvents<Planning::DriveRejected>().empty());
    vehicle.ShowOrder(vehicle.order, {});
    vehicle.ShowCancelled();
    const std::vector<Planning::DriveRejected> rejected = vehicle.TakeEvents<Planning::DriveRejected>();
    REQUIRE(rejected.size() == 1);
    CHECK(rejected[0].reason == "the action lift of the node N2 failed: jammed");

    vehicle.outputs.messages.clear();
    vehicle.Command(vehicle.MakeNextDrive());
    const VDA5050::OrderMessage order = vehicle.TakeOrders().at(0);
    REQUIRE(order.nodes[0].actions.size() == 1);
    CHECK(order.nodes[0].actions[0].actionID == "D2-0-0");
}

TEST_CASE("An action that fails in the state that shows the arrival is repeated before the job")
{
    LiftingVehicle vehicle(2);
    vehicle.ShowOrder(vehicle.order, {});
    vehicle.ShowAt("N2", 2);
    vehicle.state.actionStates = {
        LiftingVehicle::MakeState("D1-1-0", VDA5050::EActionStatus::Finished),
        LiftingVehicle::MakeState("D1-2-0", VDA5050::EActionStatus::Failed)};
    vehicle.ShowState();
    REQUIRE(vehicle.TakeEvents<Planning::NodePassed>().size() == 1);
    CHECK(vehicle.TakeEvents<Planning::Arrived>().empty());
    const auto rejected = vehicle.TakeEvents<Planning::DriveRejected>();
    REQUIRE(rejected.size() == 1);
    CHECK_THAT(rejected[0].reason, Catch::Contains("the action lift of the node N2 failed"));
    vehicle.outputs.messages.clear();
    vehicle.Command(MakeJob("CassetteLoad"));
    const std::vector<VDA5050::OrderMessage> orders = vehicle.TakeOrders();
    REQUIRE(orders.size() == 1);
    CHECK(orders[0].nodes[0].actions.at(0).actionType == "lift");
}

TEST_CASE("A job at a node whose REQUIRED action has not finished is sent when the action has been repeated")
{
    LiftingVehicle vehicle;
    vehicle.ShowAtNode(VDA5050::EActionStatus::Running);
    vehicle.LoseOrder();
    const auto repeat = [&vehicle](VDA5050::EActionStatus end) {
        vehicle.outputs.messages.clear();
        vehicle.Command(MakeJob("CassetteLoad"));
        const std::vector<VDA5050::OrderMessage> orders = vehicle.TakeOrders();
        REQUIRE(orders.size() == 1);
        REQUIRE(orders[0].nodes.size() == 1);
        REQUIRE(orders[0].nodes[0].actions.size() == 1);
        const VDA5050::Action& action = orders[0].nodes[0].actions[0];
        CHECK(action.actionType == "lift");
        vehicle.ShowOrder(orders[0], {});
        vehicle.ShowAt("N2", 0);
        vehicle.state.actionStates = {LiftingVehicle::MakeState(action.actionID, VDA5050::EActionStatus::Running)};
        vehicle.ShowState();
        CHECK(vehicle.TakeOrders().empty());
        vehicle.state.actionStates[0].actionStatus = end;
        vehicle.ShowState();
        return orders[0];
    };
    const VDA5050::OrderMessage failed = repeat(VDA5050::EActionStatus::Failed);
    CHECK(vehicle.TakeEvents<Planning::JobRejected>().size() == 1);
    CHECK(vehicle.TakeOrders().empty());

    const VDA5050::OrderMessage finished = repeat(VDA5050::EActionStatus::Finished);
    CHECK(finished.orderID != failed.orderID);
    CHECK(finished.nodes[0].actions[0].actionID != failed.nodes[0].actions[0].actionID);
    const std::vector<VDA5050::OrderMessage> jobs = vehicle.TakeOrders();
    REQUIRE(jobs.size() == 1);
    CHECK(jobs[0].orderID == "U1");
    REQUIRE(jobs[0].nodes[0].actions.size() == 1);
    CHECK(jobs[0].nodes[0].actions[0].actionType == "pick");
    CHECK(vehicle.TakeEvents<Planning::JobRejected>().size() == 1);
    CHECK(vehicle.TakeEvents<Planning::Arrived>().empty());
}

TEST_CASE("A drive does not repeat the actions of the node where it starts after they have finished")
{
    LiftingVehicle vehicle;
    vehicle.ShowAtNode(VDA5050::EActionStatus::Finished);
    vehicle.LoseOrder();
    vehicle.Command(vehicle.MakeNextDrive());
    CHECK(vehicle.TakeOrders().at(0).nodes[0].actions.empty());
}

TEST_CASE(
    "An action that the vehicle ends because its mode changed does not cancel the drive; the next drive repeats it")
{
    LiftingVehicle vehicle;
    vehicle.ShowAtNode(VDA5050::EActionStatus::Running);
    vehicle.outputs.messages.clear();
    vehicle.state.operatingMode = VDA5050::EOperatingMode::Manual;
    vehicle.ShowOrder(vehicle.order, {});
    vehicle.state.orderID.clear();
    vehicle.state.actionStates.back().actionStatus = VDA5050::EActionStatus::Failed;
    vehicle.ShowState();
    const std::vector<Planning::DriveRejected> rejected = vehicle.TakeEvents<Planning::DriveRejected>();
    REQUIRE(rejected.size() == 1);
    CHECK(rejected[0].reason.find("lost the order") != std::string::npos);
    vehicle.state.operatingMode = VDA5050::EOperatingMode::Automatic;
    vehicle.ShowState();
    vehicle.Command(vehicle.MakeNextDrive());
    CHECK(vehicle.TakeOrders().at(0).nodes[0].actions.size() == 1);
}

TEST_CASE("A vehicle that never reports a REQUIRED action has not arrived")
{
    LiftingVehicle vehicle;
    vehicle.state.actionStates.clear();
    vehicle.ShowAtEnd();
    CHECK(vehicle.TakeEvents<Planning::Arrived>().empty());
    const std::vector<Planning::DriveRejected> rejected = vehicle.TakeEvents<Planning::DriveRejected>();
    REQUIRE(rejected.size() == 1);
    CHECK(rejected[0].reason.find("lift of the node N2") != std::string::npos);
}

TEST_CASE("A drive whose action fails because it is cancelled is reported as cancelled, even in the same state")
{
    const bool bSameState = GENERATE(true, false);
    LiftingVehicle vehicle;
    vehicle.ShowAtNode(VDA5050::EActionStatus::Running);
    vehicle.Command(Planning::CancelDrive{"D1"});
    vehicle.state.actionStates[1].actionStatus = VDA5050::EActionStatus::Failed;
    if (!bSameState)
    {
        vehicle.ShowState();
    }
    vehicle.ShowCancelled();
    CHECK(vehicle.TakeEvents<Planning::DriveRejected>().empty());
    CHECK(vehicle.TakeEvents<Planning::DriveCancelled>().size() == 1);
}

} // namespace ACS::Acsd::Test
