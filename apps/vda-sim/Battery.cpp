#include "vda-sim/Battery.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ACS::VdaSim
{
namespace
{

constexpr double CHARGE_PER_METRE = 0.02;
constexpr double CHARGE_PER_SECOND = 0.5;
constexpr double RESERVE_CHARGE = 5.0; ///< %; driving does not discharge the battery below it.
constexpr double FULL_CHARGE = 100.0;
constexpr double REACH_PER_PERCENT = 50.0; ///< m

} // namespace

Battery::Battery(double charge)
    : _charge(charge)
{
}

void Battery::Discharge(double metres)
{
    _charge = std::max(std::min(_charge, RESERVE_CHARGE), _charge - metres * CHARGE_PER_METRE);
}

void Battery::Charge(double seconds)
{
    _charge = std::min(FULL_CHARGE, _charge + seconds * CHARGE_PER_SECOND);
}

void Battery::SetCharge(double charge)
{
    _charge = charge;
}

VDA5050::BatteryState Battery::MakeState(bool bCharging) const
{
    VDA5050::BatteryState state;
    state.batteryCharge = _charge;
    state.bCharging = bCharging;
    state.reach = std::floor(_charge * REACH_PER_PERCENT);
    return state;
}

bool Battery::TryUpdateLow()
{
    const bool bLow = _charge < LOW_CHARGE;
    return std::exchange(_bLow, bLow) != bLow;
}

bool Battery::IsLow() const noexcept
{
    return _bLow;
}

} // namespace ACS::VdaSim
