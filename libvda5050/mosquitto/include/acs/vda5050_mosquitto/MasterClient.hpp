#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/IRandom.hpp>
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>
#include <acs/vda5050/MasterFleet.hpp>
#include <acs/vda5050_mosquitto/IMasterHandler.hpp>
#include <acs/vda5050_mosquitto/MosquittoOptions.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

namespace ACS::VDA5050
{

/// A MasterFleet on a broker: publishes what its sessions request, runs their timers and passes their events on. Runs on the single
/// thread of the executor, and is called from there only. Other messages of the broker need a MosquittoLink of your own.
class ACS_API MasterClient final
{
public:
    /// Calls the session of a vehicle; the client carries out what it adds to out.
    using SessionCall = std::function<void(MasterSession& session, Core::Now now, MasterActions& out)>;
    /// Called once, on the executor, after the connection was closed.
    using StopHandler = std::function<void()>;

private:
    class ACS_HIDDEN Impl;

    std::unique_ptr<Impl> _impl;

    explicit MasterClient(std::unique_ptr<Impl> impl);

public:
    MasterClient(const MasterClient&) = delete;
    MasterClient& operator=(const MasterClient&) = delete;
    /// Closes the connection at once; the handler is not called any more.
    ~MasterClient();

    /// Does not connect before Start. Fails with InvalidTopic if the interfaceName is not allowed in a topic. Clock, random source,
    /// log sink and handler must outlive the client.
    [[nodiscard]] static Core::Result<std::unique_ptr<MasterClient>> Create(
        const boost::asio::any_io_executor& executor,
        const Core::IClock& clock,
        Core::IRandom& random,
        const Core::Logger& logger,
        MosquittoOptions broker,
        FleetOptions options,
        IMasterHandler& handler);

    /// Connects, and reconnects until it is stopped. Called once.
    void Start();

    /// Waits until the broker has acknowledged what was published, at most for MosquittoLink::DEFAULT_STOP_TIMEOUT, disconnects,
    /// and calls the handler once on the executor. The vehicles are not commanded. No event follows,
    /// and orders are refused.
    void StopAsync(StopHandler handler);

    /// Whether the broker is connected and all subscriptions are confirmed.
    [[nodiscard]] bool IsConnected() const;

    /// For GetSession, FindOrNull and the statistics. The reference is valid for the lifetime of the client.
    [[nodiscard]] const MasterFleet& GetFleet() const;

    // These call the function of the same name of the fleet or of the vehicle's session, and carry out its actions; their events
    // follow after the call has returned. The vehicle must be in the fleet.

    /// MasterFleet::Add: a vehicle before its first message. Returns its number.
    [[nodiscard]] Core::Result<std::size_t> Add(const VehicleAddress& address);
    /// MasterFleet::TryRemove. The events of the vehicle that were not delivered yet are dropped.
    bool TryRemove(std::size_t vehicle);
    /// MasterSession::SendOrder: resent until the vehicle shows the order.
    [[nodiscard]] Core::Result<void> SendOrder(std::size_t vehicle, OrderMessage order);
    /// MasterSession::SendOrderUpdate: sent once the vehicle shows the previous message.
    [[nodiscard]] Core::Result<void> SendOrderUpdate(std::size_t vehicle, OrderMessage update);
    /// MasterSession::SendInstantAction: resent until the vehicle shows the action. Returns its id.
    [[nodiscard]] Core::Result<std::string> SendInstantAction(std::size_t vehicle, Action action);
    /// MasterSession::Cancel: cancels the order.
    [[nodiscard]] Core::Result<void> Cancel(std::size_t vehicle);
    /// For all other functions of the session.
    void Run(std::size_t vehicle, const SessionCall& call);
};

} // namespace ACS::VDA5050
