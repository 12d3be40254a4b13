#pragma once

#include "PlanKeeper.hpp"
#include "StallWatch.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace ACS::Load
{

/// The site and the work of a measurement.
struct RobotsSetup
{
    std::size_t robots = 0;
    std::size_t plans = 0;   ///< That are kept running; one in each cell, so at most one per cell.
    std::size_t cells = 0;   ///< Of the site.
    std::size_t parking = 0; ///< Parking positions of a cell, one for each robot; 0: none, and one robot in each cell.
    std::size_t storedPlans = 0; ///< In the queue when acsd starts.
};

/// How long acsd took to start, from the exec, in seconds.
struct StartMetrics
{
    double ready = 0.0;  ///< Until it printed that it is ready: the store is loaded.
    double online = 0.0; ///< Until it had reported every robot as connected: all subscriptions are made.
    double placed = 0.0; ///< Until it had reported the position of every robot.
    double cpu = 0.0;    ///< CPU time until then.
};

/// Resource usage of acsd with this number of robots.
struct RobotsMetrics
{
    std::size_t robots = 0;
    double seconds = 0.0;
    double acsdCpu = 0.0; ///< % of a core, as the others.
    double simulatorCpu = 0.0;
    double brokerCpu = 0.0;
    double ownCpu = 0.0;
    std::int64_t residentKiB = 0; ///< Of acsd.
    std::size_t running = 0;      ///< Plans, at the end.
    std::size_t unsent = 0;       ///< Messages to vehicles that acsd could not send.
    StartMetrics start;
    TickMetrics positions;
    KeeperCount count;
};

/// Starts a broker, vda-sim, acsd and, in this program, an MCS; measures while the plans run; ends them all. With stored plans:
/// measures from the time at which every robot has a position. Nullopt on SIGINT or SIGTERM. Throws std::runtime_error with a
/// sentence if a condition is not reached in time.
[[nodiscard]] std::optional<RobotsMetrics> MeasureRobotsOrNull(const RobotsSetup& setup, std::chrono::seconds howLong);

} // namespace ACS::Load
