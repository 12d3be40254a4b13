#include "engine/PlanEngine.Impl.hpp"

#include <fmt/format.h>

#include <iterator>
#include <utility>

namespace ACS::Planning
{

std::vector<WaitReason> PlanEngine::Impl::GetWaitReasons() const
{
    std::vector<WaitReason> reasons;
    for (const auto& [planID, plan] : _plans.GetActive())
    {
        if (std::optional<WaitReason> reason = DescribeBegunOrNull(*plan))
        {
            reasons.push_back(std::move(*reason));
        }
    }
    std::size_t position = 0;
    for (const auto& [key, plan] : _plans.GetQueue())
    {
        ++position;
        reasons.push_back(DescribeWaiting(*plan, position));
    }
    return reasons;
}

std::optional<WaitReason> PlanEngine::Impl::GetWaitReasonOrNull(std::string_view planID) const
{
    const ActivePlan* planOrNull = _plans.FindActiveOrNull(planID);
    if (planOrNull == nullptr)
    {
        return std::nullopt;
    }
    const PlanBook::Queue& queue = _plans.GetQueue();
    const auto queued = queue.find(planOrNull->key);
    return queued == queue.end()
        ? DescribeBegunOrNull(*planOrNull)
        : std::optional(
            DescribeWaiting(*planOrNull, static_cast<std::size_t>(std::distance(queue.begin(), queued)) + 1));
}

/// Why the robot is not given the plan now; nullopt where it is.
std::optional<std::string> PlanEngine::Impl::DescribeUnavailabilityOrNull(const ActivePlan& plan, const Robot& robot)
    const
{
    if (!robot.bOnline)
    {
        return DescribeUnfree(robot);
    }
    if (const auto rejection = plan.rejections.find(robot.index); rejection != plan.rejections.end())
    {
        return rejection->second;
    }
    if (!IsFree(robot))
    {
        return DescribeUnfree(robot);
    }
    if (std::optional<std::string> reason = JudgePorts(plan, robot).unavailabilityOrNull)
    {
        return reason;
    }
    if (!HasWay(plan, robot))
    {
        return "no route to " + plan.resolved.steps.front().stationID;
    }
    return CanServe(robot, plan)
        ? std::nullopt
        : std::optional<std::string>(
            "robots that cannot move block the route to the station, or from there to its parking position");
}

WaitReason PlanEngine::Impl::DescribeWaiting(const ActivePlan& plan, std::size_t position) const
{
    WaitReason reason;
    reason.planID = plan.record.plan.planID;
    reason.queuePosition = position;
    for (const std::size_t index : plan.resolved.candidates)
    {
        if (std::optional<std::string> robotReason = DescribeUnavailabilityOrNull(plan, _robots[index]))
        {
            reason.robots.push_back({GetRobotID(_robots[index]), std::move(*robotReason)});
        }
    }
    if (_tscState != ETscState::Auto)
    {
        reason.message = fmt::format("The TSC is {}: no plan is begun.", GetText(_tscState));
    }
    else if (_backlog.IsFailing())
    {
        reason.message = "The store fails: no plan is begun that cannot be stored as begun.";
    }
    else if (_startup.IsHoldingWork())
    {
        reason.message = "Not every robot has told where it stands since the restart.";
    }
    else if (IsRejectedByAll(plan))
    {
        reason.message = DescribeRejections(plan);
    }
    else if (reason.robots.size() < plan.resolved.candidates.size())
    {
        reason.message = "It is about to be begun.";
    }
    else
    {
        reason.message = "No robot that can do it is free for it.";
    }
    return reason;
}

/// Of a plan that is paused, or whose robot has it and stands.
std::optional<WaitReason> PlanEngine::Impl::DescribeBegunOrNull(const ActivePlan& plan) const
{
    WaitReason reason;
    reason.planID = plan.record.plan.planID;
    if (plan.record.progress.state == EPlanState::Paused)
    {
        reason.message = plan.robot.has_value() ? "It is paused." : "It is held in the queue by PausePlan.";
        return reason;
    }
    if (!plan.robot.has_value())
    {
        return std::nullopt;
    }
    const Robot& robot = _robots[*plan.robot];
    if (const EUnavailability unavailability = GetUnavailability(robot); unavailability != EUnavailability::None)
    {
        reason.message = fmt::format("{}: {}.", GetRobotID(robot), Describe(robot, unavailability));
        return reason;
    }
    if (robot.activity == EActivity::Works && robot.job.IsUnresolved())
    {
        reason.message =
            fmt::format("{} cannot tell what became of job {}: look, and answer.", GetRobotID(robot), GetJobID(plan));
        return reason;
    }
    if (plan.bUnstored)
    {
        reason.message = "The store fails, and does not tell yet that the plan was begun.";
        return reason;
    }
    if (robot.stall.IsStalled() && robot.drive.has_value())
    {
        reason.message = fmt::format("{} does not get on: {}.", GetRobotID(robot), DescribeStall(robot));
        return reason;
    }
    if (robot.activity == EActivity::Waits && IsAtPlace(robot))
    {
        const std::optional<std::string> objection = DescribeMissingTrayOrNull(robot);
        reason.message = objection.has_value()
            ? fmt::format("{}: load the tray by hand and correct the record.", *objection)
            : GetRobotID(robot) + " is about to work.";
        return reason;
    }
    const bool bAtBaseEnd = robot.drive.has_value() && !robot.state->bDriving && robot.drive->IsAtBaseEnd();
    if (robot.activity != EActivity::Waits || (robot.drive.has_value() && !bAtBaseEnd))
    {
        return std::nullopt;
    }
    reason.message = DescribeStanding(robot);
    return reason;
}

/// A robot with a plan that has no way yet, or has come to the end of what others leave it.
std::string PlanEngine::Impl::DescribeStanding(const Robot& robot) const
{
    std::string holders;
    for (const std::size_t blocker : robot.blockers)
    {
        holders += (holders.empty() ? "" : " and ") + GetRobotID(_robots[blocker]);
    }
    if (robot.drive.has_value())
    {
        const RouteNode& next = robot.drive->route.nodes[robot.drive->releasedCount];
        return fmt::format(
            "{} waits for node {} on its route{}.",
            GetRobotID(robot),
            next.nodeID,
            holders.empty() ? "" : ", until it is clear of " + holders);
    }
    if (holders.empty())
    {
        return GetRobotID(robot) + " is about to drive.";
    }
    return fmt::format("{} waits for {} to clear its route.", GetRobotID(robot), holders);
}

} // namespace ACS::Planning
