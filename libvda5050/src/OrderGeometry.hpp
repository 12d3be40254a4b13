#pragma once

#include <acs/vda5050/OrderValidator.hpp>

#include <string_view>
#include <vector>

namespace ACS::VDA5050
{

/// Which rule of a NURBS (section 6.6) the curve breaks; empty where it keeps all. One that keeps them has a point
/// everywhere.
[[nodiscard]] std::string_view FindTrajectoryFault(const Trajectory& curve);

/// What a node's position allows in metres: the deviation that it states, or the vehicle's own.
[[nodiscard]] double GetAllowedDeviation(const NodePosition& position, const OrderContext& context);

/// Curves of a degree above MAXIMUM_CURVE_DEGREE, and those that do not join their nodes within what these and the vehicle allow: an
/// order that it cannot drive as it is written. Each an orderError that refers to edge and node.
[[nodiscard]] std::vector<OrderViolation> FindLooseEnds(const OrderMessage& order, const OrderContext& context);

} // namespace ACS::VDA5050
