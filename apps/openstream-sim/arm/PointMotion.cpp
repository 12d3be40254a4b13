#include "arm/PointMotion.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace ACS::OpenStreamSim
{

namespace
{

using Seconds = std::chrono::duration<double>;

constexpr double PEAK = 1.5; ///< The fastest of the smooth step, of its mean.

} // namespace

void PointMotion::Begin(const JointVector& from, const JointVector& to, double seconds, Core::Duration now)
{
    _from = from;
    _to = to;
    _begunAt = now;
    _seconds = std::max(seconds, GetShortestSeconds(from, to));
}

Core::Duration PointMotion::GetEnd() const noexcept
{
    return _begunAt + std::chrono::duration_cast<Core::Duration>(Seconds(_seconds));
}

JointStates PointMotion::GetStates(Core::Duration now) const
{
    JointStates states;
    states.position = _to;
    if (now >= GetEnd())
    {
        return states;
    }
    const double progress = std::clamp(Seconds(now - _begunAt).count() / _seconds, 0.0, 1.0);
    const double step = progress * progress * (3.0 - 2.0 * progress);
    const double rate = 6.0 * progress * (1.0 - progress) / _seconds;
    for (std::size_t axis = 0; axis < AXES; ++axis)
    {
        const double way = _to.at(axis) - _from.at(axis);
        states.position.at(axis) = _from.at(axis) + way * step;
        states.velocity.at(axis) = way * rate;
    }
    return states;
}

double PointMotion::GetShortestSeconds(const JointVector& from, const JointVector& to)
{
    double seconds = 0.0;
    for (std::size_t axis = 0; axis < AXES; ++axis)
    {
        seconds = std::max(seconds, PEAK * std::abs(to.at(axis) - from.at(axis)) / AXIS_LIMITS.at(axis).speed);
    }
    return seconds;
}

} // namespace ACS::OpenStreamSim
