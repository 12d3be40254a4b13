#include "operator/WaitCauses.hpp"

#include "operator/RobotTimes.hpp"
#include <acs/plan/EPlanState.hpp>
#include <acs/plan/ETscState.hpp>
#include <acs/plan/PlanRecord.hpp>
#include <acs/plan/Report.hpp>
#include <acs/plan/RobotStatus.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace ACS::Acsd
{

namespace
{

constexpr std::string_view CAUSE_QUEUE = "queue";
constexpr std::string_view CAUSE_PAUSED = "paused";
constexpr std::string_view CAUSE_TSC = "tsc";
constexpr std::string_view CAUSE_STORE = "store";
constexpr std::string_view CAUSE_ROUTE = "route";
constexpr std::string_view CAUSE_JOB = "job";
constexpr std::string_view CAUSE_ROBOT = "robot";

/// Of a job whose outcome is unknown.
constexpr std::string_view JOB_UNRESOLVED = "ACS-1008";

bool IsJobUnresolved(const Planning::PlanEngine& engine, const std::string& planID)
{
    return std::ranges::any_of(engine.GetActiveAlarms(), [&planID](const Planning::Alarm& alarm) {
        return alarm.planID == planID && alarm.errorCode == JOB_UNRESOLVED;
    });
}

/// Of a plan that a robot has and that makes no progress.
std::string_view FindCauseOfRobot(
    const Planning::PlanEngine& engine,
    const std::string& planID,
    const Planning::RobotStatus& status)
{
    if (IsJobUnresolved(engine, planID))
    {
        return CAUSE_JOB;
    }
    if (!engine.GetHoldReason().empty())
    {
        return CAUSE_TSC;
    }
    const std::vector<Planning::RobotRoute> routes = engine.GetRobotRoutes();
    const auto route = std::ranges::find(routes, status.robotID, &Planning::RobotRoute::robotID);
    return route != routes.end() && IsWaitingForRoute(engine, status, *route) ? CAUSE_ROUTE : CAUSE_ROBOT;
}

/// Empty for a plan that makes progress.
std::string_view FindCause(
    const Planning::PlanEngine& engine,
    const std::vector<Planning::RobotStatus>& statuses,
    const Planning::PlanSummary& plan,
    bool bStoreFailing)
{
    if (plan.state == Planning::EPlanState::Paused)
    {
        return CAUSE_PAUSED;
    }
    // A robot has its plan before the plan is InProgress.
    const auto robot = std::ranges::find(statuses, plan.planID, &Planning::RobotStatus::planID);
    if (robot != statuses.end())
    {
        const bool bWaits = engine.GetWaitReasonOrNull(plan.planID).has_value();
        return bWaits ? FindCauseOfRobot(engine, plan.planID, *robot) : std::string_view();
    }
    if (engine.GetTscState() != Planning::ETscState::Auto)
    {
        return CAUSE_TSC;
    }
    return bStoreFailing ? CAUSE_STORE : CAUSE_QUEUE;
}

} // namespace

std::map<std::string_view, std::size_t> CountWaitCauses(const Planning::PlanEngine& engine, bool bStoreFailing)
{
    std::map<std::string_view, std::size_t> counts{
        {CAUSE_QUEUE, 0},
        {CAUSE_PAUSED, 0},
        {CAUSE_TSC, 0},
        {CAUSE_STORE, 0},
        {CAUSE_ROUTE, 0},
        {CAUSE_JOB, 0},
        {CAUSE_ROBOT, 0}};
    const std::vector<Planning::RobotStatus> statuses = engine.GetRobotStatuses();
    for (const Planning::PlanSummary& plan : engine.GetActivePlans())
    {
        const std::string_view cause = FindCause(engine, statuses, plan, bStoreFailing);
        if (!cause.empty())
        {
            ++counts[cause];
        }
    }
    return counts;
}

} // namespace ACS::Acsd
