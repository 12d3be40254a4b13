#include "EarlyMessages.hpp"

#include <utility>

namespace ACS::VDA5050
{

EarlyMessages::EarlyMessages(const Limits& limits) noexcept
    : _limits(limits)
{
}

void EarlyMessages::OnAttempt(bool bKept)
{
    _dropped = 0;
    if (!bKept)
    {
        std::ignore = TakeAll();
    }
}

void EarlyMessages::Add(const MqttMessage& message)
{
    const std::size_t bytes = message.topic.size() + message.payload.size();
    if (_messages.size() >= _limits.maxCount || bytes > _limits.maxBytes - _bytes)
    {
        ++_dropped;
        return;
    }
    _messages.push_back(message);
    _bytes += bytes;
}

std::size_t EarlyMessages::GetDropped() const noexcept
{
    return _dropped;
}

std::vector<MqttMessage> EarlyMessages::TakeAll()
{
    _bytes = 0;
    return std::exchange(_messages, {});
}

} // namespace ACS::VDA5050
