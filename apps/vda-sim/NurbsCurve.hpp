#pragma once

#include <acs/core/NurbsCurve.hpp>
#include <acs/vda5050/OrderMessage.hpp>

namespace ACS::VdaSim
{

using Core::MapPoint;
using Core::NurbsCurve;

/// The trajectory of an edge (VDA5050, section 7), which has passed ValidateOrder.
[[nodiscard]] NurbsCurve MakeCurve(const VDA5050::Trajectory& trajectory);

} // namespace ACS::VdaSim
