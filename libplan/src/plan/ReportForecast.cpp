#include "plan/ReportForecast.hpp"

namespace ACS::Planning
{

std::size_t CountReportsAhead(EPlanState state)
{
    switch (state)
    {
        case EPlanState::Pending:
            return 3;
        case EPlanState::Paused:
            return 2;
        case EPlanState::InProgress:
            return 1;
        case EPlanState::Completed:
        case EPlanState::Failed:
        case EPlanState::Cancelled:
        case EPlanState::Aborted:
        default:
            return 0;
    }
}

std::size_t CountReportsAhead(EStepState state)
{
    switch (state)
    {
        case EStepState::Pending:
            return 3;
        case EStepState::Dispatched:
            return 2;
        case EStepState::InProgress:
            return 1;
        case EStepState::Completed:
        case EStepState::Failed:
        case EStepState::Skipped:
        default:
            return 0;
    }
}

std::size_t CountReportsAhead(EJobState state)
{
    switch (state)
    {
        case EJobState::Pending:
            return 3;
        case EJobState::Instructed:
            return 2;
        case EJobState::InProgress:
            return 1;
        case EJobState::Completed:
        case EJobState::Failed:
        default:
            return 0;
    }
}

std::size_t CountReportsAhead(const PlanProgress& progress)
{
    std::size_t count = CountReportsAhead(progress.state);
    for (const StepProgress& step : progress.steps)
    {
        count += CountReportsAhead(step.state);
        for (const EJobState job : step.jobs)
        {
            count += CountReportsAhead(job);
        }
    }
    return count;
}

std::size_t CountReportsAhead(const Plan& plan)
{
    std::size_t count = CountReportsAhead(EPlanState::Pending);
    for (const Step& step : plan.steps)
    {
        count += CountReportsAhead(EStepState::Pending) + step.jobs.size() * CountReportsAhead(EJobState::Pending);
    }
    return count;
}

} // namespace ACS::Planning
