#include "RingSite.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <iterator>
#include <numbers>
#include <utility>
#include <vector>

namespace ACS::Load::RingSite
{
namespace
{

constexpr std::string_view MAP = "floor-1";

struct Place
{
    double x = 0.0;
    double y = 0.0;
};

Place GetPlace(std::size_t index)
{
    const double step = 2.0 * std::numbers::pi / static_cast<double>(NODES);
    const double angle = step * static_cast<double>(index % NODES);
    return {METRES_APART / step * std::cos(angle), METRES_APART / step * std::sin(angle)};
}

std::string GetName(std::size_t index)
{
    return fmt::format("N{:03}", index % NODES);
}

} // namespace

std::string WriteLIF()
{
    std::string nodes;
    std::string edges;
    for (std::size_t index = 0; index < NODES; ++index)
    {
        const std::string_view comma = index == 0 ? "" : ",";
        const Place place = GetPlace(index);
        fmt::format_to(
            std::back_inserter(nodes),
            R"({}{{"nodeId":"{}","mapId":"{}","nodePosition":{{"x":{},"y":{}}},"vehicleTypeNodeProperties":[{{"vehicleTypeId":"any"}}]}})",
            comma,
            GetName(index),
            MAP,
            place.x,
            place.y);
        fmt::format_to(
            std::back_inserter(edges),
            R"({}{{"edgeId":"{}-{}","startNodeId":"{}","endNodeId":"{}","vehicleTypeEdgeProperties":[{{"vehicleTypeId":"any","maxSpeed":{}}}]}})",
            comma,
            GetName(index),
            GetName(index + 1),
            GetName(index),
            GetName(index + 1),
            METRES_PER_SECOND);
    }
    return fmt::format(
        R"({{"metaInformation":{{"projectIdentification":"ring","creator":"bench","exportTimestamp":"2026-01-01T00:00:00Z","lifVersion":"1.0.0"}},"layouts":[{{"layoutId":"ring","layoutVersion":"1","nodes":[{}],"edges":[{}],"stations":[]}}]}})",
        nodes,
        edges);
}

std::size_t GetNodeIndex(const std::string& nodeID)
{
    return nodeID.empty() ? 0 : std::strtoul(nodeID.c_str() + 1, nullptr, 10);
}

VDA5050::OrderBuilder MakeRoute(std::string orderID, std::size_t firstNode, std::size_t edges)
{
    std::vector<VDA5050::OrderNode> nodes(edges + 1);
    std::vector<VDA5050::OrderEdge> ways(edges);
    for (std::size_t index = 0; index < nodes.size(); ++index)
    {
        const Place place = GetPlace(firstNode + index);
        nodes[index].nodeID = GetName(firstNode + index);
        VDA5050::NodePosition& position = nodes[index].nodePosition.emplace();
        position.x = place.x;
        position.y = place.y;
        position.mapID = MAP;
    }
    for (std::size_t index = 0; index < ways.size(); ++index)
    {
        ways[index].edgeID = nodes[index].nodeID + "-" + nodes[index + 1].nodeID;
        ways[index].maxSpeed = METRES_PER_SECOND;
    }
    return *VDA5050::OrderBuilder::Create(std::move(orderID), std::move(nodes), std::move(ways));
}

} // namespace ACS::Load::RingSite
