#pragma once

#include "LinkFixture.hpp"
#include "SchemaCheck.hpp"
#include "SessionTimers.hpp"
#include <acs/vda5050/MasterFleet.hpp>
#include <acs/vda5050_mosquitto/MosquittoLink.hpp>

#include <boost/asio/io_context.hpp>

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <variant>

namespace ACS::Testing
{

/// A MasterFleet on a link: performs the actions of its sessions and records their events.
class LinkedFleet final : VDA5050::IMqttLinkListener
{
    using Timers = SessionTimers<VDA5050::EMasterTimer>;

    boost::asio::io_context& _context;
    RecordingLogSink _log;
    SeededRandom _random;
    std::map<std::size_t, std::unique_ptr<Timers>> _timers;
    VDA5050::MosquittoLink _link;

public:
    VDA5050::MasterFleet fleet;
    VDA5050::FleetActions events;

    LinkedFleet(boost::asio::io_context& context, VDA5050::MosquittoOptions link, VDA5050::FleetOptions options)
        : _context(context),
          _link(context.get_executor(), _random, Core::Logger(_log, "mqtt"), std::move(link), *this),
          fleet(std::move(options))
    {
        _link.Subscribe(fleet.GetSubscriptions());
        _link.Start();
    }

    [[nodiscard]] Core::Result<void> SendOrder(std::size_t vehicle, const VDA5050::OrderMessage& order)
    {
        VDA5050::MasterActions out;
        Core::Result<void> sent = fleet.GetSession(vehicle).SendOrder(order, ReadClock(), out);
        VDA5050::FleetActions actions;
        VDA5050::AppendActions(vehicle, out, actions);
        Execute(actions);
        return sent;
    }

    template <typename TEvent>
    [[nodiscard]] std::size_t Count(std::size_t vehicle) const
    {
        std::size_t count = 0;
        for (const VDA5050::FleetAction& action : events)
        {
            const bool bCounts = action.vehicle == vehicle && std::holds_alternative<TEvent>(action.action);
            count += bCounts ? 1U : 0U;
        }
        return count;
    }

private:
    void Execute(const VDA5050::FleetActions& actions)
    {
        for (const auto& [vehicle, action] : actions)
        {
            events.push_back({vehicle, action});
            auto& timers = _timers.try_emplace(vehicle, nullptr).first->second;
            timers = timers == nullptr ? std::make_unique<Timers>(_context) : std::move(timers);
            if (const auto* publish = std::get_if<VDA5050::PublishMessage>(&action))
            {
                CheckValid(publish->message.topic, publish->message.payload);
                std::ignore = _link.Publish(publish->message); // what is lost is sent again
            }
            else if (const auto* start = std::get_if<VDA5050::StartMasterTimer>(&action))
            {
                const std::size_t number = vehicle;
                const VDA5050::EMasterTimer timer = start->timer;
                timers->Start(timer, start->delay, [this, number, timer]() {
                    Do([number, timer](auto& all, auto& out) { all.OnTimer(number, timer, ReadClock(), out); });
                });
            }
            else if (const auto* cancel = std::get_if<VDA5050::CancelMasterTimer>(&action))
            {
                timers->Cancel(cancel->timer);
            }
        }
    }

    template <typename TCall>
    void Do(const TCall& call)
    {
        VDA5050::FleetActions out;
        call(fleet, out);
        Execute(out);
    }

    void OnLinkUp() override
    {
        Do([](auto& all, auto& out) { all.OnLinkUp(ReadClock(), out); });
    }

    void OnLinkDown(std::error_code /*reason*/) override
    {
        Do([](auto& all, auto& out) { all.OnLinkDown(ReadClock(), out); });
    }

    void OnMqttMessage(const VDA5050::MqttMessage& message) override
    {
        Do([&message](auto& all, auto& out) { all.OnMessage(message, ReadClock(), out); });
    }
};

} // namespace ACS::Testing
