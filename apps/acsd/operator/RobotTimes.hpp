#pragma once

#include "common/http/MetricsEndpoint.hpp"
#include <acs/core/Now.hpp>
#include <acs/plan/ERobotStatus.hpp>
#include <acs/plan/PlanEngine.hpp>
#include <acs/plan/RobotStatus.hpp>

#include <functional>
#include <map>
#include <optional>
#include <string>

namespace ACS::Acsd
{

/// Whether the robot does not move because other robots have reserved the next nodes of its route, or block it. Not while an
/// alarm, its maintenance or the TSC keeps it from driving.
[[nodiscard]] bool IsWaitingForRoute(
    const Planning::PlanEngine& engine,
    const Planning::RobotStatus& status,
    const Planning::RobotRoute& route);

/// How long each robot had each status, and how long it waited for its route.
class RobotTimes final
{
    /// One robot since the last update.
    struct Times
    {
        std::optional<Planning::ERobotStatus> status; ///< nullopt until the first one.
        Core::SteadyTime statusAt;                    ///< Until then its time is counted.
        bool bWaits = false;                          ///< For its route, at the last sample.
        Core::SteadyTime sampledAt;
    };

    Apps::MetricsEndpoint& _metrics;
    std::map<std::string, Times, std::less<>> _robots;

public:
    /// The endpoint must outlive it.
    explicit RobotTimes(Apps::MetricsEndpoint& metrics);

    void OnStatusChanged(const Planning::RobotStatus& status, Core::Now now);

    /// Samples the robots that wait for their routes. Call it regularly: the time between two samples counts if the robot
    /// waited at both of them.
    void Sample(const Planning::PlanEngine& engine, Core::Now now);

private:
    void CountStatus(Times& times, const Planning::RobotStatus& status, Core::SteadyTime now);
};

} // namespace ACS::Acsd
