#include "traffic/WaitingRobots.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace ACS::Planning
{

WaitingRobots::WaitingRobots(EngineState& engine, const TscControl& tsc, PlaceTracker& places)
    : _admission(engine.admission),
      _fleet(engine.fleet),
      _tsc(tsc),
      _traffic(places.GetTraffic())
{
}

std::optional<std::size_t> WaitingRobots::GetTargetOrNull(const Robot& robot) const
{
    if (robot.parking.retreatNode.has_value() || robot.planOrNull == nullptr)
    {
        return robot.parking.retreatNode.has_value() ? robot.parking.retreatNode : robot.parking.GetHomeOrNull();
    }
    return _admission.FindDockOrNull(
        robot.planOrNull->resolved.steps[robot.planOrNull->step].stationID,
        robot.options->vehicleTypeID);
}

std::vector<std::size_t> WaitingRobots::GetTargetHolders(const Robot& robot, std::size_t target) const
{
    std::vector<std::size_t> holders = _traffic.GetHolders(target, robot.index);
    for (const std::size_t other : _traffic.GetArriving(target))
    {
        if (other != robot.index && std::ranges::count(holders, other) == 0)
        {
            holders.push_back(other);
        }
    }
    return holders;
}

bool WaitingRobots::IsAtPlace(const Robot& robot) const
{
    if (robot.planOrNull == nullptr || robot.drive.has_value() || !robot.place.node.has_value())
    {
        return false;
    }
    const ActivePlan& plan = *robot.planOrNull;
    return robot.place.IsOn(
        _admission.FindDockOrNull(plan.resolved.steps[plan.step].stationID, robot.options->vehicleTypeID));
}

std::vector<Robot*> WaitingRobots::GetWaiting()
{
    std::vector<Robot*> waiting;
    for (Robot& robot : _fleet)
    {
        if (robot.activity == EActivity::Waits && !robot.drive.has_value() && robot.IsUsable())
        {
            waiting.push_back(&robot);
        }
    }
    std::ranges::sort(waiting, IsMoreUrgent);
    return waiting;
}

std::vector<Robot*> WaitingRobots::ListAwayFromHome()
{
    std::vector<Robot*> away;
    for (Robot& robot : _fleet)
    {
        const bool bIdle = robot.planOrNull == nullptr && !robot.drive.has_value() && !robot.parking.bRefused;
        if (bIdle && robot.IsUsable() && robot.parking.homeNode.has_value()
            && !robot.place.IsOn(robot.parking.GetHomeOrNull()))
        {
            away.push_back(&robot);
        }
    }
    return away;
}

bool WaitingRobots::IsMoving(const Robot& robot) const
{
    if (!_traffic.IsMovable(robot.index))
    {
        return false;
    }
    if (robot.drive.has_value())
    {
        const ActiveDrive& drive = *robot.drive;
        return drive.IsCancelling() || !drive.bConfirmed || drive.passed + 1 < drive.grantedCount
            || drive.grantedCount == drive.nodes.size();
    }
    return robot.activity == EActivity::Works;
}

bool WaitingRobots::IsWaiting(const Robot& robot) const
{
    if (!_traffic.IsMovable(robot.index) || IsMoving(robot))
    {
        return false;
    }
    if (robot.drive.has_value() || robot.activity == EActivity::Waits)
    {
        return true;
    }
    const std::optional<std::size_t> target = GetTargetOrNull(robot);
    return _tsc.CanDriveHome() && !robot.parking.bRefused && target.has_value() && !robot.place.IsOn(target);
}

bool WaitingRobots::IsHelpable(const Robot& robot) const
{
    return robot.search.block.empty()
        && (robot.search.blockers.empty() || std::ranges::any_of(robot.search.blockers, [this](std::size_t other) {
                return _traffic.IsMovable(other);
            }));
}

bool WaitingRobots::IsYielding(const Robot& robot) const
{
    if (!robot.search.yield.has_value() || robot.parking.retreatNode.has_value())
    {
        return false;
    }
    const Robot& leader = _fleet[robot.search.yield->leader];
    if (!_traffic.IsMovable(leader.index) || (IsWaiting(leader) && !IsHelpable(leader)))
    {
        return false;
    }
    if (!robot.search.yield->planSequence.has_value())
    {
        return leader.planOrNull == nullptr && leader.parking.homeNode.has_value()
            && !leader.place.IsOn(leader.parking.GetHomeOrNull());
    }
    return leader.planOrNull != nullptr && leader.planOrNull->record.sequence == robot.search.yield->planSequence
        && leader.planOrNull->step == robot.search.yield->step && leader.activity == EActivity::Waits;
}

void WaitingRobots::YieldTo(Robot& robot, const Robot& leader)
{
    Yield yield;
    yield.leader = leader.index;
    if (leader.planOrNull != nullptr)
    {
        yield.planSequence = leader.planOrNull->record.sequence;
        yield.step = leader.planOrNull->step;
    }
    robot.search.yield = yield;
}

std::vector<Robot*> WaitingRobots::ListDeadlocked()
{
    std::vector<bool> hopeful(_fleet.size(), false);
    std::vector<Robot*> waiting;
    for (Robot& robot : _fleet)
    {
        hopeful[robot.index] = IsMoving(robot);
        if (IsWaiting(robot))
        {
            waiting.push_back(&robot);
        }
    }
    for (bool bChanged = true; std::exchange(bChanged, false);)
    {
        std::erase_if(waiting, [&hopeful, &bChanged](const Robot* robotOrNull) {
            const bool bHopeful = std::ranges::any_of(robotOrNull->search.blockers, [&hopeful](std::size_t other) {
                return hopeful[other];
            });
            hopeful[robotOrNull->index] = hopeful[robotOrNull->index] || bHopeful;
            bChanged = bChanged || bHopeful;
            return bHopeful;
        });
    }
    std::ranges::sort(waiting, IsMoreUrgent);
    return waiting;
}

std::vector<Robot*> WaitingRobots::GetBlockersOf(const Robot& start)
{
    const std::vector<bool> marked = MarkBlockersOf(start);
    std::vector<Robot*> found;
    for (Robot& robot : _fleet)
    {
        if (marked[robot.index])
        {
            found.push_back(&robot);
        }
    }
    std::ranges::sort(found, IsMoreUrgent);
    std::ranges::reverse(found);
    return found;
}

bool WaitingRobots::HasMovingBlocker(const Robot& start) const
{
    const std::vector<bool> marked = MarkBlockersOf(start);
    return std::ranges::any_of(_fleet, [this, &marked](const Robot& robot) {
        return marked[robot.index] && IsMoving(robot);
    });
}

bool WaitingRobots::IsTaken(std::size_t node, const Robot& robot) const
{
    return !GetTargetHolders(robot, node).empty();
}

std::vector<bool> WaitingRobots::MarkBlockersOf(const Robot& start) const
{
    std::vector<bool> marked(_fleet.size(), false);
    std::vector<std::size_t> open = start.search.blockers;
    while (!open.empty())
    {
        const std::size_t robot = open.back();
        open.pop_back();
        if (!marked[robot])
        {
            marked[robot] = true;
            if (IsWaiting(_fleet[robot]))
            {
                std::ranges::copy(_fleet[robot].search.blockers, std::back_inserter(open));
            }
        }
    }
    return marked;
}

} // namespace ACS::Planning
