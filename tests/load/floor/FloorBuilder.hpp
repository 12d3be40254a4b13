#pragma once

#include <acs/plan/SiteMap.hpp>

#include <string>
#include <utility>
#include <vector>

namespace ACS::Testing
{

inline constexpr double FLOOR_PITCH = 3;  ///< Metres between two nodes of a lane.
inline constexpr double FLOOR_SPUR = 1.5; ///< Metres from a lane to a dock.

/// Collects the nodes, edges and stations of a floor.
class FloorBuilder
{
    std::vector<Planning::SiteNode> _nodes;
    std::vector<Planning::SiteEdge> _edges;
    std::vector<Planning::SiteStation> _stations;

public:
    /// Ignored if there is the node already. Metres.
    void AddNode(const std::string& nodeID, double x, double y);
    void AddLane(const std::string& from, const std::string& to, bool bBothWays);
    /// Only for vehicles with a load, or only for those without; the last edges that were added.
    void Restrict(std::size_t edges, Planning::SiteLoadRestriction restriction);
    /// A dock on a spur at the node of a lane.
    void AddDock(const std::string& laneID, const std::string& stationID, double x, double y);
    [[nodiscard]] std::pair<double, double> GetPosition(const std::string& nodeID) const;
    [[nodiscard]] Planning::SiteMap Build();
};

} // namespace ACS::Testing
