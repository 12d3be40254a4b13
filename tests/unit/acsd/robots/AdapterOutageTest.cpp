#include "robots/ArmFixture.hpp"
#include "robots/VehicleFixture.hpp"
#include "robots/VehicleReport.hpp"
#include <acs/vda5050/PredefinedActions.hpp>

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>
#include <vector>

// What an outage or a restart leaves behind in the adapters.

namespace ACS::Acsd::Test
{

TEST_CASE("A job whose order was not sent before an outage is returned after it: it may be resolved")
{
    VehicleFixture vehicle;
    vehicle.ComeOnline();
    vehicle.state.operatingMode = VDA5050::EOperatingMode::Manual; // switched while the job was stored
    vehicle.ShowState();
    vehicle.Command(MakeJob("CassetteLoad"));
    CHECK(vehicle.TakeOrders().empty());
    SECTION("own connection")
    {
        vehicle.adapter.OnLinkDown(vehicle.clock.GetNow(), vehicle.actions);
    }
    SECTION("the vehicle is silent")
    {
        vehicle.clock.Advance(std::chrono::seconds(60));
        vehicle.adapter.OnTimer(
            static_cast<Planning::AdapterTimerID>(VDA5050::EMasterTimer::Silence),
            vehicle.clock.GetNow(),
            vehicle.actions);
    }
    REQUIRE_FALSE(vehicle.TakeEvents<Planning::LinkChanged>().back().bOnline);
    // The operator answers done: the engine commands nothing.
    vehicle.actions.clear();
    vehicle.state.operatingMode = VDA5050::EOperatingMode::Automatic;
    vehicle.adapter.OnLinkUp(vehicle.clock.GetNow(), vehicle.actions);
    vehicle.ShowState();
    CHECK(vehicle.TakeOrders().empty());
    CHECK(vehicle.TakeEvents<Planning::JobUnknown>().size() == 1);
}

TEST_CASE("A job whose order waits for minOrderInterval is returned after an outage")
{
    VDA5050::MasterOptions options = VehicleFixture::MakeOptions();
    options.factsheet.emplace().protocolLimits.timing.minOrderInterval = 5;
    VehicleFixture vehicle(JobMethods{{"CassetteLoad", {"pick", 0}}}, options);
    vehicle.ComeOnline();
    vehicle.Command(MakeDrive());
    const auto drives = vehicle.TakeOrders();
    REQUIRE(drives.size() == 1);
    vehicle.Command(Planning::CancelDrive{"D"});
    const auto cancel = vehicle.codec.Decode<VDA5050::InstantActionsMessage>(vehicle.outputs.messages.back().payload);
    REQUIRE(cancel);
    vehicle.ShowOrder(drives[0], {});
    vehicle.state.actionStates = {
        {cancel->actions.at(0).actionID, "cancelOrder", "", VDA5050::EActionStatus::Finished, ""}};
    vehicle.ShowState();
    vehicle.outputs.messages.clear();
    vehicle.Command(MakeJob("CassetteLoad"));
    CHECK(vehicle.TakeEvents<Planning::JobFailed>().empty());
    CHECK(vehicle.TakeOrders().empty()); // delayed by the interval
    vehicle.adapter.OnLinkDown(vehicle.clock.GetNow(), vehicle.actions);
    vehicle.clock.Advance(std::chrono::minutes(10)); // The operator answers done.
    vehicle.actions.clear();
    vehicle.adapter.OnLinkUp(vehicle.clock.GetNow(), vehicle.actions);
    vehicle.ShowState();
    CHECK(vehicle.TakeOrders().empty());
}

TEST_CASE("A job that was deferred during an outage is returned after it: it may be resolved")
{
    VDA5050::MasterOptions options = VehicleFixture::MakeOptions();
    options.bFactsheetRequested = true;
    VehicleFixture vehicle(JobMethods{{"CassetteLoad", {"pick", 0}}}, options);
    vehicle.ComeOnline();
    vehicle.adapter.OnLinkDown(vehicle.clock.GetNow(), vehicle.actions);
    vehicle.Command(MakeJob("CassetteLoad")); // stored before the outage was known
    vehicle.ComeOnline();
    vehicle.actions.clear();
    vehicle.adapter.OnTimer(51, vehicle.clock.GetNow(), vehicle.actions);
    CHECK(vehicle.TakeOrders().empty());
    CHECK(vehicle.TakeEvents<Planning::JobUnknown>().size() == 1);
}

TEST_CASE("A vehicle that executes another order while its own is not shown yet is occupied, and keeps its nodes")
{
    VehicleFixture vehicle;
    vehicle.ComeOnline();
    if (GENERATE(true, false))
    {
        vehicle.Command(MakeDrive());
    }
    else
    {
        vehicle.Command(MakeJob("CassetteLoad"));
    }
    REQUIRE(vehicle.TakeOrders().size() == 1);
    vehicle.state.orderID = "foreign";
    vehicle.state.bDriving = true;
    vehicle.state.nodeStates = {{"X", 2, "", true, std::nullopt}, {"Y", 4, "", true, std::nullopt}};
    vehicle.ShowState();
    const Planning::StateChanged shown = vehicle.TakeEvents<Planning::StateChanged>().back();
    CHECK(shown.bOccupied);
    CHECK(shown.heldNodeIDs == std::vector<std::string>{"X", "Y"});
}

TEST_CASE("A rejected order that the vehicle executes after all occupies it, also when the next one was sent")
{
    VehicleFixture vehicle;
    vehicle.ComeOnline();
    vehicle.Command(MakeDrive());
    const auto first = vehicle.TakeOrders();
    REQUIRE(first.size() == 1);
    VDA5050::VehicleError error;
    error.errorType = "orderError";
    error.errorReferences = {{"orderId", "D"}, {"orderUpdateId", "0"}, {"topic", "order"}};
    vehicle.state.errors = {error};
    vehicle.ShowState();
    REQUIRE(vehicle.TakeEvents<Planning::DriveRejected>().size() == 1);
    vehicle.state.errors.clear();
    vehicle.ShowState();
    const bool bNextSent = GENERATE(false, true);
    if (bNextSent)
    {
        Planning::Drive next = MakeDrive();
        next.driveID = "D2";
        vehicle.Command(next);
        REQUIRE(vehicle.TakeOrders().size() == 1);
    }
    CAPTURE(bNextSent);
    vehicle.ShowOrder(first[0], {"B", "C"});
    vehicle.outputs.messages.clear();
    vehicle.ShowState();
    CHECK(vehicle.TakeEvents<Planning::StateChanged>().back().bOccupied);
    const auto isCancel = [](const VDA5050::MqttMessage& message) {
        return message.payload.find("cancelOrder") != std::string::npos;
    };
    CHECK(std::ranges::count_if(vehicle.outputs.messages, isCancel) == 1);
}

TEST_CASE("A job of an arm with other counters is returned also while its base is offline")
{
    ArmFixture arm;
    arm.BringUpWithBase();
    arm.adapter.OnLinkDown(arm.clock.GetNow(), arm.actions);
    arm.DeliverData("[6,6,0]");
    arm.actions.clear();
    Planning::StartJob job; // stored meanwhile
    job.jobID = "J";
    job.action = "TrayLoad";
    job.progressToken = "5 5 0";
    arm.adapter.Handle(job, arm.clock.GetNow(), arm.actions);
    CHECK(arm.TakeEvents<Planning::JobUnknown>().size() == 1);
    CHECK(arm.TakeEvents<Planning::StateChanged>().empty());
}

TEST_CASE("A position of a visualization message is that of before the outage: it is not known after it")
{
    VehicleFixture vehicle;
    vehicle.ComeOnline();
    VDA5050::VisualizationMessage visualization;
    visualization.agvPosition.emplace();
    visualization.agvPosition->x = 12;
    visualization.agvPosition->bPositionInitialized = true;
    vehicle.Receive("visualization", visualization);
    CHECK(vehicle.TakeEvents<Planning::StateChanged>().back().bPoseKnown);
    VDA5050::ConnectionMessage connection;
    connection.connectionState = VDA5050::EConnectionState::ConnectionBroken;
    vehicle.Receive("connection", connection);
    vehicle.actions.clear();
    vehicle.state.lastNodeID.clear(); // carried elsewhere, and switched on
    vehicle.ComeOnline();
    CHECK_FALSE(vehicle.TakeEvents<Planning::StateChanged>().back().bPoseKnown);
}

TEST_CASE("A vehicle without the member paused that was restarted is not paused")
{
    VehicleFixture vehicle;
    vehicle.ComeOnline();
    vehicle.state.orderID = "D";
    vehicle.state.actionStates = {{"A1", "startPause", "", VDA5050::EActionStatus::Finished, ""}};
    vehicle.ShowState();
    CHECK(vehicle.TakeEvents<Planning::StateChanged>().back().bPaused);
    VDA5050::ConnectionMessage connection;
    connection.connectionState = VDA5050::EConnectionState::ConnectionBroken;
    vehicle.Receive("connection", connection);
    vehicle.state.actionStates.clear();
    vehicle.state.orderID.clear();
    vehicle.state.header.headerID = 0;
    vehicle.actions.clear();
    vehicle.ComeOnline();
    CHECK_FALSE(vehicle.TakeEvents<Planning::StateChanged>().back().bPaused);
}

TEST_CASE("A vehicle without the member paused may list the newest action first")
{
    VehicleReport report;
    VDA5050::StateMessage state;
    state.actionStates = {{"A1", "startPause", "", VDA5050::EActionStatus::Finished, ""}};
    report.Update(state, false, {});
    state.actionStates.insert(
        state.actionStates.begin(),
        VDA5050::ActionState{"A2", "stopPause", "", VDA5050::EActionStatus::Finished, ""});
    report.Update(state, false, {});
    CHECK_FALSE(report.GetState().bPaused);
}

TEST_CASE("After a restart of acsd the charging that it began before does not make the vehicle occupied")
{
    VehicleFixture vehicle;
    vehicle.state.orderID = "before";
    vehicle.state.batteryState.bCharging = true;
    vehicle.state.actionStates = {
        {"acs-startCharging-1764600000000-7", "startCharging", "", VDA5050::EActionStatus::Running, ""}};
    vehicle.ComeOnline();
    CHECK_FALSE(vehicle.TakeEvents<Planning::StateChanged>().back().bOccupied);
}

} // namespace ACS::Acsd::Test
