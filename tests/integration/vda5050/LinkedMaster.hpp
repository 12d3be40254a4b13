#pragma once

#include "LinkFixture.hpp"
#include "SchemaCheck.hpp"
#include "SessionTimers.hpp"
#include "Vda5050Sample.hpp"
#include <acs/vda5050/MasterSession.hpp>
#include <acs/vda5050_mosquitto/MosquittoLink.hpp>

#include <boost/asio/io_context.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace ACS::Testing
{

/// A MasterSession on a link: performs its actions, records its events, and checks what it publishes against the
/// schemas.
class LinkedMaster final : VDA5050::IMqttLinkListener
{
    RecordingLogSink _log;
    SeededRandom _random;
    SessionTimers<VDA5050::EMasterTimer> _timers;
    VDA5050::MosquittoLink _link;

public:
    VDA5050::MasterSession session;
    VDA5050::MasterActions events;

    LinkedMaster(boost::asio::io_context& context, VDA5050::MosquittoOptions link, VDA5050::MasterOptions options)
        : _timers(context),
          _link(context.get_executor(), _random, Core::Logger(_log, "mqtt"), std::move(link), *this),
          session(std::move(options))
    {
        _link.Subscribe(session.GetSubscriptions());
        _link.Start();
    }

    /// Calls a function of the session and performs the actions that it appends.
    template <typename TCall>
    auto Do(const TCall& call)
    {
        VDA5050::MasterActions out;
        if constexpr (std::is_void_v<decltype(call(session, ReadClock(), out))>)
        {
            call(session, ReadClock(), out);
            Execute(out);
        }
        else
        {
            auto result = call(session, ReadClock(), out);
            Execute(out);
            return result;
        }
    }

    [[nodiscard]] Core::Result<void> SendOrder(const VDA5050::OrderMessage& order)
    {
        return Do([&order](auto& master, Core::Now now, auto& out) { return master.SendOrder(order, now, out); });
    }

    [[nodiscard]] Core::Result<void> ResumeOrder(const VDA5050::OrderRecord& record)
    {
        return Do([&record](auto& master, Core::Now now, auto& out) { return master.ResumeOrder(record, now, out); });
    }

    [[nodiscard]] Core::Result<void> SendUpdate(const VDA5050::OrderMessage& order)
    {
        return Do([&order](auto& master, Core::Now now, auto& out) { return master.SendOrderUpdate(order, now, out); });
    }

    [[nodiscard]] Core::Result<std::string> SendAction(const VDA5050::Action& action)
    {
        return Do(
            [&action](auto& master, Core::Now now, auto& out) { return master.SendInstantAction(action, now, out); });
    }

    template <typename TEvent>
    [[nodiscard]] std::size_t Count() const
    {
        return VDA5050::Test::Pick<TEvent>(events).size();
    }

    /// The last reported status of an action.
    [[nodiscard]] std::optional<VDA5050::EActionStatus> GetStatusOrNull(const std::string& actionID) const
    {
        std::optional<VDA5050::EActionStatus> status;
        for (const auto& change : VDA5050::Test::Pick<VDA5050::ActionChanged>(events))
        {
            status = change.actionID == actionID ? std::optional(change.status) : status;
        }
        return status;
    }

    [[nodiscard]] std::vector<std::uint32_t> ListReached() const
    {
        std::vector<std::uint32_t> reached;
        for (const auto& node : VDA5050::Test::Pick<VDA5050::NodeReached>(events))
        {
            reached.push_back(node.sequenceID);
        }
        return reached;
    }

private:
    void Execute(const VDA5050::MasterActions& actions)
    {
        for (const VDA5050::MasterAction& action : actions)
        {
            events.push_back(action);
            if (const auto* publish = std::get_if<VDA5050::PublishMessage>(&action))
            {
                CheckValid(publish->message.topic, publish->message.payload);
                std::ignore = _link.Publish(publish->message); // what is lost is sent again
            }
            else if (const auto* start = std::get_if<VDA5050::StartMasterTimer>(&action))
            {
                const VDA5050::EMasterTimer timer = start->timer;
                _timers.Start(timer, start->delay, [this, timer]() {
                    Do([timer](auto& master, Core::Now now, auto& out) { master.OnTimer(timer, now, out); });
                });
            }
            else if (const auto* cancel = std::get_if<VDA5050::CancelMasterTimer>(&action))
            {
                _timers.Cancel(cancel->timer);
            }
        }
    }

    void OnLinkUp() override
    {
        Do([](auto& master, Core::Now now, auto& out) { master.OnLinkUp(now, out); });
    }

    void OnLinkDown(std::error_code /*reason*/) override
    {
        Do([](auto& master, Core::Now now, auto& out) { master.OnLinkDown(now, out); });
    }

    void OnMqttMessage(const VDA5050::MqttMessage& message) override
    {
        Do([&message](auto& master, Core::Now now, auto& out) { master.OnMessage(message, now, out); });
    }
};

} // namespace ACS::Testing
