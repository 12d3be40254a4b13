#pragma once

#include "traffic/ESafeStateScope.hpp"
#include "traffic/FloorGraph.hpp"
#include <acs/plan/SiteMap.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// Ways of robots to their parking positions and refuges, around nodes that others hold, and who has which of these places. Nodes by
/// index in the map. covers: of each node, how many nodes that other robots hold exclude it.
class ParkingWays
{
public:
    static constexpr std::uint32_t NOWHERE = std::numeric_limits<std::uint32_t>::max();

    /// What a vehicle can drive along with one load.
    struct LoadGraph
    {
        const FloorGraph* floor = nullptr;
        /// By node: the next one on the quickest route home. Of the nearest nodes, as many as were needed so far.
        mutable std::vector<std::uint32_t> nextToHome;
        mutable std::size_t nearest = 0; ///< Number of nodes in nextToHome; all that have a route: the number of nodes.
        std::vector<bool> returns;       ///< By node: whether a route home is free while all others are parked.
    };

    /// Of one robot.
    struct Parking
    {
        std::vector<LoadGraph> graphs; ///< None where no edge is for its type; one where loads make no difference.
        std::optional<std::size_t> home;
        std::optional<std::size_t> standIn;                ///< Instead of the home, while the way there is blocked.
        std::array<std::optional<std::size_t>, 2> refuges; ///< By ESafeStateScope. No other robot has them.
        bool bCanReturn = false; ///< With any load a route leads out of its home and back while all others are parked.
    };

private:
    /// Of searches.
    struct Scratch
    {
        std::vector<std::uint32_t> seen;
        std::uint32_t search = 0;
        std::vector<std::uint32_t> open;
    };

    std::vector<std::vector<std::uint32_t>> _near; ///< Of each node: those that it excludes, itself among them.
    std::vector<std::uint16_t> _homes;             ///< Of each node: how many homes exclude it.
    std::vector<bool> _refuges;                    ///< Of each node; empty: not known yet.
    std::array<std::vector<std::uint16_t>, 2>
        _claims;                          ///< By ESafeStateScope, of each node: how many refuges exclude it.
    std::vector<std::uint16_t> _standIns; ///< Of each node: how many stand-ins exclude it.
    std::uint64_t _released = 0;
    std::vector<bool> _blockedNodes; ///< By the operator; empty: there are no blocks.
    std::vector<bool> _blockedEdges;
    mutable Scratch _scratch;

public:
    /// clearance: nodes of one map within this distance (metres) exclude each other; nodes at the same position always do.
    ParkingWays(const SiteMap& site, double clearance);

    [[nodiscard]] const std::vector<std::uint32_t>& GetNear(std::size_t node) const;
    /// Whether two nodes exclude each other.
    [[nodiscard]] bool IsNear(std::size_t left, std::size_t right) const;
    /// The robot's stand-in; nullopt: it has none.
    void SetStandIn(Parking& parking, std::optional<std::size_t> standInOrNull);
    /// Whether the node is the refuge of another robot, or excludes it.
    [[nodiscard]] bool IsRefugeOfOther(const Parking& parking, std::size_t node, ESafeStateScope scope) const;
    /// The node is the home of a robot.
    void AddHome(std::size_t node);
    /// Whether the node is the home of another robot, or excludes it.
    [[nodiscard]] bool IsHomeOfOther(const Parking& parking, std::size_t node) const;

    void SetBlocked(const std::vector<bool>& nodes, const std::vector<bool>& edges);
    [[nodiscard]] bool IsAnyBlocked() const noexcept;
    [[nodiscard]] bool IsBlocked(std::size_t node) const;
    [[nodiscard]] bool IsBlocked(const Lane& lane) const;

    /// Refuges are dead ends for the vehicles of all types, together with all nodes within the clearance.
    void FindRefuges(const std::map<std::string, std::vector<FloorGraph>, std::less<>>& graphs);
    [[nodiscard]] bool IsRefuge(std::size_t node) const;
    /// Fills what depends on the homes of all robots.
    void FindReturns(Parking& parking) const;
    /// The stand-in or the home.
    [[nodiscard]] std::size_t GetParking(const Parking& parking, ESafeStateScope scope) const;

    /// A route around covered nodes and the homes of others, so that the order of parking does not matter.
    [[nodiscard]] bool HasWay(
        const Parking& parking,
        const LoadGraph& graph,
        std::size_t from,
        std::size_t to,
        const std::vector<std::uint16_t>& covers,
        ESafeStateScope scope) const;
    /// Whether the robot can go to its parking position; then it drops its refuge.
    [[nodiscard]] bool TryClaimHome(
        Parking& parking,
        std::size_t from,
        const std::vector<std::uint16_t>& covers,
        ESafeStateScope scope);
    /// Where the robot can go: its parking position, or a refuge that it has from then on.
    [[nodiscard]] std::optional<std::size_t> FindParkingOrNull(
        Parking& parking,
        std::size_t from,
        const std::vector<std::uint16_t>& covers,
        ESafeStateScope scope);
    /// A refuge to which it can go, not the avoided one: the one that it has, else the nearest one by the number of nodes.
    [[nodiscard]] std::optional<std::size_t> FindRefugeOrNull(
        const Parking& parking,
        std::size_t from,
        const std::vector<std::uint16_t>& covers,
        ESafeStateScope scope,
        std::optional<std::size_t> avoidedOrNull = std::nullopt) const;
    /// How often a robot has dropped its refuge.
    [[nodiscard]] std::uint64_t GetReleasedCount() const noexcept;

private:
    void FindNear(const SiteMap& site, double clearance);
    void FindReturns(const Parking& parking, LoadGraph& graph) const;
    /// Until the node has its entry in nextToHome.
    void FindWaysHome(const LoadGraph& graph, std::size_t home, std::size_t from) const;
    [[nodiscard]] bool HasStraightWayHome(
        const Parking& parking,
        const LoadGraph& graph,
        std::size_t from,
        const std::vector<std::uint16_t>& covers) const;
    [[nodiscard]] bool CanGoHome(
        const Parking& parking,
        std::size_t from,
        const std::vector<std::uint16_t>& covers,
        ESafeStateScope scope) const;
    [[nodiscard]] bool CanGoTo(
        const Parking& parking,
        std::size_t from,
        std::size_t refuge,
        const std::vector<std::uint16_t>& covers,
        ESafeStateScope scope) const;
    /// Whether no other robot has the node, or one within the clearance, as its home, stand-in or refuge.
    [[nodiscard]] bool IsRefugeFor(const Parking& parking, std::size_t node, ESafeStateScope scope) const;
    void ChangePlace(
        std::optional<std::size_t>& placeOrNull,
        std::optional<std::size_t> nextOrNull,
        std::vector<std::uint16_t>& counts) const;
    /// Whether another place than the own one excludes the node.
    [[nodiscard]] bool IsOfOther(
        const std::optional<std::size_t>& ownOrNull,
        std::size_t node,
        const std::vector<std::uint16_t>& counts) const;
    /// nullopt: it has none.
    void Claim(Parking& parking, std::optional<std::size_t> nodeOrNull, ESafeStateScope scope);
};

} // namespace ACS::Planning
