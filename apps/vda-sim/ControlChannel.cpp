#include "vda-sim/ControlChannel.hpp"

#include <optional>
#include <utility>

namespace ACS::VdaSim
{
namespace
{

constexpr std::uint8_t CONTROL_QOS = 1;
constexpr std::string_view RESULT_LEVEL = "/result";

} // namespace

ControlChannel::ControlChannel(
    const boost::asio::any_io_executor& executor,
    Core::IRandom& random,
    Core::Logger logger,
    VDA5050::MosquittoOptions options,
    std::string topic,
    CommandHandler onCommand,
    MqttTrace trace)
    : _topic(std::move(topic)),
      _logger(logger),
      _onCommand(std::move(onCommand)),
      _trace(std::move(trace)),
      _link(executor, random, std::move(logger), std::move(options), *this)
{
    _link.Subscribe({{_topic, CONTROL_QOS}});
}

void ControlChannel::Start(ConnectedHandler onConnected)
{
    _onConnected = std::move(onConnected);
    _link.Start();
}

std::size_t ControlChannel::GetBrokerIndex() const
{
    return _link.GetBrokerIndex();
}

void ControlChannel::StopAsync(std::function<void()> onStopped)
{
    _link.StopAsync(std::nullopt, VDA5050::MosquittoLink::DEFAULT_STOP_TIMEOUT, std::move(onStopped));
}

void ControlChannel::OnLinkUp()
{
    if (_onConnected)
    {
        _onConnected();
    }
}

void ControlChannel::OnLinkDown(std::error_code /*reason*/)
{
    // The link logs it and reconnects.
}

void ControlChannel::OnMqttMessage(const VDA5050::MqttMessage& message)
{
    _trace.OnReceived(message);
    if (message.bRetained)
    {
        _logger.Warning(
            "a retained command is ignored: it would be executed at each start",
            {{"topic", message.topic}});
        return;
    }
    const VDA5050::MqttMessage answer{
        _topic + std::string(RESULT_LEVEL),
        _onCommand(message.payload),
        CONTROL_QOS,
        false};
    const Core::Result<void> sent = _trace.Publish(answer, _link);
    if (!sent.has_value())
    {
        _logger.Warning("cannot answer a command", {{"reason", Core::Describe(sent.error())}});
    }
}

} // namespace ACS::VdaSim
