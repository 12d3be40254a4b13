#include <acs/vda5050/TrajectoryCurve.hpp>

namespace ACS::VDA5050
{

Core::Nurbs MakeNurbs(const Trajectory& trajectory)
{
    Core::Nurbs curve{trajectory.degree, trajectory.knotVector, {}};
    for (const ControlPoint& point : trajectory.controlPoints)
    {
        curve.points.push_back({point.x, point.y, point.weight});
    }
    return curve;
}

Trajectory MakeTrajectory(const Core::Nurbs& curve)
{
    Trajectory trajectory{static_cast<std::uint32_t>(curve.degree), curve.knots, {}};
    for (const Core::CurvePoint& point : curve.points)
    {
        trajectory.controlPoints.push_back({point.x, point.y, point.weight});
    }
    return trajectory;
}

} // namespace ACS::VDA5050
