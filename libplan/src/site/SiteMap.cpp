#include "site/TrajectoryFault.hpp"
#include <acs/plan/EPlanningError.hpp>
#include <acs/plan/SiteMap.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_set>
#include <utility>

namespace ACS::Planning
{

namespace
{

template <typename TRule>
const TRule* FindAmongOrNull(const std::vector<TRule>& rules, std::string_view vehicleTypeID) noexcept
{
    const auto found = std::ranges::find(rules, vehicleTypeID, &TRule::vehicleTypeID);
    return found == rules.end() ? nullptr : &*found;
}

tl::unexpected<Core::Error> Refuse(std::string path, std::string expected, std::string found)
{
    return Core::Fail(EPlanningError::InvalidSite, std::move(path), std::move(expected), std::move(found));
}

/// Each type has one rule at most, and a vehicle performs all actions of a rule each time that it is there.
template <typename TRule>
Core::Result<void> CheckRules(const std::vector<TRule>& rules)
{
    std::unordered_set<std::string_view> vehicleTypeIDs;
    for (std::size_t i = 0; i < rules.size(); ++i)
    {
        if (!vehicleTypeIDs.insert(rules[i].vehicleTypeID).second)
        {
            return Refuse(
                fmt::format("[{}].vehicleTypeId", i),
                "a vehicle type that no other entry of this list has",
                rules[i].vehicleTypeID);
        }
        if (rules[i].actions.size() > MOST_ACTIONS)
        {
            return Refuse(
                fmt::format("[{}].actions", i),
                fmt::format("at most {} actions", MOST_ACTIONS),
                fmt::format("{}", rules[i].actions.size()));
        }
    }
    return {};
}

Core::Result<void> PutPath(Core::Result<void> checked, const std::string& path)
{
    if (!checked.has_value())
    {
        checked.error().path.insert(0, path);
    }
    return checked;
}

/// Nodes within this distance are at the same position.
constexpr double SAME_PLACE = 0.01;

/// By node, in metres.
std::vector<double> MeasureDeviations(const std::vector<SiteNode>& nodes)
{
    std::vector<std::size_t> byX(nodes.size());
    std::iota(byX.begin(), byX.end(), std::size_t{0});
    std::ranges::sort(byX, {}, [&nodes](std::size_t index) { return nodes[index].x; });
    std::vector<double> deviations(nodes.size(), LARGEST_DEVIATION);
    for (auto left = byX.begin(); left != byX.end(); ++left)
    {
        const SiteNode& node = nodes[*left];
        for (auto right = left + 1; right != byX.end() && nodes[*right].x - node.x < 2 * LARGEST_DEVIATION; ++right)
        {
            const double distance = GetDistance(node, nodes[*right]);
            if (distance > SAME_PLACE && nodes[*right].mapID == node.mapID)
            {
                deviations[*left] = std::min(deviations[*left], distance / 2);
                deviations[*right] = std::min(deviations[*right], distance / 2);
            }
        }
    }
    return deviations;
}

} // namespace

const SiteNodeRule* SiteNode::FindRuleOrNull(std::string_view vehicleTypeID) const noexcept
{
    return FindAmongOrNull(rules, vehicleTypeID);
}

bool SiteEdgeRule::IsPermitted(ELoad load) const noexcept
{
    const SiteLoadRestriction restriction = loadRestriction.value_or(SiteLoadRestriction{});
    return (restriction.bUnloaded || load == ELoad::Loaded) && (restriction.bLoaded || load == ELoad::Empty);
}

const SiteEdgeRule* SiteEdge::FindRuleOrNull(std::string_view vehicleTypeID) const noexcept
{
    return FindAmongOrNull(rules, vehicleTypeID);
}

Core::Result<SiteMap> SiteMap::Create(
    std::vector<SiteNode> nodes,
    std::vector<SiteEdge> edges,
    std::vector<SiteStation> stations)
{
    SiteMap site;
    site._nodes = std::move(nodes);
    site._edges = std::move(edges);
    site._stations = std::move(stations);
    Core::Result<void> checked = site.IndexNodes();
    if (checked.has_value())
    {
        site._deviations = MeasureDeviations(site._nodes);
        checked = site.CheckEdges();
    }
    if (checked.has_value())
    {
        checked = site.IndexStations();
    }
    if (!checked.has_value())
    {
        return tl::unexpected(std::move(checked.error()));
    }
    return site;
}

Core::Result<void> SiteMap::IndexNodes()
{
    if (_nodes.empty())
    {
        return Refuse("nodes", "at least one node", "none");
    }
    for (std::size_t i = 0; i < _nodes.size(); ++i)
    {
        if (_nodes[i].nodeID.empty() || !_nodeIndices.emplace(_nodes[i].nodeID, i).second)
        {
            return Refuse(fmt::format("nodes[{}].nodeId", i), "an id that no other node has", _nodes[i].nodeID);
        }
        Core::Result<void> checked =
            PutPath(CheckRules(_nodes[i].rules), fmt::format("nodes[{}].vehicleTypeNodeProperties", i));
        if (!checked.has_value())
        {
            return checked;
        }
    }
    return {};
}

Core::Result<void> SiteMap::CheckEdges() const
{
    std::unordered_set<std::string> edgeIDs;
    for (std::size_t i = 0; i < _edges.size(); ++i)
    {
        const SiteEdge& edge = _edges[i];
        if (edge.edgeID.empty() || !edgeIDs.insert(edge.edgeID).second)
        {
            return Refuse(fmt::format("edges[{}].edgeId", i), "an id that no other edge has", edge.edgeID);
        }
        if (!_nodeIndices.contains(edge.startNodeID))
        {
            return Refuse(fmt::format("edges[{}].startNodeId", i), "the id of a node", edge.startNodeID);
        }
        if (!_nodeIndices.contains(edge.endNodeID) || edge.endNodeID == edge.startNodeID)
        {
            return Refuse(fmt::format("edges[{}].endNodeId", i), "the id of another node", edge.endNodeID);
        }
        Core::Result<void> checked = CheckRules(edge.rules);
        for (std::size_t rule = 0; checked.has_value() && rule < edge.rules.size(); ++rule)
        {
            checked = PutPath(CheckRule(edge, edge.rules[rule]), fmt::format("[{}].", rule));
        }
        if (!checked.has_value())
        {
            return PutPath(std::move(checked), fmt::format("edges[{}].vehicleTypeEdgeProperties", i));
        }
    }
    return {};
}

Core::Result<void> SiteMap::CheckRule(const SiteEdge& edge, const SiteEdgeRule& rule) const
{
    if (rule.maxSpeed.has_value() && !(*rule.maxSpeed > 0))
    {
        return Refuse("maxSpeed", "a speed greater than 0", fmt::format("{}", *rule.maxSpeed));
    }
    if (rule.minHeight.has_value() && rule.maxHeight.has_value() && *rule.minHeight > *rule.maxHeight)
    {
        return Refuse(
            "minHeight",
            fmt::format("at most maxHeight, {}", *rule.maxHeight),
            fmt::format("{}", *rule.minHeight));
    }
    if (!rule.orientationType.empty() && rule.orientationType != "GLOBAL" && rule.orientationType != "TANGENTIAL")
    {
        return Refuse("orientationType", "GLOBAL or TANGENTIAL", rule.orientationType);
    }
    if (const std::string fault =
            rule.trajectory.has_value() ? FindTrajectoryFault(*rule.trajectory, edge, *this) : std::string();
        !fault.empty())
    {
        return Refuse("trajectory", "a valid trajectory", fault);
    }
    return {};
}

Core::Result<void> SiteMap::IndexStations()
{
    for (std::size_t i = 0; i < _stations.size(); ++i)
    {
        const SiteStation& station = _stations[i];
        if (station.stationID.empty() || !_stationIndices.emplace(station.stationID, i).second)
        {
            return Refuse(
                fmt::format("stations[{}].stationId", i),
                "an id that no other station has",
                station.stationID);
        }
        if (station.nodeIDs.empty())
        {
            return Refuse(fmt::format("stations[{}].interactionNodeIds", i), "at least one node", "none");
        }
        for (std::size_t node = 0; node < station.nodeIDs.size(); ++node)
        {
            if (!_nodeIndices.contains(station.nodeIDs[node]))
            {
                return Refuse(
                    fmt::format("stations[{}].interactionNodeIds[{}]", i, node),
                    "the id of a node",
                    station.nodeIDs[node]);
            }
            _stationIndicesByNode.emplace(station.nodeIDs[node], i); // the first that has it
        }
    }
    return {};
}

const std::vector<SiteNode>& SiteMap::GetNodes() const noexcept
{
    return _nodes;
}

const std::vector<SiteEdge>& SiteMap::GetEdges() const noexcept
{
    return _edges;
}

const std::vector<SiteStation>& SiteMap::GetStations() const noexcept
{
    return _stations;
}

const SiteNode* SiteMap::FindNodeOrNull(std::string_view nodeID) const
{
    const auto found = _nodeIndices.find(nodeID);
    return found == _nodeIndices.end() ? nullptr : &_nodes[found->second];
}

std::optional<std::size_t> SiteMap::FindNodeIndexOrNull(std::string_view nodeID) const
{
    const auto found = _nodeIndices.find(nodeID);
    return found == _nodeIndices.end() ? std::nullopt : std::optional(found->second);
}

double SiteMap::GetAllowedDeviation(std::size_t nodeIndex) const
{
    return _deviations[nodeIndex];
}

double SiteMap::GetLength(const SiteEdge& edge, const SiteEdgeRule& rule) const
{
    if (!rule.trajectory.has_value())
    {
        return GetDistance(*FindNodeOrNull(edge.startNodeID), *FindNodeOrNull(edge.endNodeID));
    }
    constexpr double SPACING = 0.05;
    constexpr std::size_t MAXIMUM_POINTS = 1'000;
    const std::vector<Core::MapPoint> points = Core::NurbsCurve(*rule.trajectory).Sample(SPACING, MAXIMUM_POINTS);
    double length = 0;
    for (std::size_t i = 1; i < points.size(); ++i)
    {
        length += std::hypot(points[i].x - points[i - 1].x, points[i].y - points[i - 1].y);
    }
    return length;
}

const SiteStation* SiteMap::FindStationOrNull(std::string_view stationID) const
{
    const auto found = _stationIndices.find(stationID);
    return found == _stationIndices.end() ? nullptr : &_stations[found->second];
}

const SiteStation* SiteMap::FindStationAtOrNull(std::string_view nodeID) const
{
    const auto found = _stationIndicesByNode.find(nodeID);
    return found == _stationIndicesByNode.end() ? nullptr : &_stations[found->second];
}

bool SiteMap::HasVehicleType(std::string_view vehicleTypeID) const noexcept
{
    return std::ranges::any_of(_nodes, [vehicleTypeID](const SiteNode& node) {
        return node.FindRuleOrNull(vehicleTypeID) != nullptr;
    });
}

double GetDistance(const SiteNode& from, const SiteNode& to) noexcept
{
    return std::hypot(to.x - from.x, to.y - from.y);
}

} // namespace ACS::Planning
