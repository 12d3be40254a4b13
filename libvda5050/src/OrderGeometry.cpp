#include "OrderGeometry.hpp"

#include "OrderFindings.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

namespace ACS::VDA5050
{

namespace
{

double GetWeight(const ControlPoint& point)
{
    return point.weight.value_or(1.0);
}

/// Negative ones pull the curve out of the hull of its points; where all that bear on a place are 0 there is no curve.
bool HasUsableWeights(const Trajectory& curve)
{
    const auto isUsable = [](const ControlPoint& point) {
        return std::isfinite(GetWeight(point)) && GetWeight(point) >= 0.0;
    };
    const auto bearing = static_cast<std::ptrdiff_t>(curve.degree) + 1;
    const auto lost = std::search_n(
        curve.controlPoints.begin(),
        curve.controlPoints.end(),
        bearing,
        0.0,
        [](const ControlPoint& point, double weight) { return GetWeight(point) <= weight; });
    return std::ranges::all_of(curve.controlPoints, isUsable) && lost == curve.controlPoints.end()
        && GetWeight(curve.controlPoints.front()) > 0.0 && GetWeight(curve.controlPoints.back()) > 0.0;
}

/// A point of a curve that should lie at a node.
struct CurveEnd
{
    const ControlPoint& point;
    const OrderNode& node;
    std::string_view name;
};

void CheckEnd(const OrderEdge& edge, const CurveEnd& end, const OrderContext& context, OrderFindings& unusable)
{
    if (!end.node.nodePosition.has_value())
    {
        return;
    }
    const NodePosition& position = *end.node.nodePosition;
    if (std::hypot(end.point.x - position.x, end.point.y - position.y) <= GetAllowedDeviation(position, context))
    {
        return;
    }
    VehicleError& error =
        unusable.Add("the trajectory does not " + std::string(end.name) + " at its node: " + edge.edgeID);
    AddReference(error, ReferenceKeys::PARAMETER, "order.edges.trajectory");
    AddReference(error, ReferenceKeys::EDGE_ID, edge.edgeID);
    AddReference(error, ReferenceKeys::NODE_ID, end.node.nodeID);
}

} // namespace

std::string_view FindTrajectoryFault(const Trajectory& curve)
{
    const bool bCounts = curve.degree > 0 && curve.controlPoints.size() > curve.degree
        && curve.knotVector.size() == curve.controlPoints.size() + curve.degree + 1;
    const bool bRange = std::ranges::all_of(curve.knotVector, [](double knot) { return knot >= 0.0 && knot <= 1.0; });
    if (!bCounts || !bRange || !std::ranges::is_sorted(curve.knotVector))
    {
        return "a trajectory must have control points + degree + 1 knots from 0 to 1, none less than the one before";
    }
    const bool bFinite = std::ranges::all_of(curve.controlPoints, [](const ControlPoint& point) {
        return std::isfinite(point.x) && std::isfinite(point.y);
    });
    if (!bFinite || !HasUsableWeights(curve))
    {
        return "a trajectory's control points have a place, and weights that leave a curve";
    }
    return {};
}

double GetAllowedDeviation(const NodePosition& position, const OrderContext& context)
{
    const double stated = position.allowedDeviationXY.value_or(0.0);
    return stated > 0.0 ? stated : context.defaultDeviationXY;
}

std::vector<OrderViolation> FindLooseEnds(const OrderMessage& order, const OrderContext& context)
{
    OrderFindings unusable(order, ErrorTypes::ORDER_ERROR);
    for (std::size_t index = 0; index < order.edges.size(); ++index)
    {
        const OrderEdge& edge = order.edges[index];
        if (edge.trajectory.has_value())
        {
            const std::vector<ControlPoint>& points = edge.trajectory->controlPoints;
            CheckEnd(edge, CurveEnd{points.front(), order.nodes[index], "begin"}, context, unusable);
            CheckEnd(edge, CurveEnd{points.back(), order.nodes[index + 1], "end"}, context, unusable);
        }
    }
    return unusable.Take();
}

} // namespace ACS::VDA5050
