#pragma once

#include <acs/openstream/OpenStreamRequests.hpp>
#include <acs/vda5050/IMqttLink.hpp>

#include <variant>
#include <vector>

namespace ACS::Acsd
{

/// A MONITOR replaces the one before it; a CONTROL is tracked, and the adapter sends none before the last one settled.
using ArmRequest = std::variant<OpenStream::MonitorRequest, OpenStream::ControlRequest>;

/// What the adapters of one robot want sent. Filled by their calls, emptied by the host after each.
struct RobotOutputs
{
    std::vector<VDA5050::MqttMessage> messages;
    std::vector<ArmRequest> armRequests;
};

} // namespace ACS::Acsd
