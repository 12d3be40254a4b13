#pragma once

#include <acs/acsd/IMqttService.hpp>

#include <cstddef>
#include <string>
#include <system_error>
#include <vector>

namespace ACS::Acsd::Test
{

/// A connection to a broker, or the service of a robot, that records the calls. It passes nothing to the listener by itself.
class RecordingLink final : public IMqttService
{
public:
    std::vector<VDA5050::MqttMessage> published;
    std::vector<std::string> filters; ///< Of the subscriptions that have not ended.
    std::size_t attempts = 0;         ///< To publish.
    bool bFails = false;
    VDA5050::IMqttLinkListener* listenerOrNull = nullptr;

    [[nodiscard]] Core::Result<void> Publish(const VDA5050::MqttMessage& message) override
    {
        ++attempts;
        if (bFails)
        {
            return Core::Fail(std::make_error_code(std::errc::not_connected));
        }
        published.push_back(message);
        return {};
    }

    void Subscribe(const std::vector<VDA5050::MqttSubscription>& subscriptions) override
    {
        for (const VDA5050::MqttSubscription& subscription : subscriptions)
        {
            filters.push_back(subscription.topicFilter);
        }
    }

    void Unsubscribe(const std::string& topicFilter) override
    {
        std::erase(filters, topicFilter);
    }

    void SetListener(VDA5050::IMqttLinkListener* receiverOrNull) override
    {
        listenerOrNull = receiverOrNull;
    }
};

} // namespace ACS::Acsd::Test
