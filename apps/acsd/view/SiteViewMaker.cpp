#include "view/SiteViewMaker.hpp"

#include <acs/core/NurbsCurve.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace ACS::Acsd
{

namespace
{

/// Of the curves that are drawn, in metres.
constexpr double SPACING = 0.25;
constexpr std::size_t MOST_POINTS = 50;

/// Of the first vehicle type that has one: the types of one edge differ by little.
std::optional<std::vector<std::vector<double>>> MakeTrajectoryOrNull(const Planning::SiteEdge& edge)
{
    const auto rule = std::ranges::find_if(edge.rules, [](const Planning::SiteEdgeRule& candidate) {
        return candidate.trajectory.has_value();
    });
    if (rule == edge.rules.end())
    {
        return std::nullopt;
    }
    std::vector<std::vector<double>> points;
    for (const Core::MapPoint& point : Core::NurbsCurve(*rule->trajectory).Sample(SPACING, MOST_POINTS))
    {
        points.push_back({point.x, point.y});
    }
    return points;
}

} // namespace

SiteView MakeSiteView(const Planning::SiteMap& site)
{
    SiteView view;
    for (const Planning::SiteNode& node : site.GetNodes())
    {
        view.nodes.push_back({node.nodeID, node.x, node.y, node.mapID});
    }
    for (const Planning::SiteEdge& edge : site.GetEdges())
    {
        view.edges.push_back({edge.edgeID, edge.startNodeID, edge.endNodeID, MakeTrajectoryOrNull(edge)});
    }
    for (const Planning::SiteStation& station : site.GetStations())
    {
        view.stations.push_back({station.stationID, station.nodeIDs});
    }
    return view;
}

std::vector<BlockView> MakeBlockViews(const std::vector<Planning::Block>& blocks)
{
    std::vector<BlockView> views;
    views.reserve(blocks.size());
    for (const Planning::Block& block : blocks)
    {
        views.push_back({std::string(GetText(block.kind)), block.id, block.reason, block.since});
    }
    return views;
}

} // namespace ACS::Acsd
