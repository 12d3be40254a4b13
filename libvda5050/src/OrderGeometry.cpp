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

/// A point of a curve that should lie at a node.
struct CurveEnd
{
    Core::MapPoint point;
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
        if (edge.trajectory.has_value())
        {
            // Unless the knots are clamped, the outer control points are not the ends of the curve.
            const Core::NurbsCurve curve(MakeNurbs(*edge.trajectory));
            const Core::MapPoint begin = curve.GetPoint(curve.GetBegin());
            const Core::MapPoint end = curve.GetPoint(curve.GetEnd());
            CheckEnd(edge, CurveEnd{begin, order.nodes[index], "begin"}, context, unusable);
            CheckEnd(edge, CurveEnd{end, order.nodes[index + 1], "end"}, context, unusable);
        }
    }
    return unusable.Take();
}

} // namespace ACS::VDA5050
