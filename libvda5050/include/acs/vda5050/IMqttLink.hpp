#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/Result.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace ACS::VDA5050
{

/// A message to publish, or one from the broker.
struct MqttMessage
{
    std::string topic;      ///< Without wildcards.
    std::string payload;    ///< Any bytes; JSON in VDA5050.
    std::uint8_t qos = 0;   ///< 0, 1 or 2.
    bool bRetained = false; ///< The broker keeps it for later subscribers; of a received message: it was kept.

    bool operator==(const MqttMessage&) const = default;
};

/// Action of a session: pass the message to the link.
struct PublishMessage
{
    MqttMessage message; ///< To be published with its qos and bRetained.

    bool operator==(const PublishMessage&) const = default;
};

/// The last will: the broker publishes it if the client's connection breaks. Set before connecting.
struct MqttWill
{
    MqttMessage message; ///< Of VDA5050: a ConnectionMessage with ConnectionBroken, retained.

    bool operator==(const MqttWill&) const = default;
};

/// Which messages the broker delivers, and how.
struct MqttSubscription
{
    std::string topicFilter; ///< May contain the wildcards `+` and `#`.
    std::uint8_t qos = 0;    ///< Maximum quality of service of delivered messages: 0, 1 or 2.

    bool operator==(const MqttSubscription&) const = default;
};

/// Events of a link, on the owner's thread. The owner forwards them to its sessions.
class ACS_API IMqttLinkListener
{
public:
    IMqttLinkListener() = default;
    IMqttLinkListener(const IMqttLinkListener&) = delete;
    IMqttLinkListener& operator=(const IMqttLinkListener&) = delete;
    virtual ~IMqttLinkListener() = default;

    /// Connected, and all subscriptions are confirmed.
    virtual void OnLinkUp() = 0;
    /// The connection was lost; the link reconnects by itself. Called once after each OnLinkUp, unless the owner stops the
    /// link.
    virtual void OnLinkDown(std::error_code reason) = 0;
    /// A message of one of the subscriptions. The reference is valid during the call only.
    virtual void OnMqttMessage(const MqttMessage& message) = 0;
};

/// A connection to a broker, without any logic of the protocol. All calls on the owner's thread.
class ACS_API IMqttLink
{
public:
    IMqttLink() = default;
    IMqttLink(const IMqttLink&) = delete;
    IMqttLink& operator=(const IMqttLink&) = delete;
    virtual ~IMqttLink() = default;

    /// Queues a message. Fails with Core::ECoreError::QueueFull if the link's queue is full.
    [[nodiscard]] virtual Core::Result<void> Publish(const MqttMessage& message) = 0;
    /// Subscribes now and after each reconnect.
    virtual void Subscribe(const std::vector<MqttSubscription>& subscriptions) = 0;
    /// Ends the subscription with this filter, now and for later connections. Messages that are on their way still arrive.
    virtual void Unsubscribe(const std::string& topicFilter) = 0;
};

} // namespace ACS::VDA5050
