#pragma once

#include "PlanKeeper.hpp"
#include "StallWatch.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace ACS::Load
{

/// Resource usage of acsd with this number of robots, each with a plan.
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
    TickMetrics positions;
    KeeperCount count;
};

/// Starts a broker, vda-sim, acsd and, in this program, an MCS; measures while a plan runs for each robot; ends them all. The
/// site has room for this number of robots, at least for 100. Nullopt on SIGINT or SIGTERM. Throws std::runtime_error with
/// a sentence if a condition is not reached in time.
[[nodiscard]] std::optional<RobotsMetrics> MeasureRobotsOrNull(std::size_t robots, std::chrono::seconds howLong);

} // namespace ACS::Load
