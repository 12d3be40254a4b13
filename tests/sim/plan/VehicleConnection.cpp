#include "VehicleConnection.hpp"

#include "ArmPrograms.hpp"
#include "config/VehicleConfig.hpp"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace ACS::Simulation
{

namespace
{

Acsd::VehicleParameter MakeParameter(std::string key, std::string_view text)
{
    return {std::move(key), *Acsd::ParameterTemplate::Make(text)};
}

/// A pick or drop with all parameters that the standard's factsheet requires.
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
        method.armInputs.push_back({*Acsd::ParseArmRelay(relay), *Acsd::NumberTemplate::Parse(text)});
    }
    return method;
}

/// A vehicle without an arm loads and unloads by itself, and its
/// actions at a set are finePositioning. The base of an arm shows no loads.
Acsd::JobMethods MakeMethods(const Planning::RobotOptions& robot, bool bArm)
{
    using Planning::EActionEffect;
    const auto positions = bArm ? Acsd::LoadPositions() : Acsd::LoadPositions(robot.ports, {});
    Acsd::JobMethods methods(positions, std::make_shared<const Acsd::StationTable>());
    methods.SetMethod("CassetteLoad", {}, MakeHandling("pick", "cassette", EActionEffect::Load));
    methods.SetMethod("CassetteUnload", {}, MakeHandling("drop", "cassette", EActionEffect::Unload));
    methods.SetMethod("TrayLoad", {}, MakeHandling("pick", "tray", EActionEffect::Load));
    methods.SetMethod("TrayUnload", {}, MakeHandling("drop", "tray", EActionEffect::Unload));
    methods.SetMethod("MemoryPickAndPlace", {}, {"finePositioning", 0});
    methods.SetMethod("OpenSetCover", {}, {"finePositioning", 0});
    const Planning::ActionTable rules = Planning::MakeStandardActions();
    for (const auto& [action, program] : GetArmPrograms())
    {
        if (bArm)
        {
            methods.SetMethod(action, {}, MakeArmMethod(program, rules.at(action).effect));
        }
    }
    return methods;
}

Acsd::VehicleConfig MakeVehicle(const Planning::RobotOptions& robot, const ArmController* controllerOrNull)
{
    const std::string& robotID = robot.robotID.GetText();
    Acsd::VehicleConfig vehicle;
    vehicle.robotID = robotID;
    vehicle.address = {"uagv", "ACS", robotID};
    vehicle.methods = MakeMethods(robot, controllerOrNull != nullptr);
    if (controllerOrNull == nullptr)
    {
        return vehicle;
    }
    vehicle.armOrNull.emplace(); // the network has its addresses
    vehicle.armOptions.period = ARM_PERIOD;
    if (controllerOrNull->Is(EMutation::EchoIgnored))
    {
        vehicle.armOptions.echoIndex.reset();
    }
    return vehicle;
}

} // namespace

VehicleConnection::VehicleConnection(
    Timeline& timeline,
    MqttBroker& broker,
    const Planning::RobotOptions& robot,
    EventHandler handler,
    ArmController* controllerOrNull)
    : _broker(broker),
      _adapter(Acsd::MakeRobotAdapter(MakeVehicle(robot, controllerOrNull), _outputs)),
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

VehicleConnection::~VehicleConnection()
{
    _broker.Abandon(_client);
}

/// The outputs of the adapter.
void VehicleConnection::SendAll()
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

void VehicleConnection::Handle(const Planning::RobotCommand& command)
{
    if (_armOrNull != nullptr)
    {
        _armOrNull->NoteCommand(command);
    }
    _runner.Run([this, &command](Core::Now now, auto& out) { _adapter.adapter->Handle(command, now, out); });
}

void VehicleConnection::OnLinkUp()
{
    _runner.Run([this](Core::Now now, auto& out) { _adapter.adapter->OnLinkUp(now, out); });
}

void VehicleConnection::OnLinkDown(std::error_code /*reason*/)
{
    _runner.Run([this](Core::Now now, auto& out) { _adapter.adapter->OnLinkDown(now, out); });
}

void VehicleConnection::OnMqttMessage(const VDA5050::MqttMessage& message)
{
    _runner.Run([this, &message](Core::Now now, auto& out) { _adapter.adapter->OnMqttMessage(message, now, out); });
}

} // namespace ACS::Simulation
