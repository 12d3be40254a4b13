#include "arm/MotorSwitch.hpp"

namespace ACS::OpenStreamSim
{

MotorSwitch::MotorSwitch(Core::Duration delay, bool bOn)
    : _delay(delay),
      _state(bOn ? EMotorState::On : EMotorState::Off)
{
}

void MotorSwitch::SwitchOn(Core::Duration now)
{
    if (_state == EMotorState::Off)
    {
        _state = EMotorState::Busy;
        _onAt = now + _delay;
    }
}

void MotorSwitch::SwitchOff()
{
    _state = EMotorState::Off;
}

void MotorSwitch::Advance(Core::Duration now)
{
    if (_state == EMotorState::Busy && now >= _onAt)
    {
        _state = EMotorState::On;
    }
}

EMotorState MotorSwitch::GetState() const noexcept
{
    return _state;
}

} // namespace ACS::OpenStreamSim
