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
    std::string topic;
    std::string payload;
    std::uint8_t qos = 0; ///< 0, 1 or 2.
    bool bRetained = false;

    bool operator==(const MqttMessage&) const = default;
};

/// Action of a session: pass the message to the link.
struct PublishMessage
{
    MqttMessage message;

    bool operator==(const PublishMessage&) const = default;
};

/// The last will: the broker publishes it if the client's connection breaks. Set before connecting.
struct MqttWill
{
    MqttMessage message;

    bool operator==(const MqttWill&) const = default;
};

struct MqttSubscription
{
    std::string topicFilter;
    std::uint8_t qos = 0;

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
    virtual void OnLinkDown(std::error_code reason) = 0;
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
