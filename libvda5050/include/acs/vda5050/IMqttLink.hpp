#pragma once

#include <acs/core/Result.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace ACS::VDA5050
{

/// A message as a session wants it published, or as it came from the broker.
struct MqttMessage
{
    std::string topic;
    std::string payload;
    std::uint8_t qos = 0; ///< 0, 1 or 2.
    bool bRetained = false;

    bool operator==(const MqttMessage&) const = default;
};

/// What a session asks of its owner: hand the message to the link.
struct PublishMessage
{
    MqttMessage message;

    bool operator==(const PublishMessage&) const = default;
};

/// What the broker publishes for a client that vanishes; handed over before connecting.
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

/// What a link tells its owner, on the owner's thread. The owner forwards it to its sessions.
class IMqttLinkListener
{
public:
    IMqttLinkListener() = default;
    IMqttLinkListener(const IMqttLinkListener&) = delete;
    IMqttLinkListener& operator=(const IMqttLinkListener&) = delete;
    virtual ~IMqttLinkListener() = default;

    /// Connected, and all subscriptions confirmed.
    virtual void OnLinkUp() = 0;
    virtual void OnLinkDown(std::error_code reason) = 0;
    virtual void OnMqttMessage(const MqttMessage& message) = 0;
};

/// A connection to a broker: executes what sessions ask for, decides nothing. Implemented over libmosquitto and by the
/// broker of the tests. All calls on the owner's thread.
class IMqttLink
{
public:
    IMqttLink() = default;
    IMqttLink(const IMqttLink&) = delete;
    IMqttLink& operator=(const IMqttLink&) = delete;
    virtual ~IMqttLink() = default;

    /// Queues a message. Fails with Core::ECoreError::QueueFull when the link's queue has no room.
    [[nodiscard]] virtual Core::Result<void> Publish(const MqttMessage& message) = 0;
    /// Subscribes now and after each reconnect.
    virtual void Subscribe(const std::vector<MqttSubscription>& subscriptions) = 0;
};

} // namespace ACS::VDA5050
