#pragma once

#include "Catch.hpp"
#include "ManualClock.hpp"
#include "robots/Vda5050RobotAdapter.hpp"
#include <acs/vda5050/PredefinedActions.hpp>
#include <acs/vda5050/Vda5050Codec.hpp>

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace ACS::Acsd::Test
{

/// The predefined actions with the parameters of the standard, for a test to change.
struct StandardFactsheet
{
    VDA5050::FactsheetMessage factsheet;

    StandardFactsheet()
    {
        factsheet.protocolFeatures.agvActions = VDA5050::GetPredefinedActions();
    }

    VDA5050::AgvAction& GetPick()
    {
        return *std::ranges::find(
            factsheet.protocolFeatures.agvActions,
            VDA5050::ActionTypes::PICK,
            &VDA5050::AgvAction::actionType);
    }
};

/// Accepts every order.
inline const VehicleDrive::OrderCheck ACCEPT = [](const VDA5050::OrderMessage&) {
    return Core::Result<void>();
};

/// The vehicle's side is played by hand: it shows what a test lets it show.
struct VehicleFixture
{
    Testing::ManualClock clock;
    RobotOutputs outputs;
    VDA5050::Vda5050Codec codec;
    VDA5050::StateMessage state;
    Planning::AdapterActions actions;
    Vda5050RobotAdapter adapter;

    static VDA5050::MasterOptions MakeOptions()
    {
        VDA5050::MasterOptions options;
        options.address = {"uagv", "ACS", "LR01"};
        options.bFactsheetRequested = false;
        options.bStateRequested = false;
        return options;
    }

    VehicleFixture()
        : VehicleFixture(JobMethods{{"CassetteLoad", {"pick", 0}}, {"TrayLoad", {"", 11}}})
    {
    }

    explicit VehicleFixture(
        JobMethods methods,
        VDA5050::MasterOptions options = MakeOptions(),
        std::shared_ptr<DriveCheck> drives = std::make_shared<DriveCheck>(),
        const std::vector<NeededMap>& maps = {})
        : adapter(
            std::move(options),
            std::move(methods),
            outputs,
            Vda5050RobotAdapter::LOAD_TIMEOUT,
            std::move(drives),
            maps)
    {
        state.header.version = "2.0.0";
        state.header.manufacturer = "ACS";
        state.header.serialNumber = "LR01";
        state.lastNodeID = "A";
    }

    template <typename TMessage>
    void Receive(std::string_view topic, TMessage message)
    {
        message.header = state.header;
        message.header.timestamp = clock.GetNow().wall;
        std::string payload;
        const auto version = VDA5050::ReadVersionOrNull(message.header.version);
        codec.Encode(message, version.value_or(VDA5050::EVda5050Version::Version200), payload);
        adapter.OnMqttMessage({"uagv/v2/ACS/LR01/" + std::string(topic), payload, 0, false}, clock.GetNow(), actions);
    }

    void ShowState()
    {
        ++state.header.headerID;
        Receive("state", state);
    }

    void ComeOnline()
    {
        adapter.OnLinkUp(clock.GetNow(), actions);
        VDA5050::ConnectionMessage connection;
        connection.connectionState = VDA5050::EConnectionState::Online;
        Receive("connection", connection);
        ShowState();
        outputs.messages.clear();
    }

    void Command(const Planning::RobotCommand& command)
    {
        adapter.Handle(command, clock.GetNow(), actions);
    }

    std::vector<VDA5050::OrderMessage> TakeOrders()
    {
        std::vector<VDA5050::OrderMessage> orders;
        for (const VDA5050::MqttMessage& message : std::exchange(outputs.messages, {}))
        {
            if (message.topic.ends_with("/order"))
            {
                auto order = codec.Decode<VDA5050::OrderMessage>(message.payload);
                REQUIRE(order);
                orders.push_back(std::move(*order));
            }
        }
        return orders;
    }

    /// Shows the order as accepted, with these nodes still to be reached.
    void ShowOrder(const VDA5050::OrderMessage& order, const std::vector<std::string>& remaining)
    {
        state.orderID = order.orderID;
        state.orderUpdateID = order.orderUpdateID;
        state.nodeStates.clear();
        state.edgeStates.clear();
        for (const VDA5050::OrderNode& node : order.nodes)
        {
            if (std::find(remaining.begin(), remaining.end(), node.nodeID) != remaining.end())
            {
                state.nodeStates.push_back({node.nodeID, node.sequenceID, "", node.bReleased, std::nullopt});
            }
        }
    }

    void ShowAt(const std::string& nodeID, std::uint32_t sequenceID)
    {
        state.lastNodeID = nodeID;
        state.lastNodeSequenceID = sequenceID;
    }

    template <typename TEvent>
    [[nodiscard]] std::vector<TEvent> TakeEvents() const
    {
        std::vector<TEvent> events;
        for (const Planning::AdapterAction& action : actions)
        {
            const auto* raiseOrNull = std::get_if<Planning::RaiseEvent>(&action);
            if (raiseOrNull != nullptr && std::holds_alternative<TEvent>(raiseOrNull->event))
            {
                events.push_back(std::get<TEvent>(raiseOrNull->event));
            }
        }
        return events;
    }
};

inline Planning::Drive MakeDrive()
{
    Planning::Drive drive;
    drive.driveID = "D";
    drive.releasedCount = 2;
    for (const char* nodeID : {"A", "B", "C"})
    {
        drive.route.nodes.push_back({nodeID, 0.0, 0.0, std::nullopt, "floor-1"});
    }
    drive.route.edges.push_back({"AB", "A", "B", 1.0, 1.2, std::nullopt, std::nullopt, "", std::nullopt});
    drive.route.edges.push_back({"BC", "B", "C", 1.0, 0.4, std::nullopt, 0.0, "TANGENTIAL", false});
    return drive;
}

inline Planning::StartJob MakeJob(const std::string& action)
{
    Planning::StartJob job;
    job.jobID = "J";
    job.commandID = "U1";
    job.action = action;
    job.position = "A01.CP01";
    job.carrierID = "C1";
    return job;
}

} // namespace ACS::Acsd::Test
