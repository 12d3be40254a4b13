#pragma once

#include "vda-sim/MqttTrace.hpp"
#include <acs/core/IRandom.hpp>
#include <acs/core/Logger.hpp>
#include <acs/vda5050_mosquitto/MosquittoLink.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace ACS::VdaSim
{

/// Receives commands over MQTT, on its own connection: passes each message on the topic to the handler and publishes the
/// answer on TOPIC/result. One thread: the executor's.
class ControlChannel final : public VDA5050::IMqttLinkListener
{
public:
    /// Returns the answer.
    using CommandHandler = std::function<std::string(std::string_view text)>;
    using ConnectedHandler = std::function<void()>;

private:
    std::string _topic;
    Core::Logger _logger;
    CommandHandler _onCommand;
    ConnectedHandler _onConnected;
    MqttTrace _trace;
    VDA5050::MosquittoLink _link;

public:
    ControlChannel(
        const boost::asio::any_io_executor& executor,
        Core::IRandom& random,
        Core::Logger logger,
        VDA5050::MosquittoOptions options,
        std::string topic,
        CommandHandler onCommand,
        MqttTrace trace);

    /// Begins to connect; the handler is called after each subscription.
    void Start(ConnectedHandler onConnected);

    /// Index of the broker that it is connected to, in the order of the options.
    [[nodiscard]] std::size_t GetBrokerIndex() const;

    void StopAsync(std::function<void()> onStopped);

    void OnLinkUp() override;
    void OnLinkDown(std::error_code reason) override;
    void OnMqttMessage(const VDA5050::MqttMessage& message) override;
};

} // namespace ACS::VdaSim
