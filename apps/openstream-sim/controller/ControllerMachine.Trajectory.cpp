#include "controller/ControllerMachine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <span>

namespace ACS::OpenStreamSim
{

namespace
{

using Seconds = std::chrono::duration<double>;

/// Maximum distance of the first point of a trajectory from the arm's position, in deg.
constexpr double START_TOLERANCE = 0.5;

Core::Duration ToDuration(double seconds)
{
    return Core::Duration(std::llround(
        std::chrono::duration_cast<std::chrono::duration<double, Core::Duration::period>>(Seconds(seconds)).count()));
}

bool IsNear(const JointVector& one, const JointVector& other)
{
    return std::ranges::equal(one, other, [](double left, double right) {
        return std::abs(left - right) <= START_TOLERANCE;
    });
}

TrajectoryError Fail(ETrajectoryError code, std::string sentence)
{
    return TrajectoryError{code, EApiError::None, std::move(sentence)};
}

} // namespace

EApiError ControllerMachine::AcceptTrajectory()
{
    const EApiError error = CheckMotion();
    if (error != EApiError::None)
    {
        return error;
    }
    if (!_console.IsWaiting())
    {
        RaiseAlarm(EAlarm::NotExecutable);
        _arm.ClearTrajectory(_now);
        _settings.bTrajectoryLog = false;
        return EApiError::NotWaiting;
    }
    if (_alarm == EAlarm::AxisTooFast)
    {
        return EApiError::AxisTooFast;
    }
    if (_arm.GetTrajectory().IsBlocked())
    {
        return EApiError::BufferLeft;
    }
    if (!_arm.IsFollowing())
    {
        _arm.BeginTrajectory(_now);
    }
    return EApiError::None;
}

EApiError ControllerMachine::InitTrajectory(const TrajectoryAgility& agility)
{
    if (!_bRemote)
    {
        return EApiError::NotRemote;
    }
    if (_version >= FIRST_WITH_TRAJECTORY_MODE && IsTrajectoryActive())
    {
        return EApiError::None;
    }
    StopTrajectory();
    _arm.GetTrajectory().SetAgility(_version >= FIRST_WITH_AGILITY ? agility : TrajectoryAgility{});
    _alarm = EAlarm::None;
    return EApiError::None;
}

EApiError ControllerMachine::InsertPoint(const StreamedPoint& point)
{
    const EApiError error = AcceptTrajectory();
    if (error != EApiError::None)
    {
        return error;
    }
    TrajectoryFollower& trajectory = _arm.GetTrajectory();
    if (trajectory.GetFree() == 0)
    {
        return EApiError::BufferFull;
    }
    const bool bTimed = point.timeFromStart >= 0.0;
    const double first = bTimed ? point.timeFromStart - point.interval : 0.0;
    const double before = trajectory.IsResting() ? first : trajectory.GetNewestTime();
    const double time = bTimed ? point.timeFromStart : before + point.interval;
    TrajectoryPoint next;
    next.duration = ToDuration(time - before);
    if (next.duration <= Core::Duration{})
    {
        return EApiError::BadInput;
    }
    assert(point.point.size() == AXES);
    std::ranges::copy(point.point, next.position.begin());
    trajectory.Append(next, time, ToDuration(point.lookAheadTime), _now);
    return EApiError::None;
}

TrajectoryError ControllerMachine::InsertPoints(const TimedPoints& points)
{
    assert(!points.empty());
    const EApiError error = AcceptTrajectory();
    if (error != EApiError::None)
    {
        return TrajectoryError{ETrajectoryError::None, error, {}};
    }
    TrajectoryFollower& trajectory = _arm.GetTrajectory();
    if (points.size() > trajectory.GetFree())
    {
        return Fail(
            ETrajectoryError::BufferExceeded,
            fmt::format("points: expected at most {}, the free space of the buffer", trajectory.GetFree()));
    }
    const bool bResting = trajectory.IsResting();
    if (bResting && points.front().time != 0.0)
    {
        return Fail(
            ETrajectoryError::BadTime,
            "points.point_1.time_from_start: expected 0 while the arm is stationary");
    }
    if (bResting && !IsNear(points.front().position, trajectory.GetHeld()))
    {
        return Fail(ETrajectoryError::BadPositions, "points.point_1.positions: expected the position of the arm");
    }
    double before = bResting ? 0.0 : trajectory.GetNewestTime();
    // A stationary arm is already at the first point.
    const auto fresh = std::span(points).subspan(bResting ? 1 : 0);
    double earlier = before;
    for (const TimedPoint& point : fresh)
    {
        if (ToDuration(point.time - earlier) <= Core::Duration{})
        {
            return Fail(
                ETrajectoryError::BadTime,
                fmt::format("points: expected a time after {} s, found {} s", earlier, point.time));
        }
        earlier = point.time;
    }
    for (const TimedPoint& point : fresh)
    {
        trajectory.Append(TrajectoryPoint{point.position, ToDuration(point.time - before)}, point.time, {}, _now);
        before = point.time;
    }
    return {};
}

EApiError ControllerMachine::FinishTrajectory()
{
    if (!_bRemote)
    {
        return EApiError::NotRemote;
    }
    if (_arm.IsFollowing() && !_arm.GetTrajectory().IsBlocked())
    {
        _arm.GetTrajectory().Finish(_now);
    }
    return EApiError::None;
}

void ControllerMachine::StopTrajectory()
{
    _arm.ClearTrajectory(_now);
}

EAlarm ControllerMachine::GetAlarm() const noexcept
{
    return _alarm;
}

const TrajectoryFollower& ControllerMachine::GetTrajectory() const noexcept
{
    return _arm.GetTrajectory();
}

bool ControllerMachine::IsTrajectoryActive() const
{
    return _arm.IsFollowing() && _arm.GetTrajectory().IsActive(_now);
}

bool ControllerMachine::IsTrajectoryReady() const
{
    return CheckMotion() == EApiError::None && _console.IsWaiting() && _alarm != EAlarm::AxisTooFast
        && !_arm.GetTrajectory().IsBlocked();
}

} // namespace ACS::OpenStreamSim
