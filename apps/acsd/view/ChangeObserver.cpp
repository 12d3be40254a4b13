#include "view/ChangeObserver.hpp"

#include <acs/plan/PlanTransitions.hpp>

#include <fmt/format.h>

#include <string>
#include <utility>

namespace ACS::Acsd
{

namespace
{

/// " on LR01", or nothing.
std::string DescribeRobot(std::string_view robotID)
{
    return robotID.empty() ? std::string() : fmt::format(" on {}", robotID);
}

/// ": message", or nothing.
std::string DescribeReason(std::string_view message)
{
    return message.empty() ? std::string() : fmt::format(": {}", message);
}

} // namespace

ChangeObserver::ChangeObserver(Handler handler)
    : _handler(std::move(handler))
{
}

void ChangeObserver::OnPlanChanged(
    const Planning::PlanRecord& record,
    Planning::EPlanState from,
    std::string_view transactionID,
    Core::Now now)
{
    const std::string text = fmt::format(
        "plan {}: {} -> {}{}{}",
        record.plan.planID,
        GetText(from),
        GetText(record.progress.state),
        DescribeRobot(record.progress.robotID),
        DescribeReason(record.progress.message));
    _handler(
        {"plan",
         record.progress.robotID,
         record.plan.planID,
         0,
         {},
         text,
         transactionID,
         Planning::IsFinal(record.progress.state) ? &record : nullptr},
        now);
}

void ChangeObserver::OnStepChanged(
    const Planning::PlanRecord& record,
    std::size_t stepIndex,
    Planning::EStepState from,
    std::string_view transactionID,
    Core::Now now)
{
    const Planning::Step& step = record.plan.steps[stepIndex];
    const std::string text = fmt::format(
        "plan {} step {}: {} -> {} ({} at {})",
        record.plan.planID,
        step.stepNo,
        GetText(from),
        GetText(record.progress.steps[stepIndex].state),
        step.action,
        step.position);
    _handler({"step", record.progress.robotID, record.plan.planID, step.stepNo, {}, text, transactionID}, now);
}

void ChangeObserver::OnJobChanged(
    const Planning::PlanRecord& record,
    std::size_t stepIndex,
    std::size_t jobIndex,
    Planning::EJobState from,
    std::string_view transactionID,
    Core::Now now)
{
    const Planning::Step& step = record.plan.steps[stepIndex];
    const std::string& jobID = step.jobs[jobIndex].jobID;
    const std::string text = fmt::format(
        "plan {} step {} job {}: {} -> {}{}",
        record.plan.planID,
        step.stepNo,
        jobID,
        GetText(from),
        GetText(record.progress.steps[stepIndex].jobs[jobIndex]),
        DescribeRobot(record.progress.robotID));
    _handler({"job", record.progress.robotID, record.plan.planID, step.stepNo, jobID, text, transactionID}, now);
}

void ChangeObserver::OnAlarmChanged(
    const Planning::Alarm& alarm,
    bool bSet,
    std::string_view transactionID,
    Core::Now now)
{
    const std::string text = fmt::format(
        "{} alarm {} of {} {}{}",
        GetText(alarm.level),
        alarm.errorCode,
        alarm.robotID,
        bSet ? "set" : "cleared",
        bSet ? DescribeReason(alarm.message) : std::string());
    _handler(
        {"alarm",
         alarm.robotID,
         alarm.planID.has_value() ? std::string_view(*alarm.planID) : std::string_view(),
         alarm.stepNo.value_or(0),
         alarm.jobID.has_value() ? std::string_view(*alarm.jobID) : std::string_view(),
         text,
         transactionID},
        now);
}

void ChangeObserver::OnRobotStatusChanged(const Planning::RobotStatus& status, Core::Now now)
{
    const std::string text = fmt::format(
        "robot {}: {}{}{}",
        status.robotID,
        GetText(status.status),
        status.position.empty() ? std::string() : fmt::format(" at {}", status.position),
        DescribeReason(status.message));
    _handler(
        {"robot",
         status.robotID,
         status.planID.has_value() ? std::string_view(*status.planID) : std::string_view(),
         status.stepNo.value_or(0),
         status.jobID.has_value() ? std::string_view(*status.jobID) : std::string_view(),
         text,
         {}},
        now);
}

void ChangeObserver::OnTscChanged(Planning::ETscState state, Planning::ETscState from, Core::Now now)
{
    const std::string text = fmt::format("TSC: {} -> {}", GetText(from), GetText(state));
    _handler({"tsc", {}, {}, 0, {}, text, {}}, now);
}

void ChangeObserver::OnNote(std::string_view robotID, std::string_view text, Core::Now now)
{
    _handler({"note", robotID, {}, 0, {}, text, {}}, now);
}

} // namespace ACS::Acsd
