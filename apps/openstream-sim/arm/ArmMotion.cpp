#include "arm/ArmMotion.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

namespace ACS::OpenStreamSim
{

namespace
{

using std::numbers::pi;
using Seconds = std::chrono::duration<double>;

constexpr JointVector AMPLITUDES{30.0, 15.0, 20.0, 40.0, 25.0, 60.0}; ///< deg
constexpr double SWING_SECONDS = 4.0;                                 ///< About the time of one swing.
constexpr double FULL_AMPLITUDE_SECONDS = 2.0; ///< A shorter program moves less, so that no axis goes too fast.
constexpr double HOMING_SHARE = 0.5;           ///< Of an axis's speed; the swing has the rest.
constexpr double HOMING_PEAK = 1.5;            ///< The fastest of a smooth step, of its mean.
constexpr double GRAVITY_EFFORT = 94.0;        ///< Nm, of a level axis 2 or 3.
constexpr double WRIST_EFFORT = 6.0;           ///< Nm

double ToRadians(double degrees)
{
    return degrees * pi / 180.0;
}

} // namespace

JointVector ComputeEffort(const JointVector& position)
{
    const double lean = ToRadians(position[1] - HOME[1]);
    const double forearm = lean + ToRadians(position[2]);
    return {
        0.0,
        GRAVITY_EFFORT * std::cos(lean),
        GRAVITY_EFFORT * std::cos(forearm),
        0.0,
        WRIST_EFFORT * std::cos(forearm + ToRadians(position[4])),
        0.0};
}

void ArmMotion::Place(const JointVector& position)
{
    _from = position;
    _seconds = 0.0;
}

void ArmMotion::Begin(Core::Duration duration)
{
    _seconds = Seconds(duration).count();
    for (std::size_t axis = 0; axis < AXES; ++axis)
    {
        const double reach = HOMING_SHARE * AXIS_LIMITS.at(axis).speed * _seconds / HOMING_PEAK;
        _toHome.at(axis) = std::clamp(HOME.at(axis) - _from.at(axis), -reach, reach);
    }
}

void ArmMotion::End(Core::Duration elapsed)
{
    _from = GetStates(elapsed, false).position;
    _seconds = 0.0;
}

JointStates ArmMotion::GetStates(Core::Duration elapsed, bool bMoving) const
{
    JointStates states;
    states.position = _from;
    if (_seconds > 0.0)
    {
        const double progress = std::clamp(Seconds(elapsed).count() / _seconds, 0.0, 1.0);
        const double swings = std::max(1.0, std::round(_seconds / SWING_SECONDS));
        const double scale = std::min(1.0, _seconds / FULL_AMPLITUDE_SECONDS);
        const double window = std::pow(std::sin(pi * progress), 2.0);
        const double windowRate = pi * std::sin(2.0 * pi * progress);
        const double swing = std::sin(2.0 * pi * swings * progress);
        const double swingRate = 2.0 * pi * swings * std::cos(2.0 * pi * swings * progress);
        const double homing = progress * progress * (3.0 - 2.0 * progress);
        const double homingRate = 6.0 * progress * (1.0 - progress);
        for (std::size_t axis = 0; axis < AXES; ++axis)
        {
            const double amplitude = AMPLITUDES[axis] * scale;
            states.position[axis] += amplitude * window * swing + _toHome[axis] * homing;
            if (bMoving)
            {
                const double rate = amplitude * (windowRate * swing + window * swingRate) + _toHome[axis] * homingRate;
                states.velocity[axis] = rate / _seconds;
            }
        }
    }
    states.effort = ComputeEffort(states.position);
    return states;
}

} // namespace ACS::OpenStreamSim
