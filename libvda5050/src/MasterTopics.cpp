#include "MasterTopics.hpp"

#include "OrderErrors.hpp"
#include <acs/vda5050/EVda5050Error.hpp>

#include <utility>

namespace ACS::VDA5050
{

MasterTopics::MasterTopics(const MasterOptions& options)
    : _options(options),
      _table(options.address, options.qos, options.version)
{
}

std::vector<MqttSubscription> MasterTopics::GetSubscriptions() const
{
    return _table.MakeSubscriptions({ETopic::State, ETopic::Visualization, ETopic::Connection, ETopic::Factsheet});
}

std::optional<ETopic> MasterTopics::RecognizeOrNull(std::string_view topic, bool bRetained)
{
    const std::optional<ETopic> recognized = _table.FindOrNull(topic);
    if (bRetained && recognized.has_value() && !IsRetained(*recognized))
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
    _statistics.lastVersion = CutForeignText(header.version, LONGEST_VERSION);
    if (ReadVersionOrNull(header.version).has_value())
    {
        return std::nullopt;
    }
    return Core::Error{make_error_code(EVda5050Error::UnsupportedVersion), "version", "2.x", _statistics.lastVersion};
}

void MasterTopics::Refuse(ETopic topic, Core::Error error, MasterActions& out)
{
    ++_statistics.messagesRefused;
    _statistics.lastRefusal = std::string(GetTopicName(topic)) + ": " + Core::Describe(error);
    out.emplace_back(MessageRefused{topic, std::move(error)});
}

void MasterTopics::PublishPayload(ETopic topic, std::string payload, MasterActions& out)
{
    _table.CountMessage(topic);
    ++_statistics.messagesSent;
    out.emplace_back(PublishMessage{_table.MakeMessage(topic, std::move(payload))});
}

} // namespace ACS::VDA5050
