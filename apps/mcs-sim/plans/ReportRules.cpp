#include "plans/ReportRules.hpp"

#include "plans/ControlRequests.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace ACS::McsSim
{

using Protocol::EAcsCommand;
using Protocol::EJobStatus;
using Protocol::EPlanStatus;
using Protocol::EStepStatus;

namespace
{

template <typename TStatus>
using Transition = std::pair<TStatus, TStatus>;

constexpr std::array PLAN_TRANSITIONS{
    Transition<EPlanStatus>{EPlanStatus::Pending, EPlanStatus::InProgress},
    Transition<EPlanStatus>{EPlanStatus::Pending, EPlanStatus::Paused},
    Transition<EPlanStatus>{EPlanStatus::Pending, EPlanStatus::Cancelled},
    Transition<EPlanStatus>{EPlanStatus::Pending, EPlanStatus::Aborted},
    Transition<EPlanStatus>{EPlanStatus::InProgress, EPlanStatus::Completed},
    Transition<EPlanStatus>{EPlanStatus::InProgress, EPlanStatus::Failed},
    Transition<EPlanStatus>{EPlanStatus::InProgress, EPlanStatus::Cancelled},
    Transition<EPlanStatus>{EPlanStatus::InProgress, EPlanStatus::Aborted},
    Transition<EPlanStatus>{EPlanStatus::InProgress, EPlanStatus::Paused},
    Transition<EPlanStatus>{EPlanStatus::Paused, EPlanStatus::InProgress},
    Transition<EPlanStatus>{EPlanStatus::Paused, EPlanStatus::Pending},
    Transition<EPlanStatus>{EPlanStatus::Paused, EPlanStatus::Aborted},
};

constexpr std::array STEP_TRANSITIONS{
    Transition<EStepStatus>{EStepStatus::Pending, EStepStatus::Dispatched},
    Transition<EStepStatus>{EStepStatus::Pending, EStepStatus::Skipped},
    Transition<EStepStatus>{EStepStatus::Dispatched, EStepStatus::InProgress},
    Transition<EStepStatus>{EStepStatus::Dispatched, EStepStatus::Failed},
    Transition<EStepStatus>{EStepStatus::InProgress, EStepStatus::Completed},
    Transition<EStepStatus>{EStepStatus::InProgress, EStepStatus::Failed},
    Transition<EStepStatus>{EStepStatus::InProgress, EStepStatus::Skipped}, // where its job is unresolved
};

constexpr std::array JOB_TRANSITIONS{
    Transition<EJobStatus>{EJobStatus::Pending, EJobStatus::Instructed},
    Transition<EJobStatus>{EJobStatus::Instructed, EJobStatus::InProgress},
    Transition<EJobStatus>{EJobStatus::Instructed, EJobStatus::Failed},
    Transition<EJobStatus>{EJobStatus::InProgress, EJobStatus::Completed},
    Transition<EJobStatus>{EJobStatus::InProgress, EJobStatus::Failed},
};

/// A first report of Pending changes nothing, and is allowed (D-24).
template <typename TTransitions, typename TTracked, typename TStatus>
std::optional<std::string> FindBadTransitionOrNull(
    const TTransitions& transitions,
    const TTracked& tracked,
    TStatus status)
{
    const bool bInitial = status == TStatus::Pending && tracked.status == TStatus::Pending && !tracked.bReported;
    const Transition<TStatus> wanted{tracked.status, status};
    if (bInitial || std::find(transitions.begin(), transitions.end(), wanted) != transitions.end())
    {
        return std::nullopt;
    }
    return fmt::format("{} after {}", GetText(status), GetText(tracked.status));
}

template <typename TPredicate>
bool IsAnyJob(const TrackedPlan& plan, TPredicate predicate)
{
    return std::ranges::any_of(plan.steps, [&predicate](const TrackedStep& step) {
        return std::ranges::any_of(step.jobs, predicate);
    });
}

bool HasFailedJob(const TrackedStep& step)
{
    return std::ranges::count(step.jobs, EJobStatus::Failed, &TrackedJob::status) > 0;
}

bool IsFailureUntold(const TrackedStep& step)
{
    return HasFailedJob(step) && step.status != EStepStatus::Failed;
}

bool IsAnyEarlierStepOpen(const TrackedPlan& plan, const TrackedStep& step)
{
    return std::any_of(plan.steps.begin(), plan.steps.end(), [&step](const TrackedStep& other) {
        return other.stepNo < step.stepNo && !IsDone(other);
    });
}

} // namespace

bool IsStandstill(Protocol::ERobotStatus status) noexcept
{
    using enum Protocol::ERobotStatus;
    return status == Stopped || status == Error || status == Disconnected || status == Init;
}

std::optional<std::string> FindPlanViolationOrNull(const TrackedPlan& plan, EPlanStatus status)
{
    std::optional<std::string> mistakeOrNull = FindBadTransitionOrNull(PLAN_TRANSITIONS, plan, status);
    if (mistakeOrNull.has_value())
    {
        return mistakeOrNull;
    }
    if (status == EPlanStatus::Completed && !std::all_of(plan.steps.begin(), plan.steps.end(), IsDone))
    {
        return "Completed before all its steps";
    }
    if (status == EPlanStatus::Completed && std::ranges::any_of(plan.steps, HasFailedJob))
    {
        return "Completed with a failed job";
    }
    const auto isBegun = [](const TrackedJob& job) {
        return job.status != EJobStatus::Pending;
    };
    if (status == EPlanStatus::Cancelled && IsAnyJob(plan, isBegun))
    {
        return "Cancelled after a job was begun";
    }
    if (status == EPlanStatus::Failed && std::any_of(plan.steps.begin(), plan.steps.end(), IsFailureUntold))
    {
        return "Failed before the step of its failed job";
    }
    return std::nullopt;
}

bool IsConfirmed(const TrackedPlan& plan, EAcsCommand result)
{
    return result == EAcsCommand::ResumeResultReport ? plan.status != EPlanStatus::Paused
                                                     : plan.status == GetControlRule(result).status;
}

std::optional<std::string> FindSuccessViolationOrNull(const TrackedPlan& plan, EAcsCommand result)
{
    // Only section 6.7 shows the PlanReport before the result report.
    const bool bMayFollow = result != EAcsCommand::PauseResultReport && GetOutcome(plan) == EOutcome::Open;
    if (bMayFollow || IsConfirmed(plan, result))
    {
        return std::nullopt;
    }
    return fmt::format("Success while the plan is {}", GetText(plan.status));
}

std::optional<std::string> FindStepViolationOrNull(const TrackedPlan& plan, const TrackedStep& step, EStepStatus status)
{
    std::optional<std::string> mistakeOrNull = FindBadTransitionOrNull(STEP_TRANSITIONS, step, status);
    if (mistakeOrNull.has_value())
    {
        return mistakeOrNull;
    }
    const bool bBegins = status == EStepStatus::Dispatched || status == EStepStatus::InProgress;
    const bool bBeforeStart = status != EStepStatus::Pending && plan.status == EPlanStatus::Pending;
    // What was begun before the pause may still be reported: an arrival, or the outcome that an operator has decided.
    const bool bDuringPause = status == EStepStatus::Dispatched && plan.status == EPlanStatus::Paused;
    if (bBeforeStart || bDuringPause)
    {
        return fmt::format("{} while the plan is {}", GetText(status), GetText(plan.status));
    }
    if (bBegins && IsAnyEarlierStepOpen(plan, step))
    {
        return fmt::format("{} before the steps in front of it are done", GetText(status));
    }
    const bool bJobsCompleted = std::all_of(step.jobs.begin(), step.jobs.end(), [](const TrackedJob& job) {
        return job.status == EJobStatus::Completed;
    });
    if (status == EStepStatus::Completed && !bJobsCompleted)
    {
        return "Completed before all its jobs";
    }
    if (status == EStepStatus::Skipped && HasFailedJob(step))
    {
        return "Skipped after its failed job";
    }
    return std::nullopt;
}

bool IsTakenOver(const TrackedPlan& plan, const TrackedStep& step, const Protocol::StepReport& report)
{
    const bool bOpen = step.status == EStepStatus::Dispatched || step.status == EStepStatus::InProgress;
    const bool bNoJob = std::ranges::none_of(plan.steps, [](const TrackedStep& other) {
        return std::ranges::any_of(other.jobs, &TrackedJob::bReported);
    });
    return bOpen && bNoJob && report.status == EStepStatus::Dispatched && report.robotID != plan.robotID;
}

std::optional<std::string> FindJobViolationOrNull(
    const TrackedPlan& plan,
    const TrackedStep& step,
    const TrackedJob& job,
    EJobStatus status)
{
    std::optional<std::string> mistakeOrNull = FindBadTransitionOrNull(JOB_TRANSITIONS, job, status);
    if (mistakeOrNull.has_value())
    {
        return mistakeOrNull;
    }
    if (status == EJobStatus::Pending)
    {
        return std::nullopt;
    }
    const bool bDuringPause = status == EJobStatus::Instructed && plan.status == EPlanStatus::Paused;
    if (plan.status == EPlanStatus::Pending || bDuringPause)
    {
        return fmt::format("{} while the plan is {}", GetText(status), GetText(plan.status));
    }
    if (step.status != EStepStatus::InProgress)
    {
        return fmt::format("{} while its step is {}", GetText(status), GetText(step.status));
    }
    if (IsAnyJob(plan, [](const TrackedJob& other) { return other.status == EJobStatus::Failed; }))
    {
        return fmt::format("{} after a failed job", GetText(status));
    }
    return std::nullopt;
}

} // namespace ACS::McsSim
