#pragma once

#include "AdapterRunner.hpp"
#include "ISimulatedRobot.hpp"
#include "MqttBroker.hpp"
#include "RobotOutputs.hpp"
#include "Vda5050RobotAdapter.hpp"

namespace ACS::Simulation
{

/// Runs acsd's own adapter of a VDA5050 vehicle as RobotHost does, over the world's broker.
class VehicleHand final : public IRobotHand, private VDA5050::IMqttLinkListener
{
    MqttBroker& _broker;
    Acsd::RobotOutputs _outputs;
    Acsd::Vda5050RobotAdapter _adapter;
    AdapterRunner _runner;
    MqttBroker::ClientID _client;

    void Publish();
    void OnLinkUp() override;
    void OnLinkDown(std::error_code reason) override;
    void OnMqttMessage(const VDA5050::MqttMessage& message) override;

public:
    VehicleHand(
        Timeline& timeline,
        MqttBroker& broker,
        const VDA5050::VehicleAddress& address,
        ISimulatedRobot::EventHandler handler);
    VehicleHand(const VehicleHand&) = delete;
    VehicleHand& operator=(const VehicleHand&) = delete;
    ~VehicleHand() override;

    void Handle(const Planning::RobotCommand& command) override;
};

} // namespace ACS::Simulation
