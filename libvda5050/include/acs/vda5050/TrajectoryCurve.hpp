#pragma once

#include <acs/core/NurbsCurve.hpp>
#include <acs/vda5050/OrderMessage.hpp>

namespace ACS::VDA5050
{

/// The curve of a trajectory, and back.
[[nodiscard]] Core::Nurbs MakeNurbs(const Trajectory& trajectory);
[[nodiscard]] Trajectory MakeTrajectory(const Core::Nurbs& curve);

} // namespace ACS::VDA5050
