#pragma once

#include "ISimulatedRobot.hpp"
#include "MqttBroker.hpp"
#include "RobotOutputs.hpp"
#include "TimerBank.hpp"
#include "Vda5050RobotAdapter.hpp"

#include <deque>

namespace ACS::Simulation
{

/// Runs acsd's own adapter of a VDA5050 vehicle as RobotHost does, over the world's broker.
class VehicleHand final : public IRobotHand, private VDA5050::IMqttLinkListener
{
    Timeline& _timeline;
    MqttBroker& _broker;
    ISimulatedRobot::EventHandler _handler;
    TimerBank<Planning::AdapterTimerID> _timers;
    Acsd::RobotOutputs _outputs;
    Acsd::Vda5050RobotAdapter _adapter;
    MqttBroker::ClientID _client;
    std::deque<Planning::AdapterAction> _actions;
    bool _bExecuting = false;

    template <typename TCall>
    void Call(TCall call);
    void Execute(const Planning::AdapterAction& action);
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
