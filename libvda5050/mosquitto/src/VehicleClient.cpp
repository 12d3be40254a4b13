#include "BrokerEvent.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/net/ActionPump.hpp>
#include <acs/net/EventQueue.hpp>
#include <acs/net/TimerArray.hpp>
#include <acs/vda5050_mosquitto/MosquittoLink.hpp>
#include <acs/vda5050_mosquitto/VehicleClient.hpp>

#include <cstddef>
#include <optional>
#include <utility>
#include <variant>

namespace ACS::VDA5050
{

namespace
{

using VehicleEvent = std::variant<BrokerUp, BrokerDown, VehicleAction>;
using VehicleEvents = Net::EventQueue<VehicleEvent>;

constexpr std::size_t VEHICLE_TIMERS = 3;
static_assert(static_cast<std::size_t>(EVehicleTimer::Visualization) + 1 == VEHICLE_TIMERS);

using VehicleTimers = Net::TimerArray<EVehicleTimer, VEHICLE_TIMERS>;

} // namespace

class VehicleClient::Impl final : private IMqttLinkListener
{
    const Core::IClock& _clock;
    Core::Logger _logger;
    IVehicleHandler& _handler;
    VehicleSession _session;
    std::shared_ptr<VehicleEvents> _events;
    std::shared_ptr<VehicleTimers> _timers;
    Net::ActionPump<VehicleAction> _pump;
    MosquittoLink _link;
    bool _bStopped = false;

public:
    Impl(
        const boost::asio::any_io_executor& executor,
        const Core::IClock& clock,
        Core::IRandom& random,
        const Core::Logger& logger,
        MosquittoOptions broker,
        VehicleOptions options,
        IVehicleHandler& handler)
        : _clock(clock),
          _logger(logger),
          _handler(handler),
          _session(std::move(options)),
          _events(std::make_shared<VehicleEvents>(executor, [this](const VehicleEvent& event) { Deliver(event); })),
          _timers(std::make_shared<VehicleTimers>(
              executor,
              [this](EVehicleTimer timer) {
                  Run([timer](VehicleSession& session, Core::Now now, VehicleActions& out) {
                      session.OnTimer(timer, now, out);
                  });
              })),
          _link(executor, random, logger, std::move(broker), *this)
    {
        _link.Subscribe(_session.GetSubscriptions());
    }

    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    ~Impl() override
    {
        _events->Detach();
    }

    void Start()
    {
        _link.SetWill(_session.MakeWill(_clock.GetNow()));
        _link.Start();
    }

    void StopAsync(StopHandler handler)
    {
        Run([](VehicleSession& session, Core::Now now, VehicleActions& out) { session.Leave(now, out); });
        _bStopped = true;
        _events->Detach();
        _timers->CancelAll();
        _link.StopAsync(std::nullopt, MosquittoLink::DEFAULT_STOP_TIMEOUT, std::move(handler));
    }

    [[nodiscard]] bool IsConnected() const
    {
        return _link.IsConnected();
    }

    [[nodiscard]] const VehicleSession& GetSession() const
    {
        return _session;
    }

    template <typename TCall>
    void Run(TCall call)
    {
        _pump.Run(
            [&](VehicleActions& out) { call(_session, _clock.GetNow(), out); },
            [this](const VehicleAction& action) { Execute(action); });
    }

private:
    void OnLinkUp() override
    {
        // For the next connection: each will has its own time.
        _link.SetWill(_session.MakeWill(_clock.GetNow()));
        _events->Push(BrokerUp());
        Run([](VehicleSession& session, Core::Now now, VehicleActions& out) { session.OnLinkUp(now, out); });
    }

    void OnLinkDown(std::error_code reason) override
    {
        _events->Push(BrokerDown{reason});
        Run([](VehicleSession& session, Core::Now now, VehicleActions& out) { session.OnLinkDown(now, out); });
    }

    void OnMqttMessage(const MqttMessage& message) override
    {
        Run([&message](VehicleSession& session, Core::Now now, VehicleActions& out) {
            session.OnMessage(message, now, out);
        });
    }

    void Execute(const VehicleAction& action)
    {
        if (_bStopped)
        {
            return;
        }
        std::visit(
            Core::Overloaded{
                [this](const PublishMessage& publish) { Publish(publish.message); },
                [this](const StartVehicleTimer& start) { _timers->Start(start.timer, start.delay); },
                [this](const CancelVehicleTimer& cancel) { _timers->Cancel(cancel.timer); },
                [this, &action](const auto& /*event*/) {
                    _events->Push(action);
                }},
            action);
    }

    void Publish(const MqttMessage& message)
    {
        if (const Core::Result<void> published = _link.Publish(message); !published)
        {
            // The next state contains everything.
            _logger.Debug(
                "a message was not sent",
                {{"topic", message.topic}, {"reason", Core::Describe(published.error())}});
        }
    }

    void Deliver(const VehicleEvent& event)
    {
        std::visit(
            Core::Overloaded{
                [this](const BrokerUp& /*up*/) { _handler.OnBrokerUp(); },
                [this](const BrokerDown& down) { _handler.OnBrokerDown(down.reason); },
                [this](const VehicleAction& action) {
                    _handler.OnVehicleAction(action);
                }},
            event);
    }
};

VehicleClient::VehicleClient(
    const boost::asio::any_io_executor& executor,
    const Core::IClock& clock,
    Core::IRandom& random,
    const Core::Logger& logger,
    MosquittoOptions broker,
    VehicleOptions options,
    IVehicleHandler& handler)
    : _impl(std::make_unique<Impl>(executor, clock, random, logger, std::move(broker), std::move(options), handler))
{
}

VehicleClient::~VehicleClient() = default;

void VehicleClient::Start()
{
    _impl->Start();
}

void VehicleClient::StopAsync(StopHandler handler)
{
    _impl->StopAsync(std::move(handler));
}

bool VehicleClient::IsConnected() const
{
    return _impl->IsConnected();
}

const VehicleSession& VehicleClient::GetSession() const
{
    return _impl->GetSession();
}

void VehicleClient::Run(const SessionCall& call)
{
    _impl->Run(call);
}

} // namespace ACS::VDA5050
