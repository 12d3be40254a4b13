#include "traffic/PlaceTracker.hpp"

#include "robot/NodesAhead.hpp"
#include <acs/core/ShortText.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace ACS::Planning
{

PlaceTracker::PlaceTracker(EngineState& engine)
    : _site(engine.site),
      _fleet(engine.fleet),
      _transaction(engine.transaction),
      _traffic(engine.site, engine.options.clearance)
{
}

void PlaceTracker::NoteMovable(const Robot& robot)
{
    const bool bMovable = robot.IsUsable() && !robot.control.pause.IsPaused();
    if (_traffic.IsMovable(robot.index) != bMovable)
    {
        _traffic.SetMovable(robot.index, bMovable);
        ++_standingChanges;
        _transaction.RequestDispatch();
    }
}

void PlaceTracker::NoteAllMovable()
{
    std::ranges::for_each(_fleet, [this](const Robot& robot) { NoteMovable(robot); });
}

void PlaceTracker::Place(Robot& robot)
{
    const std::optional<std::size_t> node = FindNodeOrNull(robot);
    if (!node.has_value())
    {
        OnPositionLost(robot);
        return;
    }
    const std::vector<std::size_t> claim = ListClaimed(robot, *node);
    std::vector<std::size_t> ahead = FindNodesAhead(
        _site,
        IsPoseLost(robot, robot.view.state->lastNodeID) ? std::nullopt : robot.view.state,
        *node,
        ListSupposedAhead(robot, *node));
    if (ahead.empty())
    {
        ahead = FindNodesBeside(_site, *robot.view.state, *node);
    }
    const std::optional<std::size_t> heading = GetHeadingOrNull(robot, ahead);
    std::erase_if(ahead, [&claim](std::size_t between) { return std::ranges::count(claim, between) > 0; });
    std::vector<std::size_t> held(claim);
    held.insert(held.end(), ahead.begin(), ahead.end());
    if (robot.place.bPlaced && node == robot.place.node && held == robot.place.heldNodes
        && heading == robot.place.heading)
    {
        return;
    }
    std::erase_if(robot.place.possibleNodes, [&ahead](std::size_t supposed) {
        return std::ranges::count(ahead, supposed) == 0;
    });
    ReleasePossibleNodes(claim);
    if (!_traffic.TryStand(robot.index, *node, std::span(claim).subspan(1), ahead))
    {
        const auto taken = std::ranges::find_if(claim, [this, &robot](std::size_t other) {
            return _traffic.GetHolderOrNull(other).value_or(robot.index) != robot.index;
        });
        const std::size_t holder = *_traffic.GetHolderOrNull(*taken);
        robot.place.bPlaced = false;
        // The robot is there all the same: no other robot gets these nodes.
        _traffic.HoldPossible(robot.index, held);
        _transaction.RaiseAlarm(MakePlaceAlarm(
            robot,
            fmt::format(
                "Robot {} node {}, which is reserved for {}. Move the robot to a free node.",
                taken == claim.begin() ? "is on" : "may still drive to",
                _site.GetNodes()[*taken].nodeID,
                _fleet[holder].GetID())));
        return;
    }
    _transaction.ClearAlarm(MakePlaceAlarm(robot, {}));
    // An order of another master may be cancelled between two nodes, too.
    robot.place.aheadNodes.assign(held.begin() + 1, held.end());
    robot.parking.refusals = node == robot.place.node ? robot.parking.refusals : 0;
    robot.place.node = node;
    robot.place.heldNodes = std::move(held);
    robot.place.heading = heading;
    _traffic.SetHeading(robot.index, heading);
    robot.place.bPlaced = true;
    robot.search.plannedRoute.reset();
    ++_standingChanges;
    const std::string& nodeID = _site.GetNodes()[*node].nodeID;
    if (const SiteStation* stationOrNull = _site.FindStationAtOrNull(nodeID); stationOrNull != nullptr)
    {
        robot.place.position = stationOrNull->stationID;
    }
    _transaction.RequestDispatch();
}

/// Some vehicles forget their last node in manual mode. Where such a one is shows its position on its last drive.
std::optional<std::size_t> PlaceTracker::FindNodeOrNull(const Robot& robot) const
{
    const StateChanged& state = *robot.view.state;
    if (!state.lastNodeID.empty() || !robot.place.bPlaced || !robot.place.node.has_value() || !state.bPoseKnown)
    {
        return _site.FindNodeIndexOrNull(state.lastNodeID);
    }
    const std::size_t last = *robot.place.node;
    std::vector<std::size_t> passed{last};
    passed.insert(passed.end(), robot.place.aheadNodes.begin(), robot.place.aheadNodes.end());
    const auto isOn = [this, &state](std::size_t node) {
        const SiteNode& place = _site.GetNodes()[node];
        return std::hypot(state.x - place.x, state.y - place.y) <= RouteNode{}.allowedDeviation;
    };
    if (const auto on = std::ranges::find_if(passed, isOn); on != passed.end())
    {
        return *on;
    }
    const std::vector<std::size_t> between = FindNodesAhead(_site, state, last, robot.place.aheadNodes);
    if (!state.bDriving && between.size() > 1)
    {
        return between.front();
    }
    const bool bThere = state.bDriving || !between.empty() || !FindNodesBeside(_site, state, last).empty();
    return bThere ? std::optional(last) : std::nullopt;
}

void PlaceTracker::OnPositionLost(Robot& robot)
{
    const bool bWasPlaced = std::exchange(robot.place.bPlaced, false);
    const std::string& nodeID = robot.view.state->lastNodeID;
    if (!bWasPlaced && nodeID.empty())
    {
        return; // Mostly it was switched on and has not found its position yet. An alarm of before stays.
    }
    _transaction.RaiseAlarm(MakePlaceAlarm(
        robot,
        nodeID.empty()
            ? "Robot position unknown: the robot reports no node. Move it to a free node of the map."
            : fmt::format(
                "Robot is on node {}, which is not on the map. Move the robot to a free node, or correct the map.",
                Core::ShortenText(nodeID))));
}

std::optional<std::size_t> PlaceTracker::GetHeadingOrNull(const Robot& robot, std::span<const std::size_t> ahead)
{
    const bool bKnown = robot.view.state.has_value() && robot.view.state->bPoseKnown && !robot.view.state->bDriving;
    return bKnown && ahead.size() == 1 ? std::optional(ahead.front()) : std::nullopt;
}

bool PlaceTracker::IsPoseLost(const Robot& robot, std::string_view nodeID)
{
    const std::optional<StateChanged>& state = robot.view.state;
    return state.has_value() && !state->bPoseKnown && (robot.view.bHadPose || state->lastNodeID != nodeID);
}

std::vector<std::size_t> PlaceTracker::ListClaimed(const Robot& robot, std::size_t node) const
{
    std::vector<std::size_t> claim{node};
    for (const std::string& heldID : robot.view.state->heldNodeIDs)
    {
        const std::optional<std::size_t> held = _site.FindNodeIndexOrNull(heldID);
        if (held.has_value() && std::ranges::count(claim, *held) == 0)
        {
            claim.push_back(*held);
        }
    }
    return claim;
}

Alarm PlaceTracker::MakePlaceAlarm(const Robot& robot, std::string message)
{
    return MakeAlarm(robot.GetID(), ALARM_PLACE, EAlarmLevel::Heavy, std::move(message));
}

void PlaceTracker::ReservePossibleNodes()
{
    for (const Robot& robot : _fleet)
    {
        if (!robot.place.bPlaced)
        {
            _traffic.HoldPossible(robot.index, robot.place.possibleNodes);
        }
    }
}

void PlaceTracker::ReleasePossibleNodes(std::span<const std::size_t> nodes)
{
    for (Robot& robot : _fleet)
    {
        for (const std::size_t node : nodes)
        {
            if (std::erase(robot.place.possibleNodes, node) > 0)
            {
                std::erase(robot.place.aheadNodes, node);
                std::erase(robot.place.heldNodes, node);
                _traffic.Disown(robot.index, node);
            }
        }
    }
}

void PlaceTracker::ForgetPossibleNodes(Robot& robot)
{
    for (const std::size_t node : std::exchange(robot.place.possibleNodes, {}))
    {
        _traffic.Disown(robot.index, node);
    }
    robot.changes.MarkWork();
    _transaction.RequestDispatch();
}

std::vector<std::size_t> PlaceTracker::ListSupposedAhead(const Robot& robot, std::size_t node)
{
    const RobotPlace& place = robot.place;
    if (node == place.node)
    {
        return place.aheadNodes;
    }
    for (const std::vector<std::size_t>& supposed : {place.possibleNodes, place.aheadNodes})
    {
        if (const auto here = std::ranges::find(supposed, node); here != supposed.end())
        {
            return {here + 1, supposed.end()};
        }
    }
    return {};
}

std::vector<std::string> PlaceTracker::ListNodes(const Robot& robot) const
{
    std::span<const std::size_t> nodes = robot.place.possibleNodes;
    if (robot.drive.has_value())
    {
        nodes = std::span(robot.drive->nodes).subspan(robot.drive->passed);
    }
    else if (!robot.place.bPlaced && robot.view.state.has_value())
    {
        return robot.work.GetStored().nodeIDs; // position lost
    }
    else if (!robot.place.heldNodes.empty())
    {
        nodes = robot.place.heldNodes; // also if the position is lost, and then the connection
    }
    std::vector<std::string> nodeIDs;
    for (const std::size_t node : nodes)
    {
        nodeIDs.push_back(_site.GetNodes()[node].nodeID);
    }
    return nodeIDs;
}

void PlaceTracker::NoteStandingChanged() noexcept
{
    ++_standingChanges;
}

std::uint64_t PlaceTracker::GetStandingChanges() const noexcept
{
    return _standingChanges;
}

Traffic& PlaceTracker::GetTraffic() noexcept
{
    return _traffic;
}

const Traffic& PlaceTracker::GetTraffic() const noexcept
{
    return _traffic;
}

} // namespace ACS::Planning
