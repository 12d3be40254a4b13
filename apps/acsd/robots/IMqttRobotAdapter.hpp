#pragma once

#include <acs/plan/IRobotAdapter.hpp>
#include <acs/vda5050/IMqttLink.hpp>
#include <acs/vda5050/MasterSession.hpp>

#include <vector>

namespace ACS::Acsd
{

/// The adapter of a robot whose vehicle is connected to the broker. Calls append to `out`, like those of IRobotAdapter.
class IMqttRobotAdapter : public Planning::IRobotAdapter
{
public:
    [[nodiscard]] virtual std::vector<VDA5050::MqttSubscription> GetSubscriptions() const = 0;

    /// The broker is connected and has confirmed the subscriptions.
    virtual void OnLinkUp(Core::Now now, Planning::AdapterActions& out) = 0;
    virtual void OnLinkDown(Core::Now now, Planning::AdapterActions& out) = 0;

    /// Messages of other robots are ignored.
    virtual void OnMqttMessage(const VDA5050::MqttMessage& message, Core::Now now, Planning::AdapterActions& out) = 0;

    /// The session with the vehicle, for its state and statistics.
    [[nodiscard]] virtual const VDA5050::MasterSession& GetSession() const noexcept = 0;
};

} // namespace ACS::Acsd
