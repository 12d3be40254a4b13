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
    const bool bKnown = _plans.FindActiveOrNull(plan.planID) != nullptr
        || (!_options.bFinishedIDsReused && _plans.FindFinishedOrNull(plan.planID) != nullptr);
    if (bKnown && !plan.planID.empty())
    {
        return Core::Fail(
            make_error_code(Core::ECoreError::InvalidIdentifier),
            "planId",
            "a planId that was not used before (Duplicated Plan)",
            plan.planID);
    }
    Core::Result<ResolvedPlan> resolved = _admission.Resolve(plan);
    if (resolved.has_value() && _plans.GetActive().size() >= _options.maximumPlans)
    {
        return Core::Fail(
            make_error_code(Core::ECoreError::QueueFull),
            {},
            fmt::format("fewer than {} unfinished plans (Queue Full)", _options.maximumPlans),
            fmt::format("{}", _plans.GetActive().size()));
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

/// Register D-23: the same request again, whose Ack may have been lost in a crash. The plan's steps are sorted.
bool PlanEngine::Impl::IsRepetition(const Plan& plan, const std::string& transactionID) const
{
    const PlanRecord* recordOrNull = _plans.FindRecordOrNull(plan.planID);
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
    if (_options.bInitialPendingReported)
    {
        _unreported.push_back(plan->record.plan.planID);
    }
    std::ranges::for_each(_robots, [this, &plan](const Robot& robot) { CheckJobs(*plan, robot); });
    Store(_plans.Accept(std::move(plan), _now.wall));
    _actions.emplace_back(ReplyCommand{command.replyToken, true, REGISTERED});
    StartTimer(EEngineTimer::Dispatch, {}, {});
}

/// Register D-24. Not with the reply: a plan that cannot be stored is refused, and must not have been reported.
void PlanEngine::Impl::ReportAccepted()
{
    for (const std::string& planID : std::exchange(_unreported, {}))
    {
        const ActivePlan* planOrNull = _plans.FindActiveOrNull(planID);
        if (planOrNull != nullptr && planOrNull->record.progress.state == EPlanState::Pending)
        {
            AddReport(
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
        PublishTscState(from);
    }
}

void PlanEngine::Impl::PublishTscState(ETscState from)
{
    _actions.emplace_back(TscStateChanged{_tscState});
    if (_observerOrNull != nullptr)
    {
        _observerOrNull->OnTscChanged(_tscState, from, _now);
    }
}

/// While the TSC is pausing, only to make way for what still runs.
bool PlanEngine::Impl::CanDriveHome() const
{
    return _tscState == ETscState::Auto || (_tscState == ETscState::Pausing && _plans.IsAnyRunning());
}

/// The TSC is paused once no plan runs and no robot moves or works.
void PlanEngine::Impl::FinishTscPause()
{
    const auto isBusy = [](const Robot& robot) {
        const bool bPlanPaused =
            robot.planOrNull != nullptr && robot.planOrNull->record.progress.state == EPlanState::Paused;
        return !bPlanPaused && (robot.drive.has_value() || robot.job.IsOverdue());
    };
    if (_tscState == ETscState::Pausing && !_plans.IsAnyRunning() && std::ranges::none_of(_robots, isBusy))
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
