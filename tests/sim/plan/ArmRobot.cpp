#include "ArmRobot.hpp"

#include "VehicleConnection.hpp"

#include <utility>

namespace ACS::Simulation
{

ArmRobot::ArmRobot(
    const VehicleRobot::Dependencies& around,
    const Seeds& seeds,
    const std::string& robotID,
    const std::string& nodeID,
    bool bFaulty)
    : _timeline(around.timeline),
      _broker(around.broker),
      _robot(around.robot),
      _chance(seeds.trouble),
      _base(around, seeds.base, robotID, nodeID, bFaulty),
      _arm(
          {around.timeline, around.trace, around.workChecker, around.mutation, around.bBadRadio},
          seeds.arm,
          robotID,
          bFaulty,
          [this] { return _base.IsDriving(); })
{
}

std::unique_ptr<IRobotConnection> ArmRobot::MakeConnection(std::uint64_t /*number*/, EventHandler handler)
{
    return std::make_unique<VehicleConnection>(_timeline, _broker, _robot, std::move(handler), &_arm);
}

/// Usually the base and the arm share a radio.
void ArmRobot::SetReachable(bool bReachable)
{
    _bReachable = bReachable;
    const std::size_t part = bReachable ? 0 : _chance.GetBelow(4);
    _base.SetReachable(bReachable || part == 1);
    _arm.SetReachable(bReachable || part == 2);
}

bool ArmRobot::IsReachable() const
{
    return _bReachable;
}

void ArmRobot::Disturb()
{
    if (_chance.IsHit(600))
    {
        _bArmDisturbed = true;
        _arm.Disturb();
    }
    else
    {
        _base.Disturb();
    }
}

void ArmRobot::Recover()
{
    if (std::exchange(_bArmDisturbed, false))
    {
        _arm.Recover();
    }
    if (_base.IsDisturbed())
    {
        _base.Recover();
    }
}

bool ArmRobot::IsDisturbed() const
{
    return _bArmDisturbed || _base.IsDisturbed();
}

void ArmRobot::Forget()
{
    if (_chance.IsHit(600))
    {
        _arm.Restart();
    }
    else
    {
        _base.Forget();
    }
}

void ArmRobot::OnFloorChanged()
{
    _base.OnFloorChanged();
}

void ArmRobot::Calm()
{
    _base.Calm();
    _arm.Calm();
}

std::string ArmRobot::GetNodeID() const
{
    return _base.GetNodeID();
}

bool ArmRobot::IsAtRest() const
{
    return _base.IsAtRest() && !_arm.IsPlaying();
}

bool ArmRobot::IsWorkUnderWay() const
{
    return _arm.IsWorkUnderWay();
}

bool ArmRobot::IsPlaying() const
{
    return _arm.IsPlaying();
}

bool ArmRobot::IsDriving() const
{
    return _base.IsDriving();
}

} // namespace ACS::Simulation
