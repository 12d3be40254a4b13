#include "vda-sim/VehicleMotion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ACS::VdaSim
{
namespace
{

constexpr double ARRIVED = 1e-4; ///< m
constexpr double AIMED = 1e-6;   ///< rad

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

void VehicleMotion::Begin(const MotionLeg& leg)
{
    _leg = leg;
    _driven = 0.0;
    _bBraking = false;
    _bAtTarget = false;
}

void VehicleMotion::SetExitSpeed(double exitSpeed)
{
    if (_leg.has_value())
    {
        _leg->exitSpeed = exitSpeed;
    }
}

void VehicleMotion::Brake()
{
    _bBraking = _leg.has_value();
}

void VehicleMotion::Resume()
{
    _bBraking = false;
}

void VehicleMotion::Abandon()
{
    _leg.reset();
    _bBraking = false;
    _speed = 0.0;
    _turnSpeed = 0.0;
}

bool VehicleMotion::TryFinishLeg(double seconds)
{
    _turnSpeed = 0.0;
    if (!_leg.has_value())
    {
        return false;
    }
    if (_bBraking)
    {
        Drive(seconds);
        return false;
    }
    if (!_bAtTarget)
    {
        const bool bAimed = TryTurn(_leg->target.theta, seconds);
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
    }
    if (_leg->finalTheta.has_value() && !TryTurn(*_leg->finalTheta, seconds))
    {
        _speed = 0.0;
        return false;
    }
    _speed = std::min(_speed, _leg->exitSpeed);
    _leg.reset();
    return true;
}

bool VehicleMotion::TryTurn(double theta, double seconds)
{
    const double wanted = NormaliseAngle(theta - _pose.theta);
    const double possible = std::min(_leg->maxTurnSpeed, _limits.maxTurnSpeed) * seconds;
    const double turned = std::clamp(wanted, -possible, possible);
    _pose.theta = NormaliseAngle(_pose.theta + turned);
    _turnSpeed = turned / seconds;
    return std::abs(wanted - turned) <= AIMED;
}

double VehicleMotion::GetRemaining() const
{
    return std::hypot(_leg->target.x - _pose.x, _leg->target.y - _pose.y);
}

double VehicleMotion::GetDirection() const
{
    return std::atan2(_leg->target.y - _pose.y, _leg->target.x - _pose.x);
}

void VehicleMotion::Drive(double seconds)
{
    const double remaining = GetRemaining();
    const double change = _limits.acceleration * seconds;
    // As fast as the brakes allow for the speed at the end, by v² = v0² + 2as.
    const double exitSpeed = _leg->exitSpeed;
    const double stoppable = std::sqrt(exitSpeed * exitSpeed + 2.0 * _limits.acceleration * remaining);
    const double allowed = std::min({stoppable, _leg->maxSpeed, _limits.maxSpeed});
    const double wanted = _bBraking ? 0.0 : allowed;
    _speed = std::min(std::clamp(wanted, _speed - change, _speed + change), stoppable);
    const double way = std::min(_speed * seconds, remaining);
    if (remaining - way <= ARRIVED)
    {
        _pose.x = _leg->target.x;
        _pose.y = _leg->target.y;
        _driven += remaining;
        return;
    }
    const double direction = GetDirection();
    _pose.x += way * std::cos(direction);
    _pose.y += way * std::sin(direction);
    _driven += way;
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

bool VehicleMotion::IsBraking() const noexcept
{
    return _bBraking;
}

bool VehicleMotion::IsStanding() const noexcept
{
    return _speed <= 0.0 && (!_leg.has_value() || _bBraking);
}

} // namespace ACS::VdaSim
