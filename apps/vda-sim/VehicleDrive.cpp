#include "vda-sim/VehicleDrive.hpp"

#include "vda-sim/LegPlan.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ACS::VdaSim
{
namespace
{

constexpr double TOLERANCE = 0.5;  ///< m, as for a first node without an allowed deviation.
constexpr double HALF_WIDTH = 0.4; ///< m, as in the factsheet: a corridor for the contour has this much less room.

/// The pose of a vehicle on the node, with the heading that the site defines there.
Pose GetStartPose(const Planning::SiteNode& node)
{
    const auto rule = std::ranges::find_if(node.rules, [](const Planning::SiteNodeRule& candidate) {
        return candidate.theta.has_value();
    });
    return {node.x, node.y, rule != node.rules.end() ? NormaliseAngle(rule->theta.value_or(0.0)) : 0.0};
}

/// The nearest node within the tolerance of this point; empty if there is none.
std::string FindNodeAt(const Planning::SiteMap& site, double x, double y)
{
    const auto getDistance = [x, y](const Planning::SiteNode& node) {
        return std::hypot(node.x - x, node.y - y);
    };
    const auto nearest = std::ranges::min_element(site.GetNodes(), {}, getDistance);
    return nearest != site.GetNodes().end() && getDistance(*nearest) <= TOLERANCE ? nearest->nodeID : std::string();
}

} // namespace

VehicleDrive::VehicleDrive(
    const Planning::SiteMap& site,
    const MotionLimits& limits,
    const std::string& nodeID,
    const std::optional<StartPosition>& positionOrNull)
    : _site(&site),
      _limits(limits),
      _motion(limits, {}),
      _nodeID(nodeID)
{
    const Planning::SiteNode* const node = site.FindNodeOrNull(nodeID);
    if (node != nullptr)
    {
        Pose pose = GetStartPose(*node);
        if (positionOrNull.has_value())
        {
            pose.x = positionOrNull->x;
            pose.y = positionOrNull->y;
        }
        _motion.Place(pose);
        _mapID = node->mapID;
        FindPlace();
    }
}

void VehicleDrive::Begin(const VDA5050::DriveTo& leg)
{
    const bool bSameLeg = _motion.HasLeg() && _leg.has_value() && _leg->node.sequenceID == leg.node.sequenceID
        && _leg->edge.edgeID == leg.edge.edgeID;
    MotionLeg planned = PlanLeg(leg, _motion.GetPose(), *_site, _limits);
    if (bSameLeg)
    {
        _motion.SetExitSpeed(planned.exitSpeed);
    }
    else
    {
        _motion.Begin(std::move(planned));
    }
    _leg = leg;
    _placeNodeID.clear();
    _course = ECourse::Continue;
}

void VehicleDrive::Stop()
{
    if (_course == ECourse::Continue)
    {
        _course = ECourse::Stop;
    }
}

void VehicleDrive::Abandon()
{
    _leg.reset();
    _course = ECourse::Abandon;
    EndAbandoned();
}

void VehicleDrive::EndAbandoned()
{
    if (_course == ECourse::Abandon && _motion.IsStanding())
    {
        _course = ECourse::Continue;
        _motion.Abandon();
        FindPlace();
    }
}

void VehicleDrive::EndPassing()
{
    if (!_motion.HasLeg())
    {
        _motion.Abandon();
    }
}

bool VehicleDrive::TryPlace(const Pose& pose, std::string mapID)
{
    if (IsMoving())
    {
        return false;
    }
    _motion.Place(pose);
    _nodeID = FindNodeAt(*_site, pose.x, pose.y);
    _placeNodeID = _nodeID;
    _mapID = std::move(mapID);
    return true;
}

DriveStep VehicleDrive::Advance(double seconds)
{
    const double drivenBefore = _motion.GetDriven();
    const bool bArrived = _motion.TryFinishLeg(seconds);
    DriveStep step;
    step.metres = std::max(0.0, _motion.GetDriven() - drivenBefore);
    if (bArrived && _leg.has_value())
    {
        step.reached = std::exchange(_leg, std::nullopt);
        const VDA5050::OrderNode& node = step.reached->node;
        _nodeID = node.nodeID;
        _placeNodeID = _nodeID;
        if (node.nodePosition.has_value())
        {
            _mapID = node.nodePosition->mapID;
        }
    }
    return step;
}

void VehicleDrive::UpdateBrake(const FaultBoard& faults)
{
    EBrake brake = EBrake::None;
    if (faults.IsActive(EFaultKind::Stuck))
    {
        brake = EBrake::Block;
    }
    else if (faults.IsActive(EFaultKind::EmergencyStop))
    {
        brake = EBrake::Emergency;
    }
    else if (_course != ECourse::Continue || IsBlocked(faults) || faults.IsActive(EFaultKind::Lost))
    {
        brake = EBrake::Service;
    }
    const Fault* const obstacle = faults.FindOrNull(EFaultKind::Blocked);
    _motion.SetOffset(obstacle != nullptr ? GetSwerveOrNull(*obstacle).value_or(0.0) : 0.0);
    _motion.SetBrake(brake);
}

bool VehicleDrive::IsBlocked(const FaultBoard& faults) const
{
    const Fault* const obstacle = faults.FindOrNull(EFaultKind::Blocked);
    if (obstacle == nullptr)
    {
        return false;
    }
    // Only an edge has a corridor.
    return _leg.has_value() ? !GetSwerveOrNull(*obstacle).has_value() : obstacle->swerve <= 0.0;
}

/// Section 6.10.4 of 2.1: within the corridor of its edge a vehicle may leave the route to pass an obstacle. Metres to the
/// left; nullopt if there is no room.
std::optional<double> VehicleDrive::GetSwerveOrNull(const Fault& obstacle) const
{
    if (obstacle.swerve <= 0.0 || !_leg.has_value() || !_leg->edge.corridor.has_value())
    {
        return std::nullopt;
    }
    const VDA5050::Corridor& corridor = *_leg->edge.corridor;
    const bool bContour = corridor.corridorReferencePoint == VDA5050::ECorridorReferencePoint::Contour;
    const double needed = obstacle.swerve + (bContour ? HALF_WIDTH : 0.0);
    if (corridor.leftWidth >= needed)
    {
        return obstacle.swerve;
    }
    return corridor.rightWidth >= needed ? std::optional(-obstacle.swerve) : std::nullopt;
}

const VehicleMotion& VehicleDrive::GetMotion() const noexcept
{
    return _motion;
}

bool VehicleDrive::IsMoving() const noexcept
{
    return _motion.HasLeg() && !_motion.IsStanding();
}

const VDA5050::DriveTo* VehicleDrive::GetLegOrNull() const noexcept
{
    return _leg.has_value() ? &*_leg : nullptr;
}

const std::string& VehicleDrive::GetNodeID() const noexcept
{
    return _nodeID;
}

const std::string& VehicleDrive::GetPlaceNodeID() const noexcept
{
    return _placeNodeID;
}

void VehicleDrive::FindPlace()
{
    const Planning::SiteNode* const node = _site->FindNodeOrNull(_nodeID);
    const Pose& pose = _motion.GetPose();
    const bool bOn = node != nullptr && std::hypot(node->x - pose.x, node->y - pose.y) <= TOLERANCE;
    _placeNodeID = bOn ? _nodeID : std::string();
}

const std::string& VehicleDrive::GetMapID() const noexcept
{
    return _mapID;
}

} // namespace ACS::VdaSim
