#include "robot/ChargingPolicy.hpp"

#include <utility>

namespace ACS::Planning
{

ChargingPolicy::EBatteryChange ChargingPolicy::UpdateBattery(
    double percent,
    bool bRecharged,
    const DispatchOptions& limits)
{
    const bool bWasLow = IsBatteryLow();
    const bool bResumes = bWasLow || (bRecharged && _battery == EBattery::Unknown);
    const bool bLow = percent < (bResumes ? limits.batteryResume : limits.batteryFloor);
    _battery = bLow ? EBattery::Low : EBattery::Sufficient;
    if (bLow == bWasLow)
    {
        return EBatteryChange::None;
    }
    return bLow ? EBatteryChange::Low : EBatteryChange::Charged;
}

ChargingPolicy::EChargingChange ChargingPolicy::UpdateCharging(bool bCharging)
{
    if (bCharging)
    {
        const bool bKnown = std::exchange(_state, EState::Charging) == EState::Charging;
        return bKnown ? EChargingChange::None : EChargingChange::Begun;
    }
    if (_state != EState::Charging)
    {
        return EChargingChange::None;
    }
    _state = EState::Commanded;
    return EChargingChange::Interrupted;
}

bool ChargingPolicy::TryBegin()
{
    if (_state != EState::Idle)
    {
        return false;
    }
    _state = EState::Commanded;
    return true;
}

bool ChargingPolicy::TryEnd()
{
    return std::exchange(_state, EState::Idle) != EState::Idle;
}

bool ChargingPolicy::TryRepeat()
{
    if (_state != EState::Commanded)
    {
        return false;
    }
    _state = EState::Idle;
    return true;
}

void ChargingPolicy::OnLinkLost()
{
    _state = EState::Idle;
}

bool ChargingPolicy::IsBatteryLow() const noexcept
{
    return _battery == EBattery::Low;
}

bool ChargingPolicy::IsCommanded() const noexcept
{
    return _state != EState::Idle;
}

} // namespace ACS::Planning
