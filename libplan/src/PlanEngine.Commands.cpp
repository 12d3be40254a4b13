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

void PlanEngine::Impl::TellControlResult(
    EPlanControl control,
    const std::string& planID,
    bool bSucceeded,
    std::string message)
{
    TellReport(ControlResultReport{control, planID, bSucceeded, std::move(message)});
}

void PlanEngine::Impl::Control(const ControlPlan& command)
{
    const auto reply = [this, &command](bool bAccepted, std::string message) {
        _actions.emplace_back(ReplyCommand{command.replyToken, bAccepted, std::move(message)});
    };
    const auto fail = [this, &command](std::string message) {
        TellControlResult(command.control, command.planID, false, std::move(message));
    };
    const auto active = _plans.find(command.planID);
    if (active == _plans.end())
    {
        const auto finished = _finished.find(command.planID);
        if (finished == _finished.end())
        {
            reply(false, fmt::format("There is no plan {}.", command.planID));
            fail(fmt::format("There is no plan {}.", command.planID));
            return;
        }
        reply(true, "Received.");
        fail(fmt::format("The plan is already {}.", GetText(finished->second.progress.state)));
        return;
    }
    reply(true, "Received.");
    ActivePlan& plan = *active->second;
    if (plan.control.has_value())
    {
        fail(fmt::format("{} of this plan is under way.", GetText(*plan.control)));
        return;
    }
    switch (command.control)
    {
        case EPlanControl::Cancel:
            Cancel(plan);
            break;
        case EPlanControl::Abort:
            Abort(plan);
            break;
        case EPlanControl::Pause:
        case EPlanControl::Resume:
            fail(fmt::format("This version of the ACS does not support {}Plan.", GetText(command.control)));
            break;
        default:
            assert(false && "a control has no case");
            break;
    }
}

/// Section 6.5: until the robot arrives.
void PlanEngine::Impl::Cancel(ActivePlan& plan)
{
    if (plan.bArrived)
    {
        TellControlResult(
            EPlanControl::Cancel,
            plan.record.plan.planID,
            false,
            "The robot has arrived; the plan goes on.");
        return;
    }
    StopDrive(plan, EPlanControl::Cancel);
}

/// Section 6.6, 6.14: a running job is let to its end.
void PlanEngine::Impl::Abort(ActivePlan& plan)
{
    const bool bJobRuns = plan.robot.has_value() && _robots[*plan.robot].activity == EActivity::Works;
    if (bJobRuns)
    {
        plan.control = EPlanControl::Abort;
        return;
    }
    StopDrive(plan, EPlanControl::Abort);
}

/// Ends the plan at once, or, where its robot is under way to the step's place, when the robot stands.
void PlanEngine::Impl::StopDrive(ActivePlan& plan, EPlanControl control)
{
    Robot* robotOrNull = plan.robot.has_value() ? &_robots[*plan.robot] : nullptr;
    if (robotOrNull == nullptr || !robotOrNull->drive.has_value() || robotOrNull->drive->goal == EGoal::Home)
    {
        EndByControl(plan, control);
        return;
    }
    plan.control = control;
    robotOrNull->drive->bCancelling = true;
    Command(*robotOrNull, CancelDrive{robotOrNull->drive->driveID});
    StartTimer(EEngineTimer::ControlConfirm, GetRobotID(*robotOrNull), _options.controlTimeout);
}

void PlanEngine::Impl::EndByControl(ActivePlan& plan, EPlanControl control)
{
    const std::string planID = plan.record.plan.planID;
    const bool bCancelled = control == EPlanControl::Cancel;
    EndPlan(plan, bCancelled ? EPlanState::Cancelled : EPlanState::Aborted, {});
    TellControlResult(control, planID, true, bCancelled ? "The plan was cancelled." : "The plan was aborted.");
}

} // namespace ACS::Planning
