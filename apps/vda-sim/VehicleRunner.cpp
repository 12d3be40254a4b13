#include "vda-sim/VehicleRunner.hpp"

#include "common/TimerSet.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/vda5050_mosquitto/MosquittoLink.hpp>

#include <fmt/format.h>

#include <optional>
#include <utility>

namespace ACS::VdaSim
{

class VehicleRunner::Impl final : public VDA5050::IMqttLinkListener
{
    const Core::IClock* _clock;
    Core::Logger _logger;
    VirtualVehicle _vehicle;
    VirtualActions _actions;
    Apps::TimerSet _timers;
    VDA5050::MosquittoLink _link;
    Handler _onConnected;
    bool _bStopping = false;

public:
    Impl(
        const boost::asio::any_io_executor& executor,
        const Core::IClock& clock,
        Core::IRandom& random,
        const Core::Logger& logger,
        VirtualVehicle vehicle,
        VDA5050::MosquittoOptions linkOptions)
        : _clock(&clock),
          _logger(logger),
          _vehicle(std::move(vehicle)),
          _timers(executor, [this](std::uint64_t key) { OnTimer(key); }),
          _link(executor, random, logger, std::move(linkOptions), *this)
    {
        _link.Subscribe(_vehicle.GetSubscriptions());
        _link.SetWill(_vehicle.MakeWill(_clock->GetNow()));
    }

    void Start(Handler onConnected)
    {
        _onConnected = std::move(onConnected);
        _link.Start();
    }

    void StopAsync(Handler onStopped)
    {
        _bStopping = true;
        _timers.CancelAll();
        _vehicle.Leave(_clock->GetNow(), _actions);
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
        _link.StopAsync(lastMessage, VDA5050::MosquittoLink::DEFAULT_STOP_TIMEOUT, std::move(onStopped));
    }

    void OnLinkUp() override
    {
        const Core::Now now = _clock->GetNow();
        _link.SetWill(_vehicle.MakeWill(now)); // for the connection after this one
        _vehicle.OnLinkUp(now, _actions);
        Execute();
        if (_onConnected)
        {
            _onConnected();
        }
    }

    void OnLinkDown(std::error_code /*reason*/) override
    {
        _vehicle.OnLinkDown(_clock->GetNow(), _actions);
        Execute();
    }

    void OnMqttMessage(const VDA5050::MqttMessage& message) override
    {
        _vehicle.OnMessage(message, _clock->GetNow(), _actions);
        Execute();
    }

private:
    void OnTimer(std::uint64_t key)
    {
        _vehicle.OnTimer(key, _clock->GetNow(), _actions);
        Execute();
    }

    void Execute()
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
                    [this](const CancelVirtualTimer& cancel) {
                        _timers.Cancel(cancel.key);
                    }},
                action);
        }
    }

    void Publish(const VDA5050::MqttMessage& message)
    {
        const Core::Result<void> sent = _link.Publish(message);
        if (!sent.has_value())
        {
            _logger.Debug("not sent", {{"topic", message.topic}, {"reason", Core::Describe(sent.error())}});
        }
    }
};

VehicleRunner::VehicleRunner(
    const boost::asio::any_io_executor& executor,
    const Core::IClock& clock,
    Core::IRandom& random,
    const Core::Logger& logger,
    VirtualVehicle vehicle,
    VDA5050::MosquittoOptions linkOptions)
    : _impl(std::make_unique<Impl>(executor, clock, random, logger, std::move(vehicle), std::move(linkOptions)))
{
}

VehicleRunner::~VehicleRunner() = default;

void VehicleRunner::Start(Handler onConnected)
{
    _impl->Start(std::move(onConnected));
}

void VehicleRunner::StopAsync(Handler onStopped)
{
    _impl->StopAsync(std::move(onStopped));
}

} // namespace ACS::VdaSim
