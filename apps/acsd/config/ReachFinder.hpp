#pragma once

#include <acs/plan/ELoad.hpp>
#include <acs/plan/SiteMap.hpp>

#include <cstddef>
#include <string_view>
#include <vector>

namespace ACS::Acsd
{

/// Indices in SiteMap::GetNodes.
using Nodes = std::vector<std::size_t>;

/// What a robot with a load, or one without, reaches; by node.
struct LoadReach
{
    std::vector<bool> arrived; ///< It can drive there, or starts there.
    std::vector<bool> left;    ///< It can drive on from there: it arrived, or its load changed there.
};

struct Reach
{
    LoadReach empty;
    LoadReach loaded;
};

/// What the robots of one vehicle type can reach on one map.
class ReachFinder final
{
    struct Lane
    {
        std::size_t to;
        bool bEmpty;
        bool bLoaded;
    };

    using LaneTable = std::vector<std::vector<Lane>>;

    LaneTable _lanes;     ///< By the node at which they begin.
    LaneTable _backwards; ///< The same by the node at which they end, with the other node in `to`.

public:
    /// Without bRestricted the restrictions of loads do not count. The map is not kept.
    ReachFinder(const Planning::SiteMap& site, std::string_view vehicleTypeID, bool bRestricted);

    /// From the starts with any load. The load may change at each dock.
    [[nodiscard]] Reach Find(const Nodes& starts, const Nodes& docks) const;

    /// By node: whether it is reached from the start with this load. Nodes in `closed` (by node; may be empty) are not entered.
    [[nodiscard]] std::vector<bool> FindTargets(
        std::size_t start,
        Planning::ELoad load,
        const std::vector<bool>& closed = {}) const;

    /// By node: whether the target is reached from it with this load. Likewise.
    [[nodiscard]] std::vector<bool> FindSources(
        std::size_t target,
        Planning::ELoad load,
        const std::vector<bool>& closed = {}) const;

    [[nodiscard]] bool HasLaneTo(std::size_t node) const;

    /// Whether a robot can drive over the node: from one neighbour to another.
    [[nodiscard]] bool IsPassed(std::size_t node) const;

    /// Whether every route with this load over the closed nodes (by node) has one around them between the same neighbours. Cheap
    /// if the ways around are short.
    [[nodiscard]] bool IsBypassed(const std::vector<bool>& closed, Planning::ELoad load) const;

private:
    static void Visit(const LaneTable& lanes, LoadReach& reach, bool Lane::*isOpen, Nodes nodes);

    /// From the docks that are reached with the other load. False: there is no new one.
    [[nodiscard]] bool TryVisit(LoadReach& reach, bool Lane::*isOpen, const LoadReach& other, const Nodes& docks) const;

    /// Whether all targets (by node; number of them) are reached from the start.
    [[nodiscard]] bool IsReached(
        std::size_t start,
        const std::vector<bool>& targets,
        std::size_t count,
        const std::vector<bool>& closed,
        bool Lane::*isOpen) const;

    [[nodiscard]] static std::vector<bool> FindArrived(
        const LaneTable& lanes,
        std::size_t start,
        Planning::ELoad load,
        const std::vector<bool>& closed);
};

} // namespace ACS::Acsd
