#include "FloorBuilder.hpp"

#include "Floor.hpp"

#include <algorithm>
#include <span>

namespace ACS::Testing
{

using namespace Planning; // NOLINT(google-build-using-namespace): a test of that namespace

void FloorBuilder::AddNode(const std::string& nodeID, double x, double y)
{
    if (std::ranges::count(_nodes, nodeID, &SiteNode::nodeID) == 0)
    {
        _nodes.push_back({nodeID, x, y, "floor", {{FLEET_TYPE, std::nullopt}}});
    }
}

void FloorBuilder::AddLane(const std::string& from, const std::string& to, bool bBothWays)
{
    SiteEdgeRule rule;
    rule.vehicleTypeID = FLEET_TYPE;
    rule.maxSpeed = 1;
    _edges.push_back({from + ">" + to, from, to, {rule}});
    if (bBothWays)
    {
        _edges.push_back({to + ">" + from, to, from, {rule}});
    }
}

void FloorBuilder::Restrict(std::size_t edges, SiteLoadRestriction restriction)
{
    for (SiteEdge& edge : std::span(_edges).last(edges))
    {
        edge.rules.front().loadRestriction = restriction;
    }
}

void FloorBuilder::AddDock(const std::string& laneID, const std::string& stationID, double x, double y)
{
    AddNode(MakeDockID(stationID), x, y);
    AddLane(laneID, MakeDockID(stationID), true);
    _stations.push_back({stationID, {MakeDockID(stationID)}});
}

std::pair<double, double> FloorBuilder::GetPosition(const std::string& nodeID) const
{
    const auto node = std::ranges::find(_nodes, nodeID, &SiteNode::nodeID);
    return {node->x, node->y};
}

SiteMap FloorBuilder::Build()
{
    return *SiteMap::Create(std::move(_nodes), std::move(_edges), std::move(_stations));
}

} // namespace ACS::Testing
