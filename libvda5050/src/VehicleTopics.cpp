#include "VehicleTopics.hpp"

#include <utility>

namespace ACS::VDA5050
{

VehicleTopics::VehicleTopics(const VehicleOptions& options)
    : _options(options),
      _table(options.address, options.qos, options.version)
{
}

std::vector<MqttSubscription> VehicleTopics::GetSubscriptions() const
{
    return _table.MakeSubscriptions({ETopic::Order, ETopic::InstantActions});
}

std::optional<ETopic> VehicleTopics::RecognizeOrNull(std::string_view topic) const
{
    const std::optional<ETopic> known = _table.FindOrNull(topic);
    return known == ETopic::Order || known == ETopic::InstantActions ? known : std::nullopt;
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
    Header header = _table.MakeHeader(topic, now);
    _table.CountMessage(topic);
    return header;
}

} // namespace ACS::VDA5050
