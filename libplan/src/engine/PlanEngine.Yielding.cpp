#include "engine/PlanEngine.Impl.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <span>
#include <utility>

namespace ACS::Planning
{

namespace
{

/// Ways around others that a robot tries on its way to a step: others may make way for it, too, and then it arrives.
constexpr std::size_t DETOURS_AT_MOST = 3;

} // namespace

/// Will do something without anybody else: it has nodes before it, or works, or is about to answer.
bool PlanEngine::Impl::IsMoving(const Robot& robot) const
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

/// Wants to drive and cannot until others have moved.
bool PlanEngine::Impl::IsWaiting(const Robot& robot) const
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
    return CanDriveHome() && !robot.bHomeRefused && target.has_value() && target != robot.node;
}

/// Who waits for robots that cannot move is not helped by others.
bool PlanEngine::Impl::IsHelpable(const Robot& robot) const
{
    return robot.blockers.empty()
        || std::ranges::any_of(robot.blockers, [this](std::size_t other) { return _traffic.IsMovable(other); });
}

bool PlanEngine::Impl::IsYielding(const Robot& robot) const
{
    if (!robot.yield.has_value() || robot.retreatNode.has_value() || robot.planOrNull == nullptr)
    {
        return false;
    }
    const Robot& leader = _robots[robot.yield->leader];
    if (!_traffic.IsMovable(leader.index) || (IsWaiting(leader) && !IsHelpable(leader)))
    {
        return false;
    }
    if (!robot.yield->planSequence.has_value())
    {
        return leader.planOrNull == nullptr && leader.homeNode.has_value() && leader.node != leader.homeNode;
    }
    return leader.planOrNull != nullptr && leader.planOrNull->record.sequence == robot.yield->planSequence
        && leader.planOrNull->step == robot.yield->step && leader.activity == EActivity::Waits;
}

void PlanEngine::Impl::YieldTo(Robot& robot, const Robot& leader)
{
    Yield yield;
    yield.leader = leader.index;
    if (leader.planOrNull != nullptr)
    {
        yield.planSequence = leader.planOrNull->record.sequence;
        yield.step = leader.planOrNull->step;
    }
    robot.yield = yield;
}

/// Robots that wait, and wait for nobody who will do something by himself: the most urgent first.
std::vector<PlanEngine::Impl::Robot*> PlanEngine::Impl::ListDeadlocked()
{
    std::vector<bool> hopeful(_robots.size(), false);
    std::vector<Robot*> waiting;
    for (Robot& robot : _robots)
    {
        hopeful[robot.index] = IsMoving(robot);
        if (IsWaiting(robot))
        {
            waiting.push_back(&robot);
        }
    }
    for (bool bChanged = true; std::exchange(bChanged, false);)
    {
        std::erase_if(waiting, [&hopeful, &bChanged](const Robot* robot) {
            const bool bHopeful =
                std::ranges::any_of(robot->blockers, [&hopeful](std::size_t other) { return hopeful[other]; });
            hopeful[robot->index] = hopeful[robot->index] || bHopeful;
            bChanged = bChanged || bHopeful;
            return bHopeful;
        });
    }
    std::ranges::sort(waiting, IsMoreUrgent);
    return waiting;
}

/// All that a robot waits for, and what those wait for in turn; the least urgent first.
std::vector<PlanEngine::Impl::Robot*> PlanEngine::Impl::GetBlockersOf(const Robot& start)
{
    std::vector<bool> reached(_robots.size(), false);
    std::vector<std::size_t> open = start.blockers;
    std::vector<Robot*> found;
    while (!open.empty())
    {
        const std::size_t robot = open.back();
        open.pop_back();
        if (!reached[robot])
        {
            reached[robot] = true;
            found.push_back(&_robots[robot]);
            if (IsWaiting(_robots[robot]))
            {
                std::ranges::copy(_robots[robot].blockers, std::back_inserter(open));
            }
        }
    }
    std::ranges::sort(found, IsMoreUrgent);
    std::ranges::reverse(found);
    return found;
}

/// Robots that only wait for one another would do so for ever. One at a time is set in motion, until each of them waits
/// for one that moves.
void PlanEngine::Impl::ResolveDeadlocks()
{
    for (std::size_t round = 0; round < _robots.size(); ++round)
    {
        const std::vector<Robot*> stuck = ListDeadlocked();
        if (stuck.empty() || !TryResolveDeadlock(stuck))
        {
            return;
        }
    }
}

bool PlanEngine::Impl::TryResolveDeadlock(const std::vector<Robot*>& stuck)
{
    if (std::ranges::any_of(stuck, [this](Robot* robot) { return TryDetour(*robot); })
        || std::ranges::any_of(stuck, [this, &stuck](Robot* robot) { return TryMakeWay(*robot, stuck); }))
    {
        return true;
    }
    // Whoever is the first has nobody to let go first, if that one waits, too.
    Robot& first = *stuck.front();
    if (first.drive.has_value() || !IsYielding(first))
    {
        return false;
    }
    first.yield.reset();
    return TryDrive(first);
}

/// On to its aim around everybody who stands; home only where the whole way is open.
bool PlanEngine::Impl::TryDetour(Robot& robot)
{
    const bool bHome = robot.planOrNull == nullptr || robot.retreatNode.has_value();
    const std::optional<std::size_t> target = GetTargetOrNull(robot);
    if (!target.has_value() || target == robot.node || robot.bConfirming || (!bHome && robot.detours >= DETOURS_AT_MOST)
        || !GetTargetHolders(robot, *target).empty())
    {
        return false;
    }
    const auto isInTheWay = [this, &robot, bHome](std::size_t node) {
        if (bHome)
        {
            return !_traffic.IsOpenFor(node, robot.index);
        }
        const std::vector<std::size_t> holders = _traffic.GetHolders(node, robot.index);
        return std::ranges::any_of(holders, [this](std::size_t holder) { return !IsMoving(_robots[holder]); });
    };
    std::optional<PlannedRoute> detour = PlanRouteOrNull(robot, *target, isInTheWay);
    if (!detour.has_value())
    {
        return false;
    }
    const bool bBegun = robot.drive.has_value() ? TryReroute(robot, std::move(*detour), robot.retreatNode.has_value())
                                                : TryBeginDrive(robot, *detour);
    robot.detours += bBegun && !bHome ? 1U : 0U;
    return bBegun;
}

/// One of those who keep the leader goes home first; where none can, the leader does, and else whoever stands idle steps
/// aside.
bool PlanEngine::Impl::TryMakeWay(Robot& leader, const std::vector<Robot*>& stuck)
{
    if (leader.planOrNull == nullptr || leader.retreatNode.has_value() || !IsHelpable(leader))
    {
        return false;
    }
    const std::vector<Robot*> blockers = GetBlockersOf(leader);
    const auto tryRetreat = [this, &leader](Robot* robot) {
        return robot != &leader && TryRetreat(*robot, leader);
    };
    if (std::ranges::any_of(blockers, tryRetreat) || std::any_of(stuck.rbegin(), stuck.rend(), tryRetreat))
    {
        return true;
    }
    if (std::ranges::count(blockers, &leader) > 0)
    {
        const auto other = std::ranges::find_if(blockers, [this, &leader](Robot* robot) {
            return robot != &leader && IsWaiting(*robot);
        });
        if (other != blockers.end() && TryRetreat(leader, **other))
        {
            return true;
        }
    }
    return std::ranges::any_of(blockers, [this, &leader](Robot* robot) {
        return robot != &leader && TryStepAside(*robot, leader);
    });
}

bool PlanEngine::Impl::TryRetreat(Robot& robot, const Robot& leader)
{
    const bool bGoesHome = robot.drive.has_value() && robot.drive->nodes.back() == robot.parkingNode;
    if (!_traffic.IsMovable(robot.index) || IsMoving(robot) || bGoesHome || robot.bHomeRefused || robot.bConfirming
        || (robot.retreatNode.has_value() && robot.retreatNode == robot.parkingNode) || !robot.parkingNode.has_value()
        || robot.node == robot.parkingNode || !GetTargetHolders(robot, *robot.parkingNode).empty())
    {
        return false;
    }
    std::optional<PlannedRoute> plannedRoute =
        PlanRouteOrNull(robot, *robot.parkingNode, [this, &robot](std::size_t node) {
            return !_traffic.IsOpenFor(node, robot.index);
        });
    if (!plannedRoute.has_value())
    {
        return false;
    }
    bool bBegun = false;
    if (robot.drive.has_value())
    {
        bBegun = TryReroute(robot, std::move(*plannedRoute), true);
    }
    else
    {
        robot.retreatNode = robot.parkingNode;
        bBegun = TryBeginDrive(robot, *plannedRoute);
        robot.retreatNode = bBegun ? robot.retreatNode : std::nullopt;
    }
    if (bBegun)
    {
        YieldTo(robot, leader);
        Note(
            robot,
            fmt::format(
                "goes to {} first, out of the way of {}",
                _site.GetNodes()[*robot.parkingNode].nodeID,
                GetRobotID(leader)));
    }
    return bBegun;
}

/// A robot without work that stands at its home, or has none, in somebody's way: to the nearest station that nobody wants.
bool PlanEngine::Impl::TryStepAside(Robot& robot, const Robot& leader)
{
    const std::optional<std::size_t> wanted = GetTargetOrNull(leader);
    const bool bInTheWay = leader.plannedRoute.has_value() && robot.node.has_value()
        && std::ranges::any_of(leader.plannedRoute->nodes,
                               [this, &robot](std::size_t node) { return _traffic.IsNear(node, *robot.node); });
    if (!bInTheWay || robot.planOrNull != nullptr || robot.drive.has_value() || !_traffic.IsMovable(robot.index)
        || !CanDriveHome() || robot.bHomeRefused || !wanted.has_value())
    {
        return false;
    }
    std::vector<bool> avoided(_site.GetNodes().size(), false);
    for (const Robot& other : _robots)
    {
        for (const std::size_t node : other.plannedRoute.has_value() && &other != &robot ? other.plannedRoute->nodes
                                                                                         : std::vector<std::size_t>())
        {
            avoided[node] = true;
        }
    }
    std::optional<PlannedRoute> best;
    for (const SiteStation& station : _site.GetStations())
    {
        const std::optional<std::size_t> dock =
            _admission.FindDockOrNull(station.stationID, robot.options->vehicleTypeID);
        if (!dock.has_value() || avoided[*dock] || dock == wanted || dock == robot.node
            || !_traffic.IsOpenFor(*dock, robot.index) || !GetTargetHolders(robot, *dock).empty())
        {
            continue;
        }
        std::optional<PlannedRoute> plannedRoute = PlanRouteOrNull(robot, *dock, [this, &robot](std::size_t node) {
            return !_traffic.IsFreeFor(node, robot.index);
        });
        if (plannedRoute.has_value()
            && (!best.has_value() || plannedRoute->route.travelSeconds < best->route.travelSeconds))
        {
            best = std::move(plannedRoute);
        }
    }
    if (!best.has_value())
    {
        return false;
    }
    robot.retreatNode = best->target;
    if (!TryBeginDrive(robot, *best))
    {
        robot.retreatNode.reset();
        return false;
    }
    Note(robot, fmt::format("steps aside for {}", GetRobotID(leader)));
    return true;
}

/// Another way than the one that it is on: granted now, driven when the vehicle has given the present one up.
bool PlanEngine::Impl::TryReroute(Robot& robot, PlannedRoute plannedRoute, bool bRetreats)
{
    const std::size_t wanted = std::min(_options.baseLength, plannedRoute.nodes.size() - 1);
    if (_traffic.Extend(robot.index, std::span(plannedRoute.nodes).subspan(1, wanted)) == 0)
    {
        return false;
    }
    ActiveDrive& drive = *robot.drive;
    drive.reroute = Reroute{std::move(plannedRoute), bRetreats};
    drive.cancellation = ECancellation::Awaited;
    Command(robot, CancelDrive{drive.driveID});
    StartConfirming(robot, _options.controls.cancelTimeout);
    return true;
}

/// The vehicle has given its drive up for this.
void PlanEngine::Impl::BeginReroute(Robot& robot, PlannedRoute plannedRoute, bool bRetreats)
{
    if (plannedRoute.nodes.front() != robot.node)
    {
        return; // It went on meanwhile: as any that waits.
    }
    if (bRetreats)
    {
        robot.retreatNode = plannedRoute.target;
    }
    robot.plannedRoute = std::move(plannedRoute);
    if (_traffic.IsMovable(robot.index) && IsUsable(robot))
    {
        static_cast<void>(TryBeginDrive(robot, *robot.plannedRoute));
    }
}

/// The vehicle has not given its drive up in time: it stays on it.
void PlanEngine::Impl::AbandonReroute(Robot& robot)
{
    if (!robot.drive.has_value() || !robot.drive->reroute.has_value())
    {
        return;
    }
    ActiveDrive& drive = *robot.drive;
    drive.reroute.reset();
    drive.StopAwaitingCancellation();
    _traffic.Shorten(robot.index, drive.grantedCount - drive.passed);
    _bDispatchNeeded = true;
}

} // namespace ACS::Planning
