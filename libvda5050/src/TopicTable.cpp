#include "TopicTable.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace ACS::VDA5050
{

TopicTable::TopicTable(const VehicleAddress& address, const QosTable& qos, EVda5050Version version)
    : _address(address),
      _qos(qos),
      _version(version)
{
    for (std::size_t index = 0; index < TOPIC_COUNT; ++index)
    {
        _topics.at(index) = BuildTopic(address, static_cast<ETopic>(index));
    }
}

std::vector<MqttSubscription> TopicTable::MakeSubscriptions(std::initializer_list<ETopic> topics) const
{
    std::vector<MqttSubscription> subscriptions;
    for (const ETopic topic : topics)
    {
        subscriptions.push_back(MqttSubscription{_topics.at(static_cast<std::size_t>(topic)), _qos.Get(topic)});
    }
    return subscriptions;
}

std::optional<ETopic> TopicTable::FindOrNull(std::string_view topic) const
{
    const auto* const found = std::ranges::find(_topics, topic);
    return found == _topics.end() ? std::nullopt : std::optional(static_cast<ETopic>(found - _topics.begin()));
}

Header TopicTable::MakeHeader(ETopic topic, Core::Now now) const
{
    return Header{
        _headerIDs.at(static_cast<std::size_t>(topic)),
        now.wall,
        std::string(GetVersionText(_version)),
        _address.manufacturer,
        _address.serialNumber};
}

void TopicTable::CountMessage(ETopic topic)
{
    ++_headerIDs.at(static_cast<std::size_t>(topic));
}

MqttMessage TopicTable::MakeMessage(ETopic topic, std::string payload) const
{
    return {_topics.at(static_cast<std::size_t>(topic)), std::move(payload), _qos.Get(topic), IsRetained(topic)};
}

} // namespace ACS::VDA5050
