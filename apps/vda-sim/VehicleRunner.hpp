#pragma once

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

/// One virtual vehicle on one MQTT connection: executes what the vehicle asks, tells it what happens.
/// One thread: the executor's. The clock and the random source must outlive it.
class VehicleRunner
{
public:
    /// Both are called from the executor.
    using Handler = std::function<void()>;

private:
    class Impl;

    std::unique_ptr<Impl> _impl;

public:
    /// The link's will is filled in here. The random source is for the pauses between attempts to connect.
    VehicleRunner(
        const boost::asio::any_io_executor& executor,
        const Core::IClock& clock,
        Core::IRandom& random,
        const Core::Logger& logger,
        VirtualVehicle vehicle,
        VDA5050::MosquittoOptions linkOptions);
    VehicleRunner(const VehicleRunner&) = delete;
    VehicleRunner& operator=(const VehicleRunner&) = delete;
    ~VehicleRunner();

    /// Begins to connect; the handler is called each time that the vehicle is online.
    void Start(Handler onConnected);

    /// False where it has too many already.
    [[nodiscard]] bool TryInject(const Fault& fault);
    /// How many there were.
    std::size_t EndFaults(std::optional<EFaultKind> kindOrNull);
    /// How many actions waited for it.
    std::size_t Trigger();
    void OnWorldChanged();

    /// Says OFFLINE and disconnects, then calls back, once.
    void StopAsync(Handler onStopped);
};

} // namespace ACS::VdaSim
