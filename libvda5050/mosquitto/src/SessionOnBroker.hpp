#pragma once

#include "ISessionOwner.hpp"
#include <acs/core/Api.hpp>
#include <acs/core/IRandom.hpp>
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>
#include <acs/net/ActionPump.hpp>
#include <acs/net/EventQueue.hpp>
#include <acs/vda5050/IMqttLink.hpp>
#include <acs/vda5050_mosquitto/MosquittoLink.hpp>
#include <acs/vda5050_mosquitto/MosquittoOptions.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <memory>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

namespace ACS::VDA5050
{

/// What MasterClient and VehicleClient share: a session, or a fleet of them, on a link of its own. Passes the link's events to the
/// session, has the client execute the actions in order, and queues events for its handler.
template <typename TSession, typename TAction>
class ACS_HIDDEN SessionOnBroker final : private IMqttLinkListener
{
public:
    using Actions = std::vector<TAction>;
    using Owner = ISessionOwner<TSession, TAction>;
    using Event = typename Owner::Event;

private:
    using Events = Net::EventQueue<Event>;

    Owner& _owner;
    const Core::IClock& _clock;
    Core::Logger _logger;
    TSession _session;
    std::shared_ptr<Events> _events;
    Net::ActionPump<TAction> _pump;
    MosquittoLink _link;
    bool _bStopped = false;

public:
    SessionOnBroker(
        const boost::asio::any_io_executor& executor,
        const Core::IClock& clock,
        Core::IRandom& random,
        const Core::Logger& logger,
        MosquittoOptions broker,
        TSession session,
        Owner& owner)
        : _owner(owner),
          _clock(clock),
          _logger(logger),
          _session(std::move(session)),
          _events(std::make_shared<Events>(executor, [this](const Event& event) { _owner.Deliver(event); })),
          _link(executor, random, logger, std::move(broker), *this)
    {
        _link.Subscribe(_session.GetSubscriptions());
    }

    SessionOnBroker(const SessionOnBroker&) = delete;
    SessionOnBroker& operator=(const SessionOnBroker&) = delete;

    ~SessionOnBroker() override
    {
        _events->Detach();
    }

    void Start()
    {
        _owner.PrepareConnection(_session, _link, _clock.GetNow());
        _link.Start();
    }

    void StopAsync(MosquittoLink::StopHandler handler)
    {
        Run([this](TSession& session, Core::Now now, Actions& out) { _owner.EndSession(session, now, out); });
        _bStopped = true;
        _events->Detach();
        _owner.CancelTimers();
        _link.StopAsync(std::nullopt, MosquittoLink::DEFAULT_STOP_TIMEOUT, std::move(handler));
    }

    [[nodiscard]] bool IsConnected() const
    {
        return _link.IsConnected();
    }

    [[nodiscard]] const TSession& GetSession() const
    {
        return _session;
    }

    /// call(session, now, out)
    template <typename TCall>
    void Run(TCall call)
    {
        _pump.Run(
            [&](Actions& out) { call(_session, _clock.GetNow(), out); },
            [this](const TAction& action) {
                if (!_bStopped)
                {
                    _owner.Execute(action);
                }
            });
    }

    /// The session repeats what is lost, or its next message contains it.
    void Publish(const MqttMessage& message)
    {
        if (const Core::Result<void> published = _link.Publish(message); !published)
        {
            _logger.Debug(
                "a message was not sent",
                {{"topic", message.topic}, {"reason", Core::Describe(published.error())}});
        }
    }

    void Push(const TAction& event)
    {
        _events->Push(event);
    }

private:
    void OnLinkUp() override
    {
        _owner.PrepareConnection(_session, _link, _clock.GetNow());
        _events->Push(BrokerUp());
        Run([](TSession& session, Core::Now now, Actions& out) { session.OnLinkUp(now, out); });
    }

    void OnLinkDown(std::error_code reason) override
    {
        _events->Push(BrokerDown{reason});
        Run([](TSession& session, Core::Now now, Actions& out) { session.OnLinkDown(now, out); });
    }

    void OnMqttMessage(const MqttMessage& message) override
    {
        Run([&message](TSession& session, Core::Now now, Actions& out) { session.OnMessage(message, now, out); });
    }
};

} // namespace ACS::VDA5050
