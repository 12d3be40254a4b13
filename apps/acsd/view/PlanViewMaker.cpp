#include "view/PlanViewMaker.hpp"

#include <acs/plan/PlanSummaries.hpp>

#include <cstddef>
#include <string>

namespace ACS::Acsd
{

namespace
{

std::vector<JobView> MakeJobs(const Planning::Step& step, const Planning::StepProgress& progress)
{
    std::vector<JobView> jobs;
    for (std::size_t index = 0; index < step.jobs.size(); ++index)
    {
        const Planning::Job& job = step.jobs[index];
        jobs.push_back({job.jobID, job.from, job.to, std::string(GetText(progress.jobs[index]))});
    }
    return jobs;
}

} // namespace

PlanView MakePlanView(const Planning::PlanRecord& record, EPlanDetail detail)
{
    const Planning::PlanSummary summary = MakeSummary(record);
    PlanView plan;
    plan.planID = record.plan.planID;
    plan.lotID = record.plan.lotID;
    plan.priority = record.GetPriorityOrNull();
    plan.status = GetText(record.progress.state);
    plan.robotID = summary.robotID;
    plan.stepNo = summary.stepNo;
    plan.jobID = summary.jobID;
    plan.currentAction = summary.currentAction;
    plan.acceptedAt = record.acceptedAt;
    plan.startedAt = record.progress.startedAt;
    plan.endedAt = record.progress.endedAt;
    plan.message = record.progress.message;
    for (std::size_t index = 0; index < record.plan.steps.size(); ++index)
    {
        const Planning::Step& step = record.plan.steps[index];
        const Planning::StepProgress& progress = record.progress.steps[index];
        StepView& view = plan.steps.emplace_back();
        view.stepNo = step.stepNo;
        view.action = step.action;
        view.position = step.position;
        view.status = GetText(progress.state);
        if (detail == EPlanDetail::Jobs)
        {
            view.carrierIDs = step.carrierIDs;
            view.jobs = MakeJobs(step, progress);
        }
    }
    return plan;
}

WaitView MakeWaitView(const Planning::WaitReason& reason, Core::WallTime since)
{
    WaitView wait{reason.message, since, reason.queuePosition, {}};
    for (const Planning::RobotUnavailability& robot : reason.robots)
    {
        wait.robots.push_back({robot.robotID, robot.reason});
    }
    return wait;
}

} // namespace ACS::Acsd
