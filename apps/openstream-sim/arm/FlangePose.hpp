#pragma once

#include "arm/ArmMotion.hpp"

namespace ACS::OpenStreamSim
{

/// The flange in the base's coordinates.
struct FlangePose
{
    double x = 0.0;  ///< mm
    double y = 0.0;  ///< mm
    double z = 0.0;  ///< mm
    double rx = 0.0; ///< deg; the turn is rz about z, then ry about the new y, then rx about the new x.
    double ry = 0.0; ///< deg
    double rz = 0.0; ///< deg
};

/// Pose of a six-axis arm with links of plausible lengths: at HOME the upper arm is upright and the forearm is level.
[[nodiscard]] FlangePose ComputeFlangePose(const JointVector& position);

} // namespace ACS::OpenStreamSim
