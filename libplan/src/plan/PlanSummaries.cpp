#include <acs/plan/PlanSummaries.hpp>

#include <cstddef>
#include <vector>

namespace ACS::Planning
{

PlanSummary MakeSummary(const PlanRecord& record)
{
    PlanSummary summary;
    const PlanProgress& progress = record.progress;
    summary.planID = record.plan.planID;
    summary.state = progress.state;
    summary.robotID = progress.robotID.empty() ? std::nullopt : std::optional(progress.robotID);
    summary.startTime = progress.startedAt.value_or(record.acceptedAt);
    summary.endTime = progress.endedAt;
    if (progress.state == EPlanState::Completed)
    {
        return summary;
    }
    std::size_t step = 0;
    while (
        step + 1 < progress.steps.size()
        && (progress.steps[step].state == EStepState::Completed || progress.steps[step].state == EStepState::Skipped))
    {
        ++step;
    }
    const std::vector<EJobState>& jobs = progress.steps[step].jobs;
    std::size_t job = 0;
    while (job + 1 < jobs.size() && jobs[job] == EJobState::Completed)
    {
        ++job;
    }
    summary.stepNo = record.plan.steps[step].stepNo;
    summary.currentAction = record.plan.steps[step].action;
    if (!jobs.empty())
    {
        summary.jobID = record.plan.steps[step].jobs[job].jobID;
    }
    return summary;
}

} // namespace ACS::Planning
