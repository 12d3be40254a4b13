#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/NurbsCurve.hpp>
#include <acs/core/Result.hpp>
#include <acs/plan/ELoad.hpp>
#include <acs/plan/SiteAction.hpp>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace ACS::Planning
{

/// Of one rule of a node or edge. A vehicle performs the required ones each time, so more of them are an error of the map.
inline constexpr std::size_t MOST_ACTIONS = 100;

/// How a vehicle type uses a node. A type without a rule may not use the node.
struct SiteNodeRule
{
    std::string vehicleTypeID;
    std::optional<double> theta;          ///< Radians; absent: any.
    std::vector<SiteAction> actions = {}; ///< What the vehicle may or must do on the node.

    bool operator==(const SiteNodeRule&) const = default;
};

/// A point where a vehicle can be, and where routes begin, end and branch.
struct ACS_API SiteNode
{
    std::string nodeID;              ///< Unique among the nodes of the map.
    double x = 0;                    ///< Metres.
    double y = 0;                    ///< Metres.
    std::string mapID;               ///< May be empty.
    std::vector<SiteNodeRule> rules; ///< At most one for each vehicle type.

    /// Null if the type may not use the node.
    [[nodiscard]] const SiteNodeRule* FindRuleOrNull(std::string_view vehicleTypeID) const noexcept;

    bool operator==(const SiteNode&) const = default;
};

/// Which vehicles may use an edge.
struct SiteLoadRestriction
{
    bool bUnloaded = true; ///< Vehicles without a load may.
    bool bLoaded = true;   ///< Vehicles with a load may.

    bool operator==(const SiteLoadRestriction&) const = default;
};

/// How far a vehicle may leave an edge, left and right of the driving direction, to avoid obstacles.
struct SiteCorridor
{
    double leftWidth = 0;  ///< Metres.
    double rightWidth = 0; ///< Metres.
    /// Whether the contour of the vehicle with its load must stay inside; otherwise its kinematic center.
    bool bContour = false;

    bool operator==(const SiteCorridor&) const = default;
};

/// How a vehicle type uses an edge. A type without a rule may not use the edge.
struct ACS_API SiteEdgeRule
{
    std::string vehicleTypeID;
    std::optional<double> maxSpeed;         ///< Metres per second, > 0.
    std::optional<double> maxRotationSpeed; ///< Radians per second.
    std::optional<double> orientation;      ///< Radians (degrees in LIF).
    std::string orientationType;            ///< "TANGENTIAL", "GLOBAL" or empty.
    std::optional<bool> bRotationAllowed;   ///< Whether the vehicle may rotate on the edge; absent: not stated.
    std::optional<SiteLoadRestriction> loadRestriction; ///< Absent: with and without a load.
    std::optional<double> minHeight = {};               ///< Metres; of the load handling device at least.
    std::optional<double> maxHeight = {};               ///< Metres; of the vehicle with its load at most.
    std::optional<Core::Nurbs> trajectory = {}; ///< Without a fault, from node to node; absent: a straight line.
    std::vector<SiteAction> actions = {};       ///< What the vehicle may or must do on the edge.

    /// Whether a vehicle of the type with this load may use the edge.
    [[nodiscard]] bool IsPermitted(ELoad load) const noexcept;

    bool operator==(const SiteEdgeRule&) const = default;
};

/// A directed connection of two nodes.
struct ACS_API SiteEdge
{
    std::string edgeID;
    std::string startNodeID;
    std::string endNodeID;
    std::vector<SiteEdgeRule> rules;                     ///< At most one for each vehicle type.
    std::optional<SiteCorridor> corridor = std::nullopt; ///< Absent: the vehicle stays on the edge.

    /// Null if the type may not use the edge.
    [[nodiscard]] const SiteEdgeRule* FindRuleOrNull(std::string_view vehicleTypeID) const noexcept;

    bool operator==(const SiteEdge&) const = default;
};

/// A place where robots work, charge or park. Its id is the location of MCS-ACS ("A01.CP01"), or any name for a charger or a
/// parking position.
struct SiteStation
{
    std::string stationID;                       ///< Unique among the stations of the map.
    std::vector<std::string> nodeIDs;            ///< The docks; at least one.
    std::optional<double> height = std::nullopt; ///< Metres.

    bool operator==(const SiteStation&) const = default;
};

/// Metres. The largest distance from a node at which it counts as reached.
inline constexpr double LARGEST_DEVIATION = 0.5;

/// Nodes, directed edges and stations of a site. Always valid: ids are unique among nodes, among edges and among stations,
/// every referenced node exists, there is at least one node, and no rule contradicts itself or another one of the same node or
/// edge. Immutable; a copy is independent.
class ACS_API SiteMap
{
    struct TextHash
    {
        using is_transparent = void; // NOLINT(readability-identifier-naming): the standard's name

        [[nodiscard]] std::size_t operator()(std::string_view text) const noexcept
        {
            return std::hash<std::string_view>()(text);
        }
    };

    using Index = std::unordered_map<std::string, std::size_t, TextHash, std::equal_to<>>;

    std::vector<SiteNode> _nodes;
    std::vector<SiteEdge> _edges;
    std::vector<SiteStation> _stations;
    Index _nodeIndices;
    Index _stationIndices;
    Index _stationIndicesByNode;
    std::vector<double> _deviations; ///< Of each node.

    SiteMap() = default;

public:
    /// Errors: EPlanningError::InvalidSite, with a path such as "nodes[3].nodeId".
    [[nodiscard]] static Core::Result<SiteMap> Create(
        std::vector<SiteNode> nodes,
        std::vector<SiteEdge> edges,
        std::vector<SiteStation> stations);

    /// In the order of Create; an index of it is a nodeIndex.
    [[nodiscard]] const std::vector<SiteNode>& GetNodes() const noexcept;
    /// In the order of Create; an index of it is an edgeIndex.
    [[nodiscard]] const std::vector<SiteEdge>& GetEdges() const noexcept;
    /// In the order of Create.
    [[nodiscard]] const std::vector<SiteStation>& GetStations() const noexcept;

    /// Null if there is no node of this id.
    [[nodiscard]] const SiteNode* FindNodeOrNull(std::string_view nodeID) const;

    /// Index in GetNodes; nullopt if there is no node of this id.
    [[nodiscard]] std::optional<std::size_t> FindNodeIndexOrNull(std::string_view nodeID) const;

    /// Metres. The node is reached when the vehicle is within this distance: LARGEST_DEVIATION, and at most half the distance
    /// to the nearest other node.
    [[nodiscard]] double GetAllowedDeviation(std::size_t nodeIndex) const;

    /// Metres along the trajectory of the vehicle type, or along the straight line; the type may use the edge.
    [[nodiscard]] double GetLength(const SiteEdge& edge, const SiteEdgeRule& rule) const;

    /// Null if there is no station of this id.
    [[nodiscard]] const SiteStation* FindStationOrNull(std::string_view stationID) const;

    /// The first station that has the node; null if no station has it.
    [[nodiscard]] const SiteStation* FindStationAtOrNull(std::string_view nodeID) const;

    /// Whether any node has a rule for the vehicle type.
    [[nodiscard]] bool HasVehicleType(std::string_view vehicleTypeID) const noexcept;

private:
    [[nodiscard]] Core::Result<void> IndexNodes();
    [[nodiscard]] Core::Result<void> CheckEdges() const;
    [[nodiscard]] Core::Result<void> CheckRule(const SiteEdge& edge, const SiteEdgeRule& rule) const;
    [[nodiscard]] Core::Result<void> IndexStations();
};

/// Straight-line distance of two nodes in metres. Their maps are not compared.
[[nodiscard]] ACS_API double GetDistance(const SiteNode& from, const SiteNode& to) noexcept;

} // namespace ACS::Planning
