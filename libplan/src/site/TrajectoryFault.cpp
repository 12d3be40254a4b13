#include "site/TrajectoryFault.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>

namespace ACS::Planning
{

namespace
{

bool CanBeScaled(const std::vector<double>& knots)
{
    return !knots.empty() && std::ranges::is_sorted(knots) && knots.back() > knots.front();
}

std::string FindShapeFault(const Core::Nurbs& curve)
{
    const std::size_t points = curve.points.size();
    if (points <= curve.degree)
    {
        return fmt::format(
            "degree {} requires at least {} control points, found {}",
            curve.degree,
            curve.degree + 1,
            points);
    }
    if (const std::size_t wanted = points + curve.degree + 1; curve.knots.size() != wanted)
    {
        return fmt::format(
            "{} control points and degree {} require {} knots, found {}",
            points,
            curve.degree,
            wanted,
            curve.knots.size());
    }
    if (!CanBeScaled(curve.knots))
    {
        return "the knots must not decrease, and the last must be greater than the first";
    }
    if (curve.knots[curve.degree] == curve.knots[points])
    {
        return fmt::format("the curve is empty, because the knots {} and {} are equal", curve.degree + 1, points + 1);
    }
    return std::string(Core::FindCurveFault(curve));
}

std::string FindEndFault(const Core::MapPoint& end, std::string_view verb, std::string_view nodeID, const SiteMap& site)
{
    const std::size_t index = *site.FindNodeIndexOrNull(nodeID);
    const SiteNode& node = site.GetNodes()[index];
    const double distance = std::hypot(end.x - node.x, end.y - node.y);
    const double allowed = site.GetAllowedDeviation(index);
    return distance <= allowed
        ? std::string()
        : fmt::format("it {} {:.3f} m from the node {}, allowed are {:.3f} m", verb, distance, nodeID, allowed);
}

} // namespace

void ScaleKnots(std::vector<double>& knots)
{
    if (!CanBeScaled(knots))
    {
        return;
    }
    const double first = knots.front();
    const double range = knots.back() - first;
    for (double& knot : knots)
    {
        knot = (knot - first) / range;
    }
}

std::string FindTrajectoryFault(const Core::Nurbs& curve, const SiteEdge& edge, const SiteMap& site)
{
    std::string fault = FindShapeFault(curve);
    if (fault.empty())
    {
        const Core::NurbsCurve shape(curve);
        fault = FindEndFault(shape.GetPoint(shape.GetBegin()), "begins", edge.startNodeID, site);
        if (fault.empty())
        {
            fault = FindEndFault(shape.GetPoint(shape.GetEnd()), "ends", edge.endNodeID, site);
        }
    }
    return fault;
}

} // namespace ACS::Planning
