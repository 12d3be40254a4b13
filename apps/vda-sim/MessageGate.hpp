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

/// One direction of a vehicle's messages: lets them through, loses them or holds them back, as the faults say. None
/// overtakes another. Pure.
class MessageGate
{
public:
    /// What is held back at most; what comes then is lost, as where the buffers of a network are full.
    static constexpr std::size_t MAX_MESSAGES = 10'000;
    static constexpr std::size_t MAX_BYTES = 16U * 1024U * 1024U;

private:
    struct Held
    {
        Core::SteadyTime due;
        VDA5050::MqttMessage message;
    };

    EFaultDirection _direction; ///< In or Out.
    std::deque<Held> _held;
    std::size_t _heldBytes = 0;
    std::size_t _overflow = 0;

public:
    explicit MessageGate(EFaultDirection direction);

    /// Appends the message to out where it goes through at once.
    void Pass(
        VDA5050::MqttMessage message,
        const FaultBoard& faults,
        Core::IRandom& random,
        Core::SteadyTime now,
        std::vector<VDA5050::MqttMessage>& out);

    /// Appends what was held back long enough.
    void Release(Core::SteadyTime now, std::vector<VDA5050::MqttMessage>& out);

    /// When Release has something to do next.
    [[nodiscard]] std::optional<Core::SteadyTime> GetNextTimeOrNull() const;

    /// How many were lost for want of room since the last call.
    [[nodiscard]] std::size_t TakeOverflow() noexcept;

    /// The connection is gone, and with it what was on its way.
    void Clear();
};

} // namespace ACS::VdaSim
