#include "plans/TrackedPlan.hpp"

#include <algorithm>
#include <cassert>

namespace ACS::McsSim
{

using Protocol::EJobStatus;
using Protocol::EPlanStatus;
using Protocol::EStepStatus;

namespace
{

/// What of an arrival and the jobs of a step is done; the whole step is 1 + the number of its jobs.
double GetDoneParts(const TrackedStep& step) noexcept
{
    if (IsDone(step))
    {
        return 1.0 + static_cast<double>(step.jobs.size());
    }
    double parts = step.status == EStepStatus::InProgress || step.status == EStepStatus::Failed ? 1.0 : 0.0;
    for (const TrackedJob& job : step.jobs)
    {
        parts += job.status == EJobStatus::Completed ? 1.0 : 0.0;
        parts += job.status == EJobStatus::InProgress ? 0.5 : 0.0;
    }
    return parts;
}

} // namespace

std::string_view GetText(EOutcome outcome)
{
    switch (outcome)
    {
        case EOutcome::Open:
            return "unfinished";
        case EOutcome::Completed:
            return "completed";
        case EOutcome::Failed:
            return "failed";
        case EOutcome::Cancelled:
            return "cancelled";
        case EOutcome::Aborted:
            return "aborted";
        case EOutcome::Refused:
            return "refused";
        default:
            assert(false);
            return "";
    }
}

EOutcome GetOutcome(const TrackedPlan& plan)
{
    if (plan.delivery == EDelivery::Refused)
    {
        return EOutcome::Refused;
    }
    switch (plan.status)
    {
        case EPlanStatus::Completed:
            return EOutcome::Completed;
        case EPlanStatus::Failed:
            return EOutcome::Failed;
        case EPlanStatus::Cancelled:
            return EOutcome::Cancelled;
        case EPlanStatus::Aborted:
            return EOutcome::Aborted;
        case EPlanStatus::Pending:
        case EPlanStatus::InProgress:
        case EPlanStatus::Paused:
            return EOutcome::Open;
        default:
            assert(false);
            return EOutcome::Open;
    }
}

bool IsDone(const TrackedStep& step) noexcept
{
    return step.status == EStepStatus::Completed || step.status == EStepStatus::Skipped;
}

std::size_t GetCurrentStep(const TrackedPlan& plan) noexcept
{
    const auto open =
        std::find_if(plan.steps.begin(), plan.steps.end(), [](const TrackedStep& step) { return !IsDone(step); });
    const auto current = open == plan.steps.end() && open != plan.steps.begin() ? open - 1 : open;
    return static_cast<std::size_t>(current - plan.steps.begin());
}

std::size_t GetCurrentJob(const TrackedStep& step) noexcept
{
    const auto open = std::find_if(step.jobs.begin(), step.jobs.end(), [](const TrackedJob& job) {
        return job.status != EJobStatus::Completed;
    });
    const auto current = open == step.jobs.end() && open != step.jobs.begin() ? open - 1 : open;
    return static_cast<std::size_t>(current - step.jobs.begin());
}

double GetProgress(const TrackedPlan& plan) noexcept
{
    if (plan.status == EPlanStatus::Completed)
    {
        return 1.0;
    }
    double done = 0.0;
    double all = 0.0;
    for (const TrackedStep& step : plan.steps)
    {
        done += GetDoneParts(step);
        all += 1.0 + static_cast<double>(step.jobs.size());
    }
    return all > 0.0 ? done / all : 0.0;
}

} // namespace ACS::McsSim
