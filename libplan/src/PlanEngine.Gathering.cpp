#include "PlanEngine.Impl.hpp"

#include <algorithm>
#include <utility>

namespace ACS::Planning
{

/// Whether it has still to tell where it stands. One that is out of service may be switched off for days.
bool PlanEngine::Impl::IsAwaited(const Robot& robot)
{
    return !robot.state.has_value() && !robot.bInMaintenance;
}

/// bHasWork: before robots have told where they stand and what they do, nothing is begun.
void PlanEngine::Impl::BeginGathering(bool bHasWork)
{
    if (_options.restartWait.count() > 0)
    {
        _bAwaiting = true;
        _bGathering = bHasWork;
        StartTimer(EEngineTimer::Gathering, {}, _options.restartWait);
    }
}

void PlanEngine::Impl::FollowGathering()
{
    if (_bAwaiting && std::ranges::none_of(_robots, IsAwaited))
    {
        CancelTimer(EEngineTimer::Gathering, {});
        EndGathering();
    }
}

void PlanEngine::Impl::EndGathering()
{
    _bAwaiting = false;
    if (std::exchange(_bGathering, false))
    {
        _bDispatchNeeded = true;
        if (_tscState == ETscState::Auto)
        {
            TellTsc(ETscState::Paused);
        }
    }
}

/// Section 9: silence from the start on is an alarm, too.
void PlanEngine::Impl::RaiseMissing()
{
    for (const Robot& robot : _robots)
    {
        if (!IsAwaited(robot))
        {
            continue;
        }
        if (robot.bOnline)
        {
            RaiseAlarm(MakePlaceAlarm(robot, "It is connected and does not tell its state."));
            continue;
        }
        const bool bHasWork = robot.planOrNull != nullptr || robot.job.has_value();
        Alarm alarm = MakeLinkAlarm(robot);
        alarm.message = bHasWork ? "It has not come back since the ACS was started, and has work."
                                 : "It has not been there since the ACS was started.";
        RaiseAlarm(std::move(alarm));
    }
}

} // namespace ACS::Planning
