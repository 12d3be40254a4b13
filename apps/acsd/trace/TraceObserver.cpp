#include "trace/TraceObserver.hpp"

#include <acs/plan/PlanTransitions.hpp>

#include <fmt/format.h>

namespace ACS::Acsd
{

namespace
{

/// The text after the separator; nothing if it is empty.
std::string AppendPart(std::string_view separator, std::string_view text)
{
    return text.empty() ? std::string() : fmt::format("{}{}", separator, text);
}

} // namespace

TraceObserver::TraceObserver(MessageTrace* traceOrNull, Planning::IPlanObserver& next)
    : _traceOrNull(traceOrNull),
      _next(next)
{
}

void TraceObserver::OnPlanChanged(
    const Planning::PlanRecord& record,
    Planning::EPlanState from,
    std::string_view transactionID,
    Core::Now now)
{
    const Planning::PlanProgress& progress = record.progress;
    Write(
        {"plan", progress.robotID, record.plan.planID, transactionID},
        fmt::format("{} -> {}{}", GetText(from), GetText(progress.state), AppendPart(": ", progress.message)));
    if (_traceOrNull != nullptr && !progress.robotID.empty())
    {
        _traceOrNull->SetPlan(progress.robotID, IsFinal(progress.state) ? std::string() : record.plan.planID);
    }
    _next.OnPlanChanged(record, from, transactionID, now);
}

void TraceObserver::OnStepChanged(
    const Planning::PlanRecord& record,
    std::size_t stepIndex,
    Planning::EStepState from,
    std::string_view transactionID,
    Core::Now now)
{
    const Planning::Step& step = record.plan.steps[stepIndex];
    Write(
        {"step", record.progress.robotID, record.plan.planID, transactionID},
        fmt::format(
            "step {}: {} -> {} ({} at {})",
            step.stepNo,
            GetText(from),
            GetText(record.progress.steps[stepIndex].state),
            step.action,
            step.position));
    if (_traceOrNull != nullptr && !record.progress.robotID.empty())
    {
        _traceOrNull->SetPlan(record.progress.robotID, record.plan.planID);
    }
    _next.OnStepChanged(record, stepIndex, from, transactionID, now);
}

void TraceObserver::OnJobChanged(
    const Planning::PlanRecord& record,
    std::size_t stepIndex,
    std::size_t jobIndex,
    Planning::EJobState from,
    std::string_view transactionID,
    Core::Now now)
{
    const Planning::Step& step = record.plan.steps[stepIndex];
    Write(
        {"job", record.progress.robotID, record.plan.planID, transactionID},
        fmt::format(
            "step {} job {}: {} -> {}",
            step.stepNo,
            step.jobs[jobIndex].jobID,
            GetText(from),
            GetText(record.progress.steps[stepIndex].jobs[jobIndex])));
    _next.OnJobChanged(record, stepIndex, jobIndex, from, transactionID, now);
}

void TraceObserver::OnAlarmChanged(
    const Planning::Alarm& alarm,
    bool bSet,
    std::string_view transactionID,
    Core::Now now)
{
    const std::string planID = alarm.planID.value_or(std::string());
    Write(
        {"alarm", alarm.robotID, planID, transactionID},
        fmt::format("{} {} {}: {}", GetText(alarm.level), alarm.errorCode, bSet ? "set" : "cleared", alarm.message));
    _next.OnAlarmChanged(alarm, bSet, transactionID, now);
}

void TraceObserver::OnRobotStatusChanged(const Planning::RobotStatus& status, Core::Now now)
{
    const std::string planID = status.planID.value_or(std::string());
    Write(
        {"robot", status.robotID, planID, {}},
        fmt::format(
            "{}{}{}",
            GetText(status.status),
            AppendPart(" at ", status.position),
            AppendPart(": ", status.message)));
    _next.OnRobotStatusChanged(status, now);
}

void TraceObserver::OnTscChanged(Planning::ETscState state, Planning::ETscState from, Core::Now now)
{
    Write({"tsc", {}, {}, {}}, fmt::format("{} -> {}", GetText(from), GetText(state)));
    _next.OnTscChanged(state, from, now);
}

void TraceObserver::OnNote(std::string_view robotID, std::string_view text, Core::Now now)
{
    Write({"note", robotID, {}, {}}, std::string(text));
    _next.OnNote(robotID, text, now);
}

void TraceObserver::Write(const Entry& entry, const std::string& text)
{
    if (_traceOrNull != nullptr)
    {
        _traceOrNull->Add(
            {"engine",
             ProtocolBeast::EWireDirection::Out,
             entry.robotID,
             {},
             text,
             entry.kind,
             entry.planID,
             entry.transactionID},
            ETraceUse::All);
    }
}

} // namespace ACS::Acsd
