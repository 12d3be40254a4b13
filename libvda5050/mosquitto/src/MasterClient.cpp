#include "BrokerEvent.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/net/ActionPump.hpp>
#include <acs/net/EventQueue.hpp>
#include <acs/net/TimerArray.hpp>
#include <acs/vda5050_mosquitto/MasterClient.hpp>
#include <acs/vda5050_mosquitto/MosquittoLink.hpp>

#include <cassert>
#include <optional>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <variant>

namespace ACS::VDA5050
{

namespace
{

using MasterEvent = std::variant<BrokerUp, BrokerDown, FleetAction>;
using MasterEvents = Net::EventQueue<MasterEvent>;

constexpr std::size_t MASTER_TIMERS = 3;
static_assert(static_cast<std::size_t>(EMasterTimer::Silence) + 1 == MASTER_TIMERS);

using MasterTimers = Net::TimerArray<EMasterTimer, MASTER_TIMERS>;

} // namespace

class MasterClient::Impl final : private IMqttLinkListener
{
    boost::asio::any_io_executor _executor;
    const Core::IClock& _clock;
    Core::Logger _logger;
    IMasterHandler& _handler;
    MasterFleet _fleet;
    std::shared_ptr<MasterEvents> _events;
    std::unordered_map<std::size_t, std::shared_ptr<MasterTimers>> _timers; ///< By vehicle.
    Net::ActionPump<FleetAction> _pump;
    MosquittoLink _link;
    bool _bStopped = false;

public:
    Impl(
        const boost::asio::any_io_executor& executor,
        const Core::IClock& clock,
        Core::IRandom& random,
        const Core::Logger& logger,
        MosquittoOptions broker,
        MasterFleet fleet,
        IMasterHandler& handler)
        : _executor(executor),
          _clock(clock),
          _logger(logger),
          _handler(handler),
          _fleet(std::move(fleet)),
          _events(std::make_shared<MasterEvents>(executor, [this](const MasterEvent& event) { Deliver(event); })),
          _link(executor, random, logger, std::move(broker), *this)
    {
        _link.Subscribe(_fleet.GetSubscriptions());
    }

    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    ~Impl() override
    {
        _events->Detach();
    }

    void Start()
    {
        _link.Start();
    }

    void StopAsync(StopHandler handler)
    {
        OnLinkDown({}); // The sessions accept nothing from now on.
        _bStopped = true;
        _events->Detach();
        _timers.clear();
        _link.StopAsync(std::nullopt, MosquittoLink::DEFAULT_STOP_TIMEOUT, std::move(handler));
    }

    [[nodiscard]] bool IsConnected() const
    {
        return _link.IsConnected();
    }

    [[nodiscard]] const MasterFleet& GetFleet() const
    {
        return _fleet;
    }

    /// call(fleet, now, out); returns its result, a Core::Result.
    template <typename TCall>
    auto Run(TCall call)
    {
        std::optional<std::invoke_result_t<TCall, MasterFleet&, Core::Now, FleetActions&>> result;
        _pump.Run(
            [&](FleetActions& out) { result.emplace(call(_fleet, _clock.GetNow(), out)); },
            [this](const FleetAction& action) { Execute(action); });
        return std::move(*result);
    }

    /// Likewise, call(session, now, out).
    template <typename TCall>
    auto RunSession(std::size_t vehicle, TCall call)
    {
        assert(_fleet.Contains(vehicle));
        return Run([&](MasterFleet& fleet, Core::Now now, FleetActions& out) {
            MasterActions actions;
            auto result = call(fleet.GetSession(vehicle), now, actions);
            AppendActions(vehicle, actions, out);
            return result;
        });
    }

    bool TryRemove(std::size_t vehicle)
    {
        bool bRemoved = false;
        Run([vehicle, &bRemoved](MasterFleet& fleet, Core::Now /*now*/, FleetActions& out) {
            bRemoved = fleet.TryRemove(vehicle, out);
            return Core::Result<void>();
        });
        _timers.erase(vehicle);
        return bRemoved;
    }

private:
    void OnLinkUp() override
    {
        _events->Push(BrokerUp());
        Run([](MasterFleet& fleet, Core::Now now, FleetActions& out) {
            fleet.OnLinkUp(now, out);
            return Core::Result<void>();
        });
    }

    void OnLinkDown(std::error_code reason) override
    {
        _events->Push(BrokerDown{reason});
        Run([](MasterFleet& fleet, Core::Now now, FleetActions& out) {
            fleet.OnLinkDown(now, out);
            return Core::Result<void>();
        });
    }

    void OnMqttMessage(const MqttMessage& message) override
    {
        Run([&message](MasterFleet& fleet, Core::Now now, FleetActions& out) {
            fleet.OnMessage(message, now, out);
            return Core::Result<void>();
        });
    }

    void Execute(const FleetAction& action)
    {
        if (_bStopped)
        {
            return;
        }
        const std::size_t vehicle = action.vehicle;
        std::visit(
            Core::Overloaded{
                [this](const PublishMessage& publish) { Publish(publish.message); },
                [this, vehicle](const StartMasterTimer& start) { StartTimer(vehicle, start); },
                [this, vehicle](const CancelMasterTimer& cancel) {
                    if (const auto found = _timers.find(vehicle); found != _timers.end())
                    {
                        found->second->Cancel(cancel.timer);
                    }
                },
                [this, &action](const auto& /*event*/) {
                    _events->Push(action);
                }},
            action.action);
    }

    void Publish(const MqttMessage& message)
    {
        if (const Core::Result<void> published = _link.Publish(message); !published)
        {
            _logger.Debug(
                "a message is sent later",
                {{"topic", message.topic}, {"reason", Core::Describe(published.error())}});
        }
    }

    void StartTimer(std::size_t vehicle, const StartMasterTimer& start)
    {
        std::shared_ptr<MasterTimers>& timers = _timers[vehicle];
        if (timers == nullptr)
        {
            timers = std::make_shared<MasterTimers>(_executor, [this, vehicle](EMasterTimer timer) {
                Run([vehicle, timer](MasterFleet& fleet, Core::Now now, FleetActions& out) {
                    fleet.OnTimer(vehicle, timer, now, out);
                    return Core::Result<void>();
                });
            });
        }
        timers->Start(start.timer, start.delay);
    }

    void Deliver(const MasterEvent& event)
    {
        std::visit(
            Core::Overloaded{
                [this](const BrokerUp& /*up*/) { _handler.OnBrokerUp(); },
                [this](const BrokerDown& down) { _handler.OnBrokerDown(down.reason); },
                [this](const FleetAction& action) {
                    if (_fleet.Contains(action.vehicle))
                    {
                        _handler.OnVehicleEvent(action.vehicle, action.action);
                    }
                }},
            event);
    }
};

MasterClient::MasterClient(std::unique_ptr<Impl> impl)
    : _impl(std::move(impl))
{
}

MasterClient::~MasterClient() = default;

Core::Result<std::unique_ptr<MasterClient>> MasterClient::Create(
    const boost::asio::any_io_executor& executor,
    const Core::IClock& clock,
    Core::IRandom& random,
    const Core::Logger& logger,
    MosquittoOptions broker,
    FleetOptions options,
    IMasterHandler& handler)
{
    Core::Result<MasterFleet> fleet = MasterFleet::Create(std::move(options));
    if (!fleet)
    {
        return tl::unexpected<Core::Error>(std::move(fleet.error()));
    }
    auto impl = std::make_unique<Impl>(executor, clock, random, logger, std::move(broker), std::move(*fleet), handler);
    return std::unique_ptr<MasterClient>(new MasterClient(std::move(impl))); // the constructor is private
}

void MasterClient::Start()
{
    _impl->Start();
}

void MasterClient::StopAsync(StopHandler handler)
{
    _impl->StopAsync(std::move(handler));
}

bool MasterClient::IsConnected() const
{
    return _impl->IsConnected();
}

const MasterFleet& MasterClient::GetFleet() const
{
    return _impl->GetFleet();
}

Core::Result<std::size_t> MasterClient::Add(const VehicleAddress& address)
{
    return _impl->Run(
        [&address](MasterFleet& fleet, Core::Now now, FleetActions& out) { return fleet.Add(address, now, out); });
}

bool MasterClient::TryRemove(std::size_t vehicle)
{
    return _impl->TryRemove(vehicle);
}

Core::Result<void> MasterClient::SendOrder(std::size_t vehicle, OrderMessage order)
{
    return _impl->RunSession(vehicle, [&order](MasterSession& session, Core::Now now, MasterActions& out) {
        return session.SendOrder(std::move(order), now, out);
    });
}

Core::Result<void> MasterClient::SendOrderUpdate(std::size_t vehicle, OrderMessage update)
{
    return _impl->RunSession(vehicle, [&update](MasterSession& session, Core::Now now, MasterActions& out) {
        return session.SendOrderUpdate(std::move(update), now, out);
    });
}

Core::Result<std::string> MasterClient::SendInstantAction(std::size_t vehicle, Action action)
{
    return _impl->RunSession(vehicle, [&action](MasterSession& session, Core::Now now, MasterActions& out) {
        return session.SendInstantAction(std::move(action), now, out);
    });
}

Core::Result<void> MasterClient::Cancel(std::size_t vehicle)
{
    return _impl->RunSession(vehicle, [](MasterSession& session, Core::Now now, MasterActions& out) {
        return session.Cancel(now, out);
    });
}

void MasterClient::Run(std::size_t vehicle, const SessionCall& call)
{
    _impl->RunSession(vehicle, [&call](MasterSession& session, Core::Now now, MasterActions& out) {
        call(session, now, out);
        return Core::Result<void>();
    });
}

} // namespace ACS::VDA5050
