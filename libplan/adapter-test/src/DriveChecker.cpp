#include "DriveChecker.hpp"

#include "EventText.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace ACS::AdapterTest
{

DriveChecker::DriveChecker(FindingSink sink)
    : _sink(std::move(sink))
{
}

void DriveChecker::OnDrive(const Planning::Drive& drive, const RobotTruth& truth)
{
    _drive = drive;
    _passedCount = 0;
    _end = EEnd::Open;
    _bLost = false;
    _bCancelAsked = false;
    _knownIDs.insert(drive.driveID);
    _visited = {truth.nodeID};
}

void DriveChecker::OnExtend(const Planning::ExtendDrive& extend)
{
    if (_drive.has_value() && _drive->driveID == extend.driveID)
    {
        _drive->releasedCount = extend.releasedCount;
    }
}

void DriveChecker::OnCancel(const Planning::CancelDrive& cancel)
{
    _bCancelAsked = _bCancelAsked || (_drive.has_value() && _drive->driveID == cancel.driveID);
}

void DriveChecker::OnRestart()
{
    _bLost = true;
}

void DriveChecker::OnNodePassed(const Planning::NodePassed& event)
{
    if (!IsOpen(event.driveID, event))
    {
        return;
    }
    const std::vector<Planning::RouteNode>& nodes = _drive->route.nodes;
    if (_passedCount > 0 && nodes[_passedCount - 1].nodeID == event.nodeID)
    {
        return; // a repeated event, which the engine ignores
    }
    if (_passedCount == nodes.size() || nodes[_passedCount].nodeID != event.nodeID)
    {
        const std::string next = _passedCount == nodes.size() ? "no node" : nodes[_passedCount].nodeID;
        _sink(ERule::NodesInOrder, fmt::format("{} was raised; {} is next.", DescribeEvent(event), next));
        return;
    }
    ++_passedCount;
    if (!_visited.contains(event.nodeID))
    {
        _sink(ERule::NodesInOrder, fmt::format("{} was raised; the robot was not there.", DescribeEvent(event)));
    }
}

void DriveChecker::OnArrived(const Planning::Arrived& event, const RobotTruth& truth)
{
    if (!IsOpen(event.driveID, event))
    {
        return;
    }
    const std::string& target = _drive->route.nodes.back().nodeID;
    if (_passedCount < _drive->route.nodes.size())
    {
        _sink(ERule::ArrivalTrue, fmt::format("NodePassed was raised for {} nodes only.", _passedCount));
    }
    if (truth.nodeID != target || truth.bDriving)
    {
        _sink(ERule::ArrivalTrue, fmt::format("the robot is at node '{}' or still drives.", truth.nodeID));
    }
    _end = EEnd::Arrived;
}

void DriveChecker::OnRejected(const Planning::DriveRejected& event, const RobotTruth& truth)
{
    if (!IsOpen(event.driveID, event))
    {
        return;
    }
    if (truth.bDriving)
    {
        _sink(ERule::NothingKept, fmt::format("{} was raised, and the robot still drives.", DescribeEvent(event)));
    }
    _end = EEnd::Rejected;
}

void DriveChecker::OnCancelled(const Planning::DriveCancelled& event, const RobotTruth& truth)
{
    if (!IsOpen(event.driveID, event))
    {
        return;
    }
    if (truth.bDriving)
    {
        _sink(ERule::CancelStops, fmt::format("{} was raised, and the robot still drives.", DescribeEvent(event)));
    }
    else if (event.nodeID != truth.nodeID)
    {
        _sink(
            ERule::CancelStops,
            fmt::format("{} was raised; the robot is at node '{}'.", DescribeEvent(event), truth.nodeID));
    }
    _end = EEnd::Cancelled;
}

void DriveChecker::Sample(const RobotTruth& truth, const Planning::StateChanged* stateOrNull)
{
    if (truth.nodeID == _nodeID)
    {
        return;
    }
    const bool bFirst = _nodeID.empty();
    _nodeID = truth.nodeID;
    _visited.insert(truth.nodeID);
    if (!bFirst)
    {
        VerifyEntered(stateOrNull);
    }
}

DriveChecker::EEnd DriveChecker::GetEnd() const noexcept
{
    return _end;
}

std::size_t DriveChecker::GetPassedCount() const noexcept
{
    return _passedCount;
}

const std::set<std::string>& DriveChecker::GetVisited() const noexcept
{
    return _visited;
}

bool DriveChecker::IsOpen(const std::string& driveID, const Planning::RobotEvent& event) const
{
    if (!_knownIDs.contains(driveID))
    {
        _sink(ERule::KnownIDs, fmt::format("{} was raised, of a drive that was not commanded.", DescribeEvent(event)));
        return false;
    }
    if (_drive->driveID != driveID || _end != EEnd::Open)
    {
        _sink(ERule::OneEnd, fmt::format("{} was raised after the end of the drive.", DescribeEvent(event)));
        return false;
    }
    return !_bLost;
}

bool DriveChecker::IsReleased(const std::string& nodeID) const
{
    const auto first = _drive->route.nodes.begin();
    const auto last = first + static_cast<std::ptrdiff_t>(std::min(_drive->releasedCount, _drive->route.nodes.size()));
    return std::ranges::find(first, last, nodeID, &Planning::RouteNode::nodeID) != last;
}

void DriveChecker::VerifyEntered(const Planning::StateChanged* stateOrNull)
{
    if (stateOrNull != nullptr && std::ranges::count(stateOrNull->heldNodeIDs, _nodeID) > 0)
    {
        return;
    }
    const bool bReleased = _drive.has_value() && IsReleased(_nodeID);
    if (_bLost && bReleased)
    {
        if (stateOrNull != nullptr && stateOrNull->lastNodeID != _nodeID) // a state may be raised before the sample
        {
            _sink(ERule::HeldNodes, fmt::format("the robot enters node '{}', which is not in heldNodeIDs.", _nodeID));
        }
        return;
    }
    if (!bReleased)
    {
        _sink(ERule::ReleasedNodesOnly, fmt::format("the robot enters node '{}', which is not released.", _nodeID));
    }
    else if (_end != EEnd::Open)
    {
        _sink(ERule::NothingKept, fmt::format("the robot enters node '{}' after the end of its drive.", _nodeID));
    }
}

} // namespace ACS::AdapterTest
