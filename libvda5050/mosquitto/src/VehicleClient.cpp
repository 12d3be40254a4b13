#include "SessionOnBroker.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/net/TimerArray.hpp>
#include <acs/vda5050_mosquitto/VehicleClient.hpp>

#include <cstddef>
#include <memory>
#include <utility>
#include <variant>

namespace ACS::VDA5050
{

namespace
{

constexpr std::size_t VEHICLE_TIMERS = 3;
static_assert(static_cast<std::size_t>(EVehicleTimer::Visualization) + 1 == VEHICLE_TIMERS);

using VehicleTimers = Net::TimerArray<EVehicleTimer, VEHICLE_TIMERS>;

} // namespace

class VehicleClient::Impl final : private ISessionOwner<VehicleSession, VehicleAction>
{
    IVehicleHandler& _handler;
    std::shared_ptr<VehicleTimers> _timers;

public:
    SessionOnBroker<VehicleSession, VehicleAction> onBroker;

    Impl(
        const boost::asio::any_io_executor& executor,
        const Core::IClock& clock,
        Core::IRandom& random,
        const Core::Logger& logger,
        MosquittoOptions broker,
        VehicleOptions options,
        IVehicleHandler& handler)
        : _handler(handler),
          _timers(std::make_shared<VehicleTimers>(
              executor,
              [this](EVehicleTimer timer) {
                  onBroker.Run([timer](VehicleSession& session, Core::Now now, VehicleActions& out) {
                      session.OnTimer(timer, now, out);
                  });
              })),
          onBroker(executor, clock, random, logger, std::move(broker), VehicleSession(std::move(options)), *this)
    {
    }

private:
    void Execute(const VehicleAction& action) override
    {
        std::visit(
            Core::Overloaded{
                [this](const PublishMessage& publish) { onBroker.Publish(publish.message); },
                [this](const StartVehicleTimer& start) { _timers->Start(start.timer, start.delay); },
                [this](const CancelVehicleTimer& cancel) { _timers->Cancel(cancel.timer); },
                [this, &action](const auto& /*event*/) {
                    onBroker.Push(action);
                }},
            action);
    }

    void CancelTimers() override
    {
        _timers->CancelAll();
    }

    void EndSession(VehicleSession& session, Core::Now now, VehicleActions& out) override
    {
        session.Leave(now, out);
    }

    /// Each will has its own time.
    void PrepareConnection(VehicleSession& session, MosquittoLink& link, Core::Now now) override
    {
        link.SetWill(session.MakeWill(now));
    }

    void Deliver(const Event& event) override
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
    _impl->onBroker.Start();
}

void VehicleClient::StopAsync(StopHandler handler)
{
    _impl->onBroker.StopAsync(std::move(handler));
}

bool VehicleClient::IsConnected() const
{
    return _impl->onBroker.IsConnected();
}

const VehicleSession& VehicleClient::GetSession() const
{
    return _impl->onBroker.GetSession();
}

void VehicleClient::Run(const SessionCall& call)
{
    _impl->onBroker.Run(call);
}

} // namespace ACS::VDA5050
