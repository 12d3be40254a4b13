#pragma once

#include <acs/core/IRandom.hpp>
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/vda5050/VehicleSession.hpp>
#include <acs/vda5050_mosquitto/MosquittoLink.hpp>

#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/system/error_code.hpp>
#include <fmt/core.h>

#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <system_error>
#include <utility>
#include <variant>

/// A VehicleSession on a broker: publishes what the session requests, runs its timers, and passes the other actions on.
class VehicleOnBroker final : public ACS::VDA5050::IMqttLinkListener
{
public:
    /// May call Do and Stop.
    using ActionHandler = std::function<void(const ACS::VDA5050::VehicleAction& action)>;

private:
    boost::asio::io_context& _io;
    ActionHandler _onAction;
    ACS::VDA5050::VehicleSession _session;
    ACS::VDA5050::VehicleActions _actions; ///< Requested, and not yet carried out.
    bool _bExecuting = false;
    std::map<ACS::VDA5050::EVehicleTimer, boost::asio::steady_timer> _timers;
    ACS::VDA5050::MosquittoLink _link;

public:
    VehicleOnBroker(
        boost::asio::io_context& io,
        ACS::Core::IRandom& random,
        const ACS::VDA5050::MosquittoOptions& broker,
        const ACS::VDA5050::VehicleOptions& vehicle,
        ActionHandler onAction)
        : _io(io),
          _onAction(std::move(onAction)),
          _session(vehicle),
          _link(io.get_executor(), random, ACS::Core::Logger(), broker, *this)
    {
        _link.Subscribe(_session.GetSubscriptions());
        _link.SetWill(_session.MakeWill(ReadClock()));
        _link.Start();
    }

    /// Calls the session: `Do([](auto& session, Core::Now now, auto& out) { session.OnLoads(…, now, out); })`.
    template <typename TCall>
    void Do(TCall call)
    {
        call(_session, ReadClock(), _actions);
        Execute();
    }

    /// OFFLINE is the last message, and the broker sends no will. Ends the io_context.
    void Stop()
    {
        Do([](auto& session, ACS::Core::Now now, auto& out) { session.Leave(now, out); });
        _link.StopAsync(std::nullopt, ACS::VDA5050::MosquittoLink::DEFAULT_STOP_TIMEOUT, [this]() { _io.stop(); });
    }

    void OnLinkUp() override
    {
        _link.SetWill(_session.MakeWill(ReadClock())); // For the next connection: each will has its own time.
        Do([](auto& session, ACS::Core::Now now, auto& out) { session.OnLinkUp(now, out); });
    }

    void OnLinkDown(std::error_code reason) override
    {
        fmt::print("no broker: {}; trying again\n", reason.message());
        Do([](auto& session, ACS::Core::Now now, auto& out) { session.OnLinkDown(now, out); });
    }

    void OnMqttMessage(const ACS::VDA5050::MqttMessage& message) override
    {
        Do([&message](auto& session, ACS::Core::Now now, auto& out) { session.OnMessage(message, now, out); });
    }

private:
    [[nodiscard]] static ACS::Core::Now ReadClock()
    {
        return {std::chrono::steady_clock::now(), std::chrono::system_clock::now()};
    }

    /// An action may lead to a call of Do, whose actions come after the batch.
    void Execute()
    {
        if (std::exchange(_bExecuting, true))
        {
            return;
        }
        while (!_actions.empty())
        {
            for (const ACS::VDA5050::VehicleAction& action : std::exchange(_actions, {}))
            {
                Execute(action);
            }
        }
        _bExecuting = false;
    }

    void Execute(const ACS::VDA5050::VehicleAction& action)
    {
        if (const auto* const publishOrNull = std::get_if<ACS::VDA5050::PublishMessage>(&action))
        {
            static_cast<void>(_link.Publish(publishOrNull->message)); // The next state contains what is lost.
        }
        else if (const auto* const startOrNull = std::get_if<ACS::VDA5050::StartVehicleTimer>(&action))
        {
            StartTimer(*startOrNull);
        }
        else if (const auto* const cancelOrNull = std::get_if<ACS::VDA5050::CancelVehicleTimer>(&action))
        {
            _timers.erase(cancelOrNull->timer);
        }
        else
        {
            _onAction(action);
        }
    }

    void StartTimer(const ACS::VDA5050::StartVehicleTimer& start)
    {
        boost::asio::steady_timer& timer = _timers.try_emplace(start.timer, _io).first->second;
        timer.expires_after(start.delay);
        timer.async_wait([this, name = start.timer](const boost::system::error_code& error) {
            if (!error)
            {
                Do([name](auto& session, ACS::Core::Now now, auto& out) { session.OnTimer(name, now, out); });
            }
        });
    }
};
