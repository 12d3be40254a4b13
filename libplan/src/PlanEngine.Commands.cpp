#include "PlanEngine.Impl.hpp"
#include <acs/core/ECoreError.hpp>
#include <acs/core/Result.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

namespace ACS::Planning
{

Core::Result<ResolvedPlan> PlanEngine::Impl::Admit(const Plan& plan) const
{
    const bool bKnown = _plans.contains(plan.planID) || _finished.contains(plan.planID);
    if (bKnown && !plan.planID.empty())
    {
        return Core::Fail(
            make_error_code(Core::ECoreError::InvalidIdentifier),
            "planId",
            "a planId that was not used before (Duplicated Plan)",
            plan.planID);
    }
    Core::Result<ResolvedPlan> resolved = _admission.Resolve(plan);
    if (resolved.has_value() && _plans.size() >= _options.maximumPlans)
    {
        return Core::Fail(
            make_error_code(Core::ECoreError::QueueFull),
            {},
            fmt::format("fewer than {} unfinished plans (Queue Full)", _options.maximumPlans),
            fmt::format("{}", _plans.size()));
    }
    return resolved;
}

void PlanEngine::Impl::Submit(const SubmitPlan& command)
{
    auto plan = std::make_unique<ActivePlan>();
    plan->record.plan = command.plan;
    SortSteps(plan->record.plan);
    Core::Result<ResolvedPlan> resolved = Admit(plan->record.plan);
    if (!resolved.has_value())
    {
        _actions.emplace_back(ReplyCommand{command.replyToken, false, Core::Describe(resolved.error())});
        return;
    }
    plan->resolved = std::move(*resolved);
    ++_lastPlanSequence;
    plan->record.sequence = _lastPlanSequence;
    plan->record.acceptedAt = _now.wall;
    for (const Step& step : plan->record.plan.steps)
    {
        plan->record.progress.steps.push_back(
            {EStepState::Pending, std::vector<EJobState>(step.jobs.size(), EJobState::Pending)});
    }
    const std::int64_t priority = plan->record.plan.priority.value_or(_options.defaultPriority);
    plan->key = {-priority, plan->record.sequence};
    _changes.emplace_back(PlanAdded{plan->record});
    _actions.emplace_back(ReplyCommand{command.replyToken, true, "Plan registered successfully."});
    StartTimer(EEngineTimer::Dispatch, {}, {});
    _pending.emplace(plan->key, plan.get());
    const std::string planID = plan->record.plan.planID;
    _plans.emplace(planID, std::move(plan));
}

void PlanEngine::Impl::Acknowledge(const MessageAcknowledged& command)
{
    if (!_outbox.TryRemove(command.sequence))
    {
        return;
    }
    if (_acknowledged.empty())
    {
        StartTimer(EEngineTimer::Acknowledged, {}, _options.acknowledgedDelay);
    }
    _acknowledged.emplace_back(ReportRemoved{command.sequence});
}

} // namespace ACS::Planning
