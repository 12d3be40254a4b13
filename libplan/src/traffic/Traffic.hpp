#pragma once

#include "traffic/ESafeStateScope.hpp"
#include "traffic/FloorGraph.hpp"
#include "traffic/ParkingWays.hpp"
#include <acs/plan/SiteMap.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ACS::Planning
{

/// Reservations of nodes and the safe-state check (docs/design/traffic.md). Robots and nodes by index.
///
/// A node and all nodes within the clearance are reserved by one robot at a time. A robot holds the node on which it is
/// stationary and the granted nodes of its route, and frees each node as it passes. A grant is refused if a robot that could
/// park before, one after another with the others, could not park afterwards. Whether it can park does not depend on its
/// present load: a job may change that on any station.
class Traffic
{
    using Parking = ParkingWays::Parking;
    using LoadGraph = ParkingWays::LoadGraph;

    /// An answer of CanServe, while the robot and the fixed obstacles stay where they are.
    struct Served
    {
        std::uint64_t fixedAt = 0; ///< Value of Changes::fixed; 0: none yet.
        std::size_t from = 0;
        std::optional<std::size_t> heading;
        std::size_t node = 0;
        bool bCan = false;
    };

    /// Why a grant was refused: with the nodes ahead, these robots could not park any more, whatever all others do. Nothing but
    /// a change of what they hold makes the grant possible.
    struct Refusal
    {
        std::vector<std::size_t> ahead;
        std::vector<std::pair<std::size_t, std::uint64_t>> stuck; ///< Robots, itself among them, with Vehicle::changes.
        std::vector<std::size_t> blockers;
        bool bForBlocks = false;
        std::uint64_t disturbedAt = 0; ///< Value of Changes::disturbs.
        std::uint64_t fixedAt = 0;     ///< Value of Changes::fixed.
        std::uint64_t refugesAt = 0;   ///< Value of Changes::refuges.
    };

    struct Vehicle
    {
        Parking parking;
        std::vector<std::size_t> path;      ///< Held nodes in driving order; it is on the first.
        std::optional<std::size_t> heading; ///< It is stationary between its node and this one, and cannot turn round.
        std::vector<std::size_t> extra;     ///< Other held nodes: where it may be, or may drive uncommanded.
        std::optional<std::size_t> destination; ///< Last node of its drive.
        mutable Served served;
        std::array<Refusal, 2> refusals; ///< The last ones: of several nodes, and of the next one only.
        std::uint64_t changes = 0;       ///< Of what it holds and where it is.
        bool bMovable = false;
    };

    /// Which robots can park; kept until it may have changed.
    struct SafeState
    {
        std::vector<bool> reachable;
        bool bAll = false;
    };

    /// A node that another robot holds, and that this one gets as soon as it is freed.
    struct Awaited
    {
        std::size_t robot = 0;
        std::size_t node = 0;

        bool operator==(const Awaited&) const = default;
    };

    /// Numbers of changes.
    struct Changes
    {
        std::uint64_t freed = 0;    ///< See GetFreedCount.
        std::uint64_t disturbs = 0; ///< Other than nodes that were given back or granted.
        std::uint64_t fixed = 1;    ///< Of what robots that cannot move hold, and of blocks.
        std::uint64_t refuges = 0;  ///< Of refuges that became free.
    };

    /// Whether robots that cannot move hold nodes.
    struct AnyFixed
    {
        std::uint64_t at = 0; ///< Value of Changes::fixed then; 0: not known yet.
        bool bAny = false;
    };

    ParkingWays _ways;
    std::map<std::string, std::vector<FloorGraph>, std::less<>> _graphs; ///< By type: of empty and loaded vehicles.
    std::vector<Vehicle> _vehicles;
    std::vector<std::optional<std::size_t>> _holders;
    std::vector<std::uint16_t> _covers;                  ///< Of each node: how many held nodes exclude it.
    std::vector<std::vector<std::size_t>> _arriving;     ///< Of each node: the robots that have it as destination.
    std::array<std::optional<SafeState>, 2> _safeStates; ///< By ESafeStateScope; nullopt: it must be found again.
    std::vector<Awaited> _awaited;                       ///< In the order in which they were asked for.
    bool _bPassedOn = false; ///< Something that was given back is held by another since the last Note.
    std::vector<std::size_t> _blockers;
    bool _bBlocksRefuse = false; ///< The blocks limited the last Extend.
    bool _bReturnsKnown = false;
    bool _bTrial = false; ///< Nodes are held on trial.
    Changes _changes;
    mutable AnyFixed _anyFixed;

public:
    /// clearance: nodes of one map within this distance (metres) exclude each other; nodes at the same position always do.
    Traffic(const SiteMap& site, double clearance);

    /// Adds the robot with the next index. The home must be exclusive.
    void AddRobot(std::string_view vehicleTypeID, std::optional<std::size_t> homeOrNull);

    /// No robot is granted these nodes, by index in the map, and routes to parking positions avoid these edges.
    void SetBlocked(const std::vector<bool>& nodes, const std::vector<bool>& edges);
    /// Where the robot parks while the way to its home is blocked; nullopt: its home. No other robot has it.
    void SetStandIn(std::size_t robot, std::optional<std::size_t> standInOrNull);
    /// Whether the last Extend was refused because of blocks.
    [[nodiscard]] bool IsRefusedForBlocks() const noexcept;

    /// A robot that cannot move is a fixed obstacle.
    void SetMovable(std::size_t robot, bool bMovable);
    [[nodiscard]] bool IsMovable(std::size_t robot) const;

    /// The robot is stationary on the node or on an extra one. Its other reservations are freed, except the possible nodes
    /// (HoldPossible). False, without a change, if another robot holds the node or an extra one.
    [[nodiscard]] bool TryStand(
        std::size_t robot,
        std::size_t node,
        std::span<const std::size_t> extra = {},
        std::span<const std::size_t> possible = {});

    /// The robot is stationary on its way to this node: its way to its parking position begins there. Ignored if another robot
    /// holds the node. nullopt: the robot is on its node. Until TryStand or a grant.
    void SetHeading(std::size_t robot, std::optional<std::size_t> headingOrNull);

    /// The robot may be on these nodes: reserves them in addition, and those of other robots as soon as they are freed.
    void HoldPossible(std::size_t robot, std::span<const std::size_t> nodes);

    /// The last node of the robot's drive; nullopt: it has none. Reserves nothing.
    void SetDestination(std::size_t robot, std::optional<std::size_t> nodeOrNull);
    /// Robots whose destination is the node or one within the clearance, in their order.
    [[nodiscard]] std::vector<std::size_t> GetArriving(std::size_t node) const;

    /// Frees one node of HoldPossible.
    void Disown(std::size_t robot, std::size_t node);

    /// Grants the next nodes of the route, up to the first that is refused or that it must pass before. Returns their number;
    /// GetBlockers has the reason for 0.
    [[nodiscard]] std::size_t Extend(std::size_t robot, std::span<const std::size_t> ahead);

    /// The robot is on these nodes without a grant. False, without a change, if another robot holds one. Its possible nodes
    /// (HoldPossible) among them become nodes of its route.
    [[nodiscard]] bool TryOverrun(std::size_t robot, std::span<const std::size_t> ahead);

    /// Frees the first count nodes, less than it holds.
    void Pass(std::size_t robot, std::size_t count);

    /// Frees all but the first count nodes, 1 or more.
    void Shorten(std::size_t robot, std::size_t count);

    [[nodiscard]] std::optional<std::size_t> GetHolderOrNull(std::size_t node) const;
    /// The reserved nodes of its route, in driving order.
    [[nodiscard]] std::span<const std::size_t> GetHeld(std::size_t robot) const;
    /// All nodes that it holds: those of its route in driving order, then the others.
    [[nodiscard]] std::vector<std::size_t> ListReserved(std::size_t robot) const;
    /// Whether no other robot holds the node or one within the clearance.
    [[nodiscard]] bool IsFreeFor(std::size_t node, std::size_t robot) const;
    /// As IsFreeFor, and the node is not the home of another robot.
    [[nodiscard]] bool IsOpenFor(std::size_t node, std::size_t robot) const;
    /// Whether the node, or one within the clearance, is the refuge of another robot, around fixed obstacles and blocks.
    [[nodiscard]] bool IsRefugeOfOther(std::size_t node, std::size_t robot) const;
    /// Other robots that hold the node or one within the clearance.
    [[nodiscard]] std::vector<std::size_t> GetHolders(std::size_t node, std::size_t robot) const;
    /// Whether the node is a dead end for the vehicle type with any load, so that no route passes through it.
    [[nodiscard]] bool IsSpur(std::string_view vehicleTypeID, std::size_t node) const;
    /// Where the robot can drive now, to wait there instead of parking; not the avoided node.
    [[nodiscard]] std::optional<std::size_t> FindRefugeOrNull(
        std::size_t robot,
        std::optional<std::size_t> avoidedOrNull = std::nullopt);
    /// The nodes that the node excludes, itself among them.
    [[nodiscard]] const std::vector<std::uint32_t>& GetNear(std::size_t node) const;
    /// Whether two nodes exclude each other.
    [[nodiscard]] bool IsNear(std::size_t left, std::size_t right) const;

    /// Of the nodes ahead, how many the robot may hold without closing the way to the parking position of a robot that is on the
    /// target.
    [[nodiscard]] std::size_t CountBeforeWayOut(
        std::size_t robot,
        std::span<const std::size_t> ahead,
        std::size_t target) const;

    /// Robots whose reservations, or whose routes to their parking positions, limited the last Extend.
    [[nodiscard]] const std::vector<std::size_t>& GetBlockers() const noexcept;

    /// Other robots that hold nodes and cannot move.
    [[nodiscard]] std::vector<std::size_t> GetFixed(std::size_t robot) const;

    /// Increases with each change after which a refused grant may be possible.
    [[nodiscard]] std::uint64_t GetFreedCount() const noexcept;

    /// Whether robots that cannot move leave free a route to the node and from there home. True without a home.
    [[nodiscard]] bool CanServe(std::size_t robot, std::size_t node) const;

private:
    /// Of all robots, once after robots were added.
    void FindReturns();
    [[nodiscard]] static std::size_t GetEnd(const Vehicle& vehicle);
    void Hold(std::size_t robot, std::size_t node);
    void Free(std::size_t node);
    void GiveBack(std::size_t node);
    void Note(bool bOnlyFreed);
    /// Of its nodes, where it holds them while it cannot move.
    void NoteFixed(std::size_t robot);
    void Cover(const Vehicle& vehicle, std::vector<std::uint16_t>& covers, bool bAdd) const;
    [[nodiscard]] bool IsAnyFixed() const;
    [[nodiscard]] bool HasWayAround(const Vehicle& vehicle, std::size_t node) const;
    /// Whether the lane on which it is stationary between two nodes is open.
    [[nodiscard]] bool HasOpenStart(const Vehicle& vehicle) const;
    [[nodiscard]] SafeState FindSafeState(ESafeStateScope standing);
    [[nodiscard]] const SafeState& GetSafeState(ESafeStateScope standing);
    [[nodiscard]] bool IsAsGood(ESafeStateScope standing, std::size_t robot, Refusal& refusal);
    /// Whether the robot can park after those in its way, as far as they can. False: not known.
    [[nodiscard]] bool CanParkSoon(std::size_t robot, ESafeStateScope scope);
    /// Where it can park, if it can.
    [[nodiscard]] std::optional<std::size_t> ParkOrNull(
        Vehicle& vehicle,
        const std::vector<std::uint16_t>& covers,
        ESafeStateScope scope);
    /// Adds or removes what excludes the node.
    void CoverNode(std::size_t node, std::vector<std::uint16_t>& covers) const;
    void AddInTheWay(const Vehicle& vehicle, std::vector<std::size_t>& robots) const;
    void AddBlockers(const std::vector<std::size_t>& robots);
    [[nodiscard]] bool IsRefusedStill(const Refusal& refusal, std::span<const std::size_t> ahead) const;
    /// Claims its parking position if the route there from the node is free, whatever the others do.
    [[nodiscard]] bool TryLeaveFirst(std::size_t robot, std::size_t from);
    /// Claims a refuge that no other robot needs, if the robot can go there from the node before the others. The safe states are known.
    [[nodiscard]] bool TryTakeRefuge(std::size_t robot, std::size_t from, bool bAsIs);
    [[nodiscard]] bool IsSafe(std::size_t robot, std::span<const std::size_t> ahead);
};

} // namespace ACS::Planning
