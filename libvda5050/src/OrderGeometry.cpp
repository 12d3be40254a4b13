#include "OrderGeometry.hpp"

#include "OrderFindings.hpp"
#include <acs/vda5050/TrajectoryCurve.hpp>

#include <cmath>
#include <cstddef>
#include <string>

namespace ACS::VDA5050
{

namespace
{

/// An end of a curve, which should lie at a node.
struct CurveEnd
{
    double parameter = 0.0;
    const OrderNode& node;
    std::string_view name;
};

void CheckEnd(
    const OrderEdge& edge,
    const Core::NurbsCurve& curve,
    const CurveEnd& end,
    const OrderContext& context,
    OrderFindings& unusable)
{
    if (!end.node.nodePosition.has_value())
    {
        return;
    }
    const Core::MapPoint point = curve.GetPoint(end.parameter);
    const NodePosition& position = *end.node.nodePosition;
    if (std::hypot(point.x - position.x, point.y - position.y) <= GetAllowedDeviation(position, context))
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
    return Core::FindCurveFault(MakeNurbs(curve));
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
        if (!edge.trajectory.has_value())
        {
            continue;
        }
        if (edge.trajectory->degree > MAXIMUM_CURVE_DEGREE)
        {
            VehicleError& error =
                unusable.Add("the degree of a trajectory is above " + std::to_string(MAXIMUM_CURVE_DEGREE));
            AddReference(error, ReferenceKeys::PARAMETER, "order.edges.trajectory");
            AddReference(error, ReferenceKeys::EDGE_ID, edge.edgeID);
            continue;
        }
        // Unless the knots are clamped, the outer control points are not the ends of the curve.
        const Core::NurbsCurve curve(MakeNurbs(*edge.trajectory));
        CheckEnd(edge, curve, CurveEnd{curve.GetBegin(), order.nodes[index], "begin"}, context, unusable);
        CheckEnd(edge, curve, CurveEnd{curve.GetEnd(), order.nodes[index + 1], "end"}, context, unusable);
    }
    return unusable.Take();
}

} // namespace ACS::VDA5050
