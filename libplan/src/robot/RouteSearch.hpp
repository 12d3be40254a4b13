#pragma once

#include "robot/ActiveDrive.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// A robot yields to the leader until the leader has reached its target, or has another one.
struct Yield
{
    std::size_t leader = 0;
    std::optional<std::uint64_t> planSequence; ///< nullopt: the leader drives to its parking position.
    std::size_t step = 0;
};

/// The planned route of a robot, and what blocks it. Kept by TrafficCoordinator and DeadlockResolver.
struct RouteSearch
{
    std::optional<PlannedRoute> plannedRoute; ///< The quickest route to its target, kept while it waits.
    std::optional<PlannedRoute> detour;       ///< Around the robots that blocked the route at detourAt.
    std::uint64_t detourAt = 0;               ///< PlaceTracker::GetStandingChanges then.
    std::size_t detourTarget = 0;
    ELoad detourLoad = ELoad::Unknown;
    std::size_t detours = 0;           ///< Driven on the way to its present step.
    std::uint64_t refusedAt = 0;       ///< Traffic::GetFreedCount then; 0: ask again.
    std::vector<std::size_t> blockers; ///< Robots that blocked its last attempt to drive.
    std::string block;           ///< What closes its way that no robot can clear: a block, or its load; empty: nothing.
    std::uint64_t blockedAt = 0; ///< Traffic::GetFreedCount when no way around the block was found.
    std::optional<Yield> yield;
};

} // namespace ACS::Planning
