#include "traffic/TrafficCoordinator.hpp"

#include "robot/NodesAhead.hpp"
#include <acs/core/ShortText.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <span>
#include <utility>

// Where a robot is during its drive, and after it.

namespace ACS::Planning
{

bool TrafficCoordinator::TryAdvance(Robot& robot, std::size_t routeIndex)
{
    ActiveDrive& drive = *robot.drive;
    if (routeIndex >= drive.grantedCount)
    {
        const std::span<const std::size_t> nodes(drive.nodes);
        const std::span<const std::size_t> overrun =
            nodes.subspan(drive.grantedCount, routeIndex + 1 - drive.grantedCount);
        if (drive.reroute.has_value() || !_traffic.TryOverrun(robot.index, overrun))
        {
            drive.bOverran = true;
            HoldStray(robot, drive.nodes[routeIndex]);
            _transaction.RaiseAlarm(PlaceTracker::MakePlaceAlarm(
                robot,
                fmt::format(
                    "Robot entered node {} without a reservation. Move the robot to a free node.",
                    drive.route.nodes[routeIndex].nodeID)));
            return false;
        }
        _transaction.Note(robot, "drove beyond the released nodes");
        drive.grantedCount = routeIndex + 1;
    }
    if (routeIndex > drive.passed)
    {
        _traffic.Pass(robot.index, routeIndex - drive.passed);
        _transaction.RequestDispatch();
        robot.place.aheadNodes.clear();
        robot.place.heading.reset();
        robot.place.possibleNodes.clear();
        robot.parking.refusals = 0;
    }
    HoldStray(robot, std::nullopt);
    drive.passed = routeIndex;
    drive.bReported = false;
    robot.place.node = drive.nodes[routeIndex];
    if (std::exchange(drive.bOverran, false))
    {
        _transaction.ClearAlarm(PlaceTracker::MakePlaceAlarm(robot, {}));
    }
    return true;
}

void TrafficCoordinator::VerifyRoute(Robot& robot)
{
    ActiveDrive& drive = *robot.drive;
    const std::string& nodeID = robot.view.state->lastNodeID;
    drive.bReported = true;
    const bool bOff =
        drive.bTaken && !nodeID.empty() && std::ranges::count(drive.route.nodes, nodeID, &RouteNode::nodeID) == 0;
    if (drive.bTaken && !nodeID.empty())
    {
        HoldStray(robot, _site.FindNodeIndexOrNull(nodeID));
    }
    if (std::exchange(drive.bLeftRoute, bOff) == bOff)
    {
        return;
    }
    _transaction.RequestDispatch();
    if (bOff)
    {
        _transaction.RaiseAlarm(PlaceTracker::MakePlaceAlarm(
            robot,
            fmt::format(
                "Robot reports node {}, which is not on its route. Check where the robot is.",
                Core::ShortenText(nodeID))));
    }
    else
    {
        _transaction.ClearAlarm(PlaceTracker::MakePlaceAlarm(robot, {}));
    }
}

void TrafficCoordinator::HoldStray(Robot& robot, std::optional<std::size_t> nodeOrNull)
{
    std::optional<std::size_t>& stray = robot.place.strayNode;
    if (stray.has_value() && stray != nodeOrNull)
    {
        _traffic.Disown(robot.index, *std::exchange(stray, std::nullopt));
        _transaction.RequestDispatch();
    }
    if (nodeOrNull.has_value() && _traffic.GetHolderOrNull(*nodeOrNull) != robot.index)
    {
        _traffic.HoldPossible(robot.index, std::span(&*nodeOrNull, 1));
        stray = nodeOrNull;
    }
}

/// Where a robot was switched off and carried, or drove past its grant. A state from before the last node passed shows nothing.
bool TrafficCoordinator::IsReportedElsewhere(const Robot& robot)
{
    const ActiveDrive& drive = *robot.drive;
    const std::optional<StateChanged>& state = robot.view.state;
    return drive.bReported && state.has_value() && !state->lastNodeID.empty()
        && state->lastNodeID != drive.route.nodes[drive.passed].nodeID;
}

void TrafficCoordinator::EndDrive(Robot& robot)
{
    const std::string& robotID = robot.GetID();
    const ActiveDrive& drive = *robot.drive;
    const bool bElsewhere = IsReportedElsewhere(robot);
    // The alarm of a robot elsewhere is cleared only if its place is free.
    if (!bElsewhere && (drive.bLeftRoute || drive.bOverran))
    {
        _transaction.ClearAlarm(PlaceTracker::MakePlaceAlarm(robot, {}));
    }
    if (!drive.bConfirmed)
    {
        _transaction.CancelTimer(EEngineTimer::DriveExtension, robotID);
    }
    // An open pause must still be confirmed.
    const bool bControlOpen = robot.planOrNull != nullptr && robot.planOrNull->record.progress.control.has_value();
    if (drive.IsCancelling() && !bControlOpen)
    {
        _answers.StopConfirming(robot);
    }
    const std::optional<StateChanged> stateOrNull =
        PlaceTracker::IsPoseLost(robot, drive.route.nodes[drive.passed].nodeID) ? std::nullopt : robot.view.state;
    const std::size_t begin = drive.passed + 1;
    if (!drive.bConfirmed)
    {
        robot.place.aheadNodes = FindNodesAhead(
            _site,
            stateOrNull,
            *robot.place.node,
            robot.place.aheadNodes); // of the previous drive: the robot never had this one
    }
    else if (begin < drive.grantedCount)
    {
        robot.place.aheadNodes = FindNodesAhead(
            _site,
            stateOrNull,
            *robot.place.node,
            std::span(drive.nodes).subspan(begin, drive.grantedCount - begin));
    }
    else
    {
        robot.place.aheadNodes.clear();
    }
    robot.place.heldNodes.assign(1, *robot.place.node);
    for (const std::size_t between : robot.place.aheadNodes)
    {
        if (std::ranges::count(robot.place.heldNodes, between) == 0)
        {
            robot.place.heldNodes.push_back(between);
        }
    }
    if (const auto stray = std::exchange(robot.place.strayNode, std::nullopt);
        stray.has_value() && std::ranges::count(robot.place.heldNodes, *stray) == 0)
    {
        robot.place.heldNodes.push_back(*stray); // until it reports where it is
    }
    const bool bStands =
        _traffic.TryStand(robot.index, *robot.place.node, {}, std::span(robot.place.heldNodes).subspan(1));
    assert(bStands);
    static_cast<void>(bStands);
    robot.place.heading = PlaceTracker::GetHeadingOrNull(robot, robot.place.aheadNodes);
    _traffic.SetHeading(robot.index, robot.place.heading);
    robot.drive.reset();
    _traffic.SetDestination(robot.index, std::nullopt);
    _places.NoteStandingChanged();
    robot.search.plannedRoute.reset();
    robot.search.blockers.clear();
    robot.search.block.clear();
    _transaction.RequestDispatch();
    if (bElsewhere)
    {
        _places.Place(robot);
    }
}

} // namespace ACS::Planning
