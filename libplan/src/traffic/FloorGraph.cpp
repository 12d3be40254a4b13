#include "traffic/FloorGraph.hpp"

#include "site/DriveTime.hpp"
#include <acs/plan/Router.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ACS::Planning
{

namespace
{

double GetHeading(const SiteNode& from, const SiteNode& to, const SiteEdgeRule& rule)
{
    const double orientation = rule.orientation.value_or(0);
    return rule.orientationType == "GLOBAL" ? orientation : std::atan2(to.y - from.y, to.x - from.x) + orientation;
}

/// Where each node's part begins in a list that is in the order of nodes.
template <typename TList, typename TGetNode>
std::vector<std::size_t> MakeFirsts(const TList& list, std::size_t nodeCount, TGetNode getNode)
{
    std::vector<std::size_t> firsts(nodeCount + 1, 0);
    for (const auto& entry : list)
    {
        ++firsts[getNode(entry) + 1];
    }
    for (std::size_t node = 0; node < nodeCount; ++node)
    {
        firsts[node + 1] += firsts[node];
    }
    return firsts;
}

} // namespace

double GetAngleBetween(double left, double right)
{
    return std::abs(std::remainder(left - right, 2 * std::numbers::pi));
}

bool IsLoadRestricted(const SiteMap& site, std::string_view vehicleTypeID)
{
    return std::ranges::any_of(site.GetEdges(), [vehicleTypeID](const SiteEdge& edge) {
        const SiteEdgeRule* const ruleOrNull = edge.FindRuleOrNull(vehicleTypeID);
        return ruleOrNull != nullptr && !ruleOrNull->IsPermitted(ELoad::Unknown);
    });
}

FloorGraph::FloorGraph(const SiteMap& site, std::string_view vehicleTypeID, ELoad load)
{
    const std::vector<SiteEdge>& edges = site.GetEdges();
    for (std::size_t i = 0; i < edges.size(); ++i)
    {
        const std::size_t from = *site.FindNodeIndexOrNull(edges[i].startNodeID);
        const std::size_t to = *site.FindNodeIndexOrNull(edges[i].endNodeID);
        const SiteNode& fromNode = site.GetNodes()[from];
        const SiteNode& toNode = site.GetNodes()[to];
        const SiteEdgeRule* ruleOrNull = edges[i].FindRuleOrNull(vehicleTypeID);
        if (ruleOrNull == nullptr || !ruleOrNull->IsPermitted(load) || fromNode.FindRuleOrNull(vehicleTypeID) == nullptr
            || toNode.FindRuleOrNull(vehicleTypeID) == nullptr || from == to)
        {
            continue;
        }
        Lane lane;
        lane.from = from;
        lane.to = to;
        lane.edge = i;
        lane.length = site.GetLength(edges[i], *ruleOrNull);
        lane.seconds = GetDriveSeconds(lane.length, ruleOrNull->maxSpeed);
        lane.heading = GetHeading(fromNode, toNode, *ruleOrNull);
        lane.turnSpeed = ruleOrNull->maxRotationSpeed.value_or(0);
        _lanes.push_back(lane);
    }
    std::ranges::stable_sort(_lanes, {}, &Lane::from);
    for (std::size_t lane = 0; lane < _lanes.size(); ++lane)
    {
        _incoming.push_back(lane);
    }
    std::ranges::stable_sort(_incoming, {}, [this](std::size_t lane) { return _lanes[lane].to; });
    _firstLanes = MakeFirsts(_lanes, site.GetNodes().size(), [](const Lane& lane) { return lane.from; });
    _firstIncoming =
        MakeFirsts(_incoming, site.GetNodes().size(), [this](std::size_t lane) { return _lanes[lane].to; });
}

std::size_t FloorGraph::GetNodeCount() const noexcept
{
    return _firstLanes.size() - 1;
}

std::span<const Lane> FloorGraph::GetLanes() const noexcept
{
    return _lanes;
}

std::span<const Lane> FloorGraph::GetLanesFrom(std::size_t node) const
{
    return GetLanes().subspan(_firstLanes[node], _firstLanes[node + 1] - _firstLanes[node]);
}

std::span<const std::size_t> FloorGraph::GetLanesTo(std::size_t node) const
{
    return std::span(_incoming).subspan(_firstIncoming[node], _firstIncoming[node + 1] - _firstIncoming[node]);
}

std::size_t FloorGraph::GetIndex(const Lane& lane) const
{
    return static_cast<std::size_t>(&lane - _lanes.data());
}

double FloorGraph::GetTurnSeconds(const Lane& from, const Lane& to)
{
    const double speed = from.turnSpeed > 0 && to.turnSpeed > 0 ? std::min(from.turnSpeed, to.turnSpeed)
                                                                : std::max(from.turnSpeed, to.turnSpeed);
    return speed > 0 ? GetAngleBetween(from.heading, to.heading) / speed : 0;
}

bool IsDeadEnd(std::span<const FloorGraph> graphs, std::size_t node)
{
    if (graphs.empty() || graphs.front().GetLanesFrom(node).empty())
    {
        return false;
    }
    const std::size_t neighbour = graphs.front().GetLanesFrom(node).front().to;
    return std::ranges::all_of(graphs, [node, neighbour](const FloorGraph& graph) {
        return !graph.GetLanesFrom(node).empty() && !graph.GetLanesTo(node).empty()
            && std::ranges::all_of(
                graph.GetLanesFrom(node),
                [neighbour](const Lane& lane) { return lane.to == neighbour; })
            && std::ranges::all_of(graph.GetLanesTo(node), [&graph, neighbour](std::size_t lane) {
                   return graph.GetLanes()[lane].from == neighbour;
               });
    });
}

} // namespace ACS::Planning
