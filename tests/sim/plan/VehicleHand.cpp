#include "VehicleHand.hpp"

#include "AcsdConfig.hpp"
#include "ArmPrograms.hpp"

#include <optional>
#include <utility>

namespace ACS::Simulation
{

namespace
{

/// Every vehicle of the world takes and brings loads itself, unless it has an arm; what is done at a set is a position that
/// it takes there.
Acsd::JobMethods MakeMethods(bool bArm)
{
    if (!bArm)
    {
        return {
            {"CassetteLoad", {"pick", 0}},
            {"CassetteUnload", {"drop", 0}},
            {"TrayLoad", {"pick", 0}},
            {"TrayUnload", {"drop", 0}},
            {"MemoryPickAndPlace", {"finePositioning", 0}},
            {"OpenSetCover", {"finePositioning", 0}}};
    }
    Acsd::JobMethods methods{{"CassetteLoad", {"pick", 0}}, {"CassetteUnload", {"drop", 0}}};
    for (const auto& [action, program] : GetArmPrograms())
    {
        methods.SetMethod(action, {}, {"", program});
    }
    return methods;
}

Acsd::RobotLinkConfig MakeLink(const std::string& robotID, bool bArm)
{
    Acsd::RobotLinkConfig link{robotID, "ACS", robotID, "2.0.0", std::nullopt};
    link.methods = MakeMethods(bArm);
    if (bArm)
    {
        link.armOrNone.emplace(); // its addresses are the network's business
        link.armOptions.period = ARM_PERIOD;
    }
    return link;
}

} // namespace

VehicleHand::VehicleHand(
    Timeline& timeline,
    MqttBroker& broker,
    const std::string& robotID,
    EventHandler handler,
    ArmController* controllerOrNull)
    : _broker(broker),
      _adapter(Acsd::MakeRobotAdapter(Acsd::AcsdConfig(), MakeLink(robotID, controllerOrNull != nullptr), _outputs)),
      _runner(timeline, *_adapter.adapter, std::move(handler), [this] { SendAll(); }),
      _client(broker.Open(*this, _adapter.adapter->GetSubscriptions(), std::nullopt))
{
    if (controllerOrNull != nullptr)
    {
        _armOrNull = std::make_unique<ArmClient>(
            timeline,
            *controllerOrNull,
            Acsd::MakeArmSessionOptions(),
            [this](const OpenStream::ClientEvent& event) {
                _runner.Run(
                    [this, &event](Core::Now now, auto& out) { _adapter.armOrNull->OnArmEvent(event, now, out); });
            });
        _armOrNull->Start();
    }
}

VehicleHand::~VehicleHand()
{
    _broker.Abandon(_client);
}

/// What the adapter has put out.
void VehicleHand::SendAll()
{
    for (const VDA5050::MqttMessage& message : std::exchange(_outputs.messages, {}))
    {
        _broker.Publish(_client, message);
    }
    for (const Acsd::ArmRequest& request : std::exchange(_outputs.armRequests, {}))
    {
        _armOrNull->Send(request);
    }
}

void VehicleHand::Handle(const Planning::RobotCommand& command)
{
    if (_armOrNull != nullptr)
    {
        _armOrNull->NoteCommand(command);
    }
    _runner.Run([this, &command](Core::Now now, auto& out) { _adapter.adapter->Handle(command, now, out); });
}

void VehicleHand::OnLinkUp()
{
    _runner.Run([this](Core::Now now, auto& out) { _adapter.adapter->OnLinkUp(now, out); });
}

void VehicleHand::OnLinkDown(std::error_code /*reason*/)
{
    _runner.Run([this](Core::Now now, auto& out) { _adapter.adapter->OnLinkDown(now, out); });
}

void VehicleHand::OnMqttMessage(const VDA5050::MqttMessage& message)
{
    _runner.Run([this, &message](Core::Now now, auto& out) { _adapter.adapter->OnMqttMessage(message, now, out); });
}

} // namespace ACS::Simulation
