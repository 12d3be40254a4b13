#include "arm/Arm.hpp"

namespace ACS::OpenStreamSim
{

void Arm::BeginProgram(Core::Duration duration, Core::Duration now)
{
    Stop(now);
    _driver = EDriver::Program;
    _program.Begin(duration);
}

void Arm::EndProgram(Core::Duration elapsed)
{
    _program.End(elapsed);
}

void Arm::BeginMove(const JointVector& target, double seconds, Core::Duration now)
{
    Stop(now);
    _move.Begin(GetMotion(now, {}).position, target, seconds, now);
    _driver = EDriver::Move;
}

bool Arm::IsMoving(Core::Duration now) const
{
    return _driver == EDriver::Move && now < _move.GetEnd();
}

Core::Duration Arm::GetMoveEnd() const noexcept
{
    return _move.GetEnd();
}

void Arm::BeginTrajectory(Core::Duration now)
{
    Stop(now);
    _trajectory.Begin(GetMotion(now, {}).position, now);
    _driver = EDriver::Trajectory;
}

void Arm::ClearTrajectory(Core::Duration now)
{
    if (_driver == EDriver::Trajectory)
    {
        Stop(now);
    }
    _trajectory.Begin(HOME, now);
}

TrajectoryFollower& Arm::GetTrajectory() noexcept
{
    return _trajectory;
}

const TrajectoryFollower& Arm::GetTrajectory() const noexcept
{
    return _trajectory;
}

bool Arm::IsFollowing() const noexcept
{
    return _driver == EDriver::Trajectory;
}

bool Arm::TryAdvance(Core::Duration now)
{
    return _driver != EDriver::Trajectory || _trajectory.TryAdvance(now);
}

void Arm::Stop(Core::Duration now)
{
    if (_driver == EDriver::Program)
    {
        return;
    }
    const JointVector position = GetMotion(now, {}).position;
    if (_driver == EDriver::Trajectory)
    {
        _trajectory.Stop(now);
    }
    _driver = EDriver::Program;
    _program.Place(position);
}

JointStates Arm::GetMotion(Core::Duration now, const ProgramProgress& progress) const
{
    switch (_driver)
    {
        case EDriver::Move:
            return _move.GetStates(now);
        case EDriver::Trajectory:
            return _trajectory.GetStates(now);
        case EDriver::Program:
        default:
            return _program.GetStates(progress.elapsed, progress.bRunning);
    }
}

JointStates Arm::GetStates(Core::Duration now, const ProgramProgress& progress) const
{
    JointStates states = GetMotion(now, progress);
    states.effort = ComputeEffort(states.position);
    return states;
}

} // namespace ACS::OpenStreamSim
