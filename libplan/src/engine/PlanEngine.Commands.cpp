#include "engine/PlanEngine.Impl.hpp"
#include <acs/core/ECoreError.hpp>
#include <acs/core/Result.hpp>
#include <acs/plan/PlanTransitions.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <utility>

namespace ACS::Planning
{

Core::Result<ResolvedPlan> PlanEngine::Impl::Admit(const Plan& plan) const
{
    const bool bKnown =
        _plans.contains(plan.planID) || (!_options.bFinishedIDsReused && _finished.contains(plan.planID));
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
    if (resolved.has_value() && _outbox.GetUnacknowledged().size() >= _options.maximumReports)
    {
        return Core::Fail(
            make_error_code(Core::ECoreError::QueueFull),
            {},
            fmt::format(
                "fewer than {} reports that the MCS has not acknowledged (Outbox Full)",
                _options.maximumReports),
            fmt::format("{}", _outbox.GetUnacknowledged().size()));
    }
    if (resolved.has_value() && GetTscState() != ETscState::Auto && !_options.bTscPausedAcceptsPlans)
    {
        return Core::Fail(
            make_error_code(Core::ECoreError::QueueFull),
            {},
            "plans while the TSC is Auto",
            std::string(GetText(GetTscState())));
    }
    return resolved;
}

/// Time in the queue counts as priority, continuously: of two plans the same one is always ahead, so keys never change.
PlanEngine::Impl::QueueKey PlanEngine::Impl::MakeQueueKey(const PlanRecord& record) const
{
    const std::int64_t given = record.plan.priority.value_or(_options.defaultPriority);
    const std::int64_t priority = _options.bLowerPriorityFirst ? -given : given;
    const std::int64_t ageing = _options.queueAgeing.count();
    if (ageing == 0)
    {
        return {-priority, record.sequence};
    }
    const auto acceptedAt = std::chrono::duration_cast<std::chrono::milliseconds>(record.acceptedAt.time_since_epoch());
    return {acceptedAt.count() - priority * ageing, record.sequence};
}

/// Register D-23: the same request again, whose Ack may have been lost in a crash. The plan's steps are sorted.
bool PlanEngine::Impl::IsRepetition(const Plan& plan, const std::string& transactionID) const
{
    const auto active = _plans.find(plan.planID);
    const auto finished = _finished.find(plan.planID);
    const PlanRecord* recordOrNull =
        active != _plans.end() ? &active->second->record : (finished != _finished.end() ? &finished->second : nullptr);
    return recordOrNull != nullptr && !transactionID.empty() && recordOrNull->transactionID == transactionID
        && recordOrNull->plan == plan;
}

void PlanEngine::Impl::Submit(const SubmitPlan& command)
{
    constexpr const char* REGISTERED = "Plan registered successfully.";
    auto plan = std::make_unique<ActivePlan>();
    plan->record.plan = command.plan;
    plan->record.transactionID = command.transactionID;
    SortSteps(plan->record.plan);
    _admission.SpellActions(plan->record.plan);
    if (IsRepetition(plan->record.plan, command.transactionID))
    {
        _repeated.emplace(command.replyToken, command.plan.planID);
        _actions.emplace_back(ReplyCommand{command.replyToken, true, REGISTERED});
        return;
    }
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
    plan->key = MakeQueueKey(plan->record);
    ForgetFinished(plan->record.plan.planID);
    if (_options.bInitialPendingReported)
    {
        _unreported.push_back(plan->record.plan.planID);
    }
    _changes.emplace_back(PlanAdded{plan->record});
    _actions.emplace_back(ReplyCommand{command.replyToken, true, REGISTERED});
    StartTimer(EEngineTimer::Dispatch, {}, {});
    _pending.emplace(plan->key, plan.get());
    std::ranges::for_each(_robots, [this, &plan](const Robot& robot) { CheckJobs(*plan, robot); });
    const std::string planID = plan->record.plan.planID;
    _plans.emplace(planID, std::move(plan));
}

/// Register D-23, plan.reuse_finished_id. What the store cannot take comes back (OnStored).
void PlanEngine::Impl::ForgetFinished(const std::string& planID)
{
    const auto found = _finished.find(planID);
    if (found == _finished.end())
    {
        return;
    }
    _changes.emplace_back(PlanRemoved{found->second.sequence});
    _replaced.push_back(std::move(found->second));
    _finished.erase(found);
    std::erase(_finishedOrder, planID);
}

/// Register D-24. Not with the reply: a plan that cannot be stored is refused, and must not have been reported.
void PlanEngine::Impl::TellAccepted()
{
    for (const std::string& planID : std::exchange(_unreported, {}))
    {
        const auto found = _plans.find(planID);
        if (found != _plans.end() && found->second->record.progress.state == EPlanState::Pending)
        {
            TellReport(
                PlanReport{planID, EPlanState::Pending, GetWaitReasonOrNull(planID).value_or(WaitReason()).message});
        }
    }
}

void PlanEngine::Impl::SwitchTsc(const ControlTsc& command)
{
    const bool bAuto = _tscState == ETscState::Auto;
    if (command.bPause && bAuto)
    {
        ChangeTsc(ETscState::Pausing);
        FinishTscPause();
    }
    else if (!command.bPause && !bAuto)
    {
        ChangeTsc(ETscState::Auto);
        _bDispatchNeeded = true;
    }
    _actions.emplace_back(ReplyCommand{command.replyToken, true, fmt::format("The TSC is {}.", GetText(_tscState))});
}

void PlanEngine::Impl::ChangeTsc(ETscState state)
{
    assert(CanChange(_tscState, state));
    const ETscState from = std::exchange(_tscState, state);
    _changes.emplace_back(TscChanged{state});
    if (GetTscState() == state)
    {
        TellTsc(from);
    }
}

void PlanEngine::Impl::TellTsc(ETscState from)
{
    _actions.emplace_back(TscStateChanged{_tscState});
    if (_observerOrNull != nullptr)
    {
        _observerOrNull->OnTscChanged(_tscState, from, _now);
    }
}

bool PlanEngine::Impl::IsAnyPlanRunning() const
{
    return std::ranges::any_of(_plans, [](const auto& entry) {
        return entry.second->record.progress.state == EPlanState::InProgress;
    });
}

/// While the TSC is pausing, only to make way for what still runs.
bool PlanEngine::Impl::CanDriveHome() const
{
    return _tscState == ETscState::Auto || (_tscState == ETscState::Pausing && IsAnyPlanRunning());
}

/// The TSC is paused once no plan runs and no robot moves or works.
void PlanEngine::Impl::FinishTscPause()
{
    const auto isBusy = [](const Robot& robot) {
        const bool bPlanPaused =
            robot.planOrNull != nullptr && robot.planOrNull->record.progress.state == EPlanState::Paused;
        return !bPlanPaused && (robot.drive.has_value() || robot.overdueJobID.has_value());
    };
    if (_tscState == ETscState::Pausing && !IsAnyPlanRunning() && std::ranges::none_of(_robots, isBusy))
    {
        ChangeTsc(ETscState::Paused);
    }
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
