#pragma once

#include <acs/core/IRandom.hpp>
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>
#include <acs/vda5050/MasterFleet.hpp>
#include <acs/vda5050_mosquitto/MosquittoLink.hpp>

#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/system/error_code.hpp>
#include <fmt/core.h>

#include <chrono>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <system_error>
#include <utility>
#include <variant>

/// A MasterFleet on a broker: publishes what its sessions request, runs their timers, and passes their events on.
class ExampleFleet final : public ACS::VDA5050::IMqttLinkListener
{
public:
    /// May call SendOrder and Stop.
    using EventHandler = std::function<void(std::size_t vehicle, const ACS::VDA5050::MasterAction& event)>;

private:
    boost::asio::io_context& _io;
    EventHandler _onEvent;
    ACS::VDA5050::MasterFleet _fleet{ACS::VDA5050::FleetOptions{}};
    ACS::VDA5050::FleetActions _actions; ///< Requested by the sessions, and not yet carried out.
    std::map<std::pair<std::size_t, ACS::VDA5050::EMasterTimer>, boost::asio::steady_timer> _timers;
    ACS::VDA5050::MosquittoLink _link;

public:
    ExampleFleet(
        boost::asio::io_context& io,
        ACS::Core::IRandom& random,
        const ACS::VDA5050::MosquittoOptions& broker,
        EventHandler onEvent)
        : _io(io),
          _onEvent(std::move(onEvent)),
          _link(io.get_executor(), random, ACS::Core::Logger(), broker, *this)
    {
        _link.Subscribe(_fleet.GetSubscriptions());
        _link.Start();
    }

    [[nodiscard]] const ACS::VDA5050::MasterSession& GetSession(std::size_t vehicle) const
    {
        return _fleet.GetSession(vehicle);
    }

    /// The messages leave after the event in which this is called.
    [[nodiscard]] ACS::Core::Result<void> SendOrder(std::size_t vehicle, ACS::VDA5050::OrderMessage order)
    {
        ACS::VDA5050::MasterActions actions;
        ACS::Core::Result<void> sent = _fleet.GetSession(vehicle).SendOrder(std::move(order), ReadClock(), actions);
        ACS::VDA5050::AppendActions(vehicle, actions, _actions);
        return sent;
    }

    /// Ends the io_context.
    void Stop()
    {
        _link.StopAsync(std::nullopt, ACS::VDA5050::MosquittoLink::DEFAULT_STOP_TIMEOUT, [this]() { _io.stop(); });
    }

    void OnLinkUp() override
    {
        _fleet.OnLinkUp(ReadClock(), _actions);
        Execute();
    }

    void OnLinkDown(std::error_code reason) override
    {
        fmt::print("no broker: {}; trying again\n", reason.message());
        _fleet.OnLinkDown(ReadClock(), _actions);
        Execute();
    }

    void OnMqttMessage(const ACS::VDA5050::MqttMessage& message) override
    {
        _fleet.OnMessage(message, ReadClock(), _actions); // The first message of a vehicle discovers it.
        Execute();
    }

private:
    [[nodiscard]] static ACS::Core::Now ReadClock()
    {
        return {std::chrono::steady_clock::now(), std::chrono::system_clock::now()};
    }

    /// An action may lead to others: hence the swap.
    void Execute()
    {
        while (!_actions.empty())
        {
            for (const ACS::VDA5050::FleetAction& action : std::exchange(_actions, {}))
            {
                Execute(action.vehicle, action.action);
            }
        }
    }

    void Execute(std::size_t vehicle, const ACS::VDA5050::MasterAction& action)
    {
        if (const auto* const publishOrNull = std::get_if<ACS::VDA5050::PublishMessage>(&action))
        {
            static_cast<void>(_link.Publish(publishOrNull->message)); // The session resends what is lost.
        }
        else if (const auto* const startOrNull = std::get_if<ACS::VDA5050::StartMasterTimer>(&action))
        {
            StartTimer(vehicle, *startOrNull);
        }
        else if (const auto* const cancelOrNull = std::get_if<ACS::VDA5050::CancelMasterTimer>(&action))
        {
            _timers.erase({vehicle, cancelOrNull->timer});
        }
        else
        {
            _onEvent(vehicle, action);
        }
    }

    void StartTimer(std::size_t vehicle, const ACS::VDA5050::StartMasterTimer& start)
    {
        boost::asio::steady_timer& timer = _timers.try_emplace({vehicle, start.timer}, _io).first->second;
        timer.expires_after(start.delay);
        timer.async_wait([this, vehicle, name = start.timer](const boost::system::error_code& error) {
            if (!error)
            {
                _fleet.OnTimer(vehicle, name, ReadClock(), _actions);
                Execute();
            }
        });
    }
};
