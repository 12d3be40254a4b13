#include "why/BlockedPlaces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace ACS::Acsctl
{

BlockedPlaces::BlockedPlaces(const SiteAnswer& site)
    : _site(site)
{
}

bool BlockedPlaces::IsAtStation(const BlockInfo& block, std::string_view stationID) const
{
    if (block.kind == "station")
    {
        return block.id == stationID;
    }
    const auto station = std::ranges::find(_site.stations, stationID, &StationInfo::stationID);
    return block.kind == "node" && station != _site.stations.end()
        && std::ranges::find(station->nodeIDs, block.id) != station->nodeIDs.end();
}

bool BlockedPlaces::IsOnRoute(const BlockInfo& block, const RobotInfo& robot) const
{
    if (block.kind == "node")
    {
        return std::ranges::find(robot.route, block.id, &RouteNode::nodeID) != robot.route.end();
    }
    const auto edge = std::ranges::find(_site.edges, block.id, &EdgeInfo::edgeID);
    if (block.kind != "edge" || edge == _site.edges.end())
    {
        return false;
    }
    std::string before = robot.node.value_or("");
    for (const RouteNode& node : robot.route)
    {
        if (before == edge->startNodeID && node.nodeID == edge->endNodeID)
        {
            return true;
        }
        before = node.nodeID;
    }
    return false;
}

bool BlockedPlaces::IsNamed(const BlockInfo& block, const WaitsInfo& waits)
{
    const std::string name = fmt::format("{} {} is blocked", block.kind, block.id);
    const auto has = [&name](const std::string& text) {
        return text.find(name) != std::string::npos;
    };
    return has(waits.message)
        || std::ranges::any_of(waits.robots, [&has](const RobotReason& robot) { return has(robot.reason); });
}

} // namespace ACS::Acsctl
