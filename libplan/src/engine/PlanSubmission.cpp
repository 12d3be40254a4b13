#include "engine/PlanSubmission.hpp"

#include "plan/ReportForecast.hpp"
#include <acs/core/ECoreError.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace ACS::Planning
{

PlanSubmission::PlanSubmission(EngineState& engine, const TscControl& tsc, const WaitReasons& waits)
    : _options(engine.options),
      _admission(engine.admission),
      _plans(engine.plans),
      _fleet(engine.fleet),
      _outbox(engine.outbox),
      _room(engine.room),
      _transaction(engine.transaction),
      _call(engine.call),
      _backlog(engine.backlog),
      _tsc(tsc),
      _waits(waits)
{
}

void PlanSubmission::Submit(const SubmitPlan& command)
{
    constexpr const char* REGISTERED = "Plan registered successfully.";
    auto plan = std::make_unique<ActivePlan>();
    plan->record.plan = command.plan;
    plan->record.transactionID = command.transactionID;
    SortSteps(plan->record.plan);
    _admission.SpellActions(plan->record.plan);
    if (IsRepetition(plan->record.plan, command.transactionID))
    {
        _call.repeatedPlanIDs.emplace(command.replyToken, command.plan.planID);
        _transaction.Reply(command.replyToken, true, REGISTERED);
        return;
    }
    if (_backlog.HasWithheld()) // not tried: the number of refusals that wait stays limited
    {
        const std::string refusal =
            "The plan cannot be stored because the store is failing. Send it again later, with a new transactionId.";
        if (_backlog.HasUnknown(command.plan.planID))
        {
            _backlog.Withhold({command.replyToken, false, refusal});
            return;
        }
        _transaction.Reply(command.replyToken, false, refusal);
        return;
    }
    Core::Result<ResolvedPlan> resolved = Admit(plan->record.plan);
    if (!resolved.has_value())
    {
        _transaction.Reply(command.replyToken, false, Core::Describe(resolved.error()));
        return;
    }
    plan->resolved = std::move(*resolved);
    if (_options.bInitialPendingReported)
    {
        _unreported.push_back(plan->record.plan.planID);
    }
    _transaction.Store(_plans.Accept(std::move(plan), _transaction.GetNow().wall));
    _transaction.Reply(command.replyToken, true, REGISTERED);
    _transaction.StartTimer(EEngineTimer::Dispatch, {}, {});
}

void PlanSubmission::ReportAccepted()
{
    for (const std::string& planID : std::exchange(_unreported, {}))
    {
        const ActivePlan* planOrNull = _plans.FindActiveOrNull(planID);
        if (planOrNull != nullptr && planOrNull->record.progress.state == EPlanState::Pending)
        {
            _transaction.AddReport(PlanReport{
                planID,
                EPlanState::Pending,
                _waits.GetWaitReasonOrNull(planID).value_or(WaitReason()).message});
        }
    }
}

Core::Result<ResolvedPlan> PlanSubmission::Admit(const Plan& plan)
{
    const bool bKnown = _plans.FindActiveOrNull(plan.planID) != nullptr
        || (!_options.bFinishedIDsReused && _plans.FindFinishedOrNull(plan.planID) != nullptr);
    if (bKnown && !plan.planID.empty())
    {
        return Core::Fail(
            make_error_code(Core::ECoreError::InvalidIdentifier),
            "planId",
            "an unused planId (Duplicated Plan)",
            plan.planID);
    }
    const auto worker = std::ranges::find_if(_fleet, [&plan](const Robot& robot) {
        const StartJob* jobOrNull = robot.job.GetOrNull();
        return jobOrNull != nullptr && jobOrNull->planID == plan.planID;
    });
    if (worker != _fleet.end()) // the two jobs would have the same name for operators and robots
    {
        return Core::Fail(
            make_error_code(Core::ECoreError::InvalidIdentifier),
            "planId",
            fmt::format("an unused planId (Duplicated Plan: {} still has a job of the ended plan)", worker->GetID()),
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
    if (resolved.has_value() && _tsc.GetTscState() != ETscState::Auto && !_options.bTscPausedAcceptsPlans)
    {
        return Core::Fail(
            make_error_code(Core::ECoreError::QueueFull),
            {},
            "TSC state Auto",
            std::string(GetText(_tsc.GetTscState())));
    }
    if (resolved.has_value() && !_room.TryReserve(plan)) // last: what is reserved is accepted
    {
        return Core::Fail(
            make_error_code(Core::ECoreError::QueueFull),
            {},
            fmt::format(
                "room for {} reports of the plan among {} (Outbox Full)",
                CountReportsAhead(plan),
                _options.maximumReports),
            fmt::format(
                "{} unacknowledged reports and {} that accepted plans can cause",
                _outbox.GetUnacknowledged().size(),
                _plans.GetReportsAhead()));
    }
    return resolved;
}

bool PlanSubmission::IsRepetition(const Plan& plan, const std::string& transactionID) const
{
    const PlanRecord* recordOrNull = _plans.FindRecordOrNull(plan.planID);
    return recordOrNull != nullptr && !transactionID.empty() && recordOrNull->transactionID == transactionID
        && recordOrNull->plan == plan;
}

} // namespace ACS::Planning
