#pragma once

#include "TopicTable.hpp"
#include <acs/vda5050/MasterAction.hpp>
#include <acs/vda5050/MasterOptions.hpp>
#include <acs/vda5050/MasterSession.hpp>
#include <acs/vda5050/Vda5050Codec.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::VDA5050
{

/// The topics of one vehicle: reads what the vehicle publishes, numbers and publishes what the master sends, and counts both.
class MasterTopics
{
    const MasterOptions& _options;
    Vda5050Codec _codec;
    TopicTable _table;
    MasterStatistics _statistics;

public:
    /// The options must outlive the topics.
    explicit MasterTopics(const MasterOptions& options);

    [[nodiscard]] std::vector<MqttSubscription> GetSubscriptions() const;
    /// The topic of a message to be read. A retained message on a topic that must not be retained is only counted.
    [[nodiscard]] std::optional<ETopic> RecognizeOrNull(std::string_view topic, bool bRetained);
    /// Nullopt: the message was refused, which out reports.
    template <typename TMessage>
    [[nodiscard]] std::optional<TMessage> ReadOrNull(ETopic topic, std::string_view payload, MasterActions& out)
    {
        Core::Result<TMessage> message = _codec.Decode<TMessage>(payload);
        std::optional<Core::Error> fault = message ? FindHeaderFaultOrNull(message->header) : message.error();
        if (fault.has_value())
        {
            Refuse(topic, std::move(*fault), out);
            return std::nullopt;
        }
        return std::move(*message);
    }
    void CountState(bool bStale) noexcept;

    /// Size of the payload, if the message were sent now.
    template <typename TMessage>
    [[nodiscard]] std::size_t Measure(ETopic topic, TMessage& message, Core::Now now) const
    {
        message.header = _table.MakeHeader(topic, now);
        return _codec.Encode(message, _options.version).size();
    }
    /// Sets the header of the message.
    template <typename TMessage>
    void Publish(ETopic topic, TMessage& message, Core::Now now, MasterActions& out)
    {
        message.header = _table.MakeHeader(topic, now);
        PublishPayload(topic, _codec.Encode(message, _options.version), out);
    }
    void CountResentOrder() noexcept;

    [[nodiscard]] const MasterStatistics& GetStatistics() const noexcept;

private:
    [[nodiscard]] std::optional<Core::Error> FindHeaderFaultOrNull(const Header& header);
    void Refuse(ETopic topic, Core::Error error, MasterActions& out);
    void PublishPayload(ETopic topic, std::string payload, MasterActions& out);
};

} // namespace ACS::VDA5050
