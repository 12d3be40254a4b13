#include "operator/EntryFeed.hpp"

#include <acs/core/Timestamp.hpp>
#include <acs/json/JsonWriter.hpp>

#include <fmt/format.h>

#include <utility>

namespace ACS::Acsd
{

namespace
{

void WriteOrNull(Json::JsonWriter& writer, std::string_view key, std::string_view value)
{
    writer.Key(key);
    if (value.empty())
    {
        writer.WriteNull();
    }
    else
    {
        writer.WriteString(value);
    }
}

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

EntryFeed::EntryFeed(Publisher publish, Planning::IPlanObserver& next)
    : _publish(std::move(publish)),
      _next(next)
{
}

void EntryFeed::Publish(const Entry& entry, Core::WallTime time)
{
    std::string data;
    Json::JsonWriter writer(data);
    writer.BeginObject();
    writer.Key("time");
    writer.WriteString(Core::FormatUTC(time));
    writer.Key("kind");
    writer.WriteString(entry.kind);
    WriteOrNull(writer, "robotId", entry.robotID);
    WriteOrNull(writer, "planId", entry.planID);
    writer.Key("stepNo");
    if (entry.stepNo == 0)
    {
        writer.WriteNull();
    }
    else
    {
        writer.WriteInteger(entry.stepNo);
    }
    WriteOrNull(writer, "jobId", entry.jobID);
    writer.Key("text");
    writer.WriteString(entry.text);
    writer.EndObject();
    _publish(data);
}

void EntryFeed::OnPlanChanged(
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
    Publish({"plan", record.progress.robotID, record.plan.planID, 0, {}, text}, now.wall);
    _next.OnPlanChanged(record, from, transactionID, now);
}

void EntryFeed::OnStepChanged(
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
    Publish({"step", record.progress.robotID, record.plan.planID, step.stepNo, {}, text}, now.wall);
    _next.OnStepChanged(record, stepIndex, from, transactionID, now);
}

void EntryFeed::OnJobChanged(
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
    Publish({"job", record.progress.robotID, record.plan.planID, step.stepNo, jobID, text}, now.wall);
    _next.OnJobChanged(record, stepIndex, jobIndex, from, transactionID, now);
}

void EntryFeed::OnAlarmChanged(const Planning::Alarm& alarm, bool bSet, std::string_view transactionID, Core::Now now)
{
    const std::string text = fmt::format(
        "{} alarm {} of {} {}{}",
        GetText(alarm.level),
        alarm.errorCode,
        alarm.robotID,
        bSet ? "set" : "cleared",
        bSet ? DescribeReason(alarm.message) : std::string());
    Publish(
        {"alarm",
         alarm.robotID,
         alarm.planID.has_value() ? std::string_view(*alarm.planID) : std::string_view(),
         alarm.stepNo.value_or(0),
         alarm.jobID.has_value() ? std::string_view(*alarm.jobID) : std::string_view(),
         text},
        now.wall);
    _next.OnAlarmChanged(alarm, bSet, transactionID, now);
}

void EntryFeed::OnRobotStatusChanged(const Planning::RobotStatus& status, Core::Now now)
{
    const std::string text = fmt::format(
        "robot {}: {}{}{}",
        status.robotID,
        GetText(status.status),
        status.position.empty() ? std::string() : fmt::format(" at {}", status.position),
        DescribeReason(status.message));
    Publish(
        {"robot",
         status.robotID,
         status.planID.has_value() ? std::string_view(*status.planID) : std::string_view(),
         status.stepNo.value_or(0),
         status.jobID.has_value() ? std::string_view(*status.jobID) : std::string_view(),
         text},
        now.wall);
    _next.OnRobotStatusChanged(status, now);
}

void EntryFeed::OnTscChanged(Planning::ETscState state, Planning::ETscState from, Core::Now now)
{
    Publish({"tsc", {}, {}, 0, {}, fmt::format("TSC: {} -> {}", GetText(from), GetText(state))}, now.wall);
    _next.OnTscChanged(state, from, now);
}

void EntryFeed::OnNote(std::string_view robotID, std::string_view text, Core::Now now)
{
    Publish({"note", robotID, {}, 0, {}, text}, now.wall);
    _next.OnNote(robotID, text, now);
}

} // namespace ACS::Acsd
