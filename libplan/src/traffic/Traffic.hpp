#pragma once

#include "traffic/FloorGraph.hpp"
#include <acs/plan/SiteMap.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Planning
{

/// Who may drive onto which node of the map, and when: docs/design/traffic.md. Robots and nodes by index.
///
/// A node, with all nodes that are nearer to it than the clearance, belongs to one robot at a time. A robot holds the node
/// where it stands and the nodes of its way that it was granted; it gives them back as it passes them. A grant never takes
/// from any robot the way home that it had: after it, as before it, all of them can drive home one after another.
class Traffic
{
    struct Vehicle
    {
        const FloorGraph* graphOrNull = nullptr; ///< Null where no edge is for its type.
        std::optional<std::size_t> home;
        std::vector<std::size_t> path;         ///< What it holds in the order of driving; it stands on the first.
        std::vector<std::size_t> extra;        ///< Held too: where it may be, or go without being asked.
        std::vector<std::uint32_t> nextToHome; ///< Of each node, on the quickest way home.
        bool bMovable = false;
        bool bCanReturn = false; ///< There is a way out of its home and back, whoever else is at home.
    };

    /// Which robots can come home; kept until it may have become untrue.
    struct SafeState
    {
        std::vector<bool> reachable;
        bool bAll = false;
        bool bValid = false;
    };

    /// A node that another one holds, and that the robot is to hold as soon as it is given back.
    struct Awaited
    {
        std::size_t robot = 0;
        std::size_t node = 0;

        bool operator==(const Awaited&) const = default;
    };

    enum class ESafeStateScope : std::uint8_t
    {
        AllMove, ///< As if every robot could move.
        AsIs,    ///< Robots that cannot move stay where they are.
    };

    std::vector<std::vector<std::uint32_t>> _near; ///< Of each node: those that it excludes, itself among them.
    std::map<std::string, FloorGraph, std::less<>> _graphs;
    std::vector<Vehicle> _vehicles;
    std::vector<std::optional<std::size_t>> _holders;
    std::vector<std::uint16_t> _covers; ///< Of each node: how many held nodes exclude it.
    std::vector<std::uint16_t> _homes;  ///< Of each node: how many homes exclude it.
    std::array<SafeState, 2> _safeStates;
    std::vector<Awaited> _awaited; ///< In the order in which they were asked for.
    bool _bPassedOn = false;       ///< Something that was given back is held by another since the last Note.
    std::vector<std::size_t> _blockers;
    bool _bReturnsKnown = false;
    std::uint64_t _freedCount = 0;

    // Of searches.
    mutable std::vector<std::uint32_t> _seen;
    mutable std::uint32_t _search = 0;
    mutable std::vector<std::uint32_t> _open;

public:
    /// clearance: nodes of one map at this distance (metres) or nearer exclude each other; nodes in the same place always do.
    Traffic(const SiteMap& site, double clearance);

    /// The next index. The home must be nobody else's.
    void AddRobot(std::string_view vehicleTypeID, std::optional<std::size_t> home);

    /// Whether it is able to drive. One that is not is an obstacle for all others until it is again.
    void SetMovable(std::size_t robot, bool bMovable);
    [[nodiscard]] bool IsMovable(std::size_t robot) const;

    /// It stands on the node, may be on the extra ones too, and holds nothing else but the possible ones (HoldPossible).
    /// False, and nothing is changed, where another robot holds the node or an extra one.
    [[nodiscard]] bool TryStand(
        std::size_t robot,
        std::size_t node,
        std::span<const std::size_t> extra = {},
        std::span<const std::size_t> possible = {});

    /// It may be there, whoever else is: holds the nodes beside what it holds, those of others as soon as they give them
    /// back.
    void HoldPossible(std::size_t robot, std::span<const std::size_t> nodes);

    /// Takes back one node of HoldPossible.
    void Disown(std::size_t robot, std::size_t node);

    /// Grants the next nodes of its way, behind the last one that it holds: as many as can be, none where the first
    /// cannot. Returns how many; see GetBlockers where it is none.
    [[nodiscard]] std::size_t Extend(std::size_t robot, std::span<const std::size_t> ahead);

    /// It is on these nodes although they were not granted. False, and nothing is changed, where another holds one.
    [[nodiscard]] bool TryOverrun(std::size_t robot, std::span<const std::size_t> ahead);

    /// It has passed so many of its nodes, less than it holds.
    void Pass(std::size_t robot, std::size_t count);

    /// Gives back all but the first so many of its nodes, 1 or more.
    void Shorten(std::size_t robot, std::size_t count);

    [[nodiscard]] std::optional<std::size_t> GetHolderOrNull(std::size_t node) const;
    /// What the robot holds, in the order of driving.
    [[nodiscard]] std::span<const std::size_t> GetHeld(std::size_t robot) const;
    /// Whether no other robot holds the node or one too near to it.
    [[nodiscard]] bool IsFreeFor(std::size_t node, std::size_t robot) const;
    /// Likewise, and it is not in the way of another robot's home.
    [[nodiscard]] bool IsOpenFor(std::size_t node, std::size_t robot) const;
    /// Other robots that hold the node or one too near to it.
    [[nodiscard]] std::vector<std::size_t> GetHolders(std::size_t node, std::size_t robot) const;
    /// Whether the node is a dead end for the vehicle type: nobody else need ever pass it.
    [[nodiscard]] bool IsSpur(std::string_view vehicleTypeID, std::size_t node) const;
    /// Whether two nodes exclude each other.
    [[nodiscard]] bool IsNear(std::size_t left, std::size_t right) const;

    /// Whose nodes, or whose ways home, kept the last Extend from granting more.
    [[nodiscard]] const std::vector<std::size_t>& GetBlockers() const noexcept;

    /// All others that hold nodes and cannot move.
    [[nodiscard]] std::vector<std::size_t> GetFixed(std::size_t robot) const;

    /// Grows with everything that may turn a refusal into a grant.
    [[nodiscard]] std::uint64_t GetFreedCount() const noexcept;

    /// Whether robots that cannot move leave it a way to the node and from there home. True where it has no home.
    [[nodiscard]] bool CanServe(std::size_t robot, std::size_t node) const;

private:
    void FindNear(const SiteMap& site, double clearance);
    void FindWaysHome(Vehicle& vehicle) const;
    void FindReturns();
    [[nodiscard]] static std::size_t GetEnd(const Vehicle& vehicle);
    void Hold(std::size_t robot, std::size_t node);
    void Free(std::size_t node);
    void GiveBack(std::size_t node);
    void Note(bool bOnlyFreed);
    void Cover(const Vehicle& vehicle, std::vector<std::uint16_t>& covers, bool bAdd) const;
    [[nodiscard]] bool IsAnyFixed() const;
    [[nodiscard]] bool IsHomeOfOther(const Vehicle& vehicle, std::size_t node) const;
    [[nodiscard]] bool HasWay(
        const Vehicle& vehicle,
        std::size_t from,
        std::size_t to,
        const std::vector<std::uint16_t>& covers) const;
    [[nodiscard]] bool HasStraightWayHome(
        const Vehicle& vehicle,
        std::size_t from,
        const std::vector<std::uint16_t>& covers) const;
    [[nodiscard]] bool CanGoHome(const Vehicle& vehicle, std::size_t from, const std::vector<std::uint16_t>& covers);
    [[nodiscard]] SafeState FindSafeState(ESafeStateScope standing);
    [[nodiscard]] const SafeState& GetSafeState(ESafeStateScope standing);
    [[nodiscard]] bool IsAsGood(ESafeStateScope standing, std::size_t robot);
    [[nodiscard]] bool IsSafe(std::size_t robot, std::span<const std::size_t> ahead);
};

} // namespace ACS::Planning
