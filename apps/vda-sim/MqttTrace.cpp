#include "vda-sim/MqttTrace.hpp"

#include <utility>

namespace ACS::VdaSim
{

MqttTrace::MqttTrace(Apps::SimulatorTrace* traceOrNull, std::string robotID)
    : _traceOrNull(traceOrNull),
      _robotID(std::move(robotID))
{
}

void MqttTrace::OnReceived(const VDA5050::MqttMessage& message) const
{
    if (_traceOrNull != nullptr)
    {
        Write(true, message, _traceOrNull->GetNow());
    }
}

Core::Result<void> MqttTrace::Publish(const VDA5050::MqttMessage& message, VDA5050::IMqttLink& link) const
{
    // Before the receiver can have the message.
    const Core::Now now = _traceOrNull == nullptr ? Core::Now() : _traceOrNull->GetNow();
    Core::Result<void> published = link.Publish(message);
    if (_traceOrNull != nullptr && published.has_value())
    {
        Write(false, message, now);
    }
    return published;
}

void MqttTrace::OnSent(const VDA5050::MqttMessage& message) const
{
    if (_traceOrNull != nullptr)
    {
        Write(false, message, _traceOrNull->GetNow());
    }
}

void MqttTrace::Write(bool bIn, const VDA5050::MqttMessage& message, Core::Now now) const
{
    Apps::TraceLine line;
    line.link = "mqtt";
    line.bIn = bIn;
    line.text = message.payload;
    line.robotID = _robotID;
    line.topic = message.topic;
    _traceOrNull->Write(line, now);
}

} // namespace ACS::VdaSim
