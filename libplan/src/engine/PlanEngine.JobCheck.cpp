#include "engine/PlanEngine.Impl.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace ACS::Planning
{

/// A plan that a robot has stays with it: the adapter refuses its jobs itself.
void PlanEngine::Impl::OnJobCheck(Robot& robot, const JobCheckChanged& event)
{
    robot.jobCheck = event.jobCheck;
    for (const auto& [planID, plan] : _plans.GetActive())
    {
        if (!plan->robot.has_value())
        {
            CheckJobs(*plan, robot);
        }
    }
    _bDispatchNeeded = true;
}

/// The plan's first job that the robot cannot do keeps the plan from the robot.
void PlanEngine::Impl::CheckJobs(ActivePlan& plan, const Robot& robot) const
{
    plan.rejections.erase(robot.index);
    if (robot.jobCheck == nullptr || std::ranges::count(plan.resolved.candidates, robot.index) == 0)
    {
        return;
    }
    for (std::size_t step = 0; step < plan.resolved.steps.size(); ++step)
    {
        const std::size_t count = std::max<std::size_t>(plan.resolved.steps[step].jobs.size(), 1);
        for (std::size_t job = 0; job < count; ++job)
        {
            std::optional<std::string> reason =
                robot.jobCheck->GetRejectionReasonOrNull(MakeStartJob(plan, step, job, robot));
            if (reason.has_value())
            {
                plan.rejections.emplace(robot.index, std::move(*reason));
                return;
            }
        }
    }
}

/// What a robot that is out of reach would reject is not known for certain.
bool PlanEngine::Impl::IsRejectedByAll(const ActivePlan& plan) const
{
    return std::ranges::all_of(plan.resolved.candidates, [this, &plan](std::size_t index) {
        return _robots[index].bOnline && plan.rejections.contains(index);
    });
}

std::string PlanEngine::Impl::DescribeRejections(const ActivePlan& plan) const
{
    std::string text;
    for (const auto& [index, reason] : plan.rejections)
    {
        text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", GetRobotID(_robots[index]), reason);
    }
    return fmt::format("No robot can do it: {}.", text);
}

} // namespace ACS::Planning
