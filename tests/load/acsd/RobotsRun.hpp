#pragma once

#include "PlanKeeper.hpp"
#include "StallWatch.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace ACS::Load
{

/// What acsd needed for so many robots, each with a plan.
struct RobotsFigures
{
    std::size_t robots = 0;
    double seconds = 0.0;
    double acsdCpu = 0.0; ///< % of a core, as the others.
    double simulatorCpu = 0.0;
    double brokerCpu = 0.0;
    double ownCpu = 0.0;
    std::int64_t residentKiB = 0; ///< Of acsd.
    std::size_t running = 0;      ///< Plans, at the end.
    TickFigures positions;
    KeeperCount count;
};

/// Starts a broker, vda-sim, acsd and, in this program, an MCS; measures when a plan runs for each robot; ends them all. The
/// site has room for so many robots, or for 100. nullopt where SIGINT or SIGTERM asked for the end. Throws
/// std::runtime_error with a sentence where something does not come about.
[[nodiscard]] std::optional<RobotsFigures> MeasureRobotsOrNull(std::size_t robots, std::chrono::seconds howLong);

} // namespace ACS::Load
