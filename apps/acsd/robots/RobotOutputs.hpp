#pragma once

#include <acs/acsd/RobotAction.hpp>
#include <acs/openstream/OpenStreamRequests.hpp>
#include <acs/vda5050/IMqttLink.hpp>

#include <variant>
#include <vector>

namespace ACS::Acsd
{

/// A MONITOR replaces the one before it; a CONTROL is tracked, and the adapter sends none before the last one settled.
using ArmRequest = std::variant<OpenStream::MonitorRequest, OpenStream::ControlRequest>;

/// Messages that the adapters of one robot send. Calls of the adapters fill it; the host empties it after each call.
struct RobotOutputs
{
    std::vector<VDA5050::MqttMessage> messages;
    std::vector<ArmRequest> armRequests;
    std::vector<RobotActionChange> actionChanges; ///< Of the instant actions of operators.
};

} // namespace ACS::Acsd
