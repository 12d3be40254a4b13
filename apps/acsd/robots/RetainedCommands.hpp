#pragma once

#include <acs/acsd/IRobotMetrics.hpp>
#include <acs/core/Logger.hpp>
#include <acs/vda5050/IMqttLink.hpp>
#include <acs/vda5050/Topic.hpp>

#include <chrono>
#include <string>
#include <vector>

namespace ACS::Acsd
{

/// Removes what other programs have left retained on the command topics of one vehicle: the broker would deliver such an order
/// to the vehicle at each connect. Commands are never retained.
///
/// The broker marks a message as retained only for a subscription that is made after it. So each connection subscribes, until the
/// first message on the topic that is not marked: acsd's own next order, or one that another program retains now. Each RENEWAL
/// subscribes again to the topics where that has happened, and so finds what was retained meanwhile.
class RetainedCommands final
{
public:
    static constexpr std::chrono::minutes RENEWAL{5};

    /// All of these must outlive the object.
    struct Dependencies
    {
        VDA5050::IMqttLink& mqtt;
        Core::Logger logger;
        IRobotMetrics& metrics;
    };

private:
    Dependencies _dependencies;
    std::string _robotID;
    std::vector<std::string> _topics;
    std::vector<std::string> _ended; ///< Those whose subscription has ended in this connection.

public:
    RetainedCommands(Dependencies dependencies, std::string robotID, const VDA5050::VehicleAddress& vehicle);

    void OnLinkUp();
    void OnLinkDown();
    /// Call it every RENEWAL while the link is up.
    void Renew();

    /// False: the message is not on a command topic, and nothing was done.
    [[nodiscard]] bool TryHandle(const VDA5050::MqttMessage& message);

private:
    void Subscribe(const std::vector<std::string>& topics);
    void Remove(const VDA5050::MqttMessage& message);
};

} // namespace ACS::Acsd
