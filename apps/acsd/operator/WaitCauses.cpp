#include "operator/WaitCauses.hpp"

#include "operator/RobotTimes.hpp"
#include <acs/plan/EPlanState.hpp>
#include <acs/plan/ETscState.hpp>
#include <acs/plan/PlanRecord.hpp>
#include <acs/plan/Report.hpp>
#include <acs/plan/RobotStatus.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>
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

/// What robots do for plans.
struct RobotsAtWork
{
    std::vector<Planning::RobotStatus> statuses;
    std::vector<Planning::RobotRoute> routes;                    ///< In the same order.
    std::map<std::string_view, std::size_t, std::less<>> robots; ///< By planID: the robot's index in both.

    explicit RobotsAtWork(const Planning::PlanEngine& engine)
        : statuses(engine.GetRobotStatuses()),
          routes(engine.GetRobotRoutes())
    {
        for (std::size_t i = 0; i < statuses.size(); ++i)
        {
            if (statuses[i].planID.has_value())
            {
                robots.emplace(*statuses[i].planID, i);
            }
        }
    }

    RobotsAtWork(const RobotsAtWork&) = delete;
    RobotsAtWork& operator=(const RobotsAtWork&) = delete;
    ~RobotsAtWork() = default;
};

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
    const Planning::RobotStatus& status,
    const Planning::RobotRoute& route)
{
    if (IsJobUnresolved(engine, planID))
    {
        return CAUSE_JOB;
    }
    if (!engine.GetHoldReason().empty())
    {
        return CAUSE_TSC;
    }
    return IsWaitingForRoute(engine, status, route) ? CAUSE_ROUTE : CAUSE_ROBOT;
}

/// Empty for a plan that makes progress.
std::string_view FindCause(
    const Planning::PlanEngine& engine,
    const RobotsAtWork& atWork,
    const Planning::PlanSummary& plan,
    bool bStoreFailing)
{
    if (plan.state == Planning::EPlanState::Paused)
    {
        return CAUSE_PAUSED;
    }
    // A robot has its plan before the plan is InProgress.
    const auto robot = atWork.robots.find(plan.planID);
    if (robot != atWork.robots.end())
    {
        const bool bWaits = engine.GetWaitReasonOrNull(plan.planID).has_value();
        return bWaits
            ? FindCauseOfRobot(engine, plan.planID, atWork.statuses[robot->second], atWork.routes[robot->second])
            : std::string_view();
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
    const RobotsAtWork atWork(engine);
    for (const Planning::PlanSummary& plan : engine.GetActivePlans())
    {
        const std::string_view cause = FindCause(engine, atWork, plan, bStoreFailing);
        if (!cause.empty())
        {
            ++counts[cause];
        }
    }
    return counts;
}

} // namespace ACS::Acsd
