#pragma once

#include <acs/core/Result.hpp>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace ACS::Planning
{

/// What a vehicle type does on a node. A type that a node does not name may not use it.
struct SiteNodeRule
{
    std::string vehicleTypeID;
    std::optional<double> theta; ///< Radians; absent: any.

    bool operator==(const SiteNodeRule&) const = default;
};

struct SiteNode
{
    std::string nodeID;
    double x = 0;      ///< Metres.
    double y = 0;      ///< Metres.
    std::string mapID; ///< May be empty.
    std::vector<SiteNodeRule> rules;

    /// Null where the type may not use the node.
    [[nodiscard]] const SiteNodeRule* FindRuleOrNull(std::string_view vehicleTypeID) const noexcept;

    bool operator==(const SiteNode&) const = default;
};

/// How a vehicle type drives along an edge. A type that an edge does not name may not use it.
struct SiteEdgeRule
{
    std::string vehicleTypeID;
    std::optional<double> maxSpeed;         ///< Metres per second, more than 0.
    std::optional<double> maxRotationSpeed; ///< Radians per second.
    std::optional<double> orientation;      ///< Radians (LIF has degrees).
    std::string orientationType;            ///< "TANGENTIAL", "GLOBAL" or empty.
    std::optional<bool> bRotationAllowed;

    bool operator==(const SiteEdgeRule&) const = default;
};

/// One way from a node to another.
struct SiteEdge
{
    std::string edgeID;
    std::string startNodeID;
    std::string endNodeID;
    std::vector<SiteEdgeRule> rules;

    /// Null where the type may not use the edge.
    [[nodiscard]] const SiteEdgeRule* FindRuleOrNull(std::string_view vehicleTypeID) const noexcept;

    bool operator==(const SiteEdge&) const = default;
};

/// A place where robots work. Its id is the MCS location ("A01.CP01"), or any name for a charger or a parking spot.
struct SiteStation
{
    std::string stationID;
    std::vector<std::string> nodeIDs;            ///< Where a robot docks; at least one.
    std::optional<double> height = std::nullopt; ///< Metres.

    bool operator==(const SiteStation&) const = default;
};

/// The floor: nodes, directed edges, stations. Valid by construction: ids are unique (nodes, edges and stations each),
/// everything refers to known nodes, there is a node. Copied with all its content; nodes are addressed by index too.
class SiteMap
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

    SiteMap() = default;

public:
    /// Errors: EPlanningError::InvalidSite, with the path "nodes[3].nodeId" and so on.
    [[nodiscard]] static Core::Result<SiteMap> Create(
        std::vector<SiteNode> nodes,
        std::vector<SiteEdge> edges,
        std::vector<SiteStation> stations);

    [[nodiscard]] const std::vector<SiteNode>& GetNodes() const noexcept;
    [[nodiscard]] const std::vector<SiteEdge>& GetEdges() const noexcept;
    [[nodiscard]] const std::vector<SiteStation>& GetStations() const noexcept;

    /// Null where there is no node of this id.
    [[nodiscard]] const SiteNode* FindNodeOrNull(std::string_view nodeID) const;
    [[nodiscard]] std::optional<std::size_t> FindNodeIndexOrNull(std::string_view nodeID) const;

    /// Null where there is no station of this id.
    [[nodiscard]] const SiteStation* FindStationOrNull(std::string_view stationID) const;

    /// The first station that has the node; null where there is none.
    [[nodiscard]] const SiteStation* FindStationAtOrNull(std::string_view nodeID) const;

    /// Whether any node names the vehicle type.
    [[nodiscard]] bool HasVehicleType(std::string_view vehicleTypeID) const noexcept;

private:
    [[nodiscard]] Core::Result<void> IndexNodes();
    [[nodiscard]] Core::Result<void> CheckEdges() const;
    [[nodiscard]] Core::Result<void> IndexStations();
};

/// Metres between two nodes, as the crow flies.
[[nodiscard]] double GetDistance(const SiteNode& from, const SiteNode& to) noexcept;

} // namespace ACS::Planning
