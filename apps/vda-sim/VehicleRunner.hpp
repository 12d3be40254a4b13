#pragma once

#include "vda-sim/MqttTrace.hpp"
#include "vda-sim/VirtualVehicle.hpp"
#include <acs/core/IRandom.hpp>
#include <acs/core/Now.hpp>
#include <acs/vda5050_mosquitto/MosquittoOptions.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>

namespace ACS::VdaSim
{

/// Runs one virtual vehicle on one MQTT connection: executes its actions and passes it messages, timers and the state of
/// the connection. One thread: the executor's. The clock and the random source must outlive it.
class VehicleRunner
{
public:
    /// Both are called from the executor.
    using Handler = std::function<void()>;

private:
    class Impl;

    std::unique_ptr<Impl> _impl;

public:
    /// Adds the will to the link options. The random source varies the pauses between attempts to connect.
    VehicleRunner(
        const boost::asio::any_io_executor& executor,
        const Core::IClock& clock,
        Core::IRandom& random,
        const Core::Logger& logger,
        VirtualVehicle vehicle,
        VDA5050::MosquittoOptions linkOptions,
        MqttTrace trace);
    VehicleRunner(const VehicleRunner&) = delete;
    VehicleRunner& operator=(const VehicleRunner&) = delete;
    ~VehicleRunner();

    /// Begins to connect; the handler is called each time the vehicle goes online.
    void Start(Handler onConnected);

    /// False if the vehicle has the maximum number of faults.
    [[nodiscard]] bool TryInject(const Fault& fault);
    /// Returns the number of faults ended.
    std::size_t EndFaults(std::optional<EFaultKind> kindOrNull);
    /// Returns the number of actions that waited for it.
    std::size_t Trigger();
    void OnWorldChanged();

    /// Publishes OFFLINE and disconnects, then calls back once.
    void StopAsync(Handler onStopped);
};

} // namespace ACS::VdaSim
