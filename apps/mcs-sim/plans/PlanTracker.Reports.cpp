#include "plans/PlanTracker.hpp"

#include "console/CleanText.hpp"
#include "plans/ReportRules.hpp"
#include <acs/core/Overloaded.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <variant>

// The reports of the ACS, and what is wrong with them.
namespace ACS::McsSim
{

namespace
{

/// What became of a request to cancel, abort, pause or resume.
template <typename TReport>
void AddResult(std::string_view name, const TReport& report, PlanTracker::Lines& out)
{
    out.push_back(
        fmt::format("{} {} {}{}", CleanText(report.planID), name, GetText(report.result), MakeTail(report.message)));
}

/// " (robotID): text", or what there is of it.
std::string MakeRobotTail(std::string_view robotID, std::string_view text)
{
    return (robotID.empty() ? std::string() : " (" + CleanText(robotID) + ")") + MakeTail(text);
}

} // namespace

void PlanTracker::OnRequest(const Protocol::AcsPayload& payload, Lines& out)
{
    std::visit(
        Core::Overloaded{
            [this, &out](const Protocol::PlanReport& report) { Handle(report, out); },
            [this, &out](const Protocol::StepReport& report) { Handle(report, out); },
            [this, &out](const Protocol::JobReport& report) { Handle(report, out); },
            [&out](const Protocol::ErrorReport& report) { Handle(report, out); },
            [this, &out](const Protocol::AcsCommStateUpdate& update) { Handle(update, out); },
            [&out](const Protocol::TscStateUpdate& update) { Handle(update, out); },
            [&out](const Protocol::CancelResultReport& report) { AddResult("CancelResultReport", report, out); },
            [&out](const Protocol::AbortResultReport& report) { AddResult("AbortResultReport", report, out); },
            [&out](const Protocol::PauseResultReport& report) { AddResult("PauseResultReport", report, out); },
            [&out](const Protocol::ResumeResultReport& report) { AddResult("ResumeResultReport", report, out); },
            // Other messages do not concern a plan, or answer a request that is never sent here.
            [](const auto& /*other*/) {
            }},
        payload);
}

void PlanTracker::Handle(const Protocol::PlanReport& report, Lines& out)
{
    TrackedPlan* const planOrNull = FindReportedOrNull("PlanReport", report.planID, out);
    if (planOrNull == nullptr)
    {
        return;
    }
    const std::optional<std::string> mistake = FindPlanViolationOrNull(*planOrNull, report.status);
    if (mistake.has_value())
    {
        AddViolation(fmt::format("{} PlanReport {}", CleanText(report.planID), *mistake), out);
    }
    ChangePlan(*planOrNull, [planOrNull, &report] {
        planOrNull->status = report.status;
        planOrNull->bReported = true;
        const bool bBad = IsFinal(report.status) && report.status != Protocol::EPlanStatus::Completed;
        planOrNull->reason = bBad && !report.message.empty() ? report.message : planOrNull->reason;
    });
    out.push_back(fmt::format(
        "{} PlanReport {}{}",
        CleanText(report.planID),
        GetText(report.status),
        MakeRobotTail(planOrNull->robotID, report.message)));
}

void PlanTracker::Handle(const Protocol::StepReport& report, Lines& out)
{
    TrackedPlan* const planOrNull = FindReportedOrNull("StepReport", report.planID, out);
    TrackedStep* const stepOrNull =
        planOrNull == nullptr ? nullptr : FindStepOrNull(*planOrNull, "StepReport", report.stepNo, out);
    if (stepOrNull == nullptr)
    {
        return;
    }
    if (IsTakenOver(*planOrNull, *stepOrNull, report))
    {
        planOrNull->robotID = report.robotID;
        stepOrNull->status = Protocol::EStepStatus::Pending;
    }
    CheckRobot(*planOrNull, report.robotID, out);
    const std::optional<std::string> mistake = FindStepViolationOrNull(*planOrNull, *stepOrNull, report.status);
    if (mistake.has_value())
    {
        AddViolation(fmt::format("{} StepReport step {} {}", CleanText(report.planID), report.stepNo, *mistake), out);
    }
    stepOrNull->status = report.status;
    stepOrNull->bReported = true;
    if (report.status == Protocol::EStepStatus::Failed && !report.message.empty())
    {
        planOrNull->reason = report.message;
    }
    out.push_back(fmt::format(
        "{} StepReport step {} {} at {} {}{}",
        CleanText(report.planID),
        report.stepNo,
        CleanText(stepOrNull->action),
        CleanText(stepOrNull->position),
        GetText(report.status),
        MakeRobotTail(report.robotID, report.message)));
}

void PlanTracker::Handle(const Protocol::JobReport& report, Lines& out)
{
    TrackedPlan* const planOrNull = FindReportedOrNull("JobReport", report.planID, out);
    TrackedStep* const stepOrNull =
        planOrNull == nullptr ? nullptr : FindStepOrNull(*planOrNull, "JobReport", report.stepNo, out);
    if (stepOrNull == nullptr)
    {
        return;
    }
    const auto job = std::find_if(stepOrNull->jobs.begin(), stepOrNull->jobs.end(), [&report](const TrackedJob& other) {
        return other.jobID == report.jobID;
    });
    if (job == stepOrNull->jobs.end())
    {
        AddViolation(
            fmt::format(
                "{} JobReport step {} for an unknown job {}",
                CleanText(report.planID),
                report.stepNo,
                CleanText(report.jobID)),
            out);
        return;
    }
    CheckRobot(*planOrNull, report.robotID, out);
    const auto number = job - stepOrNull->jobs.begin() + 1;
    const std::optional<std::string> mistake = FindJobViolationOrNull(*planOrNull, *stepOrNull, *job, report.status);
    if (mistake.has_value())
    {
        AddViolation(
            fmt::format("{} JobReport step {} job {} {}", CleanText(report.planID), report.stepNo, number, *mistake),
            out);
    }
    job->status = report.status;
    job->bReported = true;
    if (report.status == Protocol::EJobStatus::Failed && !report.message.empty())
    {
        planOrNull->reason = report.message;
    }
    out.push_back(fmt::format(
        "{} JobReport step {} job {}/{} {}{}",
        CleanText(report.planID),
        report.stepNo,
        number,
        stepOrNull->jobs.size(),
        GetText(report.status),
        MakeRobotTail(report.robotID, report.message)));
}

void PlanTracker::Handle(const Protocol::ErrorReport& report, Lines& out)
{
    out.push_back(fmt::format(
        "{} ErrorReport {} {} {}{}",
        CleanText(report.robotID.empty() ? "ACS" : report.robotID),
        GetText(report.level),
        CleanText(report.errorCode),
        report.bSet ? "set" : "cleared",
        MakeTail(report.message)));
}

void PlanTracker::Handle(const Protocol::AcsCommStateUpdate& update, Lines& out)
{
    if (_bAcsReady != update.bConnected)
    {
        out.emplace_back(update.bConnected ? "ACS takes plans again" : "ACS takes no plans for now");
    }
    _bAcsReady = update.bConnected;
}

void PlanTracker::Handle(const Protocol::TscStateUpdate& update, Lines& out)
{
    out.push_back(fmt::format("ACS TscStateUpdate {}", GetText(update.state)));
}

TrackedPlan* PlanTracker::FindReportedOrNull(std::string_view what, const std::string& planID, Lines& out)
{
    const TrackedPlan* const foundOrNull = FindPlanOrNull(planID);
    if (foundOrNull == nullptr)
    {
        AddViolation(fmt::format("{} {} for an unknown plan", CleanText(planID), what), out);
        return nullptr;
    }
    TrackedPlan& plan = _plans[static_cast<std::size_t>(foundOrNull - _plans.data())];
    if (plan.sends == 0)
    {
        AddViolation(fmt::format("{} {} before it was sent", CleanText(planID), what), out);
        return nullptr;
    }
    if (GetOutcome(plan) != EOutcome::Open)
    {
        AddViolation(fmt::format("{} {} after it was {}", CleanText(planID), what, GetText(GetOutcome(plan))), out);
        return nullptr;
    }
    return &plan;
}

TrackedStep* PlanTracker::FindStepOrNull(TrackedPlan& plan, std::string_view what, std::int32_t stepNo, Lines& out)
{
    const auto step = std::find_if(plan.steps.begin(), plan.steps.end(), [stepNo](const TrackedStep& other) {
        return other.stepNo == stepNo;
    });
    if (step == plan.steps.end())
    {
        AddViolation(
            fmt::format("{} {} for an unknown step {}", CleanText(plan.planned.plan.planID), what, stepNo),
            out);
        return nullptr;
    }
    return &*step;
}

void PlanTracker::CheckRobot(TrackedPlan& plan, const std::string& robotID, Lines& out)
{
    if (!plan.robotID.empty() && plan.robotID != robotID)
    {
        AddViolation(
            fmt::format(
                "{} moved from {} to {}",
                CleanText(plan.planned.plan.planID),
                CleanText(plan.robotID),
                CleanText(robotID)),
            out);
    }
    plan.robotID = robotID;
}

} // namespace ACS::McsSim
