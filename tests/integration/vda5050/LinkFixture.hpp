#pragma once

#include "MosquittoBroker.hpp"
#include "RecordingLogSink.hpp"
#include "SeededRandom.hpp"
#include <acs/vda5050_mosquitto/MosquittoLink.hpp>

#include <boost/asio/io_context.hpp>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace ACS::Testing
{

/// Remembers what a link tells.
class RecordingListener final : public VDA5050::IMqttLinkListener
{
public:
    std::size_t ups = 0;
    std::size_t downs = 0;
    std::vector<VDA5050::MqttMessage> messages;
    std::function<void()> whenUp;

    void OnLinkUp() override
    {
        ++ups;
        if (whenUp)
        {
            whenUp();
        }
    }

    void OnLinkDown(std::error_code /*reason*/) override
    {
        ++downs;
    }

    void OnMqttMessage(const VDA5050::MqttMessage& message) override
    {
        messages.push_back(message);
    }

    [[nodiscard]] std::size_t CountTopic(std::string_view topic) const
    {
        return static_cast<std::size_t>(std::ranges::count(messages, topic, &VDA5050::MqttMessage::topic));
    }

    [[nodiscard]] bool Contains(std::string_view topic, std::string_view part) const
    {
        return std::ranges::any_of(messages, [topic, part](const VDA5050::MqttMessage& message) {
            return message.topic == topic && message.payload.find(part) != std::string::npos;
        });
    }
};

/// Runs the loop until the condition holds; false where the time was over first.
inline bool TryRunUntil(
    boost::asio::io_context& context,
    const std::function<bool()>& isTrue,
    std::chrono::milliseconds timeout = std::chrono::seconds(15))
{
    const auto deadline = std::chrono::steady_clock::now() + timeout;
    context.restart();
    while (!isTrue())
    {
        if (context.run_one_until(deadline) == 0)
        {
            return isTrue();
        }
    }
    return true;
}

/// A link to a broker of the test, with short pauses between attempts.
struct TestLink
{
    RecordingLogSink log;
    SeededRandom random;
    RecordingListener listener;
    VDA5050::MosquittoLink link;

    TestLink(boost::asio::io_context& context, VDA5050::MosquittoOptions options)
        : link(context.get_executor(), random, Core::Logger(log, "mqtt"), std::move(options), listener)
    {
    }
};

inline VDA5050::MosquittoOptions MakeOptions(std::uint16_t port, std::string clientID)
{
    VDA5050::MosquittoOptions options;
    options.port = port;
    options.clientID = std::move(clientID);
    options.backoff.initial = std::chrono::milliseconds(20);
    options.backoff.maximum = std::chrono::milliseconds(200);
    return options;
}

} // namespace ACS::Testing
