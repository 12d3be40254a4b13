#pragma once

#include "common/process/TimerSet.hpp"
#include "vda-sim/MqttTrace.hpp"
#include "vda-sim/VirtualVehicle.hpp"
#include <acs/core/IRandom.hpp>
#include <acs/core/Now.hpp>
#include <acs/vda5050_mosquitto/MosquittoLink.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <system_error>

namespace ACS::VdaSim
{

/// Runs one virtual vehicle on one MQTT connection: executes its actions and passes it messages, timers and the state of
/// the connection. One thread: the executor's. The clock and the random source must outlive it.
class VehicleRunner final : public VDA5050::IMqttLinkListener
{
public:
    /// Both are called from the executor.
    using Handler = std::function<void()>;

private:
    boost::asio::any_io_executor _executor;
    const Core::IClock& _clock;
    Core::IRandom& _random;
    Core::Logger _logger;
    VirtualVehicle _vehicle;
    VirtualActions _actions;
    Apps::TimerSet<std::uint64_t> _timers;
    VDA5050::MosquittoOptions _linkOptions;
    MqttTrace _trace;
    std::unique_ptr<VDA5050::MosquittoLink> _linkOrNull;    ///< Null while a fault has cut the connection.
    std::unique_ptr<VDA5050::MosquittoLink> _leavingOrNull; ///< Disconnecting without OFFLINE.
    Handler _onConnected;
    bool _bStopping = false;

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

    /// Begins to connect; the handler is called each time the vehicle goes online.
    void Start(Handler onConnected);
    /// Index of the broker that it is connected to, in the order of the link options; 0 while a fault has cut the connection.
    [[nodiscard]] std::size_t GetBrokerIndex() const;

    /// False if the vehicle has the maximum number of faults.
    [[nodiscard]] bool TryInject(const Fault& fault);
    /// Returns the number of faults ended.
    std::size_t EndFaults(std::optional<EFaultKind> kindOrNull);
    /// Returns the number of actions that waited for it.
    std::size_t Trigger();
    void OnWorldChanged();

    /// Publishes OFFLINE and disconnects, then calls back once.
    void StopAsync(Handler onStopped);

private:
    void OnLinkUp() override;
    void OnLinkDown(std::error_code reason) override;
    void OnMqttMessage(const VDA5050::MqttMessage& message) override;

    void OnTimer(std::uint64_t key);
    void Execute();
    void Open();
    void Cut(bool bWill);
    void Publish(const VDA5050::MqttMessage& message);
};

} // namespace ACS::VdaSim
