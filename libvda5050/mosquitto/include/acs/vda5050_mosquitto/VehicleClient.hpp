#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/IRandom.hpp>
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/vda5050/VehicleSession.hpp>
#include <acs/vda5050_mosquitto/IVehicleHandler.hpp>
#include <acs/vda5050_mosquitto/MosquittoOptions.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <functional>
#include <memory>

namespace ACS::VDA5050
{

/// A VehicleSession on a broker: publishes what it requests, with a will for each connection, runs its timers and passes its other
/// actions on. Runs on the single thread of the executor, and is called from there only.
class ACS_API VehicleClient final
{
public:
    /// Calls the session; the client carries out what it adds to out.
    using SessionCall = std::function<void(VehicleSession& session, Core::Now now, VehicleActions& out)>;
    /// Called once, on the executor, after the connection was closed.
    using StopHandler = std::function<void()>;

private:
    class ACS_HIDDEN Impl;

    std::unique_ptr<Impl> _impl;

public:
    /// Does not connect before Start. The will of the broker's options is ignored. Clock, random source, log sink and handler must
    /// outlive the client.
    VehicleClient(
        const boost::asio::any_io_executor& executor,
        const Core::IClock& clock,
        Core::IRandom& random,
        const Core::Logger& logger,
        MosquittoOptions broker,
        VehicleOptions options,
        IVehicleHandler& handler);
    VehicleClient(const VehicleClient&) = delete;
    VehicleClient& operator=(const VehicleClient&) = delete;
    /// Closes the connection at once, so that the broker sends the will; the handler is not called any more.
    ~VehicleClient();

    /// Connects, and reconnects until it is stopped. Called once.
    void Start();

    /// Publishes OFFLINE as the last message, waits until the broker has acknowledged it, at most for
    /// MosquittoLink::DEFAULT_STOP_TIMEOUT, disconnects without a will, and calls the handler once on the executor. No action follows.
    void StopAsync(StopHandler handler);

    /// Whether the broker is connected and all subscriptions are confirmed.
    [[nodiscard]] bool IsConnected() const;

    /// The reference is valid for the lifetime of the client.
    [[nodiscard]] const VehicleSession& GetSession() const;

    /// Reports position, battery, loads, arrivals and the progress of actions to the session. The actions that follow from it come
    /// after the call has returned.
    void Run(const SessionCall& call);
};

} // namespace ACS::VDA5050
