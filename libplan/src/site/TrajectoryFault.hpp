#pragma once

#include <acs/core/NurbsCurve.hpp>
#include <acs/plan/SiteMap.hpp>

#include <string>
#include <vector>

namespace ACS::Planning
{

/// Scales knots linearly to 0 to 1, which VDA5050 requires. Does nothing if they decrease or are all equal.
void ScaleKnots(std::vector<double>& knots);

/// Why the curve is no trajectory of the edge; empty: it is one. The site has the nodes of the edge. The ends of the curve
/// must be within the allowed deviation of the nodes; unless the knots are clamped, these are not its outer control points.
[[nodiscard]] std::string FindTrajectoryFault(const Core::Nurbs& curve, const SiteEdge& edge, const SiteMap& site);

} // namespace ACS::Planning
