#include "VehicleHand.hpp"

#include "AcsdConfig.hpp"
#include "ArmPrograms.hpp"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace ACS::Simulation
{

namespace
{

/// A pick or a drop with what its factsheet demands.
Acsd::JobMethod MakeHandling(const std::string& actionType)
{
    Acsd::JobMethod method{actionType};
    for (const auto& [key, value] :
         {std::pair("stationType", "rack"),
          std::pair("stationName", "{place}"),
          std::pair("loadType", "carrier"),
          std::pair("loadId", "{carrier}")})
    {
        method.parameters.push_back({key, *Acsd::ParameterTemplate::Make(std::string_view(value)), false});
    }
    return method;
}

/// Every vehicle of the world takes and brings loads itself, unless it has an arm; what is done at a set is a position that
/// it takes there.
Acsd::JobMethods MakeMethods(bool bArm)
{
    return {std::move(key), *Acsd::ParameterTemplate::Make(text)};
}

/// A pick or drop with all that the factsheet of the standard demands.
Acsd::JobMethod MakeHandling(std::string vehicleAction, std::string_view loadType, Planning::EActionEffect effect)
{
    return {
        std::move(vehicleAction),
        0,
        {MakeParameter("stationType", "rack"),
         MakeParameter("stationName", "{place}"),
         MakeParameter("loadType", loadType),
         MakeParameter("loadId", "{carrier}"),
         MakeParameter("lhd", "{robot_port}")},
        {},
        effect};
}

Acsd::JobMethod MakeArmMethod(const ArmProgramTexts& program, Planning::EActionEffect effect)
{
    Acsd::JobMethod method{"", program.program, {}, {}, effect};
    for (const auto& [relay, text] : program.inputs)
    {
        return {
            {"CassetteLoad", MakeHandling("pick")},
            {"CassetteUnload", MakeHandling("drop")},
            {"TrayLoad", MakeHandling("pick")},
            {"TrayUnload", MakeHandling("drop")},
            {"MemoryPickAndPlace", {"finePositioning", 0}},
            {"OpenSetCover", {"finePositioning", 0}}};
    }
    Acsd::JobMethods methods{{"CassetteLoad", MakeHandling("pick")}, {"CassetteUnload", MakeHandling("drop")}};
    for (const auto& [action, program] : GetArmPrograms())
    {
        if (bArm)
        {
            methods.SetMethod(action, {}, MakeArmMethod(program, rules.at(action).effect));
        }
    }
    return methods;
}

Acsd::RobotLinkConfig MakeLink(const Planning::RobotOptions& robot, const ArmController* controllerOrNull)
{
    const std::string& robotID = robot.robotID.GetText();
    Acsd::RobotLinkConfig link{robotID, "ACS", robotID, "2.0.0", std::nullopt};
    link.methods = MakeMethods(robot, controllerOrNull != nullptr);
    if (controllerOrNull == nullptr)
    {
        return link;
    }
    link.armOrNone.emplace(); // its addresses are the network's business
    link.armOptions.period = ARM_PERIOD;
    if (controllerOrNull->Is(EMutation::EchoIgnored))
    {
        link.armOptions.echoIndex.reset();
    }
    return link;
}

} // namespace

VehicleHand::VehicleHand(
    Timeline& timeline,
    MqttBroker& broker,
    const Planning::RobotOptions& robot,
    EventHandler handler,
    ArmController* controllerOrNull)
    : _broker(broker),
      _adapter(Acsd::MakeRobotAdapter(Acsd::AcsdConfig(), MakeLink(robot, controllerOrNull), _outputs)),
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
