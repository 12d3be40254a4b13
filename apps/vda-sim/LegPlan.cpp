#include "vda-sim/LegPlan.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ACS::VdaSim
{
namespace
{

constexpr double DEFAULT_SPEED = 1.0;     ///< m/s where an order states none.
constexpr double NODE_CORNER_ANGLE = 0.1; ///< rad: a smaller change of direction is no corner.

/// VDA5050, orientation of an edge: against the map or against the direction of travel.
double GetEdgeHeading(double direction, std::optional<double> orientationOrNull, bool bGlobal)
{
    if (bGlobal)
    {
        return orientationOrNull.value_or(direction);
    }
    return NormaliseAngle(direction + orientationOrNull.value_or(0.0));
}

double GetMaxSpeed(const VDA5050::OrderEdge& edge)
{
    return edge.maxSpeed.value_or(DEFAULT_SPEED);
}

double GetMaxTurnSpeed(const VDA5050::OrderEdge& edge, const MotionLimits& limits)
{
    return edge.maxRotationSpeed.value_or(limits.maxTurnSpeed);
}

double GetTurn(double from, double to)
{
    return std::abs(NormaliseAngle(to - from));
}

/// That of the site if the order states none; the present one if both do not.
Pose GetNodePose(const VDA5050::OrderNode& node, const Pose& pose, const Planning::SiteMap& site)
{
    if (node.nodePosition.has_value())
    {
        return {node.nodePosition->x, node.nodePosition->y, 0.0};
    }
    const Planning::SiteNode* const known = site.FindNodeOrNull(node.nodeID);
    return known != nullptr ? Pose{known->x, known->y, 0.0} : pose;
}

double GetExitSpeed(
    const VDA5050::DriveTo& drive,
    const MotionLeg& leg,
    const Pose& pose,
    const Planning::SiteMap& site,
    const MotionLimits& limits)
{
    const double direction = leg.path.GetDirectionOrNull(leg.path.GetLength()).value_or(pose.theta);
    const double heading = leg.heading.value_or(NormaliseAngle(direction + leg.relativeHeading));
    const bool bTurnsThere = leg.finalTheta.has_value() && GetTurn(heading, *leg.finalTheta) > limits.turnTolerance;
    if (drive.bStopAtNode || bTurnsThere || !drive.next.has_value())
    {
        return 0.0;
    }
    const VDA5050::OrderEdge& edge = drive.next->edge;
    const Pose nextPose = GetNodePose(drive.next->node, pose, site);
    LegPath next = LegPath::Create(leg.path.GetPoint(leg.path.GetLength()), {nextPose.x, nextPose.y}, edge.trajectory);
    const double nextDirection = next.GetDirectionOrNull(0.0).value_or(direction);
    const bool bGlobal = edge.orientationType == VDA5050::EOrientationType::Global;
    const double nextHeading = GetEdgeHeading(nextDirection, edge.orientation, bGlobal);
    const bool bMustTurn = GetTurn(heading, nextHeading) > limits.turnTolerance;
    if (bMustTurn && !edge.bRotationAllowed.value_or(true))
    {
        return 0.0;
    }
    const bool bCorner = GetTurn(direction, nextDirection) > NODE_CORNER_ANGLE;
    // The leg after the next is unknown until the next begins: the vehicle must be able to stop at the end of the next.
    const double turnSpeed = std::min(GetMaxTurnSpeed(edge, limits), limits.maxTurnSpeed);
    next.Plan(turnSpeed, limits.lateralAcceleration, limits.cornerSpeed, limits.deceleration, 0.0);
    return std::min(
        {leg.maxSpeed,
         GetMaxSpeed(edge),
         next.GetAllowedSpeed(0.0, limits.deceleration),
         bCorner ? limits.cornerSpeed : limits.maxSpeed});
}

} // namespace

MotionLeg PlanLeg(
    const VDA5050::DriveTo& drive,
    const Pose& pose,
    const Planning::SiteMap& site,
    const MotionLimits& limits)
{
    const VDA5050::OrderEdge& edge = drive.edge;
    const Pose target = GetNodePose(drive.node, pose, site);
    MotionLeg leg;
    leg.path = LegPath::Create({pose.x, pose.y}, {target.x, target.y}, edge.trajectory);
    if (edge.orientationType == VDA5050::EOrientationType::Global)
    {
        leg.heading = edge.orientation;
    }
    else
    {
        leg.relativeHeading = edge.orientation.value_or(0.0);
    }
    leg.maxSpeed = GetMaxSpeed(edge);
    leg.maxTurnSpeed = GetMaxTurnSpeed(edge, limits);
    leg.bTurnBefore = !edge.bRotationAllowed.value_or(true);
    if (drive.node.nodePosition.has_value())
    {
        leg.finalTheta = drive.node.nodePosition->theta;
    }
    leg.exitSpeed = GetExitSpeed(drive, leg, pose, site, limits);
    return leg;
}

} // namespace ACS::VdaSim
