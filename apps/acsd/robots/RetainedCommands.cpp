#include "robots/RetainedCommands.hpp"

#include <algorithm>
#include <utility>

namespace ACS::Acsd
{

namespace
{

constexpr const char* REMOVED = "acsd_retained_commands_removed_total";
constexpr std::uint8_t QOS = 1; // what is lost here would stay on the broker

} // namespace

RetainedCommands::RetainedCommands(
    Dependencies dependencies,
    std::string robotID,
    const VDA5050::VehicleAddress& vehicle)
    : _dependencies(std::move(dependencies)),
      _robotID(std::move(robotID)),
      _topics{
          VDA5050::BuildTopic(vehicle, VDA5050::ETopic::Order),
          VDA5050::BuildTopic(vehicle, VDA5050::ETopic::InstantActions)}
{
    _dependencies.metrics.AddCounter(REMOVED, "Retained messages removed from the command topics of vehicles");
}

void RetainedCommands::OnLinkUp()
{
    _ended.clear();
    Subscribe(_topics);
}

/// Not to the others: their subscriptions are in effect, or the broker refuses them.
void RetainedCommands::Renew()
{
    Subscribe(std::exchange(_ended, {}));
}

void RetainedCommands::Subscribe(const std::vector<std::string>& topics)
{
    for (const std::string& topic : topics)
    {
        _dependencies.mqtt.Subscribe({{topic, QOS}});
    }
}

/// A broker that refuses these subscriptions must not prevent the next connection, as those made before it would.
void RetainedCommands::OnLinkDown()
{
    _ended.clear();
    for (const std::string& topic : _topics)
    {
        _dependencies.mqtt.Unsubscribe(topic);
    }
}

bool RetainedCommands::TryHandle(const VDA5050::MqttMessage& message)
{
    if (std::ranges::find(_topics, message.topic) == _topics.end())
    {
        return false;
    }
    if (message.bRetained)
    {
        Remove(message);
    }
    else if (std::ranges::find(_ended, message.topic) == _ended.end())
    {
        _ended.push_back(message.topic);
        _dependencies.mqtt.Unsubscribe(message.topic);
    }
    return true;
}

void RetainedCommands::Remove(const VDA5050::MqttMessage& message)
{
    const Core::Result<void> published = _dependencies.mqtt.Publish({message.topic, {}, QOS, true});
    if (!published)
    {
        _dependencies.logger.Error(
            "a retained message on a command topic of the vehicle cannot be removed",
            {{"robotId", _robotID}, {"topic", message.topic}, {"reason", Core::Describe(published.error())}});
        return;
    }
    _dependencies.metrics.Increment(REMOVED, {});
    _dependencies.logger.Warning(
        "a retained message was removed from a command topic of the vehicle: find the program that publishes commands with "
        "the retain flag",
        {{"robotId", _robotID}, {"topic", message.topic}, {"message", Core::QuoteForError(message.payload)}});
}

} // namespace ACS::Acsd
