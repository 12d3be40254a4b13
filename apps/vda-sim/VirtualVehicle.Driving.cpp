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
    _hands.Undock();
    // Whether an obstacle can be passed depends on the edge.
    TellCondition(now);
    TellBattery(now);
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
    // An order may state any number: below zero it allows no movement, as zero does.
    leg.maxSpeed = std::max(edge.maxSpeed.value_or(DEFAULT_SPEED), 0.0);
    leg.maxTurnSpeed = std::max(edge.maxRotationSpeed.value_or(_options.limits.maxTurnSpeed), 0.0);
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
    if (drive.bStopAtNode || bTurnsThere)
    {
        return 0.0;
    }
    const VDA5050::StateMessage state = _session.GetState();
    const auto node = std::ranges::find(state.nodeStates, drive.node.sequenceID + 2, &VDA5050::NodeState::sequenceID);
    const auto edge = std::ranges::find(state.edgeStates, drive.node.sequenceID + 1, &VDA5050::EdgeState::sequenceID);
    if (node == state.nodeStates.end() || edge == state.edgeStates.end())
    {
        return 0.0;
    }
    VDA5050::OrderNode nextNode;
    nextNode.nodeID = node->nodeID;
    if (node->nodePosition.has_value())
    {
        nextNode.nodePosition = VDA5050::NodePosition{};
        nextNode.nodePosition->x = node->nodePosition->x;
        nextNode.nodePosition->y = node->nodePosition->y;
    }
    const Pose nextPose = GetNodePose(nextNode);
    const LegPath next =
        LegPath::Create(leg.path.GetPoint(leg.path.GetLength()), {nextPose.x, nextPose.y}, edge->trajectory);
    const double nextDirection = next.GetDirectionOrNull(0.0).value_or(direction);
    const bool bCorner = GetTurn(direction, nextDirection) > CORNER_ANGLE;
    const double speed = bCorner ? std::min(leg.maxSpeed, _options.limits.cornerSpeed) : leg.maxSpeed;
    const auto known = std::ranges::find(_site->GetEdges(), edge->edgeID, &Planning::SiteEdge::edgeID);
    if (known == _site->GetEdges().end() || known->rules.empty())
    {
        return speed;
    }
    const Planning::SiteEdgeRule& rule = known->rules.front();
    const double nextHeading = GetEdgeHeading(nextDirection, rule.orientation, rule.orientationType == "GLOBAL");
    const bool bMustTurn = GetTurn(heading, nextHeading) > _options.limits.turnTolerance;
    if (bMustTurn && !rule.bRotationAllowed.value_or(true))
    {
        return 0.0;
    }
    return std::min(speed, rule.maxSpeed.value_or(speed));
}

} // namespace ACS::VdaSim
