#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/NurbsCurve.hpp>
#include <acs/vda5050/OrderMessage.hpp>

namespace ACS::VDA5050
{

/// The curve of a trajectory, and back.
[[nodiscard]] ACS_API Core::Nurbs MakeNurbs(const Trajectory& trajectory);
/// The trajectory of a curve, for an order or a state.
[[nodiscard]] ACS_API Trajectory MakeTrajectory(const Core::Nurbs& curve);

} // namespace ACS::VDA5050
