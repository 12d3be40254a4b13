#include "VehicleTopics.hpp"

#include <algorithm>
#include <utility>

namespace ACS::VDA5050
{

VehicleTopics::VehicleTopics(const VehicleOptions& options)
    : _options(options)
{
    for (std::size_t index = 0; index < TOPIC_COUNT; ++index)
    {
        _topics.at(index) = BuildTopic(_options.address, static_cast<ETopic>(index));
    }
}

std::vector<MqttSubscription> VehicleTopics::GetSubscriptions() const
{
    std::vector<MqttSubscription> subscriptions;
    for (const ETopic topic : {ETopic::Order, ETopic::InstantActions})
    {
        subscriptions.push_back(MqttSubscription{_topics.at(static_cast<std::size_t>(topic)), _options.qos.Get(topic)});
    }
    return subscriptions;
}

std::optional<ETopic> VehicleTopics::RecognizeOrNull(std::string_view topic) const
{
    for (const ETopic known : {ETopic::Order, ETopic::InstantActions})
    {
        if (topic == _topics.at(static_cast<std::size_t>(known)))
        {
            return known;
        }
    }
    return std::nullopt;
}

Core::Result<MessageIdentity> VehicleTopics::DecodeIdentity(std::string_view payload)
{
    return _codec.DecodeIdentity(payload);
}

bool VehicleTopics::IsForeign(ETopic topic, const Header& header, VehicleActions& out) const
{
    std::optional<Core::Error> foreign = FindForeignNameOrNull(header, _options.address);
    if (foreign.has_value())
    {
        out.emplace_back(MessageIgnored{topic, std::move(*foreign)});
    }
    return foreign.has_value();
}

MqttMessage VehicleTopics::MakeConnection(EConnectionState state, Core::Now now)
{
    ConnectionMessage message;
    message.header = MakeHeader(ETopic::Connection, now);
    message.connectionState = state;
    return MakeMessage(ETopic::Connection, message);
}

Header VehicleTopics::MakeHeader(ETopic topic, Core::Now now)
{
    return Header{
        _headerIDs.at(static_cast<std::size_t>(topic))++,
        now.wall,
        std::string(GetVersionText(_options.version)),
        _options.address.manufacturer,
        _options.address.serialNumber};
}

} // namespace ACS::VDA5050
