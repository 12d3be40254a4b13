#pragma once

#include "vda-sim/LoadHandling.hpp"
#include "vda-sim/VehicleProfile.hpp"
#include <acs/vda5050/OrderValidator.hpp>

#include <vector>

namespace ACS::VdaSim
{

/// m: farther from its node, a vehicle that handles loads in place only rejects a pick or a drop.
constexpr double PLACE_TOLERANCE = 0.1;

/// Why a vehicle with these traits rejects the order, which is valid otherwise: a horizon, or a pick or a drop at a node
/// at another position than the vehicle's. Empty if it accepts it.
[[nodiscard]] std::vector<VDA5050::OrderViolation> FindRejected(
    const VDA5050::OrderMessage& order,
    const VDA5050::OrderContext& context,
    const VehicleTraits& traits,
    const LoadHandling& handling);

} // namespace ACS::VdaSim
