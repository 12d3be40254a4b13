#pragma once

#include "AdapterRunner.hpp"
#include "ArmClient.hpp"
#include "ArmController.hpp"
#include "ISimulatedRobot.hpp"
#include "MqttBroker.hpp"
#include "robots/RobotAdapterFactory.hpp"
#include "robots/RobotOutputs.hpp"

#include <memory>
#include <string>

namespace ACS::Simulation
{

/// Runs acsd's adapter of a VDA5050 vehicle, with an arm or without, as RobotRunner does: over the simulated broker, and
/// over the network of the arm's controller.
class VehicleConnection final : public IRobotConnection, private VDA5050::IMqttLinkListener
{
public:
    using EventHandler = ISimulatedRobot::EventHandler;

private:
    MqttBroker& _broker;
    Acsd::RobotOutputs _outputs;
    Acsd::RobotAdapter _adapter;
    AdapterRunner _runner;
    MqttBroker::ClientID _client;
    std::unique_ptr<ArmClient> _armOrNull;

public:
    /// The controller of its arm; null: without one.
    VehicleConnection(
        Timeline& timeline,
        MqttBroker& broker,
        const Planning::RobotOptions& robot,
        EventHandler handler,
        ArmController* controllerOrNull);
    VehicleConnection(const VehicleConnection&) = delete;
    VehicleConnection& operator=(const VehicleConnection&) = delete;
    ~VehicleConnection() override;

    void Handle(const Planning::RobotCommand& command) override;

private:
    void SendAll();
    void OnLinkUp() override;
    void OnLinkDown(std::error_code reason) override;
    void OnMqttMessage(const VDA5050::MqttMessage& message) override;
};

} // namespace ACS::Simulation
