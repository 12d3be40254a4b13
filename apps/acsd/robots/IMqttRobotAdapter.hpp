#pragma once

#include <acs/plan/IRobotAdapter.hpp>
#include <acs/vda5050/IMqttLink.hpp>
#include <acs/vda5050/MasterSession.hpp>

#include <vector>

namespace ACS::Acsd
{

/// An adapter whose robot (or its base) speaks over the broker. Calls append to out, as those of IRobotAdapter.
class IMqttRobotAdapter : public Planning::IRobotAdapter
{
public:
    [[nodiscard]] virtual std::vector<VDA5050::MqttSubscription> GetSubscriptions() const = 0;

    /// The broker is connected and the subscriptions stand.
    virtual void OnLinkUp(Core::Now now, Planning::AdapterActions& out) = 0;
    virtual void OnLinkDown(Core::Now now, Planning::AdapterActions& out) = 0;

    /// Messages for other robots may come too and are ignored.
    virtual void OnMqttMessage(const VDA5050::MqttMessage& message, Core::Now now, Planning::AdapterActions& out) = 0;

    /// What the vehicle has shown, and what was counted of it.
    [[nodiscard]] virtual const VDA5050::MasterSession& GetSession() const noexcept = 0;
};

} // namespace ACS::Acsd
