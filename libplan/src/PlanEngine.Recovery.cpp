#include "PlanEngine.Impl.hpp"
#include <acs/core/Overloaded.hpp>

#include <algorithm>

namespace ACS::Planning
{

void PlanEngine::Impl::Restore(StoredState state, Core::Now now, EngineActions& out)
{
    Begin(now);
    _outbox.Restore(std::move(state.outbox), state.lastReportSequence);
    RestoreAlarms(std::move(state.alarms));
    RestoreTsc(state.tscState);
    for (const CarriersChanged& stored : state.carriers)
    {
        const auto found = _robotIndices.find(stored.robotID);
        if (found != _robotIndices.end() && stored.carrierIDs.size() == _robots[found->second].carriers.size())
        {
            Robot& robot = _robots[found->second];
            robot.carriers = stored.carrierIDs;
            robot.lastStatus = MakeStatus(robot, DeriveStatus(robot));
        }
    }
    std::ranges::sort(state.plans, {}, &PlanRecord::sequence);
    for (PlanRecord& record : state.plans)
    {
        RestorePlan(std::move(record));
    }
    StartTimer(EEngineTimer::Dispatch, {}, {});
    End(out);
}

/// What was paused stays so: nothing of it runs after a start.
void PlanEngine::Impl::RestoreTsc(ETscState stored)
{
    const bool bPaused = _options.bTscStartsPaused || stored != ETscState::Auto;
    _tscState = bPaused ? ETscState::Paused : ETscState::Auto;
    if (_tscState != stored)
    {
        _changes.emplace_back(TscChanged{_tscState});
    }
}

/// An alarm about a robot that is gone would have nobody to clear it.
void PlanEngine::Impl::RestoreAlarms(std::vector<Alarm> alarms)
{
    _alarms = std::move(alarms);
    std::vector<Alarm> orphans;
    for (const Alarm& alarm : _alarms)
    {
        if (alarm.robotID != OWN_ROBOT_ID && !_robotIndices.contains(alarm.robotID))
        {
            orphans.push_back(alarm);
        }
        // Set when the store worked again, to be cleared by what was not called any more.
        _bStoreFailing = _bStoreFailing || alarm.errorCode == ALARM_STORE;
    }
    for (const Alarm& orphan : orphans)
    {
        ClearAlarm(orphan);
    }
}

void PlanEngine::Impl::RestorePlan(PlanRecord record)
{
    _lastPlanSequence = std::max(_lastPlanSequence, record.sequence);
    if (IsFinal(record.progress.state))
    {
        RememberFinished(std::move(record));
        return;
    }
    auto owned = std::make_unique<ActivePlan>();
    ActivePlan& plan = *owned;
    plan.record = std::move(record);
    plan.key = MakeQueueKey(plan.record);
    Core::Result<ResolvedPlan> resolved = _admission.Resolve(plan.record.plan);
    _plans.emplace(plan.record.plan.planID, std::move(owned));
    // One that was paused before a robot had it is held in the queue.
    const bool bHeld = plan.record.progress.state == EPlanState::Paused && plan.record.progress.robotID.empty();
    if (plan.record.progress.state != EPlanState::Pending && !bHeld)
    {
        EndInterrupted(plan);
        return;
    }
    if (!resolved.has_value())
    {
        EndPlan(
            plan,
            EPlanState::Aborted,
            "The site or the robots have changed while the ACS was down: " + Core::Describe(resolved.error()));
        return;
    }
    plan.resolved = std::move(*resolved);
    if (!bHeld)
    {
        _pending.emplace(plan.key, &plan);
    }
}

/// Nobody saw what became of the work: it is ended, with an alarm that says where to look.
void PlanEngine::Impl::EndInterrupted(ActivePlan& plan)
{
    const PlanSummary summary = MakeSummary(plan.record);
    Alarm alarm;
    alarm.robotID = plan.record.progress.robotID;
    alarm.errorCode = ALARM_INTERRUPTED;
    alarm.level = EAlarmLevel::Heavy;
    alarm.message = "The ACS stopped while this plan was worked on: look at the robot and its carriers.";
    alarm.planID = summary.planID;
    alarm.stepNo = summary.stepNo;
    alarm.jobID = summary.jobID;
    const std::vector<StepProgress>& steps = plan.record.progress.steps;
    while (plan.step + 1 < steps.size() && IsFinal(steps[plan.step].state))
    {
        ++plan.step;
    }
    const std::vector<EJobState>& jobs = steps[plan.step].jobs;
    while (plan.job + 1 < jobs.size() && IsFinal(jobs[plan.job]))
    {
        ++plan.job;
    }
    RaiseAlarm(std::move(alarm));
    if (plan.record.progress.state == EPlanState::InProgress)
    {
        FailPlan(plan, "The ACS was restarted while the plan was worked on.");
        return;
    }
    // The robot still stands for that, and nobody else would have it go on.
    if (const auto robot = _robotIndices.find(plan.record.progress.robotID); robot != _robotIndices.end())
    {
        _robots[robot->second].bResumeOwed = true;
    }
    // Section 7 has no other way out of Paused.
    EndPlan(plan, EPlanState::Aborted, "The ACS was restarted while the plan was paused.");
}

void PlanEngine::Impl::OnStoreFailed(
    const StoreBatch& batch,
    std::span<const EngineAction> skipped,
    std::string_view reason,
    Core::Now now,
    EngineActions& out)
{
    _now = now;
    _bStoreFailing = true;
    _bStoreAttempted = false;
    const std::string refusal = "The plan cannot be stored: " + std::string(reason);
    bool bPlanRefused = false;
    for (const StoreChange& change : batch.changes)
    {
        const auto* removedOrNull = std::get_if<PlanRemoved>(&change);
        if (removedOrNull != nullptr
            && std::ranges::count(_replaced, removedOrNull->sequence, &PlanRecord::sequence) > 0)
        {
            continue; // it comes back below
        }
        const auto* addedOrNull = std::get_if<PlanAdded>(&change);
        if (addedOrNull == nullptr)
        {
            _unsaved.push_back(change);
            continue;
        }
        // Not told to anybody and not begun: as if it had never come.
        bPlanRefused = true;
        const auto found = _plans.find(addedOrNull->record.plan.planID);
        if (found != _plans.end())
        {
            _pending.erase(found->second->key);
            _plans.erase(found);
        }
    }
    for (PlanRecord& record : std::exchange(_replaced, {}))
    {
        RememberFinished(std::move(record));
    }
    Alarm alarm;
    alarm.robotID = OWN_ROBOT_ID;
    alarm.errorCode = ALARM_STORE;
    alarm.level = EAlarmLevel::Heavy;
    alarm.message = "Plans cannot be stored: " + std::string(reason);
    for (const EngineAction& action : skipped)
    {
        std::visit(
            Core::Overloaded{
                [this](const StorePlans& typed) {
                    _unsaved.insert(_unsaved.end(), typed.batch.changes.begin(), typed.batch.changes.end());
                },
                [this](const SendReport& typed) { _held.push_back(typed.entry); },
                [&out, &refusal, bPlanRefused](const ReplyCommand& typed) {
                    const bool bRefusedNow = bPlanRefused && typed.bAccepted;
                    out.emplace_back(bRefusedNow ? ReplyCommand{typed.replyToken, false, refusal} : typed);
                },
                [&out](const auto& typed) {
                    out.emplace_back(typed);
                }},
            action);
    }
    RaiseAlarm(std::move(alarm));
    std::ranges::move(_changes, std::back_inserter(_unsaved));
    _changes.clear();
    for (EngineAction& action : _actions)
    {
        if (auto* reportOrNull = std::get_if<SendReport>(&action); reportOrNull != nullptr)
        {
            _held.push_back(std::move(reportOrNull->entry));
        }
    }
    _actions.clear();
    out.emplace_back(StartEngineTimer{{EEngineTimer::StoreRetry, {}}, _options.storeRetry});
}

/// A call after a batch that did not fail.
void PlanEngine::Impl::NoteStoreSuccess()
{
    if (!_bStoreFailing || !_bStoreAttempted)
    {
        return;
    }
    _bStoreFailing = false;
    Alarm alarm;
    alarm.robotID = OWN_ROBOT_ID;
    alarm.errorCode = ALARM_STORE;
    ClearAlarm(alarm);
}

} // namespace ACS::Planning
