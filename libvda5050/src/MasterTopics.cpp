#include "MasterTopics.hpp"

#include <acs/vda5050/EVda5050Error.hpp>

#include <algorithm>
#include <utility>

namespace ACS::VDA5050
{

MasterTopics::MasterTopics(const MasterOptions& options)
    : _options(options)
{
    for (std::size_t index = 0; index < TOPIC_COUNT; ++index)
    {
        _topics.at(index) = BuildTopic(_options.address, static_cast<ETopic>(index));
    }
}

std::vector<MqttSubscription> MasterTopics::GetSubscriptions() const
{
    std::vector<MqttSubscription> subscriptions;
    for (const ETopic topic : {ETopic::State, ETopic::Visualization, ETopic::Connection, ETopic::Factsheet})
    {
        subscriptions.push_back(MqttSubscription{_topics.at(static_cast<std::size_t>(topic)), _options.qos.Get(topic)});
    }
    return subscriptions;
}

std::optional<ETopic> MasterTopics::RecognizeOrNull(std::string_view topic, bool bRetained)
{
    const auto* const found = std::ranges::find(_topics, topic);
    if (found == _topics.end())
    {
        return std::nullopt;
    }
    const auto recognized = static_cast<ETopic>(found - _topics.begin());
    if (bRetained && !IsRetained(recognized))
    {
        // Its age is unknown, so it proves neither life nor progress of an order.
        ++_statistics.retainedIgnored;
        return std::nullopt;
    }
    return recognized;
}

void MasterTopics::CountState(bool bStale) noexcept
{
    ++(bStale ? _statistics.statesIgnored : _statistics.statesReceived);
}

void MasterTopics::CountResentOrder() noexcept
{
    ++_statistics.ordersResent;
}

const MasterStatistics& MasterTopics::GetStatistics() const noexcept
{
    return _statistics;
}

/// An empty version is accepted, like empty names: the topic has both.
std::optional<Core::Error> MasterTopics::FindHeaderFaultOrNull(const Header& header)
{
    if (std::optional<Core::Error> foreign = FindForeignNameOrNull(header, _options.address))
    {
        return foreign;
    }
    if (header.version.empty())
    {
        return std::nullopt;
    }
    constexpr std::size_t LONGEST_VERSION = 32;
    _statistics.lastVersion = header.version.substr(0, LONGEST_VERSION);
    if (ReadVersionOrNull(header.version).has_value())
    {
        return std::nullopt;
    }
    return Core::Error{make_error_code(EVda5050Error::UnsupportedVersion), "version", "2.x", header.version};
}

void MasterTopics::Refuse(ETopic topic, Core::Error error, MasterActions& out)
{
    ++_statistics.messagesRefused;
    _statistics.lastRefusal = std::string(GetTopicName(topic)) + ": " + Core::Describe(error);
    out.emplace_back(MessageRefused{topic, std::move(error)});
}

Header MasterTopics::MakeHeader(ETopic topic, Core::Now now) const
{
    return Header{
        _headerIDs.at(static_cast<std::size_t>(topic)),
        now.wall,
        std::string(GetVersionText(_options.version)),
        _options.address.manufacturer,
        _options.address.serialNumber};
}

void MasterTopics::PublishPayload(ETopic topic, std::string payload, MasterActions& out)
{
    const auto index = static_cast<std::size_t>(topic);
    ++_headerIDs.at(index);
    ++_statistics.messagesSent;
    out.emplace_back(
        PublishMessage{MqttMessage{_topics.at(index), std::move(payload), _options.qos.Get(topic), IsRetained(topic)}});
}

} // namespace ACS::VDA5050
