#include "plans/PlanTracker.hpp"

#include "console/CleanText.hpp"
#include "plans/ReportRules.hpp"
#include <acs/core/Overloaded.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <variant>

// The reports of the ACS, and what is wrong with them.
namespace ACS::McsSim
{

namespace
{

/// " (robotID): text", or what there is of it.
std::string MakeRobotTail(std::string_view robotID, std::string_view text)
{
    return (robotID.empty() ? std::string() : " (" + CleanText(robotID) + ")") + MakeTail(text);
}

} // namespace

void PlanTracker::OnRequest(const Protocol::AcsPayload& payload, Core::WallTime sentAt, Lines& out)
{
    std::visit(
        Core::Overloaded{
            [this, &out](const Protocol::PlanReport& report) { Handle(report, out); },
            [this, sentAt, &out](const Protocol::StepReport& report) { Handle(report, sentAt, out); },
            [this, sentAt, &out](const Protocol::JobReport& report) { Handle(report, sentAt, out); },
            [this, &out](const Protocol::ErrorReport& report) { Handle(report, out); },
            [this, &out](const Protocol::RobotStatusUpdate& update) { Handle(update, out); },
            [this, &out](const Protocol::AcsCommStateUpdate& update) { Handle(update, out); },
            [&out](const Protocol::TscStateUpdate& update) { Handle(update, out); },
            [this, &out](const Protocol::CancelResultReport& report) { Handle(report, out); },
            [this, &out](const Protocol::AbortResultReport& report) { Handle(report, out); },
            [this, &out](const Protocol::PauseResultReport& report) { Handle(report, out); },
            [this, &out](const Protocol::ResumeResultReport& report) { Handle(report, out); },
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
    if (report.status != Protocol::EPlanStatus::Paused)
    {
        CheckStandstill(*planOrNull, out);
    }
    ChangePlan(*planOrNull, [planOrNull, &report] {
        planOrNull->status = report.status;
        planOrNull->bReported = true;
        const bool bBad = IsFinal(report.status) && report.status != Protocol::EPlanStatus::Completed;
        planOrNull->reason = bBad && !report.message.empty() ? report.message : planOrNull->reason;
    });
    CheckConfirmed(*planOrNull, out);
    out.push_back(fmt::format(
        "{} PlanReport {}{}",
        CleanText(report.planID),
        GetText(report.status),
        MakeRobotTail(planOrNull->robotID, report.message)));
}

void PlanTracker::Handle(const Protocol::StepReport& report, Core::WallTime sentAt, Lines& out)
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
    std::optional<std::string> mistake = FindStepViolationOrNull(*planOrNull, *stepOrNull, report.status);
    if (!mistake.has_value() && report.status == Protocol::EStepStatus::Dispatched)
    {
        mistake = FindAbortViolationOrNull(*planOrNull, GetText(report.status), sentAt);
    }
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

void PlanTracker::Handle(const Protocol::JobReport& report, Core::WallTime sentAt, Lines& out)
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
        AddUnknownJob(*planOrNull, "JobReport", report.stepNo, report.jobID, out);
        return;
    }
    CheckRobot(*planOrNull, report.robotID, out);
    const auto number = job - stepOrNull->jobs.begin() + 1;
    std::optional<std::string> mistake = FindJobViolationOrNull(*planOrNull, *stepOrNull, *job, report.status);
    if (!mistake.has_value() && report.status == Protocol::EJobStatus::Instructed)
    {
        mistake = FindAbortViolationOrNull(*planOrNull, GetText(report.status), sentAt);
    }
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

std::optional<std::string> PlanTracker::FindAbortViolationOrNull(
    const TrackedPlan& plan,
    std::string_view begun,
    Core::WallTime sentAt) const
{
    // The result report may come before PlanReport Aborted.
    const bool bResultReported = plan.unconfirmed == Protocol::EAcsCommand::AbortResultReport;
    return bResultReported || _controls.IsAborting(plan.planned.plan.planID, sentAt)
        ? std::optional(fmt::format("{} after the ACS accepted AbortPlan", begun))
        : std::nullopt;
}

template <Protocol::EAcsCommand COMMAND>
void PlanTracker::Handle(const Protocol::ResultReport<COMMAND>& report, Lines& out)
{
    const std::optional<std::string> mistake =
        FindResultViolationOrNull(COMMAND, report.planID, report.result == Protocol::EReportResult::Success);
    if (mistake.has_value())
    {
        AddViolation(fmt::format("{} {} {}", CleanText(report.planID), GetText(COMMAND), *mistake), out);
    }
    out.push_back(fmt::format(
        "{} {} {}{}",
        CleanText(report.planID),
        GetText(COMMAND),
        GetText(report.result),
        MakeTail(report.message)));
}

std::optional<std::string> PlanTracker::FindResultViolationOrNull(
    Protocol::EAcsCommand result,
    const std::string& planID,
    bool bSuccess)
{
    const ControlRequests::EResultOrigin origin = _controls.Close(result, planID, bSuccess);
    TrackedPlan* const foundOrNull = FindTrackedOrNull(planID);
    const std::string_view request = GetText(GetControlRule(result).request);
    if (origin == ControlRequests::EResultOrigin::None)
    {
        return foundOrNull == nullptr ? "for an unknown plan" : fmt::format("without an open {}", request);
    }
    if (!bSuccess)
    {
        return std::nullopt;
    }
    if (origin == ControlRequests::EResultOrigin::Refused)
    {
        return fmt::format("Success after {}Ack Fail", request);
    }
    if (foundOrNull == nullptr || foundOrNull->sends == 0 || foundOrNull->delivery == EDelivery::Refused)
    {
        return "Success for a plan that the ACS does not have";
    }
    std::optional<std::string> mistake = FindSuccessViolationOrNull(*foundOrNull, result);
    if (!mistake.has_value() && !IsConfirmed(*foundOrNull, result))
    {
        foundOrNull->unconfirmed = result;
    }
    const bool bPaused = result == Protocol::EAcsCommand::PauseResultReport && !foundOrNull->robotID.empty();
    if (!mistake.has_value() && bPaused && origin == ControlRequests::EResultOrigin::Request)
    {
        const auto latest = _robotStatuses.find(foundOrNull->robotID);
        if (latest == _robotStatuses.end() ? _robotStatuses.size() < MAX_ROBOTS : !IsStandstill(latest->second))
        {
            _standstillsDue.insert(planID);
        }
    }
    return mistake;
}

template <typename TMessage>
void PlanTracker::CheckNamed(std::string_view what, const TMessage& message, Lines& out)
{
    if (message.planID.value_or("").empty())
    {
        return;
    }
    TrackedPlan* const planOrNull = FindTrackedOrNull(*message.planID);
    if (planOrNull == nullptr || planOrNull->sends == 0)
    {
        AddViolation(fmt::format("{} {} for an unknown plan", CleanText(*message.planID), what), out);
        return;
    }
    const TrackedStep* const stepOrNull =
        message.stepNo.has_value() ? FindStepOrNull(*planOrNull, what, *message.stepNo, out) : nullptr;
    if (stepOrNull == nullptr || message.jobID.value_or("").empty())
    {
        return;
    }
    if (std::ranges::find(stepOrNull->jobs, *message.jobID, &TrackedJob::jobID) == stepOrNull->jobs.end())
    {
        AddUnknownJob(*planOrNull, what, stepOrNull->stepNo, *message.jobID, out);
    }
}

void PlanTracker::AddUnknownJob(
    const TrackedPlan& plan,
    std::string_view what,
    std::int32_t stepNo,
    const std::string& jobID,
    Lines& out)
{
    AddViolation(
        fmt::format(
            "{} {} step {} for an unknown job {}",
            CleanText(plan.planned.plan.planID),
            what,
            stepNo,
            CleanText(jobID)),
        out);
}

void PlanTracker::Handle(const Protocol::ErrorReport& report, Lines& out)
{
    if (report.bSet)
    {
        CheckNamed("ErrorReport", report, out);
    }
    out.push_back(fmt::format(
        "{} ErrorReport {} {} {}{}",
        CleanText(report.robotID.empty() ? "ACS" : report.robotID),
        GetText(report.level),
        CleanText(report.errorCode),
        report.bSet ? "set" : "cleared",
        MakeTail(report.message)));
}

void PlanTracker::Handle(const Protocol::RobotStatusUpdate& update, Lines& out)
{
    CheckNamed("RobotStatusUpdate", update, out);
    if (_robotStatuses.size() < MAX_ROBOTS || _robotStatuses.contains(update.robotID))
    {
        _robotStatuses[update.robotID] = update.robotStatus;
    }
    if (IsStandstill(update.robotStatus))
    {
        std::erase_if(_standstillsDue, [this, &update](const std::string& planID) {
            return FindTrackedOrNull(planID)->robotID == update.robotID;
        });
    }
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
    TrackedPlan* const planOrNull = FindTrackedOrNull(planID);
    if (planOrNull == nullptr)
    {
        AddViolation(fmt::format("{} {} for an unknown plan", CleanText(planID), what), out);
        return nullptr;
    }
    const TrackedPlan& plan = *planOrNull;
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
    return planOrNull;
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

void PlanTracker::CheckConfirmed(TrackedPlan& plan, Lines& out)
{
    if (!plan.unconfirmed.has_value())
    {
        return;
    }
    const bool bConfirmed = IsConfirmed(plan, *plan.unconfirmed);
    const bool bRefuted = !bConfirmed && GetOutcome(plan) != EOutcome::Open;
    if (bRefuted)
    {
        AddViolation(
            fmt::format(
                "{} PlanReport {} after {} Success",
                CleanText(plan.planned.plan.planID),
                GetText(plan.status),
                GetText(*plan.unconfirmed)),
            out);
    }
    if (bConfirmed || bRefuted)
    {
        plan.unconfirmed.reset();
    }
}

void PlanTracker::CheckStandstill(const TrackedPlan& plan, Lines& out)
{
    if (_standstillsDue.erase(plan.planned.plan.planID) > 0)
    {
        AddViolation(
            fmt::format(
                "{} PauseResultReport Success without RobotStatusUpdate Stopped of {}",
                CleanText(plan.planned.plan.planID),
                CleanText(plan.robotID)),
            out);
    }
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
