#pragma once

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

/// Metres per second along an edge for which the map gives no speed.
inline constexpr double DEFAULT_SPEED = 1.0;

/// A beginning of a way, and what the way takes.
struct QuickestStart
{
    std::size_t nodeIndex = 0; ///< See SiteMap::GetNodes.
    double travelSeconds = 0.0;
};

/// Ways of shortest travel time over a map, for each vehicle type along the edges and nodes that it may use. Holds a
/// reference to the map, which must outlive it. Not shared between threads.
class Router
{
public:
    /// Whether the way must not lead over the node of this index (see SiteMap::GetNodes). Must not search itself.
    using NodeFilter = std::function<bool(std::size_t nodeIndex)>;

private:
    class Impl;

    std::unique_ptr<Impl> _impl;

public:
    explicit Router(const SiteMap& site);
    Router(const Router&) = delete;
    Router& operator=(const Router&) = delete;
    ~Router();

    /// From node to node, one node and no edge where they are the same. nullopt where there is no way, or one of the
    /// ids or the vehicle type is not on the map.
    [[nodiscard]] std::optional<Route> FindRouteOrNull(
        std::string_view vehicleTypeID,
        std::string_view fromNodeID,
        std::string_view toNodeID) const;

    /// Likewise, around the nodes that the filter excludes; the ends are never excluded.
    [[nodiscard]] std::optional<Route> FindRouteOrNull(
        std::string_view vehicleTypeID,
        std::string_view fromNodeID,
        std::string_view toNodeID,
        const NodeFilter& isExcluded) const;

    /// From which of these nodes the target is reached quickest, the nodes by their index in the map; nullopt where there
    /// is no way from any. One search, however many starts there are. Of several as quick, that of the lowest index.
    [[nodiscard]] std::optional<QuickestStart> FindQuickestStartOrNull(
        std::string_view vehicleTypeID,
        std::span<const std::size_t> startIndices,
        std::size_t targetIndex) const;

    /// Of all searches so far: what they have cost, in a figure that no clock disturbs.
    [[nodiscard]] std::uint64_t CountVisitedNodes() const noexcept;
};

} // namespace ACS::Planning
