#pragma once

#include "common/http/MetricsEndpoint.hpp"
#include <acs/core/Logger.hpp>
#include <acs/vda5050/IMqttLink.hpp>
#include <acs/vda5050/Topic.hpp>

#include <string>
#include <vector>

namespace ACS::Acsd
{

/// Removes what other programs have left retained on the command topics of one vehicle: the broker would deliver such an order
/// to the vehicle at each connect. Commands are never retained.
///
/// The broker delivers a retained message after a subscription only. So each connection subscribes once, until the first message
/// that is not retained, such as acsd's own next order.
class RetainedCommands final
{
public:
    /// All of these must outlive the object.
    struct Dependencies
    {
        VDA5050::IMqttLink& mqtt;
        Core::Logger logger;
        Apps::MetricsEndpoint& metrics;
    };

private:
    Dependencies _dependencies;
    std::string _robotID;
    std::vector<std::string> _topics;

public:
    RetainedCommands(Dependencies dependencies, std::string robotID, const VDA5050::VehicleAddress& vehicle);

    void OnLinkUp();
    void OnLinkDown();

    /// False: the message is not on a command topic, and nothing was done.
    [[nodiscard]] bool TryHandle(const VDA5050::MqttMessage& message);

private:
    void Remove(const VDA5050::MqttMessage& message);
};

} // namespace ACS::Acsd
