#include "VehicleHand.hpp"

#include "OperationsConfig.hpp"

#include <algorithm>
#include <utility>

namespace ACS::Simulation
{

namespace
{

/// As acsd makes them of its defaults.
VDA5050::MasterOptions MakeOptions(const VDA5050::VehicleAddress& address)
{
    const std::chrono::milliseconds offlineAfter = Acsd::OperationsConfig{}.offlineAfter;
    VDA5050::MasterOptions options;
    options.address = address;
    options.stateMargin = std::min(options.stateMargin, offlineAfter / 3);
    options.stateInterval = offlineAfter - options.stateMargin;
    return options;
}

/// Every vehicle of the world takes and brings loads itself; what is done at a set is a position that it takes there.
Acsd::JobMethods MakeMethods()
{
    return {
        {"CassetteLoad", {"pick", 0}},
        {"CassetteUnload", {"drop", 0}},
        {"TrayLoad", {"pick", 0}},
        {"TrayUnload", {"drop", 0}},
        {"MemoryPickAndPlace", {"finePositioning", 0}},
        {"OpenSetCover", {"finePositioning", 0}}};
}

} // namespace

VehicleHand::VehicleHand(
    Timeline& timeline,
    MqttBroker& broker,
    const VDA5050::VehicleAddress& address,
    ISimulatedRobot::EventHandler handler)
    : _broker(broker),
      _adapter(MakeOptions(address), MakeMethods(), _outputs),
      _runner(timeline, _adapter, std::move(handler), [this] { Publish(); }),
      _client(broker.Open(*this, _adapter.GetSubscriptions(), std::nullopt))
{
}

VehicleHand::~VehicleHand()
{
    _broker.Abandon(_client);
}

/// What the adapter has put out.
void VehicleHand::Publish()
{
    for (const VDA5050::MqttMessage& message : std::exchange(_outputs.messages, {}))
    {
        _broker.Publish(_client, message);
    }
}

void VehicleHand::Handle(const Planning::RobotCommand& command)
{
    _runner.Run([this, &command](Core::Now now, auto& out) { _adapter.Handle(command, now, out); });
}

void VehicleHand::OnLinkUp()
{
    _runner.Run([this](Core::Now now, auto& out) { _adapter.OnLinkUp(now, out); });
}

void VehicleHand::OnLinkDown(std::error_code /*reason*/)
{
    _runner.Run([this](Core::Now now, auto& out) { _adapter.OnLinkDown(now, out); });
}

void VehicleHand::OnMqttMessage(const VDA5050::MqttMessage& message)
{
    _runner.Run([this, &message](Core::Now now, auto& out) { _adapter.OnMqttMessage(message, now, out); });
}

} // namespace ACS::Simulation
