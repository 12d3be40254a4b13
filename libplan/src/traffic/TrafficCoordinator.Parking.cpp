#include "traffic/TrafficCoordinator.hpp"

#include "traffic/BlockText.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <span>
#include <utility>

// Parking positions, blocks of the operator, and further nodes of a drive.

namespace ACS::Planning
{

void TrafficCoordinator::AssignParking()
{
    std::vector<bool> taken(_site.GetNodes().size(), false);
    const auto take = [this, &taken](std::size_t node) {
        std::ranges::for_each(_traffic.GetNear(node), [&taken](std::uint32_t near) { taken[near] = true; });
    };
    for (const Robot& robot : _fleet)
    {
        for (const std::optional<std::size_t>& own : {robot.parking.homeNode, robot.parking.chargeNode})
        {
            if (own.has_value())
            {
                take(*own);
            }
        }
    }
    for (Robot& robot : _fleet)
    {
        const RobotOptions& options = *robot.options;
        robot.parking.parkingNode =
            robot.parking.homeNode.has_value() ? robot.parking.homeNode : robot.parking.chargeNode;
        if (!robot.parking.parkingNode.has_value())
        {
            robot.parking.parkingNode = FindParkingOrNull(options, taken);
        }
        if (robot.parking.parkingNode.has_value())
        {
            take(*robot.parking.parkingNode);
        }
        _traffic.AddRobot(options.vehicleTypeID, robot.parking.parkingNode);
        if (options.startNodeID.has_value())
        {
            const bool bStands = _traffic.TryStand(robot.index, *_site.FindNodeIndexOrNull(*options.startNodeID));
            assert(bStands);
            static_cast<void>(bStands);
        }
    }
}

/// The first dock that is not within the clearance of a taken one and where it can park.
std::optional<std::size_t> TrafficCoordinator::FindParkingOrNull(
    const RobotOptions& robot,
    const std::vector<bool>& taken) const
{
    for (const SiteStation& station : _site.GetStations())
    {
        const std::optional<std::size_t> dock = _admission.FindDockOrNull(station.stationID, robot.vehicleTypeID);
        // A search for a route last: the docks of the robots before are many.
        if (dock.has_value() && !taken[*dock] && CanParkAt(robot, *dock))
        {
            return dock;
        }
    }
    return std::nullopt;
}

bool TrafficCoordinator::CanParkAt(const RobotOptions& robot, std::size_t dock) const
{
    if (!_traffic.IsSpur(robot.vehicleTypeID, dock))
    {
        return false;
    }
    const std::string& dockID = _site.GetNodes()[dock].nodeID;
    const std::string& startID = robot.startNodeID.value_or(dockID);
    return _routes.GetRouter().FindRouteOrNull(robot.vehicleTypeID, startID, dockID).has_value()
        && _routes.GetRouter().FindRouteOrNull(robot.vehicleTypeID, dockID, startID).has_value();
}

bool TrafficCoordinator::CanServe(const Robot& robot, const ActivePlan& plan) const
{
    return std::ranges::all_of(plan.resolved.steps, [this, &robot](const ResolvedStep& step) {
        const std::optional<std::size_t> dock = _admission.FindDockOrNull(step.stationID, robot.options->vehicleTypeID);
        return !dock.has_value()
            || (_blocks.FindOfTargetOrNull(step.stationID, *dock) == nullptr && _traffic.CanServe(robot.index, *dock));
    });
}

const Router& TrafficCoordinator::GetOpenRouter() const noexcept
{
    return _routes.GetOpenRouter();
}

void TrafficCoordinator::OnBlocksChanged()
{
    _routes.OnBlocksChanged();
    _traffic.SetBlocked(_blocks.GetNodes(), _blocks.GetEdges());
    for (Robot& robot : _fleet)
    {
        robot.search.plannedRoute.reset();
        robot.search.detour.reset();
        robot.search.detourAt = 0;
        robot.search.block.clear();
        robot.changes.MarkStatus();
    }
    _places.NoteStandingChanged();
    _transaction.RequestDispatch();
}

void TrafficCoordinator::UpdateStandIns()
{
    if (_blocks.IsEmpty() && !_bStandIns)
    {
        return;
    }
    _bStandIns = !_blocks.IsEmpty();
    for (Robot& robot : _fleet)
    {
        const std::optional<std::size_t> standIn = ChooseStandInOrNull(robot);
        if (std::exchange(robot.parking.standInNode, standIn) != standIn)
        {
            _traffic.SetStandIn(robot.index, standIn);
            robot.search.plannedRoute.reset();
            _transaction.RequestDispatch();
        }
    }
}

std::optional<std::size_t> TrafficCoordinator::ChooseStandInOrNull(const Robot& robot) const
{
    const ParkingPlaces& parking = robot.parking;
    if (_blocks.IsEmpty() || !parking.parkingNode.has_value() || !robot.place.node.has_value()
        || IsParkingOpen(robot, *parking.parkingNode))
    {
        return std::nullopt;
    }
    if (parking.standInNode.has_value() && IsParkingOpen(robot, *parking.standInNode))
    {
        return parking.standInNode;
    }
    std::optional<std::size_t> nearest;
    double seconds = std::numeric_limits<double>::infinity();
    const std::array start{*robot.place.node};
    for (const SiteStation& station : _site.GetStations())
    {
        const std::string& vehicleTypeID = robot.options->vehicleTypeID;
        const std::optional<std::size_t> dock = _admission.FindDockOrNull(station.stationID, vehicleTypeID);
        if (!dock.has_value() || !_traffic.IsSpur(vehicleTypeID, *dock) || !IsOpenDock(*dock)
            || IsParkingTaken(robot, *dock))
        {
            continue;
        }
        const auto way = GetOpenRouter().FindQuickestStartOrNull(vehicleTypeID, robot.GetLoad(), start, *dock);
        if (way.has_value() && way->travelSeconds < seconds)
        {
            nearest = dock;
            seconds = way->travelSeconds;
        }
    }
    return nearest;
}

bool TrafficCoordinator::IsParkingOpen(const Robot& robot, std::size_t node) const
{
    const std::array start{*robot.place.node};
    return IsOpenDock(node)
        && GetOpenRouter()
               .FindQuickestStartOrNull(robot.options->vehicleTypeID, robot.GetLoad(), start, node)
               .has_value();
}

bool TrafficCoordinator::IsParkingTaken(const Robot& robot, std::size_t node) const
{
    return !_traffic.IsOpenFor(node, robot.index) || _traffic.IsRefugeOfOther(node, robot.index)
        || std::ranges::any_of(_fleet, [&robot, node](const Robot& other) {
               const ParkingPlaces& parking = other.parking;
               return &other != &robot
                   && (parking.homeNode == node || parking.chargeNode == node || parking.parkingNode == node
                       || parking.standInNode == node);
           });
}

const Block* TrafficCoordinator::FindTargetBlockOrNull(const Robot& robot, std::size_t target) const
{
    const bool bHome = robot.planOrNull == nullptr || robot.parking.retreatNode.has_value();
    return bHome
        ? _blocks.FindOfDockOrNull(target)
        : _blocks.FindOfTargetOrNull(robot.planOrNull->resolved.steps[robot.planOrNull->step].stationID, target);
}

bool TrafficCoordinator::IsOpenDock(std::size_t node) const
{
    return _blocks.FindOfDockOrNull(node) == nullptr;
}

std::optional<std::string> TrafficCoordinator::DescribeBlockOrNull(const Robot& robot, const ActivePlan& plan) const
{
    for (const ResolvedStep& step : plan.resolved.steps)
    {
        const std::optional<std::size_t> dock = _admission.FindDockOrNull(step.stationID, robot.options->vehicleTypeID);
        const Block* blockOrNull = dock.has_value() ? _blocks.FindOfTargetOrNull(step.stationID, *dock) : nullptr;
        if (blockOrNull == nullptr && dock.has_value() && robot.place.node.has_value())
        {
            blockOrNull = _routes.FindBlockOrNull(robot, *dock);
        }
        if (blockOrNull != nullptr)
        {
            return BlockBook::Describe(*blockOrNull);
        }
    }
    return !_blocks.IsEmpty() && _traffic.GetFixed(robot.index).empty() && !CanServe(robot, plan)
        ? std::optional<std::string>(CUT_OFF)
        : std::nullopt;
}

bool TrafficCoordinator::TryNoteBlock(Robot& robot, std::size_t target) const
{
    const Block* const targetOrNull = FindTargetBlockOrNull(robot, target);
    if (targetOrNull != nullptr && robot.parking.retreatNode.has_value())
    {
        robot.parking.retreatNode.reset();
    }
    const Block* const blockOrNull = targetOrNull == nullptr && !RoutePlanner::HasRoute(robot, target)
        ? _routes.FindBlockOrNull(robot, target)
        : targetOrNull;
    robot.search.block = blockOrNull == nullptr ? std::string() : BlockBook::Describe(*blockOrNull);
    if (blockOrNull != nullptr)
    {
        robot.search.blockers.clear();
    }
    return blockOrNull != nullptr;
}

const Block* TrafficCoordinator::FindDriveBlockOrNull(const Robot& robot) const
{
    const ActiveDrive& drive = *robot.drive;
    if (_blocks.IsEmpty() || drive.grantedCount == drive.nodes.size())
    {
        return nullptr;
    }
    const std::size_t open = _blocks.CountOpen(drive.route, drive.grantedCount);
    return open < drive.nodes.size() ? _blocks.FindOnRouteOrNull(drive.route, open)
                                     : FindTargetBlockOrNull(robot, drive.nodes.back());
}

void TrafficCoordinator::NoteBlock(Robot& robot, std::string block)
{
    robot.changes.MarkStatus(robot.search.block != block);
    robot.search.block = std::move(block);
}

void TrafficCoordinator::GrantFurther(Robot& robot)
{
    ActiveDrive& drive = *robot.drive;
    const std::size_t wanted = std::min(
        drive.CountReachable(_site, robot.options->vehicleTypeID, robot.GetLoad()),
        drive.passed + 1 + 2 * _options.baseLength);
    if (wanted == drive.grantedCount)
    {
        NoteClosedEdge(robot);
        return;
    }
    const std::span<const std::size_t> nodes(drive.nodes);
    const std::vector<std::size_t> formerBlockers = robot.search.blockers;
    const std::size_t granted =
        Extend(robot, nodes.subspan(drive.grantedCount, wanted - drive.grantedCount), drive.nodes.back());
    drive.grantedCount += granted;
    robot.changes.MarkStatus(granted > 0 || robot.search.blockers != formerBlockers);
    robot.search.refusedAt = _traffic.GetFreedCount();
}

void TrafficCoordinator::NoteClosedEdge(Robot& robot) const
{
    const ActiveDrive& drive = *robot.drive;
    const ELoad load = robot.GetLoad();
    const bool bOtherRoute = _routes.PlanRouteOrNull(robot, drive.nodes.back(), {}).has_value();
    const std::vector<std::size_t> formerBlockers = std::exchange(
        robot.search.blockers,
        bOtherRoute ? _traffic.GetHolders(drive.nodes.back(), robot.index) : std::vector<std::size_t>());
    robot.changes.MarkStatus(robot.search.blockers != formerBlockers);
    robot.search.refusedAt = 0;
    NoteBlock(
        robot,
        bOtherRoute ? std::string()
                    : fmt::format(
                        "{} robot may not use edge {} of its route",
                        load == ELoad::Loaded ? "a loaded" : "an empty",
                        drive.route.edges[drive.grantedCount - 1].edgeID));
}

bool TrafficCoordinator::IsStoppedByBlock(const Robot& robot) const
{
    if (!robot.drive.has_value() || robot.control.bConfirming || !_traffic.IsMovable(robot.index)
        || !robot.CanAdvance())
    {
        return false;
    }
    const ActiveDrive& drive = *robot.drive;
    return drive.bConfirmed && !drive.IsCancelling() && !drive.bLeftRoute && drive.passed + 1 >= drive.grantedCount
        && drive.grantedCount < drive.nodes.size()
        && (FindDriveBlockOrNull(robot) != nullptr || robot.search.block == CUT_OFF);
}

void TrafficCoordinator::AvoidBlocks()
{
    if (_blocks.IsEmpty())
    {
        return;
    }
    for (Robot& robot : _fleet)
    {
        if (IsStoppedByBlock(robot) && robot.search.blockedAt != _traffic.GetFreedCount())
        {
            AvoidBlock(robot);
            robot.search.blockedAt = _traffic.GetFreedCount();
        }
    }
}

void TrafficCoordinator::AvoidBlock(Robot& robot)
{
    if (const Block* const blockOrNull = FindDriveBlockOrNull(robot); blockOrNull != nullptr)
    {
        NoteBlock(robot, BlockBook::Describe(*blockOrNull));
    }
    if (robot.parking.retreatNode.has_value() && !IsOpenDock(*robot.parking.retreatNode))
    {
        robot.parking.retreatNode.reset();
    }
    const std::optional<std::size_t> target = _waiting.GetTargetOrNull(robot);
    std::optional<PlannedRoute> route;
    if (target.has_value() && !robot.place.IsOn(target) && FindTargetBlockOrNull(robot, *target) == nullptr)
    {
        route = _routes.PlanRouteOrNull(robot, *target, {});
    }
    if (route.has_value() && _traffic.CanServe(robot.index, *target))
    {
        static_cast<void>(TryReroute(robot, std::move(*route), robot.parking.retreatNode.has_value()));
        return;
    }
    if (std::optional<PlannedRoute> way = PlanWayOffLaneOrNull(robot); way.has_value())
    {
        static_cast<void>(TryReroute(robot, std::move(*way), true));
    }
}

std::optional<PlannedRoute> TrafficCoordinator::PlanWayOffLaneOrNull(const Robot& robot) const
{
    const std::optional<std::size_t> parking = robot.parking.GetParkingOrNull();
    if (!parking.has_value() || robot.place.IsOn(parking) || robot.parking.bRefused || !IsOpenDock(*parking)
        || _traffic.IsSpur(robot.options->vehicleTypeID, *robot.place.node)
        || !_waiting.GetTargetHolders(robot, *parking).empty())
    {
        return std::nullopt;
    }
    return _routes.PlanRouteOrNull(robot, *parking, {});
}

bool TrafficCoordinator::TryLeaveLane(Robot& robot)
{
    const std::optional<PlannedRoute> route =
        _traffic.IsMovable(robot.index) ? PlanWayOffLaneOrNull(robot) : std::nullopt;
    if (!route.has_value())
    {
        return false;
    }
    const std::string block = robot.search.block;
    robot.parking.retreatNode = route->target;
    const bool bBegun = TryBeginDrive(robot, *route);
    robot.parking.retreatNode = bBegun ? robot.parking.retreatNode : std::nullopt;
    robot.search.block = block;
    return bBegun;
}

} // namespace ACS::Planning
