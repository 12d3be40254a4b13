#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/IRandom.hpp>
#include <acs/core/Logger.hpp>
#include <acs/core/Result.hpp>
#include <acs/vda5050/IMqttLink.hpp>
#include <acs/vda5050_mosquitto/MosquittoOptions.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ACS::VDA5050
{

/// A connection to an MQTT 3.1.1 or 5 broker through libmosquitto, on the caller's executor. Reconnects indefinitely with
/// exponential backoff, to the next broker if there are several; an outage is logged once per broker, not per attempt. Without a
/// connection Publish fails, and the sessions resend.
///
/// Runs on the single thread of the executor. Each attempt to connect has a thread of its own until the name of the host is
/// resolved and connect() has begun, so that a name server or a broker that does not answer never blocks the executor. An
/// attempt that hangs is abandoned after connectTimeout; the next one with the same broker (in a persistent session: with any
/// broker) begins when its thread has ended. Of a name with several addresses only the first one is tried, except for localhost.
class ACS_API MosquittoLink final : public IMqttLink
{
public:
    /// Called once, on the executor, after the connection was closed.
    using StopHandler = std::function<void()>;

    /// A time limit for StopAsync that suits a broker on the local network.
    static constexpr std::chrono::milliseconds DEFAULT_STOP_TIMEOUT{2'000};

private:
    class ACS_HIDDEN Impl;

    std::shared_ptr<Impl> _impl;

public:
    /// Does not connect before Start. The random source (for the backoff) and the listener must outlive the link.
    MosquittoLink(
        const boost::asio::any_io_executor& executor,
        Core::IRandom& random,
        Core::Logger logger,
        MosquittoOptions options,
        IMqttLinkListener& listener);
    MosquittoLink(const MosquittoLink&) = delete;
    MosquittoLink& operator=(const MosquittoLink&) = delete;

    /// Closes the connection without DISCONNECT, so that the broker sends the will. The listener is not called any more.
    ~MosquittoLink() override;

    /// Starts connecting. Must not be called after StopAsync.
    void Start();

    /// Fails and sends nothing with std::errc::not_connected, with Core::ECoreError::QueueFull if too many messages wait, or
    /// with an error of libmosquitto (for example a topic with wildcards).
    [[nodiscard]] Core::Result<void> Publish(const MqttMessage& message) override;

    /// Applies to the current and all later connections. OnLinkUp follows when the subscriptions made before the connection
    /// are confirmed; messages that arrive earlier are delivered after it. If the broker refuses one of them, the connection
    /// is closed and retried; the refusal of a later subscription is logged.
    void Subscribe(const std::vector<MqttSubscription>& subscriptions) override;

    /// Without a connection, the broker keeps the subscription of a persistent session.
    void Unsubscribe(const std::string& topicFilter) override;

    /// Applies from the next connect on.
    void SetWill(const MqttWill& will);

    /// Between OnLinkUp and OnLinkDown.
    [[nodiscard]] bool IsConnected() const;

    /// The broker that is connected or tried: 0 is MosquittoOptions::host, N the Nth of furtherBrokers.
    [[nodiscard]] std::size_t GetBrokerIndex() const;

    /// Publishes the last message (OFFLINE), waits until the broker has acknowledged it and all earlier ones, at most for
    /// the timeout, disconnects so that no will is sent, and then calls the handler once on the executor. Nothing is
    /// received any more. The handler of a repeated call is called as well; its other arguments are ignored.
    void StopAsync(
        const std::optional<MqttMessage>& lastMessageOrNull,
        std::chrono::milliseconds timeout,
        StopHandler handler);
};

} // namespace ACS::VDA5050
