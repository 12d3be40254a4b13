#include "PlanLog.hpp"

#include <string>
#include <utility>

namespace ACS::Acsd
{

namespace
{

constexpr const char* PLAN_CHANGES = "acsd_plan_changes_total";
constexpr const char* JOB_CHANGES = "acsd_job_changes_total";
constexpr const char* ALARMS_SET = "acsd_alarms_set_total";

} // namespace

PlanLog::PlanLog(Core::Logger logger, Apps::MetricsEndpoint& metrics)
    : _logger(std::move(logger)),
      _metrics(metrics)
{
    _metrics.AddCounter(PLAN_CHANGES, "Plans that reached a status");
    _metrics.AddCounter(JOB_CHANGES, "Jobs that reached a status");
    _metrics.AddCounter(ALARMS_SET, "Alarms that were set");
}

void PlanLog::OnPlanChanged(const Planning::PlanRecord& record, Planning::EPlanState from, Core::Now /*now*/)
{
    const std::string_view status = GetText(record.progress.state);
    _metrics.Increment(PLAN_CHANGES, {{"status", std::string(status)}});
    _logger.Info(
        "plan",
        {{"planId", record.plan.planID},
         {"robotId", record.progress.robotID},
         {"from", GetText(from)},
         {"status", status},
         {"reason", record.progress.message}});
}

void PlanLog::OnStepChanged(
    const Planning::PlanRecord& record,
    std::size_t stepIndex,
    Planning::EStepState from,
    Core::Now /*now*/)
{
    const Planning::Step& step = record.plan.steps[stepIndex];
    const std::string number = std::to_string(step.stepNo);
    _logger.Info(
        "step",
        {{"planId", record.plan.planID},
         {"robotId", record.progress.robotID},
         {"stepNo", number},
         {"action", step.action},
         {"from", GetText(from)},
         {"status", GetText(record.progress.steps[stepIndex].state)}});
}

void PlanLog::OnJobChanged(
    const Planning::PlanRecord& record,
    std::size_t stepIndex,
    std::size_t jobIndex,
    Planning::EJobState from,
    Core::Now /*now*/)
{
    const Planning::Step& step = record.plan.steps[stepIndex];
    const std::string number = std::to_string(step.stepNo);
    const std::string_view status = GetText(record.progress.steps[stepIndex].jobs[jobIndex]);
    _metrics.Increment(JOB_CHANGES, {{"status", std::string(status)}, {"action", step.action}});
    _logger.Info(
        "job",
        {{"planId", record.plan.planID},
         {"robotId", record.progress.robotID},
         {"stepNo", number},
         {"jobId", step.jobs[jobIndex].jobID},
         {"from", GetText(from)},
         {"status", status}});
}

void PlanLog::OnAlarmChanged(const Planning::Alarm& alarm, bool bSet, Core::Now /*now*/)
{
    if (bSet)
    {
        _metrics.Increment(ALARMS_SET, {{"level", std::string(GetText(alarm.level))}});
    }
    _logger.Warning(
        bSet ? "alarm set" : "alarm cleared",
        {{"robotId", alarm.robotID},
         {"errorCode", alarm.errorCode},
         {"level", GetText(alarm.level)},
         {"planId", alarm.planID.has_value() ? std::string_view(*alarm.planID) : std::string_view()},
         {"text", alarm.message}});
}

void PlanLog::OnRobotStatusChanged(const Planning::RobotStatus& status, Core::Now /*now*/)
{
    _logger.Info(
        "robot",
        {{"robotId", status.robotID},
         {"status", GetText(status.status)},
         {"position", status.position},
         {"planId", status.planID.has_value() ? std::string_view(*status.planID) : std::string_view()}});
}

void PlanLog::OnTscChanged(Planning::ETscState state, Planning::ETscState from, Core::Now /*now*/)
{
    _logger.Info("TSC", {{"from", GetText(from)}, {"state", GetText(state)}});
}

void PlanLog::OnNote(std::string_view robotID, std::string_view text, Core::Now /*now*/)
{
    _logger.Warning(text, {{"robotId", robotID}});
}

} // namespace ACS::Acsd
