#pragma once

#include "vda-sim/VehicleMotion.hpp"
#include <acs/plan/SiteMap.hpp>
#include <acs/vda5050/VehicleSession.hpp>

namespace ACS::VdaSim
{

/// The movement from this pose to the node of the drive. The site gives the positions of nodes that have none.
[[nodiscard]] MotionLeg PlanLeg(
    const VDA5050::DriveTo& drive,
    const Pose& pose,
    const Planning::SiteMap& site,
    const MotionLimits& limits);

} // namespace ACS::VdaSim
