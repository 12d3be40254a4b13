#pragma once

#include <acs/core/Now.hpp>

#include <cstdint>

namespace ACS::OpenStreamSim
{

/// Values of motor_on_state, as in the newer manuals.
enum class EMotorState : std::uint8_t
{
    On = 0,
    Off = 1,
    Busy = 2, ///< Switching on.
};

/// The power of the motors. Times are simulated, since the controller's start.
class MotorSwitch
{
    Core::Duration _delay;
    Core::Duration _onAt{};
    EMotorState _state = EMotorState::Off;

public:
    /// The delay is the time from the command to motor on.
    MotorSwitch(Core::Duration delay, bool bOn);

    void SwitchOn(Core::Duration now);
    void SwitchOff();
    void Advance(Core::Duration now);

    [[nodiscard]] EMotorState GetState() const noexcept;
};

} // namespace ACS::OpenStreamSim
