#include "engine/PlanEngine.Impl.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace ACS::Planning
{

/// Whether it has still to tell where it stands. One that is out of service may be switched off for days.
bool PlanEngine::Impl::IsPositionAwaited(const Robot& robot)
{
    return !robot.state.has_value() && !robot.bInMaintenance;
}

void PlanEngine::Impl::BeginStartup(bool bHasWork)
{
    if (_options.restartWait.count() > 0)
    {
        _startup.Begin(bHasWork);
        StartTimer(EEngineTimer::Startup, {}, _options.restartWait);
    }
    else
    {
        ReservePossibleNodes();
    }
}

void PlanEngine::Impl::UpdateStartup()
{
    if (_startup.IsWaiting() && std::ranges::none_of(_robots, IsPositionAwaited))
    {
        CancelTimer(EEngineTimer::Startup, {});
        EndStartup();
    }
}

void PlanEngine::Impl::EndStartup()
{
    ReservePossibleNodes();
    if (_startup.TryRelease())
    {
        _bDispatchNeeded = true;
        if (_tscState == ETscState::Auto)
        {
            PublishTscState(ETscState::Paused);
        }
    }
}

/// Section 9: silence from the start on is an alarm, too.
void PlanEngine::Impl::RaiseMissing()
{
    for (const Robot& robot : _robots)
    {
        if (!IsPositionAwaited(robot))
        {
            continue;
        }
        if (robot.bOnline)
        {
            RaiseAlarm(MakePlaceAlarm(robot, "It is connected and does not tell its state."));
            continue;
        }
        const bool bHasWork = robot.planOrNull != nullptr || robot.job.GetOrNull() != nullptr;
        Alarm alarm = MakeLinkAlarm(
            robot,
            bHasWork ? "It has not come back since the ACS was started, and has work."
                     : "It has not been there since the ACS was started.");
        if (!robot.possibleNodes.empty())
        {
            alarm.message += " Where it may be is kept free until it is back, or is taken into maintenance.";
        }
        RaiseAlarm(std::move(alarm));
    }
}

/// Nobody else is let to where a robot may be that has not told it. Those that have told come first.
void PlanEngine::Impl::ReservePossibleNodes()
{
    for (const Robot& robot : _robots)
    {
        if (!robot.bPlaced)
        {
            _traffic.HoldPossible(robot.index, robot.possibleNodes);
        }
    }
}

/// A robot tells that it is there: so nobody is of whom that is only supposed.
void PlanEngine::Impl::ReleasePossibleNodes(std::span<const std::size_t> nodes)
{
    for (Robot& robot : _robots)
    {
        for (const std::size_t node : nodes)
        {
            if (std::erase(robot.possibleNodes, node) > 0)
            {
                std::erase(robot.aheadNodes, node);
                std::erase(robot.heldNodes, node);
                _traffic.Disown(robot.index, node);
            }
        }
    }
}

/// It is not on the floor.
void PlanEngine::Impl::ForgetPossibleNodes(Robot& robot)
{
    for (const std::size_t node : std::exchange(robot.possibleNodes, {}))
    {
        _traffic.Disown(robot.index, node);
    }
    robot.bWorkTouched = true;
    _bDispatchNeeded = true;
}

/// Of the way that was written down, what lies behind the node.
std::vector<std::size_t> PlanEngine::Impl::ListPossibleAhead(const Robot& robot, std::size_t node)
{
    const auto here = std::ranges::find(robot.possibleNodes, node);
    return here == robot.possibleNodes.end() ? std::vector<std::size_t>()
                                             : std::vector<std::size_t>(here + 1, robot.possibleNodes.end());
}

/// To be written down: where the robot may be after a restart.
std::vector<std::string> PlanEngine::Impl::ListNodes(const Robot& robot) const
{
    std::span<const std::size_t> nodes = robot.possibleNodes;
    if (robot.drive.has_value())
    {
        nodes = std::span(robot.drive->nodes).subspan(robot.drive->passed);
    }
    else if (robot.bPlaced)
    {
        nodes = robot.heldNodes;
    }
    else if (robot.state.has_value())
    {
        return robot.work.GetStored().nodeIDs; // it has lost its place
    }
    std::vector<std::string> nodeIDs;
    for (const std::size_t node : nodes)
    {
        nodeIDs.push_back(_site.GetNodes()[node].nodeID);
    }
    return nodeIDs;
}

} // namespace ACS::Planning
