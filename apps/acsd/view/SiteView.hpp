#pragma once

#include <acs/core/Now.hpp>

#include <optional>
#include <string>
#include <vector>

namespace ACS::Acsd
{

struct SiteNodeView
{
    std::string nodeID;
    double x = 0; ///< Metres.
    double y = 0; ///< Metres.
    std::string mapID;

    bool operator==(const SiteNodeView&) const = default;
};

struct SiteEdgeView
{
    std::string edgeID;
    std::string startNodeID;
    std::string endNodeID;
    /// Points along a curved edge, from node to node, in metres; nullopt: a straight line.
    std::optional<std::vector<std::vector<double>>> trajectory;

    bool operator==(const SiteEdgeView&) const = default;
};

struct SiteStationView
{
    std::string stationID;
    std::vector<std::string> nodeIDs; ///< Its docks.

    bool operator==(const SiteStationView&) const = default;
};

/// A node, an edge or a station that the operator has blocked.
struct BlockView
{
    std::string kind; ///< "node", "edge", "station"
    std::string placeID;
    std::string reason; ///< May be empty.
    Core::WallTime since;

    bool operator==(const BlockView&) const = default;
};

/// The floor, as the operator sees it.
struct SiteView
{
    std::vector<SiteNodeView> nodes;
    std::vector<SiteEdgeView> edges;
    std::vector<SiteStationView> stations;
    std::vector<BlockView> blocked;

    bool operator==(const SiteView&) const = default;
};

} // namespace ACS::Acsd
