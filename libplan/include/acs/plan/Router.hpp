#pragma once

#include <acs/core/Api.hpp>
#include <acs/plan/ELoad.hpp>
#include <acs/plan/RobotCommand.hpp>
#include <acs/plan/SiteMap.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace ACS::Planning
{

/// Speed on edges without a speed in the map, in metres per second.
inline constexpr double DEFAULT_SPEED = 1.0;

/// The start of the fastest route and its travel time.
struct QuickestStart
{
    std::size_t nodeIndex = 0;  ///< Index in SiteMap::GetNodes.
    double travelSeconds = 0.0; ///< Seconds.
};

/// Finds routes of shortest travel time, for each vehicle type over the nodes and edges that it may use with its load. The map
/// must outlive the router. Not thread-safe.
class ACS_API Router
{
public:
    /// Whether routes must avoid the node of this index in SiteMap::GetNodes. Must not call the router.
    using NodeFilter = std::function<bool(std::size_t nodeIndex)>;

private:
    class ACS_HIDDEN Impl;

    std::unique_ptr<Impl> _impl;

public:
    /// The map must outlive the router.
    explicit Router(const SiteMap& site);
    Router(const Router&) = delete;
    Router& operator=(const Router&) = delete;
    ~Router();

    /// From now on no route enters these nodes or uses these edges, by index in the map; routes may begin on such a node. Discards
    /// what earlier searches found. The sizes are those of the map.
    void SetBlocked(std::vector<bool> nodes, std::vector<bool> edges);

    /// The fastest route between two nodes for a vehicle of unknown load; one node and no edge if they are the same. nullopt if
    /// there is no route, or if a node or the vehicle type is not on the map.
    [[nodiscard]] std::optional<Route> FindRouteOrNull(
        std::string_view vehicleTypeID,
        std::string_view fromNodeID,
        std::string_view toNodeID) const;

    /// The same with this load, avoiding the nodes that the filter excludes. The filter does not apply to the two ends.
    [[nodiscard]] std::optional<Route> FindRouteOrNull(
        std::string_view vehicleTypeID,
        ELoad load,
        std::string_view fromNodeID,
        std::string_view toNodeID,
        const NodeFilter& isExcluded) const;

    /// The start node from which the target is reached fastest; of equally fast ones that of the lowest index. nullopt if the
    /// target cannot be reached from any of them. Costs one search for any number of starts.
    [[nodiscard]] std::optional<QuickestStart> FindQuickestStartOrNull(
        std::string_view vehicleTypeID,
        ELoad load,
        std::span<const std::size_t> startIndices,
        std::size_t targetIndex) const;

    /// The edge alone, as the route between its nodes. nullopt if the vehicle type may not use it.
    [[nodiscard]] std::optional<Route> MakeRouteOrNull(std::string_view vehicleTypeID, std::size_t edgeIndex) const;

    /// Number of nodes that all searches so far have visited: their cost, independent of the machine.
    [[nodiscard]] std::uint64_t CountVisitedNodes() const noexcept;
};

} // namespace ACS::Planning
