#include "vda-sim/VehicleRunner.hpp"

#include <acs/core/Overloaded.hpp>

#include <boost/asio/post.hpp>

#include <cstddef>
#include <optional>
#include <utility>

namespace ACS::VdaSim
{

VehicleRunner::VehicleRunner(
    const boost::asio::any_io_executor& executor,
    const Core::IClock& clock,
    Core::IRandom& random,
    const Core::Logger& logger,
    VirtualVehicle vehicle,
    VDA5050::MosquittoOptions linkOptions,
    MqttTrace trace)
    : _executor(executor),
      _clock(clock),
      _random(random),
      _logger(logger),
      _vehicle(std::move(vehicle)),
      _timers(executor, [this](std::uint64_t key) { OnTimer(key); }),
      _linkOptions(std::move(linkOptions)),
      _trace(std::move(trace))
{
}

void VehicleRunner::Start(Handler onConnected)
{
    _onConnected = std::move(onConnected);
    Open();
}

std::size_t VehicleRunner::GetBrokerIndex() const
{
    return _linkOrNull == nullptr ? 0 : _linkOrNull->GetBrokerIndex();
}

bool VehicleRunner::TryInject(const Fault& fault)
{
    const bool bTaken = _vehicle.TryInject(fault, _clock.GetNow(), _actions);
    Execute();
    return bTaken;
}

std::size_t VehicleRunner::EndFaults(std::optional<EFaultKind> kindOrNull)
{
    const std::size_t count = _vehicle.EndFaults(kindOrNull, _clock.GetNow(), _actions);
    Execute();
    return count;
}

std::size_t VehicleRunner::Trigger()
{
    const std::size_t count = _vehicle.Trigger(_clock.GetNow(), _actions);
    Execute();
    return count;
}

void VehicleRunner::OnWorldChanged()
{
    _vehicle.OnWorldChanged(_clock.GetNow(), _actions);
    Execute();
}

void VehicleRunner::StopAsync(Handler onStopped)
{
    _bStopping = true;
    _timers.CancelAll();
    _vehicle.Leave(_clock.GetNow(), _actions);
    std::optional<VDA5050::MqttMessage> lastMessage;
    for (VirtualAction& action : std::exchange(_actions, {}))
    {
        auto* const publish = std::get_if<VDA5050::PublishMessage>(&action);
        if (publish == nullptr)
        {
            continue;
        }
        if (lastMessage.has_value())
        {
            Publish(*lastMessage);
        }
        lastMessage = std::move(publish->message);
    }
    if (_linkOrNull == nullptr)
    {
        boost::asio::post(_executor, std::move(onStopped));
        return;
    }
    if (lastMessage.has_value() && _linkOrNull->IsConnected())
    {
        _trace.OnSent(*lastMessage);
    }
    _linkOrNull->StopAsync(lastMessage, VDA5050::MosquittoLink::DEFAULT_STOP_TIMEOUT, std::move(onStopped));
}

void VehicleRunner::OnLinkUp()
{
    const Core::Now now = _clock.GetNow();
    _linkOrNull->SetWill(_vehicle.MakeWill(now)); // for the connection after this one
    _vehicle.OnLinkUp(now, _actions);
    Execute();
    if (_onConnected)
    {
        _onConnected();
    }
}

void VehicleRunner::OnLinkDown(std::error_code /*reason*/)
{
    _vehicle.OnLinkDown(_clock.GetNow(), _actions);
    Execute();
}

void VehicleRunner::OnMqttMessage(const VDA5050::MqttMessage& message)
{
    _trace.OnReceived(message);
    _vehicle.OnMessage(message, _clock.GetNow(), _actions);
    Execute();
}

void VehicleRunner::OnTimer(std::uint64_t key)
{
    _vehicle.OnTimer(key, _clock.GetNow(), _actions);
    Execute();
}

void VehicleRunner::Execute()
{
    for (const VirtualAction& action : std::exchange(_actions, {}))
    {
        std::visit(
            Core::Overloaded{
                [this](const VDA5050::PublishMessage& publish) { Publish(publish.message); },
                [this](const StartVirtualTimer& start) {
                    if (!_bStopping)
                    {
                        _timers.Start(start.key, start.delay);
                    }
                },
                [this](const CancelVirtualTimer& cancel) { _timers.Cancel(cancel.key); },
                [this](const CutLink& cut) { Cut(cut.bWill); },
                [this](const OpenLink&) {
                    Open();
                }},
            action);
    }
}

void VehicleRunner::Open()
{
    if (_bStopping || _linkOrNull != nullptr)
    {
        return;
    }
    _leavingOrNull.reset(); // else two connections would share a client id
    _linkOrNull = std::make_unique<VDA5050::MosquittoLink>(_executor, _random, _logger, _linkOptions, *this);
    _linkOrNull->Subscribe(_vehicle.GetSubscriptions());
    _linkOrNull->SetWill(_vehicle.MakeWill(_clock.GetNow()));
    _linkOrNull->Start();
}

void VehicleRunner::Cut(bool bWill)
{
    if (_bStopping || _linkOrNull == nullptr)
    {
        return;
    }
    if (!bWill)
    {
        _leavingOrNull = std::move(_linkOrNull);
        _leavingOrNull->StopAsync(std::nullopt, VDA5050::MosquittoLink::DEFAULT_STOP_TIMEOUT, []() {});
    }
    _linkOrNull.reset();
}

void VehicleRunner::Publish(const VDA5050::MqttMessage& message)
{
    if (_linkOrNull == nullptr)
    {
        return;
    }
    const Core::Result<void> sent = _trace.Publish(message, *_linkOrNull);
    if (!sent.has_value())
    {
        _logger.Debug("not sent", {{"topic", message.topic}, {"reason", Core::Describe(sent.error())}});
    }
}

} // namespace ACS::VdaSim
