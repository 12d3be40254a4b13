#include "vda-sim/VirtualVehicle.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ACS::VdaSim
{
namespace
{

constexpr double DEFAULT_SPEED = 1.0; ///< m/s where an order states none.
constexpr double CORNER_ANGLE = 0.1;  ///< rad: a smaller change of direction is no corner.

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

} // namespace

void VirtualVehicle::Drive(const VDA5050::DriveTo& drive, Core::Now now)
{
    const bool bSameLeg = _motion.HasLeg() && _leg.has_value() && _leg->node.sequenceID == drive.node.sequenceID
        && _leg->edge.edgeID == drive.edge.edgeID;
    MotionLeg leg = MakeLeg(drive);
    if (bSameLeg)
    {
        _motion.SetExitSpeed(leg.exitSpeed);
    }
    else
    {
        _motion.Begin(std::move(leg));
    }
    _leg = drive;
    _bStopWanted = false;
    _bAbandons = false;
    _actionRunner.Undock();
    UpdateDock(now);
    // Whether an obstacle can be passed depends on the edge.
    ReportCondition(now);
    ReportBattery(now);
}

Pose VirtualVehicle::GetNodePose(const VDA5050::OrderNode& node) const
{
    if (node.nodePosition.has_value())
    {
        return {node.nodePosition->x, node.nodePosition->y, 0.0};
    }
    const Planning::SiteNode* const known = _site->FindNodeOrNull(node.nodeID);
    return known != nullptr ? Pose{known->x, known->y, 0.0} : _motion.GetPose();
}

MotionLeg VirtualVehicle::MakeLeg(const VDA5050::DriveTo& drive) const
{
    const Pose& pose = _motion.GetPose();
    const VDA5050::OrderEdge& edge = drive.edge;
    const Pose target = GetNodePose(drive.node);
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
    leg.maxTurnSpeed = GetMaxTurnSpeed(edge, _options.limits);
    leg.bTurnBefore = !edge.bRotationAllowed.value_or(true);
    if (drive.node.nodePosition.has_value())
    {
        leg.finalTheta = drive.node.nodePosition->theta;
    }
    leg.exitSpeed = GetExitSpeed(drive, leg);
    return leg;
}

double VirtualVehicle::GetExitSpeed(const VDA5050::DriveTo& drive, const MotionLeg& leg) const
{
    const Pose& pose = _motion.GetPose();
    const double direction = leg.path.GetDirectionOrNull(leg.path.GetLength()).value_or(pose.theta);
    const double heading = leg.heading.value_or(NormaliseAngle(direction + leg.relativeHeading));
    const bool bTurnsThere =
        leg.finalTheta.has_value() && GetTurn(heading, *leg.finalTheta) > _options.limits.turnTolerance;
    if (drive.bStopAtNode || bTurnsThere || !drive.next.has_value())
    {
        return 0.0;
    }
    const VDA5050::OrderEdge& edge = drive.next->edge;
    const Pose nextPose = GetNodePose(drive.next->node);
    LegPath next = LegPath::Create(leg.path.GetPoint(leg.path.GetLength()), {nextPose.x, nextPose.y}, edge.trajectory);
    const double nextDirection = next.GetDirectionOrNull(0.0).value_or(direction);
    const bool bGlobal = edge.orientationType == VDA5050::EOrientationType::Global;
    const double nextHeading = GetEdgeHeading(nextDirection, edge.orientation, bGlobal);
    const bool bMustTurn = GetTurn(heading, nextHeading) > _options.limits.turnTolerance;
    if (bMustTurn && !edge.bRotationAllowed.value_or(true))
    {
        return 0.0;
    }
    const bool bCorner = GetTurn(direction, nextDirection) > CORNER_ANGLE;
    // The leg after the next is unknown until the next begins: the vehicle must be able to stop at the end of the next.
    const MotionLimits& limits = _options.limits;
    const double turnSpeed = std::min(GetMaxTurnSpeed(edge, limits), limits.maxTurnSpeed);
    next.Plan(turnSpeed, limits.lateralAcceleration, limits.cornerSpeed, limits.deceleration, 0.0);
    return std::min(
        {leg.maxSpeed,
         GetMaxSpeed(edge),
         next.GetAllowedSpeed(0.0, limits.deceleration),
         bCorner ? limits.cornerSpeed : limits.maxSpeed});
}

} // namespace ACS::VdaSim
