#pragma once

#include <acs/core/IRandom.hpp>
#include <acs/core/Logger.hpp>
#include <acs/core/Result.hpp>
#include <acs/vda5050/IMqttLink.hpp>
#include <acs/vda5050_mosquitto/MosquittoOptions.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace ACS::VDA5050
{

/// One connection to an MQTT 3.1.1 or 5 broker through libmosquitto, on the caller's executor and without a thread of its
/// own. Connects, and connects again for ever with growing pauses; says so in the log once per outage, not per attempt.
/// What is published while there is no connection is refused: the sessions above send again.
///
/// One thread: the executor's. Connecting never blocks but for the look-up of a host name, which the system's resolver
/// bounds (some seconds where its servers are silent); give an address where that matters. A name with several addresses
/// is tried at its first one, but for localhost.
class MosquittoLink final : public IMqttLink
{
    class Impl;
    std::shared_ptr<Impl> _impl;

public:
    using StopHandler = std::function<void()>;

    static constexpr std::chrono::milliseconds DEFAULT_STOP_TIMEOUT{2'000};

    /// Nothing happens before Start. The random source (for the pauses) and the listener must outlive the link.
    MosquittoLink(
        const boost::asio::any_io_executor& executor,
        Core::IRandom& random,
        Core::Logger logger,
        MosquittoOptions options,
        IMqttLinkListener& listener);
    MosquittoLink(const MosquittoLink&) = delete;
    MosquittoLink& operator=(const MosquittoLink&) = delete;

    /// Cuts the connection without a word, so that the broker sends the will. Nobody is called any more.
    ~MosquittoLink() override;

    /// Begins to connect. Not after StopAsync.
    void Start();

    /// Fails, and nothing is sent, with std::errc::not_connected, with Core::ECoreError::QueueFull where too much waits
    /// already, or with libmosquitto's own error (a topic with wildcards).
    [[nodiscard]] Core::Result<void> Publish(const MqttMessage& message) override;

    /// Kept for every connection to come; sent at once where there is one. The listener's OnLinkUp waits for those
    /// that were there before the connection; what comes in before it is handed over after it. Where the broker refuses
    /// one of them the connection is left and tried again; the refusal of a later one is logged.
    void Subscribe(const std::vector<MqttSubscription>& subscriptions) override;

    /// Used from the next connect on.
    void SetWill(const MqttWill& will);

    /// Between OnLinkUp and OnLinkDown.
    [[nodiscard]] bool IsConnected() const;

    /// Publishes the last message (OFFLINE), waits until the broker has acknowledged it and all before it (or the time is
    /// over), takes leave so that no will is sent, and then calls back, once, from the executor. Nothing is received any
    /// more. Called again, it calls back as well, with the first or after it; the other arguments of then do not count.
    void StopAsync(
        const std::optional<MqttMessage>& lastMessageOrNull,
        std::chrono::milliseconds timeout,
        StopHandler handler);
};

} // namespace ACS::VDA5050
