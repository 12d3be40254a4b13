#include "plan/ActivePlan.hpp"

#include <acs/plan/PlanTransitions.hpp>

#include <algorithm>

namespace ACS::Planning
{

bool IsOffered(const ActivePlan& plan)
{
    return plan.robot.has_value() && plan.record.progress.state == EPlanState::Pending;
}

bool HasJob(const ActivePlan& plan)
{
    return !plan.record.plan.steps[plan.step].jobs.empty();
}

const std::string& GetJobID(const ActivePlan& plan)
{
    return HasJob(plan) ? plan.record.plan.steps[plan.step].jobs[plan.job].jobID : plan.madeJobID;
}

EJobState GetJobState(const ActivePlan& plan)
{
    return HasJob(plan) ? plan.record.progress.steps[plan.step].jobs[plan.job] : EJobState::Pending;
}

std::optional<std::size_t> FindStepOrNull(const Plan& plan, std::int32_t stepNo)
{
    const auto found = std::ranges::find(plan.steps, stepNo, &Step::stepNo);
    return found == plan.steps.end() ? std::nullopt
                                     : std::optional(static_cast<std::size_t>(found - plan.steps.begin()));
}

std::optional<std::size_t> FindOpenStepOrNull(const ActivePlan& plan, std::size_t from)
{
    const std::vector<StepProgress>& steps = plan.record.progress.steps;
    for (std::size_t index = from; index < steps.size(); ++index)
    {
        if (!IsFinal(steps[index].state))
        {
            return index;
        }
    }
    return std::nullopt;
}

void FindPosition(ActivePlan& plan)
{
    const std::vector<StepProgress>& steps = plan.record.progress.steps;
    while (plan.step + 1 < steps.size() && IsFinal(steps[plan.step].state))
    {
        ++plan.step;
    }
    const std::vector<EJobState>& jobs = steps[plan.step].jobs;
    while (plan.job + 1 < jobs.size() && IsFinal(jobs[plan.job]))
    {
        ++plan.job;
    }
}

} // namespace ACS::Planning
