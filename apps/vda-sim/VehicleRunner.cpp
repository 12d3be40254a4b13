#include "vda-sim/VehicleRunner.hpp"

#include "common/process/TimerSet.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/vda5050_mosquitto/MosquittoLink.hpp>

#include <boost/asio/post.hpp>

#include <memory>
#include <optional>
#include <utility>

namespace ACS::VdaSim
{

class VehicleRunner::Impl final : public VDA5050::IMqttLinkListener
{
    boost::asio::any_io_executor _executor;
    const Core::IClock* _clock;
    Core::IRandom* _random;
    Core::Logger _logger;
    VirtualVehicle _vehicle;
    VirtualActions _actions;
    Apps::TimerSet<std::uint64_t> _timers;
    VDA5050::MosquittoOptions _linkOptions;
    MqttTrace _trace;
    std::unique_ptr<VDA5050::MosquittoLink> _linkOrNull;    ///< Null while a fault has cut the connection.
    std::unique_ptr<VDA5050::MosquittoLink> _leavingOrNull; ///< Disconnecting without OFFLINE.
    Handler _onConnected;
    bool _bStopping = false;

public:
    Impl(
        const boost::asio::any_io_executor& executor,
        const Core::IClock& clock,
        Core::IRandom& random,
        const Core::Logger& logger,
        VirtualVehicle vehicle,
        VDA5050::MosquittoOptions linkOptions,
        MqttTrace trace)
        : _executor(executor),
          _clock(&clock),
          _random(&random),
          _logger(logger),
          _vehicle(std::move(vehicle)),
          _timers(executor, [this](std::uint64_t key) { OnTimer(key); }),
          _linkOptions(std::move(linkOptions)),
          _trace(std::move(trace))
    {
    }

    void Start(Handler onConnected)
    {
        _onConnected = std::move(onConnected);
        Open();
    }

    bool TryInject(const Fault& fault)
    {
        const bool bTaken = _vehicle.TryInject(fault, _clock->GetNow(), _actions);
        Execute();
        return bTaken;
    }

    std::size_t EndFaults(std::optional<EFaultKind> kindOrNull)
    {
        const std::size_t count = _vehicle.EndFaults(kindOrNull, _clock->GetNow(), _actions);
        Execute();
        return count;
    }

    std::size_t Trigger()
    {
        const std::size_t count = _vehicle.Trigger(_clock->GetNow(), _actions);
        Execute();
        return count;
    }

    void OnWorldChanged()
    {
        _vehicle.OnWorldChanged(_clock->GetNow(), _actions);
        Execute();
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

    void OnLinkUp() override
    {
        const Core::Now now = _clock->GetNow();
        _linkOrNull->SetWill(_vehicle.MakeWill(now)); // for the connection after this one
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
        _trace.OnReceived(message);
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
                    [this](const CancelVirtualTimer& cancel) { _timers.Cancel(cancel.key); },
                    [this](const CutLink& cut) { Cut(cut.bWill); },
                    [this](const OpenLink&) {
                        Open();
                    }},
                action);
        }
    }

    void Open()
    {
        if (_bStopping || _linkOrNull != nullptr)
        {
            return;
        }
        _leavingOrNull.reset(); // else two connections would share a client id
        _linkOrNull = std::make_unique<VDA5050::MosquittoLink>(_executor, *_random, _logger, _linkOptions, *this);
        _linkOrNull->Subscribe(_vehicle.GetSubscriptions());
        _linkOrNull->SetWill(_vehicle.MakeWill(_clock->GetNow()));
        _linkOrNull->Start();
    }

    void Cut(bool bWill)
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

    void Publish(const VDA5050::MqttMessage& message)
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
};

VehicleRunner::VehicleRunner(
    const boost::asio::any_io_executor& executor,
    const Core::IClock& clock,
    Core::IRandom& random,
    const Core::Logger& logger,
    VirtualVehicle vehicle,
    VDA5050::MosquittoOptions linkOptions,
    MqttTrace trace)
    : _impl(std::make_unique<
            Impl>(executor, clock, random, logger, std::move(vehicle), std::move(linkOptions), std::move(trace)))
{
}

VehicleRunner::~VehicleRunner() = default;

void VehicleRunner::Start(Handler onConnected)
{
    _impl->Start(std::move(onConnected));
}

bool VehicleRunner::TryInject(const Fault& fault)
{
    return _impl->TryInject(fault);
}

std::size_t VehicleRunner::EndFaults(std::optional<EFaultKind> kindOrNull)
{
    return _impl->EndFaults(kindOrNull);
}

std::size_t VehicleRunner::Trigger()
{
    return _impl->Trigger();
}

void VehicleRunner::OnWorldChanged()
{
    _impl->OnWorldChanged();
}

void VehicleRunner::StopAsync(Handler onStopped)
{
    _impl->StopAsync(std::move(onStopped));
}

} // namespace ACS::VdaSim
