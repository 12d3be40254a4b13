#pragma once

#include "common/trace/SimulatorTrace.hpp"
#include <acs/core/Result.hpp>
#include <acs/vda5050/IMqttLink.hpp>

#include <string>

namespace ACS::VdaSim
{

/// Writes the messages of one MQTT connection to the trace of the program, if there is one.
class MqttTrace final
{
    Apps::SimulatorTrace* _traceOrNull;
    std::string _robotID;

public:
    /// The trace outlives it. The robot is empty for a connection that belongs to no vehicle.
    MqttTrace(Apps::SimulatorTrace* traceOrNull, std::string robotID);

    void OnReceived(const VDA5050::MqttMessage& message) const;

    /// Publishes the message, and writes it if the link has accepted it.
    [[nodiscard]] Core::Result<void> Publish(const VDA5050::MqttMessage& message, VDA5050::IMqttLink& link) const;

    /// The link is about to publish the message itself.
    void OnSent(const VDA5050::MqttMessage& message) const;

private:
    void Write(bool bIn, const VDA5050::MqttMessage& message, Core::Now now) const;
};

} // namespace ACS::VdaSim
