#include "robots/VehicleFixture.hpp"
#include <acs/plan/LifReader.hpp>
#include <acs/plan/Router.hpp>

#include <string>
#include <utility>
#include <vector>

namespace ACS::Acsd::Test
{

namespace
{

/// N1 - E1 - N2 - E2 - N3, 3 m each, with these members in the rule of N2 and in that of E1.
std::string MakeMap(const std::string& nodeMembers, const std::string& edgeMembers)
{
    std::string nodes;
    for (const std::string number : {"1", "2", "3"})
    {
        nodes += (nodes.empty() ? "" : ", ") + (R"({"nodeId": "N)" + number)
            + R"(", "mapId": "floor", "nodePosition": {"x": )" + std::to_string(3 * (std::stoi(number) - 1))
            + R"(, "y": 0}, "vehicleTypeNodeProperties": [{"vehicleTypeId": "lr")"
            + (number == "2" && !nodeMembers.empty() ? ", " + nodeMembers : "") + "}]}";
    }
    std::string edges;
    for (const auto& [number, next] : {std::pair("1", "2"), std::pair("2", "3")})
    {
        const bool bFirst = edges.empty();
        edges += (bFirst ? "" : ", ") + (R"({"edgeId": "E)" + std::string(number)) + R"(", "startNodeId": "N)" + number
            + R"(", "endNodeId": "N)" + next + R"(", "vehicleTypeEdgeProperties": [{"vehicleTypeId": "lr")"
            + (bFirst && !edgeMembers.empty() ? ", " + edgeMembers : "") + "}]}";
    }
    return R"({"metaInformation": {"projectIdentification": "p", "creator": "c", "exportTimestamp": "2025-01-01T00:00:00Z",
        "lifVersion": "1.0.0"}, "layouts": [{"layoutId": "one", "layoutVersion": "1", "nodes": [)"
        + nodes + R"(], "edges": [)" + edges + R"(], "stations": []}]})";
}

/// A drive from N1 to N3 on that map.
Planning::Drive MakeMapDrive(
    const std::string& nodeMembers,
    const std::string& edgeMembers,
    std::string driveID = "3f2a7c10-5b6d-4e8f-9a0b-1c2d3e4f5061")
{
    const Core::Result<Planning::SiteMap> site = Planning::DecodeLIF(MakeMap(nodeMembers, edgeMembers));
    REQUIRE(site);
    const std::optional<Planning::Route> route = Planning::Router(*site).FindRouteOrNull("lr", "N1", "N3");
    REQUIRE(route.has_value());
    return {std::move(driveID), *route, 2};
}

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

std::string SendOrder(const std::string& nodeMembers, const std::string& edgeMembers)
{
    VehicleFixture vehicle;
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

/// The vehicle on its way from N1 to N3, or to N2 only, with the action "lift" on N2 and on E1.
struct LiftingVehicle : VehicleFixture
{
    const std::string lift =
        R"("actions": [{"actionType": "lift", "requirementType": "REQUIRED", "blockingType": "HARD"}])";
    VDA5050::OrderMessage order;

    explicit LiftingVehicle(std::size_t nodeCount = 3)
    {
        state.lastNodeID = "N1";
        ComeOnline();
        Planning::Drive drive = MakeMapDrive(lift, lift, "D1");
        drive.route.nodes.resize(nodeCount);
        drive.route.edges.resize(nodeCount - 1);
        drive.releasedCount = nodeCount;
        Command(drive);
        order = TakeOrders().at(0);
        ShowOrder(order, nodeCount == 2 ? std::vector<std::string>{"N2"} : std::vector<std::string>{"N2", "N3"});
        state.actionStates = {
            MakeState("D1-1-0", VDA5050::EActionStatus::Waiting),
            MakeState("D1-2-0", VDA5050::EActionStatus::Waiting)};
        ShowState();
        actions.clear();
    }

    static VDA5050::ActionState MakeState(std::string actionID, VDA5050::EActionStatus status)
    {
        VDA5050::ActionState action;
        action.actionID = std::move(actionID);
        action.actionType = "lift";
        action.actionStatus = status;
        return action;
    }

    /// On N2, with the edge's action finished and this status of the node's action.
    void ShowAtNode(VDA5050::EActionStatus status)
    {
        ShowOrder(order, {"N3"});
        ShowAt("N2", 2);
        state.actionStates = {MakeState("D1-1-0", VDA5050::EActionStatus::Finished), MakeState("D1-2-0", status)};
        ShowState();
    }

    /// It was restarted on N2.
    void LoseOrder()
    {
        state.orderID.clear();
        state.nodeStates.clear();
        state.actionStates.clear();
        ShowState();
        REQUIRE(TakeEvents<Planning::DriveRejected>().size() == 1);
    }

    /// On N3, where the drive ends.
    void ShowAtEnd()
    {
        ShowOrder(order, {});
        ShowAt("N3", 4);
        ShowState();
    }
};

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
    VDA5050::InstantActionsMessage cancel;
    for (const VDA5050::MqttMessage& message : vehicle.outputs.messages)
    {
        if (message.topic.ends_with("/instantActions"))
        {
            cancel = *vehicle.codec.Decode<VDA5050::InstantActionsMessage>(message.payload);
        }
    }
    REQUIRE(cancel.actions.size() == 1);
    vehicle.ShowOrder(vehicle.order, {});
    vehicle.state.actionStates.push_back(
        LiftingVehicle::MakeState(cancel.actions[0].actionID, VDA5050::EActionStatus::Finished));
    vehicle.state.actionStates.back().actionType = cancel.actions[0].actionType;
    vehicle.ShowState();
    const std::vector<Planning::DriveRejected> rejected = vehicle.TakeEvents<Planning::DriveRejected>();
    REQUIRE(rejected.size() == 1);
    CHECK(rejected[0].reason == "the action lift of the node N2 failed: jammed");

    vehicle.outputs.messages.clear();
    Planning::Drive next = MakeMapDrive(vehicle.lift, vehicle.lift, "D2");
    next.route.nodes.erase(next.route.nodes.begin());
    next.route.edges.erase(next.route.edges.begin());
    next.releasedCount = 1;
    vehicle.Command(next);
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

TEST_CASE("A job that is cancelled while actions are repeated is not sent")
{
    LiftingVehicle vehicle;
    vehicle.ShowAtNode(VDA5050::EActionStatus::Running);
    vehicle.LoseOrder();
    vehicle.Command(MakeJob("CassetteLoad"));
    const VDA5050::OrderMessage repetition = vehicle.TakeOrders().at(0);
    vehicle.ShowOrder(repetition, {});
    vehicle.ShowAt("N2", 0);
    vehicle.state.actionStates = {
        LiftingVehicle::MakeState(repetition.nodes[0].actions[0].actionID, VDA5050::EActionStatus::Running)};
    vehicle.ShowState();
    vehicle.Command(Planning::CancelJob{"J"});
    CHECK(vehicle.TakeEvents<Planning::JobFailed>().size() == 1);
    CHECK(vehicle.adapter.GetSession().GetOrderPhase() == VDA5050::EOrderPhase::Cancelling);
    vehicle.state.actionStates[0].actionStatus = VDA5050::EActionStatus::Finished;
    vehicle.ShowState();
    CHECK(vehicle.TakeOrders().empty());
}

TEST_CASE("A drive does not repeat the actions of the node where it starts after they have finished")
{
    LiftingVehicle vehicle;
    vehicle.ShowAtNode(VDA5050::EActionStatus::Finished);
    vehicle.LoseOrder();
    Planning::Drive next = MakeMapDrive(vehicle.lift, vehicle.lift, "D2");
    next.route.nodes.erase(next.route.nodes.begin());
    next.route.edges.erase(next.route.edges.begin());
    next.releasedCount = 1;
    vehicle.Command(next);
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
    Planning::Drive next = MakeMapDrive(vehicle.lift, vehicle.lift, "D2");
    next.route.nodes.erase(next.route.nodes.begin());
    next.route.edges.erase(next.route.edges.begin());
    next.releasedCount = 1;
    vehicle.Command(next);
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

} // namespace ACS::Acsd::Test
