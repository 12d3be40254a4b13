#include <acs/plan/EPlanningError.hpp>
#include <acs/plan/SiteMap.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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
        const auto slow = std::ranges::find_if(edge.rules, [](const SiteEdgeRule& rule) {
            return rule.maxSpeed.has_value() && !(*rule.maxSpeed > 0);
        });
        if (slow != edge.rules.end())
        {
            return Refuse(
                fmt::format("edges[{}].vehicleTypeEdgeProperties[{}].maxSpeed", i, slow - edge.rules.begin()),
                "a speed greater than 0",
                fmt::format("{}", *slow->maxSpeed));
        }
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
