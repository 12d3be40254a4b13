#include "robot/JobCommand.hpp"

namespace ACS::Planning
{

namespace
{

std::optional<std::string> GetTextForOrNull(
    const std::optional<Core::Location>& placeOrNull,
    const Core::RobotID& robotID)
{
    if (!placeOrNull.has_value())
    {
        return std::nullopt;
    }
    const Core::Result<Core::Location> port = placeOrNull->WithRobot(robotID);
    return port.has_value() ? port->GetText() : placeOrNull->GetText();
}

} // namespace

StartJob MakeStartJob(const Robot& robot)
{
    const ActivePlan& plan = *robot.planOrNull;
    StartJob job = MakeStartJob(plan, plan.step, plan.job, robot);
    job.jobID = GetJobID(plan);
    return job;
}

StartJob MakeStartJob(const ActivePlan& plan, std::size_t stepIndex, std::size_t jobIndex, const Robot& robot)
{
    const Step& step = plan.record.plan.steps[stepIndex];
    const ResolvedStep& resolved = plan.resolved.steps[stepIndex];
    const Core::RobotID& robotID = robot.options->robotID;
    StartJob job;
    job.planID = plan.record.plan.planID;
    job.stepNo = step.stepNo;
    job.action = step.action;
    job.position = resolved.stationID;
    if (jobIndex < resolved.jobs.size())
    {
        job.jobID = step.jobs[jobIndex].jobID;
        job.from = GetTextForOrNull(resolved.jobs[jobIndex].from, robotID);
        job.to = GetTextForOrNull(resolved.jobs[jobIndex].to, robotID);
    }
    if (jobIndex < step.carrierIDs.size() && !step.carrierIDs[jobIndex].empty())
    {
        job.carrierID = step.carrierIDs[jobIndex];
    }
    return job;
}

} // namespace ACS::Planning
