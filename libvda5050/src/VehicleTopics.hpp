#pragma once

#include "StateRoom.hpp"
#include "TopicTable.hpp"
#include <acs/vda5050/ConnectionMessage.hpp>
#include <acs/vda5050/Vda5050Codec.hpp>
#include <acs/vda5050/VehicleAction.hpp>
#include <acs/vda5050/VehicleOptions.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace ACS::VDA5050
{

/// The topics of a vehicle: reads what masters send, numbers and publishes what the vehicle sends.
class VehicleTopics
{
    const VehicleOptions& _options;
    Vda5050Codec _codec;
    TopicTable _table;
    std::array<std::size_t, TOPIC_COUNT> _payloadBytes{}; ///< Size of the last message, to reserve that of the next.

public:
    /// The options must outlive the topics.
    explicit VehicleTopics(const VehicleOptions& options);

    [[nodiscard]] std::vector<MqttSubscription> GetSubscriptions() const;
    /// The topic of a message to be read: Order or InstantActions.
    [[nodiscard]] std::optional<ETopic> RecognizeOrNull(std::string_view topic) const;
    template <typename TMessage>
    [[nodiscard]] Core::Result<TMessage> Decode(std::string_view payload)
    {
        return _codec.Decode<TMessage>(payload);
    }
    [[nodiscard]] Core::Result<MessageIdentity> DecodeIdentity(std::string_view payload);
    /// A message of another vehicle, which out reports as ignored.
    [[nodiscard]] bool IsForeign(ETopic topic, const Header& header, VehicleActions& out) const;

    [[nodiscard]] MqttMessage MakeConnection(EConnectionState state, Core::Now now);
    /// Sets the header of the message. A state that no receiver could read loses its texts for people.
    template <typename TMessage>
    void Publish(ETopic topic, TMessage& message, Core::Now now, VehicleActions& out)
    {
        message.header = MakeHeader(topic, now);
        MqttMessage made = MakeMessage(topic, message);
        if constexpr (std::is_same_v<TMessage, StateMessage>)
        {
            if (made.payload.size() > CodecLimits{}.payloadBytes)
            {
                DropTextsForPeople(message);
                made = MakeMessage(topic, message);
            }
        }
        out.emplace_back(PublishMessage{std::move(made)});
    }

private:
    [[nodiscard]] Header MakeHeader(ETopic topic, Core::Now now);
    template <typename TMessage>
    [[nodiscard]] MqttMessage MakeMessage(ETopic topic, const TMessage& message)
    {
        constexpr std::size_t SLACK = 64; // numbers have more digits at one time than at another
        const auto index = static_cast<std::size_t>(topic);
        MqttMessage made = _table.MakeMessage(topic, {});
        made.payload.reserve(_payloadBytes.at(index) + SLACK);
        _codec.Encode(message, _options.version, made.payload);
        _payloadBytes.at(index) = made.payload.size();
        return made;
    }
};

} // namespace ACS::VDA5050
