#pragma once

#include <acs/core/Now.hpp>
#include <acs/vda5050/EVda5050Version.hpp>
#include <acs/vda5050/Header.hpp>
#include <acs/vda5050/IMqttLink.hpp>
#include <acs/vda5050/QosTable.hpp>
#include <acs/vda5050/Topic.hpp>

#include <array>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::VDA5050
{

/// The topics of a vehicle, and the headerIds of what is published on them.
class TopicTable
{
    const VehicleAddress& _address;
    const QosTable& _qos;
    EVda5050Version _version;
    std::array<std::string, TOPIC_COUNT> _topics;
    std::array<std::uint32_t, TOPIC_COUNT> _headerIDs{};

public:
    /// Address and QoS must outlive the table.
    TopicTable(const VehicleAddress& address, const QosTable& qos, EVda5050Version version);

    [[nodiscard]] std::vector<MqttSubscription> MakeSubscriptions(std::initializer_list<ETopic> topics) const;
    [[nodiscard]] std::optional<ETopic> FindOrNull(std::string_view topic) const;
    /// Of the next message on the topic.
    [[nodiscard]] Header MakeHeader(ETopic topic, Core::Now now) const;
    /// The next headerId is used.
    void CountMessage(ETopic topic);
    [[nodiscard]] MqttMessage MakeMessage(ETopic topic, std::string payload) const;
};

} // namespace ACS::VDA5050
