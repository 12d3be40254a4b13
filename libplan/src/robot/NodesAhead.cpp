#include "robot/NodesAhead.hpp"

#include <acs/plan/RobotCommand.hpp>

#include <algorithm>
#include <cmath>

namespace ACS::Planning
{

namespace
{

/// Maximum distance in metres from a node at which a robot is on it.
constexpr double STAND_TOLERANCE = 0.5;

/// Still on the first of two nodes; the route may pass it again.
bool IsOn(const StateChanged& state, const SiteNode& node, const SiteNode& next)
{
    return std::hypot(state.x - node.x, state.y - node.y) <= std::min(STAND_TOLERANCE, GetDistance(node, next) / 4);
}

/// Between the two nodes, and no longer on the first.
bool IsBetween(const StateChanged& state, const SiteNode& from, const SiteNode& to)
{
    const double length = GetDistance(from, to);
    if (length <= 0)
    {
        return false;
    }
    const double x = state.x - from.x;
    const double y = state.y - from.y;
    const double along = (x * (to.x - from.x) + y * (to.y - from.y)) / length;
    const double beside = std::abs(x * (to.y - from.y) - y * (to.x - from.x)) / length;
    const double tolerance = std::min(STAND_TOLERANCE, length / 4);
    return along > tolerance && along <= length + tolerance && beside <= STAND_TOLERANCE;
}

} // namespace

std::vector<std::size_t> FindNodesAhead(
    const SiteMap& site,
    const std::optional<StateChanged>& stateOrNull,
    std::size_t node,
    std::span<const std::size_t> ahead)
{
    const std::vector<SiteNode>& nodes = site.GetNodes();
    if (!stateOrNull.has_value() || stateOrNull->bDriving)
    {
        return {ahead.begin(), ahead.end()};
    }
    if (ahead.empty() || !stateOrNull->bPoseKnown || IsOn(*stateOrNull, nodes[node], nodes[ahead.front()]))
    {
        return {};
    }
    std::size_t from = node;
    for (const std::size_t next : ahead)
    {
        if (IsBetween(*stateOrNull, nodes[from], nodes[next]))
        {
            return from == node ? std::vector<std::size_t>{next} : std::vector<std::size_t>{from, next};
        }
        from = next;
    }
    return {};
}

std::vector<std::size_t> FindNodesBeside(const SiteMap& site, const StateChanged& state, std::size_t node)
{
    const SiteNode& own = site.GetNodes()[node];
    constexpr double ON_NODE = 0.01; // metres; most robots are, and the edges need no search
    const double distance = std::hypot(state.x - own.x, state.y - own.y);
    if (!state.bPoseKnown || state.bDriving || distance <= ON_NODE)
    {
        return {};
    }
    // Within this distance a drive to the node has reached it.
    double deviation = RouteNode{}.allowedDeviation;
    std::vector<std::size_t> beside;
    for (const SiteEdge& edge : site.GetEdges())
    {
        if (edge.startNodeID != own.nodeID && edge.endNodeID != own.nodeID)
        {
            continue;
        }
        const std::string& otherID = edge.startNodeID == own.nodeID ? edge.endNodeID : edge.startNodeID;
        const std::size_t other = *site.FindNodeIndexOrNull(otherID);
        deviation = std::min(deviation, GetDistance(own, site.GetNodes()[other]) / 2);
        if (IsBetween(state, own, site.GetNodes()[other]) && std::ranges::count(beside, other) == 0)
        {
            beside.push_back(other);
        }
    }
    return distance <= deviation ? std::vector<std::size_t>() : beside;
}

} // namespace ACS::Planning
