#include "vda-sim/VehicleMotion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace ACS::VdaSim
{
namespace
{

constexpr double ARRIVED = 1e-4;      ///< m
constexpr double AIMED = 1e-6;        ///< rad
constexpr double SHARPEST_BEND = 0.1; ///< rad between two pieces of a curve; more is a corner.

} // namespace

double NormaliseAngle(double angle)
{
    return std::remainder(angle, 2.0 * std::numbers::pi);
}

VehicleMotion::VehicleMotion(const MotionLimits& limits, const Pose& pose)
    : _limits(limits),
      _pose(pose)
{
}

void VehicleMotion::Begin(MotionLeg leg)
{
    _leg = std::move(leg);
    _driven = 0.0;
    _offset = 0.0;
    _bAtTarget = false;
    PlanSpeed();
}

void VehicleMotion::SetExitSpeed(double exitSpeed)
{
    if (_leg.has_value())
    {
        _leg->exitSpeed = exitSpeed;
        PlanSpeed();
    }
}

void VehicleMotion::PlanSpeed()
{
    const double turnSpeed = std::min(_leg->maxTurnSpeed, _limits.maxTurnSpeed);
    _leg->path.Plan(turnSpeed, _limits.lateralAcceleration, _limits.cornerSpeed, _limits.deceleration, _leg->exitSpeed);
}

void VehicleMotion::SetBrake(EBrake brake)
{
    _brake = brake;
    if (_brake == EBrake::Block)
    {
        _speed = 0.0;
        _turnSpeed = 0.0;
    }
}

void VehicleMotion::SetOffset(double offset)
{
    _wantedOffset = offset;
}

void VehicleMotion::Abandon()
{
    _leg.reset();
    _speed = 0.0;
    _turnSpeed = 0.0;
}

void VehicleMotion::Place(const Pose& pose)
{
    _pose = pose;
}

bool VehicleMotion::TryFinishLeg(double seconds)
{
    if (!_leg.has_value())
    {
        _turnSpeed = 0.0;
        return false;
    }
    if (_brake != EBrake::None)
    {
        Brake(seconds);
        return false;
    }
    if (!_bAtTarget)
    {
        const bool bAimed = TryTurn(GetHeading(), seconds);
        if (!bAimed && _leg->bTurnBefore && _driven <= 0.0)
        {
            _speed = 0.0;
            return false;
        }
        Drive(seconds);
        if (GetRemaining() > 0.0)
        {
            return false;
        }
        _bAtTarget = true;
        _bFollows = false;
    }
    return TryArrive(seconds);
}

bool VehicleMotion::TryArrive(double seconds)
{
    if (_leg->finalTheta.has_value())
    {
        const bool bPasses =
            _leg->exitSpeed > 0.0 && std::abs(NormaliseAngle(*_leg->finalTheta - _pose.theta)) <= _limits.turnTolerance;
        if (!bPasses && !TryTurn(*_leg->finalTheta, seconds))
        {
            _speed = 0.0;
            return false;
        }
    }
    _speed = std::min(_speed, _leg->exitSpeed);
    _leg.reset();
    return true;
}

/// The turn comes to its end as the way does.
void VehicleMotion::Brake(double seconds)
{
    const double less = std::min(std::abs(_turnSpeed), _limits.turnAcceleration * seconds);
    _turnSpeed -= std::copysign(less, _turnSpeed);
    _pose.theta = NormaliseAngle(_pose.theta + _turnSpeed * seconds);
    if (_speed > 0.0)
    {
        Drive(seconds);
    }
}

bool VehicleMotion::TryTurn(double theta, double seconds)
{
    const double wanted = NormaliseAngle(theta - _pose.theta);
    const double fastest = std::min(_leg->maxTurnSpeed, _limits.maxTurnSpeed);
    double turned = std::clamp(wanted, -fastest * seconds, fastest * seconds);
    // A turn accelerates and brakes, except in bends, where it follows the path.
    _bFollows = _bFollows && std::abs(wanted) <= SHARPEST_BEND;
    if (!_bFollows)
    {
        const double change = _limits.turnAcceleration * seconds;
        // Kept for these seconds, and then lost within what is left.
        const double stoppable =
            std::sqrt(change * change + 2.0 * _limits.turnAcceleration * std::abs(wanted)) - change;
        const double aim = std::copysign(std::min(fastest, stoppable), wanted);
        const double turnSpeed = std::clamp(aim, _turnSpeed - change, _turnSpeed + change);
        const bool bOvershoots = turnSpeed * wanted > 0.0 && std::abs(turnSpeed * seconds) > std::abs(wanted);
        turned = bOvershoots ? wanted : turnSpeed * seconds;
    }
    const bool bAimed = std::abs(wanted - turned) <= AIMED;
    _pose.theta = NormaliseAngle(bAimed ? theta : _pose.theta + turned);
    _turnSpeed = turned / seconds;
    _bFollows = _bFollows || bAimed;
    return bAimed;
}

double VehicleMotion::GetRemaining() const
{
    return _leg->path.GetLength() - _driven;
}

double VehicleMotion::GetDirection() const
{
    return _leg->path.GetDirectionOrNull(_driven).value_or(_pose.theta);
}

double VehicleMotion::GetHeading() const
{
    if (_leg->heading.has_value())
    {
        return *_leg->heading;
    }
    const std::optional<double> direction = _leg->path.GetDirectionOrNull(_driven);
    return direction.has_value() ? NormaliseAngle(*direction + _leg->relativeHeading) : _pose.theta;
}

void VehicleMotion::ChangeSpeed(double seconds)
{
    if (_brake != EBrake::None)
    {
        const double deceleration = _brake == EBrake::Service ? _limits.deceleration : _limits.emergencyDeceleration;
        _speed = std::max(0.0, _speed - deceleration * seconds);
        return;
    }
    const double stoppable = _leg->path.GetAllowedSpeed(_driven, _limits.deceleration);
    const double wanted = std::min({stoppable, _leg->maxSpeed, _limits.maxSpeed});
    const double low = _speed - _limits.deceleration * seconds;
    const double high = _speed + _limits.acceleration * seconds;
    _speed = std::min(std::clamp(wanted, low, high), stoppable);
}

void VehicleMotion::Drive(double seconds)
{
    ChangeSpeed(seconds);
    const double length = _leg->path.GetLength();
    const double way = std::min(_speed * seconds, length - _driven);
    _driven += way;
    if (length - _driven <= ARRIVED)
    {
        _driven = length;
    }
    // Back on the route before its end.
    const double room = SWERVE_SLOPE * (length - _driven);
    const double wanted = std::clamp(_wantedOffset, -room, room);
    const double aside = SWERVE_SLOPE * way;
    _offset = std::clamp(std::clamp(wanted, _offset - aside, _offset + aside), -room, room);
    const MapPoint point = _leg->path.GetPoint(_driven);
    const double direction = GetDirection();
    _pose.x = point.x;
    _pose.y = point.y;
    if (_offset != 0.0)
    {
        _pose.x -= _offset * std::sin(direction);
        _pose.y += _offset * std::cos(direction);
    }
}

const Pose& VehicleMotion::GetPose() const noexcept
{
    return _pose;
}

double VehicleMotion::GetSpeed() const noexcept
{
    return _speed;
}

double VehicleMotion::GetTurnSpeed() const noexcept
{
    return _turnSpeed;
}

double VehicleMotion::GetDriven() const noexcept
{
    return _driven;
}

double VehicleMotion::GetForwardSpeed() const
{
    return _leg.has_value() ? _speed * std::cos(GetDirection() - _pose.theta) : _speed;
}

double VehicleMotion::GetSidewaysSpeed() const
{
    return _leg.has_value() ? _speed * std::sin(GetDirection() - _pose.theta) : 0.0;
}

bool VehicleMotion::HasLeg() const noexcept
{
    return _leg.has_value();
}

bool VehicleMotion::IsStanding() const noexcept
{
    return _speed <= 0.0 && (!_leg.has_value() || (_brake != EBrake::None && _turnSpeed == 0.0));
}

} // namespace ACS::VdaSim
