#pragma once

#include <array>
#include <cstddef>

namespace ACS::OpenStreamSim
{

inline constexpr std::size_t AXES = 6;

using JointVector = std::array<double, AXES>;

/// Initial position of the arm, in degrees.
inline constexpr JointVector HOME{0.0, 90.0, 0.0, 0.0, 0.0, 0.0};

/// Limits of one axis.
struct AxisLimits
{
    double lowest;  ///< deg
    double highest; ///< deg
    double speed;   ///< deg/s, simulated; in either direction.
};

/// Limits of the simulated arm.
inline constexpr std::array<AxisLimits, AXES> AXIS_LIMITS{{
    {-180.0, 180.0, 200.0},
    {-60.0, 180.0, 180.0},
    {-160.0, 200.0, 200.0},
    {-360.0, 360.0, 360.0},
    {-135.0, 135.0, 360.0},
    {-720.0, 720.0, 550.0},
}};

/// The first axis (from 0) that is out of its range; AXES if none is.
[[nodiscard]] constexpr std::size_t FindAxisOutside(const JointVector& position)
{
    for (std::size_t axis = 0; axis < AXES; ++axis)
    {
        if (!(position.at(axis) >= AXIS_LIMITS.at(axis).lowest && position.at(axis) <= AXIS_LIMITS.at(axis).highest))
        {
            return axis;
        }
    }
    return AXES;
}

} // namespace ACS::OpenStreamSim
