#pragma once

#include <acs/plan/SiteMap.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace ACS::Planning
{

/// One edge of the map that a vehicle type may use, in the direction of driving.
struct Lane
{
    std::size_t from = 0; ///< Node by index in the map.
    std::size_t to = 0;   ///< Node by index in the map.
    std::size_t edge = 0; ///< Edge by index in the map.
    double length = 0;    ///< Metres.
    double seconds = 0;   ///< Of driving along it.
    double heading = 0; ///< Radians: orientation of the vehicle on the straight line, also where there is a trajectory.
    double turnSpeed = 0; ///< Radians per second; 0: not given by the map.
};

/// What a vehicle type can drive along with this load: the edges of the map whose ends and itself it may use. Lanes by index, in the
/// order of their first node.
class FloorGraph
{
    std::vector<Lane> _lanes;
    std::vector<std::size_t> _firstLanes;    ///< Of each node, and one more.
    std::vector<std::size_t> _incoming;      ///< Lanes, in the order of their last node.
    std::vector<std::size_t> _firstIncoming; ///< Of each node, and one more.

public:
    FloorGraph(const SiteMap& site, std::string_view vehicleTypeID, ELoad load);

    [[nodiscard]] std::size_t GetNodeCount() const noexcept;
    [[nodiscard]] std::span<const Lane> GetLanes() const noexcept;
    /// The lanes that begin on the node.
    [[nodiscard]] std::span<const Lane> GetLanesFrom(std::size_t node) const;
    /// Indices of the lanes that end on the node.
    [[nodiscard]] std::span<const std::size_t> GetLanesTo(std::size_t node) const;
    /// Index of a lane that GetLanes or GetLanesFrom returned.
    [[nodiscard]] std::size_t GetIndex(const Lane& lane) const;

    /// Seconds of turning on the node between two lanes; 0 if the map does not give the rotation speed.
    [[nodiscard]] static double GetTurnSeconds(const Lane& from, const Lane& to);
};

/// Whether the map restricts any edge of the vehicle type to vehicles with a load, or to those without.
[[nodiscard]] bool IsLoadRestricted(const SiteMap& site, std::string_view vehicleTypeID);

/// Whether no route passes through the node, with any load: it has one neighbour only, from which it is entered and left.
[[nodiscard]] bool IsDeadEnd(std::span<const FloorGraph> graphs, std::size_t node);

/// The smallest angle between two headings, in radians.
[[nodiscard]] double GetAngleBetween(double left, double right);

} // namespace ACS::Planning
