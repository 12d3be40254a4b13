#pragma once

#include <acs/vda5050/IMqttLink.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <string_view>
#include <system_error>
#include <vector>

namespace ACS::Testing
{

/// Records the callbacks of a link.
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

    [[nodiscard]] const VDA5050::MqttMessage* FindLastOrNull(std::string_view topic) const
    {
        const auto found =
            std::find_if(messages.rbegin(), messages.rend(), [topic](const VDA5050::MqttMessage& message) {
                return message.topic == topic;
            });
        return found != messages.rend() ? &*found : nullptr;
    }

    [[nodiscard]] bool Contains(std::string_view topic, std::string_view part) const
    {
        return std::ranges::any_of(messages, [topic, part](const VDA5050::MqttMessage& message) {
            return message.topic == topic && message.payload.find(part) != std::string::npos;
        });
    }
};

} // namespace ACS::Testing
