#include "operator/PlanLog.hpp"

#include "operator/AlarmText.hpp"
#include <acs/plan/EAlarmLevel.hpp>
#include <acs/plan/EPlanState.hpp>
#include <acs/plan/PlanTransitions.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace ACS::Acsd
{

namespace
{

constexpr const char* PLAN_CHANGES = "acsd_plan_changes_total";
constexpr const char* JOB_CHANGES = "acsd_job_changes_total";
constexpr const char* ALARMS_SET = "acsd_alarms_set_total";
constexpr const char* PLAN_WAIT = "acsd_plan_wait_seconds";
constexpr const char* PLAN_DURATION = "acsd_plan_duration_seconds";
constexpr const char* PLAN_UNCHANGED = "acsd_plan_unchanged_seconds";
constexpr const char* STEP_DURATION = "acsd_step_duration_seconds";
constexpr const char* JOB_DURATION = "acsd_job_duration_seconds";
constexpr const char* JOB_FAILURES = "acsd_job_failures_total";
constexpr const char* NOTES = "acsd_robot_notes_total";

constexpr std::array PLAN_STATES{
    Planning::EPlanState::Pending,
    Planning::EPlanState::InProgress,
    Planning::EPlanState::Paused,
    Planning::EPlanState::Completed,
    Planning::EPlanState::Failed,
    Planning::EPlanState::Cancelled,
    Planning::EPlanState::Aborted};

/// Alarms of a robot that are logged before the rate limit: more than a robot has at a time.
constexpr std::size_t FEW_ALARMS = 20;

/// Changes of a robot into one status at one place: a working robot does not repeat one that often within a minute.
constexpr std::size_t FEW_STATUSES = 20;

double GetSeconds(Core::WallTime from, Core::WallTime to)
{
    // Negative if the wall clock was set back.
    return std::max(0.0, std::chrono::duration<double>(to - from).count());
}

} // namespace

PlanLog::PlanLog(Core::Logger logger, Apps::MetricsEndpoint& metrics)
    : _logger(std::move(logger)),
      _metrics(metrics),
      _robotTimes(metrics),
      _notes(_logger),
      _alarms(_logger, FEW_ALARMS),
      _robots(_logger, FEW_STATUSES)
{
    _metrics.AddCounter(PLAN_CHANGES, "Plans that reached a status");
    _metrics.AddCounter(JOB_CHANGES, "Jobs that reached a status");
    _metrics.AddCounter(ALARMS_SET, "Alarms that were set");
    _metrics.AddHistogram(
        PLAN_WAIT,
        "Time from the acceptance of a plan to its start",
        {0.1, 0.5, 1, 5, 10, 30, 60, 120, 300, 600, 1'800, 3'600});
    _metrics.AddHistogram(
        PLAN_DURATION,
        "Time from the start of a plan to its end, by its last status",
        {5, 10, 30, 60, 120, 300, 600, 1'200, 1'800, 3'600});
    _metrics.AddGauge(
        PLAN_UNCHANGED,
        "Longest time for which a plan in progress has changed neither its status nor a step nor a job; 0 without one");
    _metrics.AddHistogram(
        STEP_DURATION,
        "Time from the start of a step, with its drive, to its end, by action",
        {1, 2, 5, 10, 20, 30, 60, 120, 300, 600, 1'200, 1'800});
    _metrics.AddHistogram(
        JOB_DURATION,
        "Time from the command of a job to its end, by action",
        {0.5, 1, 2, 5, 10, 20, 30, 60, 120, 300, 600});
    _metrics.AddCounter(JOB_FAILURES, "Failed jobs, by action");
    _metrics.AddCounter(NOTES, "Deviations of the robot from its commands");
}

void PlanLog::CreateSeries(const Planning::EngineOptions& options)
{
    for (const Planning::EPlanState state : PLAN_STATES)
    {
        _metrics.CreateCounter(PLAN_CHANGES, {{"status", std::string(GetText(state))}});
    }
    for (const Planning::EAlarmLevel level : {Planning::EAlarmLevel::Heavy, Planning::EAlarmLevel::Light})
    {
        _metrics.CreateCounter(ALARMS_SET, {{"level", std::string(GetText(level))}});
    }
    for (const auto& [action, rule] : options.actions)
    {
        if (std::ranges::find(options.robots, rule.robotType, &Planning::RobotOptions::type) != options.robots.end())
        {
            _metrics.CreateCounter(JOB_FAILURES, {{"action", action}});
        }
    }
    for (const Planning::RobotOptions& robot : options.robots)
    {
        _metrics.CreateCounter(NOTES, {{"robot", robot.robotID.GetText()}});
    }
    _metrics.CreateHistogram(PLAN_WAIT);
}

void PlanLog::Sample(const Planning::PlanEngine& engine, Core::Now now)
{
    _robotTimes.Sample(engine, now);
    Core::Duration longest{0};
    for (const Planning::PlanSummary& plan : engine.GetActivePlans())
    {
        if (plan.state == Planning::EPlanState::InProgress)
        {
            // A plan from before a restart counts from its first sample.
            const Core::SteadyTime changedAt = _changes.try_emplace(plan.planID, now.steady).first->second;
            longest = std::max(longest, now.steady - changedAt);
        }
    }
    _metrics.SetGauge(PLAN_UNCHANGED, {}, std::chrono::duration<double>(longest).count());
}

void PlanLog::OnPlanChanged(
    const Planning::PlanRecord& record,
    Planning::EPlanState from,
    std::string_view transactionID,
    Core::Now now)
{
    MarkChanged(record, now);
    const std::string_view status = GetText(record.progress.state);
    _metrics.Increment(PLAN_CHANGES, {{"status", std::string(status)}});
    const Planning::PlanProgress& progress = record.progress;
    if (from == Planning::EPlanState::Pending && progress.startedAt.has_value())
    {
        _metrics.Observe(PLAN_WAIT, {}, GetSeconds(record.acceptedAt, *progress.startedAt));
    }
    if (Planning::IsFinal(progress.state))
    {
        // Steps and jobs of the plan whose end is not reported any more.
        std::erase_if(_steps, [&record](const auto& step) { return step.first.first == record.plan.planID; });
        std::erase_if(_jobs, [&record](const auto& job) { return job.first.first == record.plan.planID; });
        if (progress.startedAt.has_value() && progress.endedAt.has_value())
        {
            _metrics.Observe(
                PLAN_DURATION,
                {{"status", std::string(status)}},
                GetSeconds(*progress.startedAt, *progress.endedAt));
        }
    }
    _logger.Info(
        "plan",
        {{"planId", record.plan.planID},
         {"robotId", record.progress.robotID},
         {"from", GetText(from)},
         {"status", status},
         {"transactionId", transactionID},
         {"reason", record.progress.message}});
}

void PlanLog::OnStepChanged(
    const Planning::PlanRecord& record,
    std::size_t stepIndex,
    Planning::EStepState from,
    std::string_view transactionID,
    Core::Now now)
{
    const Planning::Step& step = record.plan.steps[stepIndex];
    const std::string number = std::to_string(step.stepNo);
    MarkChanged(record, now);
    ObserveStep(record, step, record.progress.steps[stepIndex].state, now);
    _logger.Info(
        "step",
        {{"planId", record.plan.planID},
         {"robotId", record.progress.robotID},
         {"stepNo", number},
         {"action", step.action},
         {"from", GetText(from)},
         {"status", GetText(record.progress.steps[stepIndex].state)},
         {"transactionId", transactionID}});
}

void PlanLog::OnJobChanged(
    const Planning::PlanRecord& record,
    std::size_t stepIndex,
    std::size_t jobIndex,
    Planning::EJobState from,
    std::string_view transactionID,
    Core::Now now)
{
    const Planning::Step& step = record.plan.steps[stepIndex];
    const std::string number = std::to_string(step.stepNo);
    const std::string_view status = GetText(record.progress.steps[stepIndex].jobs[jobIndex]);
    _metrics.Increment(JOB_CHANGES, {{"status", std::string(status)}, {"action", step.action}});
    MarkChanged(record, now);
    ObserveJob(record, step, step.jobs[jobIndex].jobID, record.progress.steps[stepIndex].jobs[jobIndex], now);
    _logger.Info(
        "job",
        {{"planId", record.plan.planID},
         {"robotId", record.progress.robotID},
         {"stepNo", number},
         {"jobId", step.jobs[jobIndex].jobID},
         {"from", GetText(from)},
         {"status", status},
         {"transactionId", transactionID}});
}

void PlanLog::MarkChanged(const Planning::PlanRecord& record, Core::Now now)
{
    if (Planning::IsFinal(record.progress.state))
    {
        _changes.erase(record.plan.planID);
    }
    else
    {
        _changes.insert_or_assign(record.plan.planID, now.steady);
    }
}

/// The time of a step that another robot takes over begins again. A skipped step is not measured.
void PlanLog::ObserveStep(
    const Planning::PlanRecord& record,
    const Planning::Step& step,
    Planning::EStepState state,
    Core::Now now)
{
    const std::pair key(record.plan.planID, step.stepNo);
    if (state == Planning::EStepState::Dispatched)
    {
        _steps.insert_or_assign(key, now.steady);
        return;
    }
    const auto begun = _steps.find(key);
    if (!Planning::IsFinal(state) || begun == _steps.end())
    {
        return;
    }
    if (state != Planning::EStepState::Skipped)
    {
        const std::chrono::duration<double> lasted = now.steady - begun->second;
        _metrics.Observe(STEP_DURATION, {{"action", step.action}}, lasted.count());
    }
    _steps.erase(begun);
}

void PlanLog::ObserveJob(
    const Planning::PlanRecord& record,
    const Planning::Step& step,
    const std::string& jobID,
    Planning::EJobState state,
    Core::Now now)
{
    const std::pair key(record.plan.planID, jobID);
    if (!Planning::IsFinal(state))
    {
        _jobs.try_emplace(key, now.steady);
        return;
    }
    if (state == Planning::EJobState::Failed)
    {
        _metrics.Increment(JOB_FAILURES, {{"action", step.action}});
    }
    const auto begun = _jobs.find(key);
    if (begun != _jobs.end())
    {
        const std::chrono::duration<double> lasted = now.steady - begun->second;
        _metrics.Observe(JOB_DURATION, {{"action", step.action}}, lasted.count());
        _jobs.erase(begun);
    }
}

void PlanLog::OnAlarmChanged(const Planning::Alarm& alarm, bool bSet, std::string_view transactionID, Core::Now now)
{
    if (bSet)
    {
        _metrics.Increment(ALARMS_SET, {{"level", std::string(GetText(alarm.level))}});
    }
    _alarms.Write(
        now.steady,
        Core::ELogLevel::Warning,
        alarm.robotID,
        bSet ? "alarm set" : "alarm cleared",
        {{"robotId", alarm.robotID},
         {"errorCode", alarm.errorCode},
         {"level", GetText(alarm.level)},
         {"planId", alarm.planID.has_value() ? std::string_view(*alarm.planID) : std::string_view()},
         {"transactionId", transactionID},
         {"text", MakeAlarmText(alarm)}});
}

void PlanLog::OnRobotStatusChanged(const Planning::RobotStatus& status, Core::Now now)
{
    _robotTimes.OnStatusChanged(status, now);
    _robots.Write(
        now.steady,
        Core::ELogLevel::Info,
        fmt::format("{} {} {}", status.robotID, GetText(status.status), status.position),
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

void PlanLog::OnNote(std::string_view robotID, std::string_view text, Core::Now now)
{
    _metrics.Increment(NOTES, {{"robot", std::string(robotID)}});
    const std::string kind = std::string(robotID) + ' ' + std::string(text);
    _notes.Write(now.steady, Core::ELogLevel::Warning, kind, text, {{"robotId", robotID}});
}

} // namespace ACS::Acsd
