#include "MosquittoClient.hpp"

#include <mosquitto.h>

#include <array>
#include <charconv>
#include <system_error>

namespace ACS::VDA5050
{

std::optional<ReceivedPublish> ReadPublishLineOrNull(std::string_view line)
{
    // "Client x received PUBLISH (d0, q2, r0, m7, 'topic', ... (5 bytes))"
    constexpr std::string_view EVENT = " received PUBLISH (d";
    const std::size_t begin = line.find(EVENT);
    if (begin == std::string_view::npos)
    {
        return std::nullopt;
    }
    const std::string_view fields = line.substr(begin + EVENT.size());
    const auto readOrNull = [fields](std::string_view name) {
        const std::size_t place = fields.find(name);
        std::optional<int> number;
        if (place != std::string_view::npos)
        {
            const std::string_view text = fields.substr(place + name.size());
            int value = 0;
            const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
            number = result.ec == std::errc() ? std::optional(value) : std::nullopt;
        }
        return number;
    };
    const std::optional<int> qos = readOrNull(", q");
    const std::optional<int> messageID = readOrNull(", m");
    if (!qos.has_value() || !messageID.has_value())
    {
        return std::nullopt;
    }
    return ReceivedPublish{*messageID, *qos};
}

void MosquittoClient::Deleter::operator()(mosquitto* client) const
{
    mosquitto_destroy(client);
}

MosquittoClient::MosquittoClient(mosquitto* client)
    : _handle(client)
{
}

mosquitto* MosquittoClient::GetHandleOrNull() const noexcept
{
    return _handle.get();
}

void MosquittoClient::OnSending(int messageID)
{
    _unacknowledged.insert(messageID);
}

bool MosquittoClient::TryAcknowledge(int messageID)
{
    return _unacknowledged.erase(messageID) > 0;
}

std::size_t MosquittoClient::CountUnacknowledged() const noexcept
{
    return _unacknowledged.size();
}

void MosquittoClient::OnPublishCame(int messageID)
{
    const bool bNew = _halfReceived.insert(messageID).second;
    _bCopyLeft = _bCopyLeft || !bNew;
}

void MosquittoClient::OnReleased(int messageID)
{
    _halfReceived.erase(messageID);
}

bool MosquittoClient::IsQuiet() const noexcept
{
    return _halfReceived.empty() && _unacknowledged.empty();
}

bool MosquittoClient::IsSpoilt() const noexcept
{
    return _bCopyLeft;
}

} // namespace ACS::VDA5050
