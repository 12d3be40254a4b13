#pragma once

#include "robot/ActiveDrive.hpp"
#include "robot/Robot.hpp"
#include "site/BlockBook.hpp"
#include <acs/plan/Router.hpp>
#include <acs/plan/SiteMap.hpp>

#include <cstddef>
#include <memory>
#include <optional>

namespace ACS::Planning
{

/// Owns the routers. Plans the routes of robots, around the blocks of the operator, with their present load and from where they
/// are.
class RoutePlanner
{
    const SiteMap& _site;
    const BlockBook& _blocks;
    Router _router;                      ///< Of the map, without blocks.
    std::unique_ptr<Router> _openRouter; ///< Around the blocks; null if there are none.

public:
    /// Site and blocks must outlive the planner.
    RoutePlanner(const SiteMap& site, const BlockBook& blocks);

    void OnBlocksChanged();
    /// As if nothing was blocked.
    [[nodiscard]] const Router& GetRouter() const noexcept;
    [[nodiscard]] const Router& GetOpenRouter() const noexcept;
    /// What blocks its way to the target, if there would be a route without the blocks and there is none with them.
    [[nodiscard]] const Block* FindBlockOrNull(const Robot& robot, std::size_t target) const;
    /// Whether its planned route leads to the target, and may be driven with its present load.
    [[nodiscard]] static bool HasRoute(const Robot& robot, std::size_t target);
    /// Plans its route to the target if it has none. False: there is none.
    [[nodiscard]] bool TryPlanRoute(Robot& robot, std::size_t target) const;
    /// The quickest route that avoids the excluded nodes.
    [[nodiscard]] std::optional<PlannedRoute> PlanRouteOrNull(
        const Robot& robot,
        std::size_t target,
        const Router::NodeFilter& isExcluded) const;
    /// The lane from the robot's node to the next one, if the robot is stationary between the two. It cannot turn round there, so
    /// its route begins with this lane, and may pass its node again. nullopt if the robot is on its node, or if the target cannot
    /// be reached in this way.
    [[nodiscard]] std::optional<Route> FindLaneOrNull(const Robot& robot, std::size_t target) const;
    /// Between two nodes the robot is farther from the first node than the map allows, and would reject the drive: extends the
    /// allowed deviation to the robot.
    static void ReachStart(const Robot& robot, Route& route);
};

} // namespace ACS::Planning
