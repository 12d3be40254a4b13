#include "robots/VehicleFixture.hpp"

#include <optional>
#include <string>
#include <vector>

namespace ACS::Acsd::Test
{

TEST_CASE("A charge that cannot be is taken as the nearest that can, a position that cannot be as not known")
{
    VehicleFixture vehicle;
    vehicle.ComeOnline();
    const auto show = [&vehicle](double charge, double x, double y) {
        vehicle.state.batteryState.batteryCharge = charge;
        vehicle.state.agvPosition.emplace();
        vehicle.state.agvPosition->bPositionInitialized = true;
        vehicle.state.agvPosition->x = x;
        vehicle.state.agvPosition->y = y;
        vehicle.ShowState();
        return vehicle.TakeEvents<Planning::StateChanged>().back();
    };
    CHECK(show(1e300, 1, 2).batteryPercent == 100);
    CHECK(show(-1e300, 1, 2).batteryPercent == 0);
    CHECK(show(42.5, 1, 2).batteryPercent == 42.5);
    CHECK(show(50, 1, -2).bPoseKnown);
    CHECK_FALSE(show(50, 1e300, 2).bPoseKnown);
    CHECK_FALSE(show(50, 1, -1e8).bPoseKnown);

    VDA5050::VisualizationMessage seen;
    seen.agvPosition = vehicle.state.agvPosition;
    seen.agvPosition->y = 0;
    vehicle.Receive("visualization", seen);
    CHECK(vehicle.TakeEvents<Planning::StateChanged>().back().bPoseKnown);
    seen.agvPosition->x = -1e300;
    vehicle.Receive("visualization", seen);
    CHECK_FALSE(vehicle.TakeEvents<Planning::StateChanged>().back().bPoseKnown);
}

TEST_CASE("6.10.6 A state without the position after one that had it means that the vehicle has lost it")
{
    VehicleFixture vehicle;
    VDA5050::VisualizationMessage seen;
    seen.agvPosition.emplace();
    seen.agvPosition->bPositionInitialized = true;
    seen.agvPosition->x = 3;
    vehicle.ComeOnline();
    vehicle.Receive("visualization", seen);
    vehicle.ShowState(); // of a vehicle that reports its position by visualization only
    CHECK(vehicle.TakeEvents<Planning::StateChanged>().back().bPoseKnown);

    vehicle.state.agvPosition = seen.agvPosition;
    vehicle.ShowState();
    CHECK(vehicle.TakeEvents<Planning::StateChanged>().back().bPoseKnown);
    vehicle.state.agvPosition.reset();
    vehicle.ShowState();
    CHECK_FALSE(vehicle.TakeEvents<Planning::StateChanged>().back().bPoseKnown);
}

TEST_CASE("A vehicle is online after its connection message and its first state")
{
    VehicleFixture vehicle;
    vehicle.adapter.OnLinkUp(vehicle.clock.GetNow(), vehicle.actions);
    CHECK(vehicle.TakeEvents<Planning::LinkChanged>().empty());
    vehicle.ComeOnline();
    CHECK(vehicle.TakeEvents<Planning::LinkChanged>() == std::vector<Planning::LinkChanged>{{true}});
    vehicle.adapter.OnLinkDown(vehicle.clock.GetNow(), vehicle.actions);
    CHECK(vehicle.TakeEvents<Planning::LinkChanged>() == std::vector<Planning::LinkChanged>{{true}, {false}});
}

TEST_CASE("6.6 A drive is an order of base and horizon, its extension an update from the decision point")
{
    VehicleFixture vehicle;
    vehicle.ComeOnline();
    vehicle.Command(MakeDrive());
    const auto orders = vehicle.TakeOrders();
    REQUIRE(orders.size() == 1);
    CHECK(orders[0].orderID == "D");
    REQUIRE(orders[0].nodes.size() == 3);
    CHECK(orders[0].nodes[1].bReleased);
    CHECK_FALSE(orders[0].nodes[2].bReleased);
    CHECK(orders[0].edges[1].maxSpeed == 0.4);

    // Not before the vehicle has shown the order.
    vehicle.Command(Planning::ExtendDrive{"D", 3});
    CHECK(vehicle.TakeOrders().empty());
    vehicle.ShowOrder(orders[0], {"B", "C"});
    vehicle.ShowState();
    const auto updates = vehicle.TakeOrders();
    REQUIRE(updates.size() == 1);
    CHECK(updates[0].orderUpdateID == 1);
    CHECK(updates[0].nodes.front().nodeID == "B");
    CHECK(updates[0].nodes.back().bReleased);
}

TEST_CASE("Each node is reported once, and the arrival when the whole route is driven")
{
    VehicleFixture vehicle;
    vehicle.ComeOnline();
    Planning::Drive drive = MakeDrive();
    drive.releasedCount = 3;
    vehicle.Command(drive);
    const auto order = vehicle.TakeOrders().at(0);
    vehicle.ShowOrder(order, {"B", "C"});
    vehicle.ShowState();
    CHECK(vehicle.TakeEvents<Planning::NodePassed>() == std::vector<Planning::NodePassed>{{"D", "A"}});
    // The state in which B was passed is lost.
    vehicle.ShowOrder(order, {});
    vehicle.ShowAt("C", 4);
    vehicle.ShowState();
    vehicle.ShowState();
    CHECK(
        vehicle.TakeEvents<Planning::NodePassed>()
        == std::vector<Planning::NodePassed>{{"D", "A"}, {"D", "B"}, {"D", "C"}});
    CHECK(vehicle.TakeEvents<Planning::Arrived>() == std::vector<Planning::Arrived>{{"D"}});
}

TEST_CASE("A job is an order of the vehicle's current node, whose action has the commandID")
{
    VehicleFixture vehicle;
    vehicle.ComeOnline();
    vehicle.Command(MakeJob("CassetteLoad"));
    const auto orders = vehicle.TakeOrders();
    REQUIRE(orders.size() == 1);
    REQUIRE(orders[0].nodes.size() == 1);
    CHECK(orders[0].edges.empty());
    CHECK(orders[0].nodes[0].nodeID == "A");
    const VDA5050::Action& action = orders[0].nodes[0].actions.at(0);
    CHECK(action.actionID == "U1");
    CHECK(orders[0].orderID == "U1");
    CHECK(action.actionType == "pick");
    CHECK(action.blockingType == VDA5050::EBlockingType::Hard);

    vehicle.ShowOrder(orders[0], {});
    vehicle.state.actionStates = {{"U1", "pick", "", VDA5050::EActionStatus::Running, ""}};
    vehicle.ShowState();
    vehicle.ShowState();
    CHECK(vehicle.TakeEvents<Planning::JobStarted>() == std::vector<Planning::JobStarted>{{"J"}});
    vehicle.state.actionStates[0].actionStatus = VDA5050::EActionStatus::Finished;
    vehicle.ShowState();
    vehicle.ShowState();
    CHECK(vehicle.TakeEvents<Planning::JobFinished>() == std::vector<Planning::JobFinished>{{"J"}});
    CHECK(vehicle.TakeEvents<Planning::JobFailed>().empty());
}

TEST_CASE("A failed action fails the job with the vehicle's words")
{
    VehicleFixture vehicle;
    vehicle.ComeOnline();
    vehicle.Command(MakeJob("CassetteLoad"));
    vehicle.ShowOrder(vehicle.TakeOrders().at(0), {});
    vehicle.state.actionStates = {{"U1", "pick", "", VDA5050::EActionStatus::Failed, "station is empty"}};
    vehicle.ShowState();
    CHECK(vehicle.TakeEvents<Planning::JobFailed>() == std::vector<Planning::JobFailed>{{"J", "station is empty"}});
}

TEST_CASE("A rejected order is reported with type and description of the vehicle's error")
{
    VehicleFixture vehicle;
    vehicle.ComeOnline();
    vehicle.Command(MakeDrive());
    VDA5050::VehicleError error;
    error.errorType = "noRouteError";
    error.errorDescription = "too far away";
    error.errorReferences = {{"orderId", "D"}, {"orderUpdateId", "0"}, {"topic", "order"}};
    vehicle.state.errors = {error};
    vehicle.ShowState();
    const auto rejected = vehicle.TakeEvents<Planning::DriveRejected>();
    REQUIRE(rejected.size() == 1);
    CHECK(rejected[0].driveID == "D");
    CHECK(rejected[0].reason == "the vehicle rejected the order: noRouteError: too far away");
}

TEST_CASE("A rejected order of a job rejects the job, also with an error without a description")
{
    VehicleFixture vehicle;
    vehicle.ComeOnline();
    vehicle.Command(MakeJob("CassetteLoad"));
    VDA5050::VehicleError error;
    error.errorType = "validationError";
    error.errorReferences = {{"orderId", "U1"}, {"orderUpdateId", "0"}, {"topic", "order"}};
    vehicle.state.errors = {error};
    vehicle.ShowState();
    CHECK(vehicle.TakeEvents<Planning::JobFailed>().empty());
    const auto rejected = vehicle.TakeEvents<Planning::JobRejected>();
    REQUIRE(rejected.size() == 1);
    CHECK(rejected[0].jobID == "J");
    CHECK(rejected[0].reason == "the vehicle rejected the order: validationError");
}

TEST_CASE("A command that comes before the vehicle has finished waits and is sent then")
{
    VehicleFixture vehicle;
    vehicle.ComeOnline();
    vehicle.Command(MakeJob("CassetteLoad"));
    const auto order = vehicle.TakeOrders().at(0);
    vehicle.ShowOrder(order, {});
    vehicle.state.actionStates = {{"U1", "pick", "", VDA5050::EActionStatus::Running, ""}};
    vehicle.ShowState();
    vehicle.Command(MakeDrive());
    CHECK(vehicle.TakeOrders().empty());
    vehicle.state.actionStates[0].actionStatus = VDA5050::EActionStatus::Finished;
    vehicle.ShowState();
    const auto orders = vehicle.TakeOrders();
    REQUIRE(orders.size() == 1);
    CHECK(orders[0].orderID == "D");
}

TEST_CASE("A job whose jobId an earlier plan had is another order: the vehicle would take the first one for it")
{
    VehicleFixture vehicle;
    vehicle.ComeOnline();
    vehicle.Command(MakeJob("CassetteLoad"));
    const auto first = vehicle.TakeOrders().at(0);
    vehicle.ShowOrder(first, {});
    vehicle.state.actionStates = {{"U1", "pick", "", VDA5050::EActionStatus::Failed, "jammed"}};
    vehicle.ShowState();
    Planning::StartJob again = MakeJob("CassetteLoad");
    again.commandID = "U2";
    vehicle.Command(again);
    const auto second = vehicle.TakeOrders().at(0);
    CHECK(second.orderID == "U2");
    vehicle.ShowState();
    vehicle.ShowOrder(second, {});
    vehicle.state.actionStates = {{"U2", "pick", "", VDA5050::EActionStatus::Finished, ""}};
    vehicle.ShowState();
    CHECK(vehicle.TakeEvents<Planning::JobFailed>().size() == 1);
    CHECK(vehicle.TakeEvents<Planning::JobFinished>() == std::vector<Planning::JobFinished>{{"J"}});
}

TEST_CASE("A job whose action ends, runs again and fails after its end is done once: its first end holds")
{
    VehicleFixture vehicle;
    vehicle.ComeOnline();
    vehicle.Command(MakeJob("CassetteLoad"));
    vehicle.ShowOrder(vehicle.TakeOrders().at(0), {});
    using E = VDA5050::EActionStatus;
    for (const E status : {E::Finished, E::Running, E::Finished, E::Failed, E::Waiting})
    {
        vehicle.state.actionStates = {{"U1", "pick", "", status, ""}};
        vehicle.ShowState();
    }
    CHECK(vehicle.TakeEvents<Planning::JobFinished>() == std::vector<Planning::JobFinished>{{"J"}});
    CHECK(vehicle.TakeEvents<Planning::JobFailed>().empty());
}

TEST_CASE("Unknown ids change nothing: actions, nodes beyond the route, orders that have ended")
{
    VehicleFixture vehicle;
    vehicle.ComeOnline();
    vehicle.Command(MakeJob("CassetteLoad"));
    const auto orders = vehicle.TakeOrders();
    vehicle.ShowOrder(orders.at(0), {});
    vehicle.state.lastNodeID = "nowhere";
    vehicle.state.actionStates = {{"X9", "pick", "", VDA5050::EActionStatus::Finished, ""}};
    vehicle.ShowState();
    CHECK(vehicle.TakeEvents<Planning::JobFinished>().empty());
    CHECK(vehicle.TakeEvents<Planning::NodePassed>().empty());
    CHECK(vehicle.TakeEvents<Planning::Arrived>().empty());
}

TEST_CASE("An order of before a restart is cancelled once, and the robot is occupied until it is gone")
{
    VehicleFixture vehicle;
    vehicle.state.orderID = "old";
    vehicle.state.lastNodeSequenceID = 2;
    vehicle.state.nodeStates.push_back({"C", 4, "", false, std::nullopt});
    vehicle.adapter.OnLinkUp(vehicle.clock.GetNow(), vehicle.actions);
    vehicle.ShowState();
    CHECK(vehicle.TakeEvents<Planning::StateChanged>().back().bOccupied);
    vehicle.ShowState();
    const auto isCancel = [](const VDA5050::MqttMessage& message) {
        return message.payload.find("cancelOrder") != std::string::npos;
    };
    CHECK(std::count_if(vehicle.outputs.messages.begin(), vehicle.outputs.messages.end(), isCancel) == 1);
    vehicle.Command(MakeDrive());
    CHECK(vehicle.TakeOrders().empty());
    vehicle.state.nodeStates.clear();
    vehicle.ShowState();
    CHECK_FALSE(vehicle.TakeEvents<Planning::StateChanged>().back().bOccupied);
    CHECK(vehicle.TakeOrders().size() == 1);
}

TEST_CASE("An action of before a restart is let to its end")
{
    VehicleFixture vehicle;
    vehicle.state.orderID = "old";
    vehicle.state.actionStates = {{"U0", "pick", "", VDA5050::EActionStatus::Running, ""}};
    vehicle.adapter.OnLinkUp(vehicle.clock.GetNow(), vehicle.actions);
    vehicle.ShowState();
    CHECK(vehicle.TakeEvents<Planning::StateChanged>().back().bOccupied);
    CHECK(vehicle.outputs.messages.empty());
    vehicle.state.actionStates[0].actionStatus = VDA5050::EActionStatus::Finished;
    vehicle.ShowState();
    CHECK_FALSE(vehicle.TakeEvents<Planning::StateChanged>().back().bOccupied);
}

/// The vehicle drives from A towards B; the update that releases C is sent, and not yet shown.
void SendUnseenUpdate(VehicleFixture& vehicle)
{
    vehicle.ComeOnline();
    vehicle.Command(MakeDrive());
    vehicle.ShowOrder(vehicle.TakeOrders().at(0), {"B", "C"});
    vehicle.ShowState();
    vehicle.Command(Planning::ExtendDrive{"D", 3});
    REQUIRE(vehicle.TakeOrders().size() == 1);
}

void RejectUpdate(VehicleFixture& vehicle, const std::string& orderUpdateID)
{
    VDA5050::VehicleError error;
    error.errorType = "orderUpdateError";
    error.errorDescription = "no such edge";
    error.errorReferences = {{"orderId", "D"}, {"orderUpdateId", orderUpdateID}, {"topic", "order"}};
    vehicle.state.errors = {error};
    vehicle.ShowState();
}

TEST_CASE("A rejected update is followed by one that releases a single node, and the drive continues")
{
    VehicleFixture vehicle;
    vehicle.ComeOnline();
    Planning::Drive drive = MakeDrive();
    drive.releasedCount = 1;
    vehicle.Command(drive);
    vehicle.ShowOrder(vehicle.TakeOrders().at(0), {"B", "C"});
    vehicle.ShowState();
    vehicle.Command(Planning::ExtendDrive{"D", 3});
    REQUIRE(vehicle.TakeOrders().at(0).nodes.back().bReleased);
    RejectUpdate(vehicle, "1");
    const auto shortened = vehicle.TakeOrders();
    REQUIRE(shortened.size() == 1);
    CHECK(shortened[0].orderUpdateID == 2);
    CHECK(shortened[0].nodes.front().nodeID == "A");
    CHECK(std::ranges::count(shortened[0].nodes, true, &VDA5050::OrderNode::bReleased) == 2);
    vehicle.state.errors.clear();
    vehicle.ShowOrder(shortened[0], {"B", "C"});
    vehicle.ShowState();
    const auto next = vehicle.TakeOrders();
    REQUIRE(next.size() == 1);
    CHECK(next[0].nodes.front().nodeID == "B");
    CHECK(next[0].nodes.back().bReleased);
    CHECK(vehicle.TakeEvents<Planning::DriveRejected>().empty());
}

TEST_CASE("After a rejected order with a horizon the next order has none, and the one after that has one again")
{
    VehicleFixture vehicle;
    vehicle.ComeOnline();
    for (const std::size_t nodes : {3U, 2U, 3U})
    {
        vehicle.Command(MakeDrive());
        CHECK(vehicle.TakeOrders().at(0).nodes.size() == nodes);
        RejectUpdate(vehicle, "0");
        CHECK(vehicle.TakeEvents<Planning::DriveRejected>().size() == 1);
        vehicle.actions.clear();
        vehicle.state.errors.clear();
        vehicle.ShowState();
    }
}

TEST_CASE(
    "A drive whose update is refused twice is rejected when the vehicle has stopped: until then it drives on its base")
{
    VehicleFixture vehicle;
    SendUnseenUpdate(vehicle);
    RejectUpdate(vehicle, "1");
    REQUIRE(vehicle.TakeOrders().size() == 1);
    RejectUpdate(vehicle, "2");
    CHECK(vehicle.TakeEvents<Planning::DriveRejected>().empty());
    REQUIRE_FALSE(vehicle.outputs.messages.empty());
    const std::string& payload = vehicle.outputs.messages.back().payload;
    const auto cancel = vehicle.codec.Decode<VDA5050::InstantActionsMessage>(payload);
    REQUIRE(cancel);
    REQUIRE(cancel->actions.at(0).actionType == "cancelOrder");
    vehicle.ShowAt("B", 2);
    vehicle.state.nodeStates.clear();
    vehicle.state.actionStates = {
        {cancel->actions[0].actionID, "cancelOrder", "", VDA5050::EActionStatus::Finished, ""}};
    vehicle.ShowState();
    CHECK(vehicle.TakeEvents<Planning::NodePassed>().back() == Planning::NodePassed{"D", "B"});
    const auto rejected = vehicle.TakeEvents<Planning::DriveRejected>();
    REQUIRE(rejected.size() == 1);
    CHECK(rejected[0].reason.find("no such edge") != std::string::npos);
    CHECK(vehicle.TakeEvents<Planning::DriveCancelled>().empty());
}

TEST_CASE("A drive that is abandoned and cannot be cancelled yet is cancelled again, and rejected at its end")
{
    VehicleFixture vehicle;
    SendUnseenUpdate(vehicle);
    RejectUpdate(vehicle, "1");
    REQUIRE(vehicle.TakeOrders().size() == 1);
    RejectUpdate(vehicle, "2");
    std::vector<std::string> cancelIDs;
    for (int count = 0; count < 3; ++count)
    {
        const auto sent = vehicle.codec.Decode<VDA5050::InstantActionsMessage>(vehicle.outputs.messages.back().payload);
        REQUIRE(sent);
        REQUIRE(sent->actions.at(0).actionType == "cancelOrder");
        CHECK(std::ranges::count(cancelIDs, sent->actions[0].actionID) == 0);
        cancelIDs.push_back(sent->actions[0].actionID);
        vehicle.state.actionStates = {{cancelIDs.back(), "cancelOrder", "", VDA5050::EActionStatus::Failed, "busy"}};
        vehicle.outputs.messages.clear();
        vehicle.ShowState();
        vehicle.ShowState();
        CHECK(vehicle.outputs.messages.empty());
        CHECK(vehicle.TakeEvents<Planning::DriveRejected>().empty());
        CHECK_FALSE(vehicle.TakeEvents<Planning::StateChanged>().back().bOccupied);
        vehicle.clock.Advance(VehicleDrive::CANCEL_PAUSE);
        vehicle.ShowState();
        REQUIRE(vehicle.outputs.messages.size() == 1);
    }
    vehicle.ShowAt("B", 2);
    vehicle.state.nodeStates.erase(vehicle.state.nodeStates.begin());
    vehicle.ShowState();
    CHECK(vehicle.TakeEvents<Planning::NodePassed>().back() == Planning::NodePassed{"D", "B"});
    vehicle.state.orderID.clear();
    vehicle.state.nodeStates.clear();
    vehicle.ShowState();
    CHECK(vehicle.TakeEvents<Planning::DriveRejected>().size() == 1);
}

TEST_CASE("A robot is occupied while it executes an order that was cancelled before the vehicle showed it")
{
    VehicleFixture vehicle;
    vehicle.ComeOnline();
    vehicle.Command(MakeDrive());
    const auto orders = vehicle.TakeOrders();
    vehicle.Command(Planning::CancelDrive{"D"});
    const auto cancel = vehicle.codec.Decode<VDA5050::InstantActionsMessage>(vehicle.outputs.messages.back().payload);
    REQUIRE(cancel);
    vehicle.state.actionStates = {
        {cancel->actions.at(0).actionID, "cancelOrder", "", VDA5050::EActionStatus::Failed, ""}};
    vehicle.ShowState();
    CHECK(vehicle.TakeEvents<Planning::DriveCancelled>().size() == 1);
    vehicle.state.actionStates.clear();
    vehicle.ShowOrder(orders.at(0), {"B", "C"});
    vehicle.ShowState();
    CHECK(vehicle.TakeEvents<Planning::StateChanged>().back().bOccupied);
    vehicle.state.nodeStates.clear();
    vehicle.state.edgeStates.clear();
    vehicle.ShowState();
    CHECK_FALSE(vehicle.TakeEvents<Planning::StateChanged>().back().bOccupied);
}

TEST_CASE("If cancelling fails, the update that was withdrawn for it is sent again, and the drive continues")
{
    VehicleFixture vehicle;
    SendUnseenUpdate(vehicle);
    vehicle.Command(Planning::CancelDrive{"D"});
    const auto cancel = vehicle.codec.Decode<VDA5050::InstantActionsMessage>(vehicle.outputs.messages.back().payload);
    REQUIRE(cancel);
    vehicle.outputs.messages.clear();
    vehicle.state.actionStates = {
        {cancel->actions[0].actionID, "cancelOrder", "", VDA5050::EActionStatus::Failed, "not now"}};
    vehicle.ShowState();
    const auto timer = static_cast<Planning::AdapterTimerID>(VDA5050::EMasterTimer::ResendOrder);
    vehicle.adapter.OnTimer(timer, vehicle.clock.GetNow(), vehicle.actions);
    const auto updates = vehicle.TakeOrders();
    REQUIRE(updates.size() == 1);
    CHECK(updates[0].orderUpdateID == 1); // the same one: the vehicle may have received it before
    CHECK(updates[0].nodes.front().nodeID == "B");
    CHECK(updates[0].nodes.back().bReleased);
    CHECK(vehicle.TakeEvents<Planning::DriveRejected>().empty());
}

TEST_CASE("An action that the vehicle has no name for fails the job with a reason")
{
    VehicleFixture vehicle;
    vehicle.ComeOnline();
    vehicle.Command(MakeJob("TrayLoad"));
    REQUIRE(vehicle.TakeEvents<Planning::JobFailed>().size() == 1);
    CHECK(vehicle.TakeOrders().empty());
    CHECK(vehicle.adapter.GetRejectionReasonOrNull("TrayLoad").has_value());
    CHECK_FALSE(vehicle.adapter.GetRejectionReasonOrNull("CassetteLoad").has_value());
}

TEST_CASE("A fatal error of the vehicle is heavy, a warning light, and an emergency stop is shown")
{
    VehicleFixture vehicle;
    vehicle.state.errors = {
        {"motorFault", {}, "too hot", "", VDA5050::EErrorLevel::Fatal},
        {"batteryLow", {}, "", "", VDA5050::EErrorLevel::Warning}};
    vehicle.state.safetyState.emergencyStop = VDA5050::EEmergencyStop::Manual;
    vehicle.ComeOnline();
    const Planning::StateChanged shown = vehicle.TakeEvents<Planning::StateChanged>().back();
    CHECK(shown.bSafetyStop);
    REQUIRE(shown.errors.size() == 2);
    CHECK(shown.errors[0] == Planning::RobotError{"AGV-motorFault", Planning::EAlarmLevel::Heavy, "too hot"});
    CHECK(shown.errors[1].level == Planning::EAlarmLevel::Light);
}

} // namespace ACS::Acsd::Test
