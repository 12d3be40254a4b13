#pragma once

#include "OrderFindings.hpp"
#include <acs/vda5050/OrderValidator.hpp>

#include <string_view>

namespace ACS::VDA5050
{

/// Which rule of a NURBS (section 6.6) the curve breaks; empty where it keeps all. One that keeps them has a point
/// everywhere.
[[nodiscard]] std::string_view FindTrajectoryFault(const Trajectory& curve);

/// What a node's position allows in metres: the deviation that it states, or the vehicle's own.
[[nodiscard]] double GetAllowedDeviation(const NodePosition& position, const OrderContext& context);

/// Curves that do not join their nodes: an order that no vehicle can drive as it is written.
void CheckGeometry(const OrderContext& context, OrderFindings& unusable);

} // namespace ACS::VDA5050
