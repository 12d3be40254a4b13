#include "VehicleHand.hpp"

#include "OperationsConfig.hpp"
#include <acs/core/Overloaded.hpp>

#include <algorithm>
#include <iterator>
#include <utility>
#include <variant>

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
    : _timeline(timeline),
      _broker(broker),
      _handler(std::move(handler)),
      _timers(timeline),
      _adapter(MakeOptions(address), MakeMethods(), _outputs),
      _client(broker.Open(*this, _adapter.GetSubscriptions(), std::nullopt))
{
}

VehicleHand::~VehicleHand()
{
    _broker.Abandon(_client);
}

template <typename TCall>
void VehicleHand::Call(TCall call)
{
    Planning::AdapterActions wanted;
    call(_timeline.GetNow(), wanted);
    std::ranges::move(wanted, std::back_inserter(_actions));
    if (std::exchange(_bExecuting, true))
    {
        return;
    }
    while (!_actions.empty())
    {
        const Planning::AdapterAction action = std::move(_actions.front());
        _actions.pop_front();
        Execute(action);
    }
    _bExecuting = false;
    for (const VDA5050::MqttMessage& message : std::exchange(_outputs.messages, {}))
    {
        _broker.Publish(_client, message);
    }
}

void VehicleHand::Execute(const Planning::AdapterAction& action)
{
    std::visit(
        Core::Overloaded{
            [this](const Planning::RaiseEvent& raise) { _handler(raise.event); },
            [this](const Planning::StartAdapterTimer& start) {
                const Planning::AdapterTimerID timer = start.timer;
                _timers.Start(timer, start.delay, [this, timer] {
                    Call([this, timer](Core::Now now, auto& out) { _adapter.OnTimer(timer, now, out); });
                });
            },
            [this](const Planning::CancelAdapterTimer& cancel) {
                _timers.Cancel(cancel.timer);
            }},
        action);
}

void VehicleHand::Handle(const Planning::RobotCommand& command)
{
    Call([this, &command](Core::Now now, auto& out) { _adapter.Handle(command, now, out); });
}

void VehicleHand::OnLinkUp()
{
    Call([this](Core::Now now, auto& out) { _adapter.OnLinkUp(now, out); });
}

void VehicleHand::OnLinkDown(std::error_code /*reason*/)
{
    Call([this](Core::Now now, auto& out) { _adapter.OnLinkDown(now, out); });
}

void VehicleHand::OnMqttMessage(const VDA5050::MqttMessage& message)
{
    Call([this, &message](Core::Now now, auto& out) { _adapter.OnMqttMessage(message, now, out); });
}

} // namespace ACS::Simulation
