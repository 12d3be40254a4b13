#pragma once

#include <acs/acsd/RobotAction.hpp>
#include <acs/plan/IRobotAdapter.hpp>
#include <acs/vda5050/IMqttLink.hpp>
#include <acs/vda5050/MasterSession.hpp>

#include <tl/expected.hpp>

#include <string>
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

    /// Validates an instant action of an operator and sends it. The result is its id; RobotOutputs::actionChanges has its changes.
    [[nodiscard]] virtual tl::expected<std::string, RobotActionRefusal> RequestAction(
        const RobotActionRequest& request,
        Core::Now now,
        Planning::AdapterActions& out) = 0;

    /// The session with the vehicle, for its state and statistics.
    [[nodiscard]] virtual const VDA5050::MasterSession& GetSession() const noexcept = 0;
};

} // namespace ACS::Acsd
