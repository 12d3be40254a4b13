#include "SessionOnBroker.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/net/TimerArray.hpp>
#include <acs/vda5050_mosquitto/MasterClient.hpp>

#include <cassert>
#include <cstddef>
#include <memory>
#include <string>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <variant>

namespace ACS::VDA5050
{

namespace
{

constexpr std::size_t MASTER_TIMERS = 3;
static_assert(static_cast<std::size_t>(EMasterTimer::Silence) + 1 == MASTER_TIMERS);

using MasterTimers = Net::TimerArray<EMasterTimer, MASTER_TIMERS>;

} // namespace

class MasterClient::Impl final : private ISessionOwner<MasterFleet, FleetAction>
{
    boost::asio::any_io_executor _executor;
    IMasterHandler& _handler;
    std::unordered_map<std::size_t, std::shared_ptr<MasterTimers>> _timers; ///< By vehicle.

public:
    SessionOnBroker<MasterFleet, FleetAction> onBroker;

    Impl(
        const boost::asio::any_io_executor& executor,
        const Core::IClock& clock,
        Core::IRandom& random,
        const Core::Logger& logger,
        MosquittoOptions broker,
        MasterFleet fleet,
        IMasterHandler& handler)
        : _executor(executor),
          _handler(handler),
          onBroker(executor, clock, random, logger, std::move(broker), std::move(fleet), *this)
    {
    }

    /// call(session, now, out); returns its result, a Core::Result.
    template <typename TCall>
    auto RunSession(std::size_t vehicle, TCall call)
    {
        assert(onBroker.GetSession().Contains(vehicle));
        std::invoke_result_t<TCall, MasterSession&, Core::Now, MasterActions&> result;
        onBroker.Run([&](MasterFleet& fleet, Core::Now now, FleetActions& out) {
            MasterActions actions;
            result = call(fleet.GetSession(vehicle), now, actions);
            AppendActions(vehicle, actions, out);
        });
        return result;
    }

    void ForgetTimers(std::size_t vehicle)
    {
        _timers.erase(vehicle);
    }

private:
    void Execute(const FleetAction& action) override
    {
        const std::size_t vehicle = action.vehicle;
        std::visit(
            Core::Overloaded{
                [this](const PublishMessage& publish) { onBroker.Publish(publish.message); },
                [this, vehicle](const StartMasterTimer& start) { StartTimer(vehicle, start); },
                [this, vehicle](const CancelMasterTimer& cancel) {
                    if (const auto found = _timers.find(vehicle); found != _timers.end())
                    {
                        found->second->Cancel(cancel.timer);
                    }
                },
                [this, &action](const auto& /*event*/) {
                    onBroker.Push(action);
                }},
            action.action);
    }

    void StartTimer(std::size_t vehicle, const StartMasterTimer& start)
    {
        std::shared_ptr<MasterTimers>& timers = _timers[vehicle];
        if (timers == nullptr)
        {
            timers = std::make_shared<MasterTimers>(_executor, [this, vehicle](EMasterTimer timer) {
                onBroker.Run([vehicle, timer](MasterFleet& fleet, Core::Now now, FleetActions& out) {
                    fleet.OnTimer(vehicle, timer, now, out);
                });
            });
        }
        timers->Start(start.timer, start.delay);
    }

    void CancelTimers() override
    {
        _timers.clear();
    }

    /// The sessions accept nothing from now on.
    void EndSession(MasterFleet& fleet, Core::Now now, FleetActions& out) override
    {
        fleet.OnLinkDown(now, out);
    }

    void PrepareConnection(MasterFleet& /*fleet*/, MosquittoLink& /*link*/, Core::Now /*now*/) override
    {
    }

    void Deliver(const Event& event) override
    {
        std::visit(
            Core::Overloaded{
                [this](const BrokerUp& /*up*/) { _handler.OnBrokerUp(); },
                [this](const BrokerDown& down) { _handler.OnBrokerDown(down.reason); },
                [this](const FleetAction& action) {
                    if (onBroker.GetSession().Contains(action.vehicle))
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
    _impl->onBroker.Start();
}

void MasterClient::StopAsync(StopHandler handler)
{
    _impl->onBroker.StopAsync(std::move(handler));
}

bool MasterClient::IsConnected() const
{
    return _impl->onBroker.IsConnected();
}

const MasterFleet& MasterClient::GetFleet() const
{
    return _impl->onBroker.GetSession();
}

Core::Result<std::size_t> MasterClient::Add(const VehicleAddress& address)
{
    Core::Result<std::size_t> number;
    _impl->onBroker.Run([&address, &number](MasterFleet& fleet, Core::Now now, FleetActions& out) {
        number = fleet.Add(address, now, out);
    });
    return number;
}

bool MasterClient::TryRemove(std::size_t vehicle)
{
    bool bRemoved = false;
    _impl->onBroker.Run([vehicle, &bRemoved](MasterFleet& fleet, Core::Now /*now*/, FleetActions& out) {
        bRemoved = fleet.TryRemove(vehicle, out);
    });
    _impl->ForgetTimers(vehicle);
    return bRemoved;
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
