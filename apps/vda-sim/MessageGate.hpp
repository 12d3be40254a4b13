#pragma once

#include "vda-sim/Fault.hpp"
#include <acs/core/IRandom.hpp>
#include <acs/core/Now.hpp>
#include <acs/vda5050/IMqttLink.hpp>

#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

namespace ACS::VdaSim
{

/// Applies the faults to one direction of a vehicle's messages: passes, drops or delays them. Keeps their order. Pure.
class MessageGate
{
public:
    /// Limits of the delayed messages; further ones are lost, like those that find the buffers of a network full.
    static constexpr std::size_t MAX_MESSAGES = 10'000;
    static constexpr std::size_t MAX_BYTES = 16U * 1024U * 1024U;

private:
    struct Held
    {
        Core::SteadyTime due;
        VDA5050::MqttMessage message;
    };

    EFaultDirection _direction; ///< In or Out.
    Core::Duration _orderDelay;
    std::deque<Held> _held;
    std::size_t _heldBytes = 0;
    std::size_t _overflow = 0;

public:
    /// Every order is delayed by orderDelay, besides the faults.
    explicit MessageGate(EFaultDirection direction, Core::Duration orderDelay = {});

    /// Appends the message to out if it is not dropped or delayed.
    void Pass(
        VDA5050::MqttMessage message,
        const FaultBoard& faults,
        Core::IRandom& random,
        Core::SteadyTime now,
        std::vector<VDA5050::MqttMessage>& out);

    /// Appends the messages whose delay is over.
    void Release(Core::SteadyTime now, std::vector<VDA5050::MqttMessage>& out);

    /// When Release is next due; nullopt if nothing is delayed.
    [[nodiscard]] std::optional<Core::SteadyTime> GetNextTimeOrNull() const;

    /// Number of messages lost at the limits since the last call.
    [[nodiscard]] std::size_t TakeOverflow() noexcept;

    /// The connection is lost, and the delayed messages with it.
    void Clear();
};

} // namespace ACS::VdaSim
