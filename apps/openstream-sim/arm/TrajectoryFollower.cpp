#include "arm/TrajectoryFollower.hpp"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <numbers>

namespace ACS::OpenStreamSim
{

namespace
{

using Seconds = std::chrono::duration<double>;

constexpr double LAG_SECONDS = 0.04; ///< A jump of 1 is followed to 0.63 after this time.
constexpr double SETTLED_DEGREES = 0.001;
constexpr double SPEED_TOLERANCE = 1e-6; ///< Of a speed: times are rounded to nanoseconds.
constexpr std::chrono::milliseconds CLEAN_UP_TIME{500};

} // namespace

double TrajectoryFollower::GetLagSeconds() const noexcept
{
    const bool bAgile = _agility.bOn && _agility.frequency > 0.0;
    return bAgile ? 1.0 / (2.0 * std::numbers::pi * _agility.frequency) : LAG_SECONDS;
}

JointVector TrajectoryFollower::GetRates() const
{
    JointVector rates{};
    const TrajectoryPoint* const frontOrNull = _points.GetFrontOrNull();
    if (_phase != EPhase::Moving || frontOrNull == nullptr)
    {
        return rates;
    }
    const double seconds = Seconds(frontOrNull->duration).count();
    for (std::size_t axis = 0; axis < AXES; ++axis)
    {
        rates.at(axis) = (frontOrNull->position.at(axis) - _command.at(axis)) / seconds;
    }
    return rates;
}

JointVector TrajectoryFollower::GetCommand(Core::Duration now) const
{
    const JointVector rates = GetRates();
    const double seconds = Seconds(now - _since).count();
    JointVector command = _command;
    for (std::size_t axis = 0; axis < AXES; ++axis)
    {
        command.at(axis) += rates.at(axis) * seconds;
    }
    return command;
}

void TrajectoryFollower::Hold(Core::Duration now, const JointVector& command)
{
    _position = GetStates(now).position;
    _command = command;
    _since = now;
}

void TrajectoryFollower::Rest(Core::Duration now)
{
    _phase = EPhase::Resting;
    _cleanUntil = _agility.bOn ? now + CLEAN_UP_TIME : Core::Duration{};
}

bool TrajectoryFollower::CanReachFront() const
{
    const TrajectoryPoint& front = *_points.GetFrontOrNull();
    const double seconds = Seconds(front.duration).count() * (1.0 + SPEED_TOLERANCE);
    for (std::size_t axis = 0; axis < AXES; ++axis)
    {
        if (std::abs(front.position.at(axis) - _command.at(axis)) > AXIS_LIMITS.at(axis).speed * seconds)
        {
            return false;
        }
    }
    return true;
}

void TrajectoryFollower::Begin(const JointVector& position, Core::Duration now)
{
    _points.Clear();
    _buffered = {};
    _newestTime = 0.0;
    _phase = EPhase::Resting;
    _cleanUntil = {};
    _command = position;
    _position = position;
    _since = now;
}

void TrajectoryFollower::SetAgility(const TrajectoryAgility& agility)
{
    _agility = agility;
}

void TrajectoryFollower::Append(
    const TrajectoryPoint& point,
    double timeFromStart,
    Core::Duration lookAhead,
    Core::Duration now)
{
    assert(point.duration > Core::Duration{} && _phase != EPhase::Stopped);
    const bool bTaken = _points.TryPush(point);
    assert(bTaken);
    static_cast<void>(bTaken);
    _buffered += point.duration;
    _newestTime = timeFromStart;
    if (_phase == EPhase::Moving)
    {
        return;
    }
    if (_phase == EPhase::Resting)
    {
        _phase = EPhase::Buffering;
        _startAt = now + lookAhead;
    }
    if (_buffered >= lookAhead)
    {
        _startAt = std::min(_startAt, now);
    }
}

bool TrajectoryFollower::TryAdvance(Core::Duration now)
{
    while (_phase == EPhase::Buffering || _phase == EPhase::Moving)
    {
        if (_phase == EPhase::Buffering)
        {
            if (now < _startAt)
            {
                return true;
            }
            Hold(_startAt, _command);
            _phase = EPhase::Moving;
        }
        else
        {
            const TrajectoryPoint front = *_points.GetFrontOrNull();
            const Core::Duration end = _since + front.duration;
            if (now < end)
            {
                return true;
            }
            Hold(end, front.position);
            static_cast<void>(_points.PopFrontOrNull());
            _buffered -= front.duration;
        }
        if (_points.IsEmpty())
        {
            Rest(_since);
        }
        else if (!CanReachFront())
        {
            // The line that is too fast has not begun: the arm is at the end of the previous lines.
            _phase = EPhase::Stopped;
            _command = _position;
            return false;
        }
    }
    return true;
}

void TrajectoryFollower::Stop(Core::Duration now)
{
    Hold(now, _command);
    _command = _position;
    _phase = _points.IsEmpty() ? EPhase::Resting : EPhase::Stopped;
}

void TrajectoryFollower::Finish(Core::Duration now)
{
    Hold(now, GetCommand(now));
    _points.Clear();
    _buffered = {};
    Rest(now);
}

JointStates TrajectoryFollower::GetStates(Core::Duration now) const
{
    // The arm's speed is its distance from the command divided by the lag; along a line this has a closed-form solution.
    const double lag = GetLagSeconds();
    const double seconds = Seconds(now - _since).count();
    const double decay = std::exp(-seconds / lag);
    const JointVector rates = GetRates();
    JointStates states;
    for (std::size_t axis = 0; axis < AXES; ++axis)
    {
        const double behind = rates.at(axis) * lag;
        const double command = _command.at(axis) + rates.at(axis) * seconds;
        const double lacking = behind + (_command.at(axis) - _position.at(axis) - behind) * decay;
        states.position.at(axis) = command - lacking;
        states.velocity.at(axis) = lacking / lag;
    }
    return states;
}

const JointVector& TrajectoryFollower::GetHeld() const noexcept
{
    return _command;
}

const TrajectoryAgility& TrajectoryFollower::GetAgility() const noexcept
{
    return _agility;
}

std::size_t TrajectoryFollower::GetFree() const noexcept
{
    return _points.GetCapacity() - _points.GetSize();
}

double TrajectoryFollower::GetNewestTime() const noexcept
{
    return _newestTime;
}

bool TrajectoryFollower::IsResting() const noexcept
{
    return _phase == EPhase::Resting;
}

bool TrajectoryFollower::IsBlocked() const noexcept
{
    return _phase == EPhase::Stopped;
}

bool TrajectoryFollower::IsActive(Core::Duration now) const
{
    if (_phase == EPhase::Buffering || _phase == EPhase::Moving)
    {
        return true;
    }
    const JointVector position = GetStates(now).position;
    for (std::size_t axis = 0; axis < AXES; ++axis)
    {
        if (std::abs(_command.at(axis) - position.at(axis)) > SETTLED_DEGREES)
        {
            return true;
        }
    }
    return now < _cleanUntil;
}

} // namespace ACS::OpenStreamSim
