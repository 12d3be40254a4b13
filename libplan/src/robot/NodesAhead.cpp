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

/// Maximum distance in metres from the line of the edge at which a robot is on the edge: it may leave it in a corridor.
double GetEdgeTolerance(const SiteEdge& edge)
{
    return edge.corridor.has_value() ? STAND_TOLERANCE + std::max(edge.corridor->leftWidth, edge.corridor->rightWidth)
                                     : STAND_TOLERANCE;
}

/// The largest one of the edges from a node to the other.
double GetTolerance(const SiteMap& site, const SiteNode& from, const SiteNode& to)
{
    double tolerance = STAND_TOLERANCE;
    for (const SiteEdge& edge : site.GetEdges())
    {
        if (edge.startNodeID == from.nodeID && edge.endNodeID == to.nodeID)
        {
            tolerance = std::max(tolerance, GetEdgeTolerance(edge));
        }
    }
    return tolerance;
}

/// Between the two nodes, at most this distance beside the line, and no longer on the first.
bool IsBetween(const StateChanged& state, const SiteNode& from, const SiteNode& to, double mostBeside)
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
    return along > tolerance && along <= length + tolerance && beside <= mostBeside;
}

/// Whether the robot may be on a curve of the edge: a curve is inside the box of its control points.
bool IsNearCurve(const StateChanged& state, const SiteEdge& edge)
{
    const double tolerance = GetEdgeTolerance(edge);
    return std::ranges::any_of(edge.rules, [&state, tolerance](const SiteEdgeRule& rule) {
        if (!rule.trajectory.has_value())
        {
            return false;
        }
        const auto [left, right] = std::ranges::minmax(rule.trajectory->points, {}, &Core::CurvePoint::x);
        const auto [bottom, top] = std::ranges::minmax(rule.trajectory->points, {}, &Core::CurvePoint::y);
        return state.x >= left.x - tolerance && state.x <= right.x + tolerance && state.y >= bottom.y - tolerance
            && state.y <= top.y + tolerance;
    });
}

/// As between two nodes of a straight edge, for those with a curve.
std::vector<std::size_t> FindNodesOfCurve(
    const SiteMap& site,
    const StateChanged& state,
    std::size_t node,
    std::span<const std::size_t> ahead)
{
    const std::vector<SiteNode>& nodes = site.GetNodes();
    std::size_t from = node;
    for (const std::size_t next : ahead)
    {
        const bool bNear = std::ranges::any_of(site.GetEdges(), [&](const SiteEdge& edge) {
            return edge.startNodeID == nodes[from].nodeID && edge.endNodeID == nodes[next].nodeID
                && IsNearCurve(state, edge);
        });
        if (bNear)
        {
            return from == node ? std::vector<std::size_t>{next} : std::vector<std::size_t>{from, next};
        }
        from = next;
    }
    return {};
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
        if (IsBetween(*stateOrNull, nodes[from], nodes[next], GetTolerance(site, nodes[from], nodes[next])))
        {
            return from == node ? std::vector<std::size_t>{next} : std::vector<std::size_t>{from, next};
        }
        from = next;
    }
    return FindNodesOfCurve(site, *stateOrNull, node, ahead);
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
        const bool bBetween =
            IsBetween(state, own, site.GetNodes()[other], GetEdgeTolerance(edge)) || IsNearCurve(state, edge);
        if (bBetween && std::ranges::count(beside, other) == 0)
        {
            beside.push_back(other);
        }
    }
    return distance <= deviation ? std::vector<std::size_t>() : beside;
}

} // namespace ACS::Planning
