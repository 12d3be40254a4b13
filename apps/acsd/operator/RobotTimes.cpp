#include "operator/RobotTimes.hpp"

#include <acs/plan/EAlarmLevel.hpp>
#include <acs/plan/Report.hpp>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cstddef>
#include <string_view>
#include <vector>

namespace ACS::Acsd
{

namespace
{

constexpr const char* ROBOT_STATE = "acsd_robot_state";
constexpr const char* STATUS_SECONDS = "acsd_robot_status_seconds_total";
constexpr const char* ROUTE_WAIT = "acsd_robot_route_wait_seconds_total";

/// Raised while a robot does not move although it may.
constexpr std::string_view ROBOT_STALLED = "ACS-1009";

double CountSeconds(Core::SteadyTime from, Core::SteadyTime to)
{
    return std::chrono::duration<double>(to - from).count();
}

/// A robot with one of these alarms is not driven.
bool HasBlockingAlarm(const Planning::PlanEngine& engine, const std::string& robotID)
{
    return std::ranges::any_of(engine.GetActiveAlarms(), [&robotID](const Planning::Alarm& alarm) {
        return alarm.robotID == robotID
            && (alarm.level == Planning::EAlarmLevel::Heavy || alarm.errorCode == ROBOT_STALLED);
    });
}

} // namespace

bool IsWaitingForRoute(
    const Planning::PlanEngine& engine,
    const Planning::RobotStatus& status,
    const Planning::RobotRoute& route)
{
    // A robot that is paused, disconnected or faulty has another status.
    if (status.status != Planning::ERobotStatus::Moving || status.bInMaintenance || !engine.GetHoldReason().empty()
        || HasBlockingAlarm(engine, status.robotID))
    {
        return false;
    }
    if (!route.nodes.empty())
    {
        return !route.nodes.front().bReserved;
    }
    // It has no drive yet.
    return status.planID.has_value() && engine.GetWaitReasonOrNull(*status.planID).has_value();
}

RobotTimes::RobotTimes(Apps::MetricsEndpoint& metrics)
    : _metrics(metrics)
{
    _metrics.AddGauge(ROBOT_STATE, "1 for the robot's present status, 0 for its former ones");
    _metrics.AddCounter(STATUS_SECONDS, "Time for which the robot had a status");
    _metrics.AddCounter(ROUTE_WAIT, "Time for which the robot waited for other robots to clear its route");
}

void RobotTimes::OnStatusChanged(const Planning::RobotStatus& status, Core::Now now)
{
    CountStatus(_robots[status.robotID], status, now.steady);
}

void RobotTimes::Sample(const Planning::PlanEngine& engine, Core::Now now)
{
    const std::vector<Planning::RobotRoute> routes = engine.GetRobotRoutes();
    const std::vector<Planning::RobotStatus> statuses = engine.GetRobotStatuses();
    assert(routes.size() == statuses.size()); // both in the order of the options
    for (std::size_t i = 0; i < statuses.size(); ++i)
    {
        const Planning::RobotStatus& status = statuses[i];
        Times& times = _robots[status.robotID];
        CountStatus(times, status, now.steady);
        const bool bWaits = IsWaitingForRoute(engine, status, routes[i]);
        _metrics.Increment(
            ROUTE_WAIT,
            {{"robot", status.robotID}},
            bWaits && times.bWaits ? CountSeconds(times.sampledAt, now.steady) : 0.0);
        times.bWaits = bWaits;
        times.sampledAt = now.steady;
    }
}

void RobotTimes::CountStatus(Times& times, const Planning::RobotStatus& status, Core::SteadyTime now)
{
    const auto makeLabels = [&status](const char* key, Planning::ERobotStatus value) {
        return Apps::MetricsEndpoint::Labels{{"robot", status.robotID}, {key, std::string(GetText(value))}};
    };
    if (times.status.has_value())
    {
        _metrics.Increment(STATUS_SECONDS, makeLabels("status", *times.status), CountSeconds(times.statusAt, now));
    }
    if (times.status != status.status)
    {
        if (times.status.has_value())
        {
            _metrics.SetGauge(ROBOT_STATE, makeLabels("state", *times.status), 0.0);
        }
        _metrics.SetGauge(ROBOT_STATE, makeLabels("state", status.status), 1.0);
        _metrics.CreateCounter(STATUS_SECONDS, makeLabels("status", status.status));
    }
    times.status = status.status;
    times.statusAt = now;
}

} // namespace ACS::Acsd
