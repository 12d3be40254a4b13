#include "model/PlanExecutor.hpp"

#include <acs/core/Location.hpp>
#include <acs/core/Result.hpp>
#include <acs/core/Timestamp.hpp>

#include <algorithm>
#include <string>
#include <utility>

namespace ACS::AcsSim
{

using Protocol::EJobStatus;
using Protocol::EPlanStatus;
using Protocol::EReportResult;
using Protocol::ERobotStatus;
using Protocol::EStepStatus;

// ---- the robots: drive to the position of a step, do its jobs one after the other, drive on

void PlanExecutor::StartPlans(Core::Now now, ExecutorActions& out)
{
    for (RobotModel& robot : _robots)
    {
        if (robot.work.has_value())
        {
            continue;
        }
        const auto found = std::ranges::find_if(_waiting, [&](const Protocol::ExecutionPlan& plan) {
            return _entries.at(plan.planID).status != EPlanStatus::Paused && CanExecute(robot, plan);
        });
        if (found == _waiting.end())
        {
            continue;
        }
        robot.work = RobotWork{std::move(*found)};
        _waiting.erase(found);
        _entries.at(robot.work->plan.planID).robotID = robot.name;
        SetPlan(robot.work->plan.planID, EPlanStatus::InProgress, now, out);
        Drive(robot, now, out);
    }
}

/// Of the answers to queries: a robot that drives is before the first job of its step.
void PlanExecutor::UpdateEntry(const RobotModel& robot)
{
    const Protocol::PlanStep& step = robot.work->GetStep();
    const std::size_t job = robot.work->job.value_or(0);
    Protocol::PlanEntry& entry = _entries.at(robot.work->plan.planID);
    entry.stepNo = step.stepNo;
    entry.currentAction = step.action;
    entry.jobID = job < step.jobs.size() ? std::optional(step.jobs[job].jobID) : std::nullopt;
}

void PlanExecutor::Drive(RobotModel& robot, Core::Now now, ExecutorActions& out)
{
    robot.work->job.reset();
    robot.work->due = now.steady + _options.driveTime;
    UpdateEntry(robot);
    SetStep(robot, EStepStatus::Dispatched, out);
    SetStep(robot, EStepStatus::InProgress, out);
    SetRobot(robot, ERobotStatus::Moving, out);
}

/// A step without jobs (OpenSetCover) takes the time of one.
void PlanExecutor::BeginJob(RobotModel& robot, std::size_t job, Core::Now now, ExecutorActions& out)
{
    robot.work->job = job;
    robot.work->due = now.steady + _options.jobTime;
    UpdateEntry(robot);
    SetRobot(robot, ERobotStatus::Working, out);
    SetJob(robot, EJobStatus::Instructed, out);
    SetJob(robot, EJobStatus::InProgress, out);
}

void PlanExecutor::OnTimer(Core::Now now, ExecutorActions& out)
{
    for (RobotModel& robot : _robots)
    {
        if (robot.work.has_value() && !robot.work->bPaused && robot.work->due <= now.steady)
        {
            OnDone(robot, now, out);
        }
    }
}

void PlanExecutor::OnDone(RobotModel& robot, Core::Now now, ExecutorActions& out)
{
    if (robot.work->job.has_value())
    {
        OnJobDone(robot, *robot.work->job, now, out);
        return;
    }
    robot.position = robot.work->GetStep().position;
    SetRobot(robot, ERobotStatus::Arrival, out);
    BeginJob(robot, 0, now, out);
}

void PlanExecutor::OnJobDone(RobotModel& robot, std::size_t job, Core::Now now, ExecutorActions& out)
{
    if (std::exchange(_bFailNext, false))
    {
        FailPlan(robot, now, out);
        return;
    }
    MoveCarrier(robot);
    SetJob(robot, EJobStatus::Completed, out);
    SetRobot(robot, robot.status, out);
    if (robot.work->aborts > 0)
    {
        const std::string planID = robot.work->plan.planID; // The work ends in the call.
        FinishAbort(planID, robot.work->aborts, now, out);
    }
    else if (job + 1 < robot.work->GetStep().jobs.size())
    {
        BeginJob(robot, job + 1, now, out);
    }
    else
    {
        EndStep(robot, now, out);
    }
}

void PlanExecutor::EndStep(RobotModel& robot, Core::Now now, ExecutorActions& out)
{
    SetStep(robot, EStepStatus::Completed, out);
    if (++robot.work->step < robot.work->plan.steps.size())
    {
        Drive(robot, now, out);
        return;
    }
    const std::string planID = robot.work->plan.planID;
    SetPlan(planID, EPlanStatus::Completed, now, out);
    Leave(planID, now, out);
}

void PlanExecutor::FailPlan(RobotModel& robot, Core::Now now, ExecutorActions& out)
{
    const std::string planID = robot.work->plan.planID;
    SetJob(robot, EJobStatus::Failed, out);
    SetStep(robot, EStepStatus::Failed, out);
    SetPlan(planID, EPlanStatus::Failed, now, out);
    ReportAborts(planID, robot.work->aborts, EReportResult::Failed, out);
    Leave(planID, now, out);
}

/// The carrier of a load is that of the job's place in the list; a port that is unloaded is empty.
void PlanExecutor::MoveCarrier(RobotModel& robot)
{
    const Protocol::PlanJob* const jobOrNull = robot.work->GetJobOrNull();
    if (jobOrNull == nullptr)
    {
        return;
    }
    const Core::Result<Core::Location> from = Core::Location::Parse(jobOrNull->from);
    const Core::Result<Core::Location> to = Core::Location::Parse(jobOrNull->to);
    const auto isPort = [](const Core::Result<Core::Location>& place) {
        return place.has_value() && place->IsRobotPort() && !place->IsMemoryPort();
    };
    const auto& port = isPort(to) ? to : from;
    if (!isPort(port))
    {
        return;
    }
    const std::size_t index = port->GetSegments().back().number - std::size_t{1};
    const auto& names = robot.work->GetStep().carrierIDs;
    if (index < robot.carriers.size())
    {
        const std::size_t job = robot.work->job.value_or(0);
        robot.carriers[index] =
            isPort(to) && job < names.size() ? std::optional<std::string>(names[job]) : std::nullopt;
    }
}

// ---- what is reported

RobotModel* PlanExecutor::FindRobotOrNull(std::string_view planID)
{
    const auto found = std::ranges::find_if(_robots, [planID](const RobotModel& robot) {
        return robot.work.has_value() && robot.work->plan.planID == planID;
    });
    return found == _robots.end() ? nullptr : &*found;
}

bool PlanExecutor::IsWaiting(std::string_view planID) const
{
    return std::ranges::find(_waiting, planID, &Protocol::ExecutionPlan::planID) != _waiting.end();
}

bool PlanExecutor::TryForgetWaiting(const std::string& planID)
{
    return std::erase_if(_waiting, [&planID](const Protocol::ExecutionPlan& plan) { return plan.planID == planID; })
        > 0;
}

void PlanExecutor::Leave(const std::string& planID, Core::Now now, ExecutorActions& out)
{
    RobotModel* const robotOrNull = FindRobotOrNull(planID);
    if (robotOrNull != nullptr)
    {
        robotOrNull->work.reset();
        SetRobot(*robotOrNull, ERobotStatus::Idle, out);
    }
    ++_ended;
    out.emplace_back(PlanEnded{planID, _entries.at(planID).status});
    _endedPlans.push_back(planID);
    if (_endedPlans.size() > MOST_ENDED)
    {
        _entries.erase(_endedPlans.front());
        _endedPlans.pop_front();
    }
    StartPlans(now, out);
}

void PlanExecutor::SetPlan(const std::string& planID, EPlanStatus status, Core::Now now, ExecutorActions& out)
{
    Protocol::PlanEntry& entry = _entries.at(planID);
    entry.status = status;
    if (IsFinal(status))
    {
        entry.endTime = Core::Timestamp{now.wall, _options.siteOffset};
    }
    if (status == EPlanStatus::Completed)
    {
        entry.stepNo = 0;
        entry.jobID.reset();
        entry.currentAction.reset();
    }
    out.emplace_back(SendReport{Protocol::PlanReport{planID, status, ""}});
}

void PlanExecutor::SetStep(const RobotModel& robot, EStepStatus status, ExecutorActions& out)
{
    const RobotWork& work = *robot.work;
    out.emplace_back(SendReport{Protocol::StepReport{work.plan.planID, robot.name, work.GetStep().stepNo, status, ""}});
}

void PlanExecutor::SetJob(const RobotModel& robot, EJobStatus status, ExecutorActions& out)
{
    const RobotWork& work = *robot.work;
    const Protocol::PlanJob* const jobOrNull = work.GetJobOrNull();
    if (jobOrNull != nullptr)
    {
        out.emplace_back(SendReport{
            Protocol::JobReport{work.plan.planID, robot.name, work.GetStep().stepNo, jobOrNull->jobID, status, ""}});
    }
}

void PlanExecutor::SetRobot(RobotModel& robot, ERobotStatus status, ExecutorActions& out)
{
    robot.status = status;
    out.emplace_back(SendStatus{MakeStatus(robot)});
}

Protocol::RobotStatusUpdate PlanExecutor::MakeStatus(const RobotModel& robot)
{
    Protocol::RobotStatusUpdate update;
    update.robotID = robot.name;
    update.robotType = robot.type;
    update.robotStatus = robot.status;
    update.position = robot.position;
    update.carrierIDs = robot.carriers;
    if (robot.work.has_value())
    {
        const Protocol::PlanJob* const jobOrNull = robot.work->GetJobOrNull();
        update.planID = robot.work->plan.planID;
        update.stepNo = robot.work->GetStep().stepNo;
        update.jobID = jobOrNull == nullptr ? std::nullopt : std::optional(jobOrNull->jobID);
    }
    return update;
}

} // namespace ACS::AcsSim
