#include "McsJudge.hpp"

#include <acs/core/Overloaded.hpp>
#include <acs/plan/PlanTransitions.hpp>

#include <algorithm>
#include <variant>

namespace ACS::Simulation
{

namespace
{

// The enums of the protocol and of the engine have the same order (ReportMapper.cpp relies on it too).
Planning::EPlanState MakeState(Protocol::EPlanStatus status)
{
    return static_cast<Planning::EPlanState>(status);
}

Planning::EStepState MakeState(Protocol::EStepStatus status)
{
    return static_cast<Planning::EStepState>(status);
}

Planning::EJobState MakeState(Protocol::EJobStatus status)
{
    return static_cast<Planning::EJobState>(status);
}

bool IsSameAlarm(const Protocol::ErrorReport& left, const Protocol::ErrorReport& right)
{
    return left.robotID == right.robotID && left.errorCode == right.errorCode && left.planID == right.planID
        && left.jobID == right.jobID;
}

} // namespace

McsJudge::McsJudge(Trace& trace, const CrashableStore& store, const WorkChecker& workChecker)
    : _trace(trace),
      _store(store),
      _workChecker(workChecker)
{
}

void McsJudge::NotePlanSent(const std::string& planID)
{
    ++_plans.at(planID).sent;
}

void McsJudge::NotePlan(const Protocol::ExecutionPlan& plan, bool bGood)
{
    PlanView& view = _plans[plan.planID];
    view.bGood = bGood;
    for (const Protocol::PlanStep& step : plan.steps)
    {
        StepView& stepView = view.steps[step.stepNo];
        for (const Protocol::PlanJob& job : step.jobs)
        {
            stepView.jobs[job.jobID] = Protocol::EJobStatus::Pending;
        }
    }
}

void McsJudge::NotePlanAck(const Protocol::AcsAck& ack)
{
    const auto* const payloadOrNull = std::get_if<Protocol::PlanAck>(&ack.payload);
    const auto found = payloadOrNull == nullptr ? _plans.end() : _plans.find(payloadOrNull->planID);
    if (found == _plans.end())
    {
        _trace.Violate("ExecutionPlanAck for an unknown plan: {}", ack.message);
        return;
    }
    PlanView& plan = found->second;
    const bool bAccepted = ack.result == Protocol::EAckResult::Success;
    // It is already known: the Ack of an earlier attempt was lost.
    const bool bKnown = !bAccepted && plan.sent > 1 && ack.message.find("Duplicated Plan") != std::string::npos;
    if (bAccepted && !plan.bGood)
    {
        _trace.Violate("plan {} was accepted although it is invalid", found->first);
    }
    if (plan.knowledge == EKnowledge::Accepted && !bAccepted && !bKnown)
    {
        _trace.Violate("plan {} was accepted, then refused: {}", found->first, ack.message);
    }
    if (plan.knowledge != EKnowledge::Accepted)
    {
        plan.knowledge = bAccepted || bKnown ? EKnowledge::Accepted : EKnowledge::Refused;
    }
    CheckKept();
}

void McsJudge::NoteFailedByOperator(const std::string& planID)
{
    _failedByOperator.insert(planID);
}

void McsJudge::NoteControlledByOperator(const std::string& planID)
{
    _controlledByOperator.insert(planID);
}

void McsJudge::OnRequest(const Protocol::AcsRequest& request)
{
    if (const auto* statusOrNull = std::get_if<Protocol::RobotStatusUpdate>(&request.payload); statusOrNull != nullptr)
    {
        _statuses[statusOrNull->robotID] = *statusOrNull;
        return;
    }
    if (const auto* tscOrNull = std::get_if<Protocol::TscStateUpdate>(&request.payload); tscOrNull != nullptr)
    {
        _tscState = tscOrNull->state;
        return;
    }
    const Protocol::EAcsCommand command = Protocol::GetCommand(request);
    const bool bReport = command == Protocol::EAcsCommand::PlanReport || command == Protocol::EAcsCommand::StepReport
        || command == Protocol::EAcsCommand::JobReport || command == Protocol::EAcsCommand::ErrorReport
        || GetControlOrNull(command).has_value();
    if (!bReport)
    {
        return;
    }
    const auto [seen, bFirst] = _seen.emplace(request.transactionID, request.payload);
    if (!bFirst)
    {
        if (seen->second != request.payload)
        {
            _trace.Violate("report {} was repeated with different content", request.transactionID);
        }
        return;
    }
    const std::optional<std::uint64_t> sequence = _store.GetSequenceOrNull(request.transactionID);
    if (!sequence.has_value())
    {
        _trace.Violate("{} was sent before it was stored", GetText(command));
    }
    else if (*sequence <= _lastSequence)
    {
        _trace.Violate("report {} was sent after report {}", *sequence, _lastSequence);
    }
    else
    {
        _lastSequence = *sequence;
    }
    HandleFirst(request.payload);
}

void McsJudge::HandleFirst(const Protocol::AcsPayload& payload)
{
    std::visit(
        Core::Overloaded{
            [this](const Protocol::PlanReport& report) { OnPlanReport(report); },
            [this](const Protocol::StepReport& report) { OnStepReport(report); },
            [this](const Protocol::JobReport& report) { OnJobReport(report); },
            [this](const Protocol::ErrorReport& report) { OnAlarm(report); },
            [this](const Protocol::CancelResultReport& report) {
                OnResult(Planning::EPlanControl::Cancel, report.planID, report.result);
            },
            [this](const Protocol::AbortResultReport& report) {
                OnResult(Planning::EPlanControl::Abort, report.planID, report.result);
            },
            [this](const Protocol::PauseResultReport& report) {
                OnResult(Planning::EPlanControl::Pause, report.planID, report.result);
            },
            [this](const Protocol::ResumeResultReport& report) {
                OnResult(Planning::EPlanControl::Resume, report.planID, report.result);
            },
            [](const auto&) {
            }},
        payload);
}

/// The plan, if it may be reported.
McsJudge::PlanView* McsJudge::FindReportedOrNull(const std::string& planID, std::string_view what)
{
    const auto found = _plans.find(planID);
    if (found == _plans.end() || found->second.knowledge == EKnowledge::Refused)
    {
        _trace.Violate("{} for plan {}, which was {}", what, planID, found == _plans.end() ? "never sent" : "refused");
        return nullptr;
    }
    if (Planning::IsFinal(MakeState(found->second.status)))
    {
        _trace.Violate("{} for plan {}, which is already {}", what, planID, GetText(found->second.status));
        return nullptr;
    }
    // A reported plan was accepted, whatever has become of the Ack.
    found->second.knowledge = EKnowledge::Accepted;
    return &found->second;
}

void McsJudge::OnPlanReport(const Protocol::PlanReport& report)
{
    PlanView* const planOrNull = FindReportedOrNull(report.planID, "a PlanReport");
    if (planOrNull == nullptr)
    {
        return;
    }
    const bool bFirstPending =
        report.status == Protocol::EPlanStatus::Pending && planOrNull->status == Protocol::EPlanStatus::Pending;
    if (!bFirstPending && !Planning::CanChange(MakeState(planOrNull->status), MakeState(report.status)))
    {
        _trace.Violate(
            "plan {} changed from {} to {}, which MCS-ACS forbids",
            report.planID,
            GetText(planOrNull->status),
            GetText(report.status));
    }
    planOrNull->status = report.status;
    if (report.status == Protocol::EPlanStatus::Completed)
    {
        CheckCompleted(report.planID, *planOrNull);
    }
    else if (report.status == Protocol::EPlanStatus::Failed)
    {
        CheckFailed(report.planID, *planOrNull);
    }
}

/// A drive that is rejected or lost is no reason: the plan waits for its robot.
void McsJudge::CheckFailed(const std::string& planID, const PlanView& plan)
{
    const bool bHasReason =
        _failedByOperator.contains(planID) || std::ranges::any_of(plan.steps, [](const auto& step) {
            return step.second.jobs.empty() || std::ranges::any_of(step.second.jobs, [](const auto& job) {
                       return job.second == Protocol::EJobStatus::Failed;
                   });
        });
    if (!bHasReason)
    {
        _trace.Violate("plan {} is Failed, but none of its jobs is", planID);
    }
}

void McsJudge::CheckCompleted(const std::string& planID, const PlanView& plan)
{
    for (const auto& [stepNo, step] : plan.steps)
    {
        if (step.status != Protocol::EStepStatus::Completed)
        {
            _trace.Violate("plan {} is Completed, but its step {} is {}", planID, stepNo, GetText(step.status));
        }
        const WorkChecker::JobTruth truth = _workChecker.GetTruth(planID, stepNo, {});
        if (step.jobs.empty() && (truth.finished == 0 || !truth.bMoved))
        {
            _trace.Violate("plan {} is Completed, but no robot executed its step {}", planID, stepNo);
        }
    }
}

void McsJudge::OnStepReport(const Protocol::StepReport& report)
{
    PlanView* const planOrNull = FindReportedOrNull(report.planID, "a StepReport");
    const auto found =
        planOrNull == nullptr ? decltype(planOrNull->steps.begin()){} : planOrNull->steps.find(report.stepNo);
    if (planOrNull == nullptr || found == planOrNull->steps.end())
    {
        return;
    }
    StepView& step = found->second;
    if (!Planning::CanChange(MakeState(step.status), MakeState(report.status)))
    {
        _trace.Violate(
            "step {} of plan {} changed from {} to {}, which MCS-ACS forbids",
            report.stepNo,
            report.planID,
            GetText(step.status),
            GetText(report.status));
    }
    const bool bJobReported = std::ranges::any_of(planOrNull->steps, [](const auto& other) {
        return std::ranges::any_of(other.second.jobs, [](const auto& job) {
            return job.second != Protocol::EJobStatus::Pending;
        });
    });
    const bool bMoved = std::exchange(step.robotID, report.robotID) != report.robotID;
    const bool bTakenOver = report.status == Protocol::EStepStatus::Dispatched
        && step.status != Protocol::EStepStatus::Pending && bMoved && !bJobReported;
    const bool bSameStatus = report.status == Protocol::EStepStatus::Dispatched && !bMoved;
    if (step.status != Protocol::EStepStatus::Pending && !bTakenOver && (bMoved || bSameStatus))
    {
        _trace.Violate("step {} of plan {} is reported of {}", report.stepNo, report.planID, report.robotID);
    }
    step.status = report.status;
    const bool bEarlierDone = std::all_of(planOrNull->steps.begin(), found, [](const auto& earlier) {
        return earlier.second.status == Protocol::EStepStatus::Completed;
    });
    if (!bEarlierDone || planOrNull->status == Protocol::EPlanStatus::Pending)
    {
        _trace.Violate(
            "step {} of plan {} is reported before the previous step has ended",
            report.stepNo,
            report.planID);
    }
    const bool bJobsDone =
        std::ranges::all_of(step.jobs, [](const auto& job) { return job.second == Protocol::EJobStatus::Completed; });
    if (report.status == Protocol::EStepStatus::Completed && !bJobsDone)
    {
        _trace.Violate("step {} of plan {} is Completed before its jobs", report.stepNo, report.planID);
    }
}

void McsJudge::OnJobReport(const Protocol::JobReport& report)
{
    PlanView* const planOrNull = FindReportedOrNull(report.planID, "a JobReport");
    if (planOrNull == nullptr)
    {
        return;
    }
    const auto step = planOrNull->steps.find(report.stepNo);
    const bool bKnown = step != planOrNull->steps.end() && step->second.jobs.contains(report.jobID);
    if (!bKnown)
    {
        _trace.Violate("JobReport for job {}, which plan {} does not have", report.jobID, report.planID);
        return;
    }
    Protocol::EJobStatus& status = step->second.jobs[report.jobID];
    if (!Planning::CanChange(MakeState(status), MakeState(report.status)))
    {
        _trace.Violate(
            "job {} of plan {} changed from {} to {}, which MCS-ACS forbids",
            report.jobID,
            report.planID,
            GetText(status),
            GetText(report.status));
    }
    status = report.status;
    if (step->second.status != Protocol::EStepStatus::InProgress)
    {
        _trace.Violate("job {} of plan {} is reported while its step is not InProgress", report.jobID, report.planID);
    }
    const WorkChecker::JobTruth truth = _workChecker.GetTruth(report.planID, report.stepNo, report.jobID);
    const bool bNeedsEnd = report.status == Protocol::EJobStatus::Completed;
    const bool bNeedsBegin = bNeedsEnd || report.status == Protocol::EJobStatus::InProgress;
    if ((bNeedsEnd && truth.finished == 0) || (bNeedsBegin && truth.begun == 0))
    {
        _trace.Violate(
            "job {} of plan {} is reported as {}, but no robot did that",
            report.jobID,
            report.planID,
            GetText(report.status));
    }
    if (bNeedsEnd && !truth.bMoved)
    {
        _trace.Violate(
            "job {} of plan {} is reported as Completed, but nothing was moved to its target",
            report.jobID,
            report.planID);
    }
}

void McsJudge::OnAlarm(const Protocol::ErrorReport& report)
{
    const auto found = std::ranges::find_if(_alarms, [&report](const Protocol::ErrorReport& known) {
        return IsSameAlarm(known, report);
    });
    if (report.bSet == (found != _alarms.end()))
    {
        _trace.Violate("alarm {} of {} is {} twice", report.errorCode, report.robotID, report.bSet ? "set" : "cleared");
        return;
    }
    if (report.bSet)
    {
        _alarms.push_back(report);
    }
    else
    {
        _alarms.erase(found);
    }
}

void McsJudge::CheckKept()
{
    for (const auto& [planID, plan] : _plans)
    {
        if (plan.knowledge != EKnowledge::Accepted || Planning::IsFinal(MakeState(plan.status)))
        {
            continue;
        }
        const Planning::PlanRecord* const recordOrNull = _store.FindPlanOrNull(planID);
        if (recordOrNull == nullptr)
        {
            _trace.Violate("plan {} was acknowledged but is not stored", planID);
            continue;
        }
        const Planning::EPlanState state = recordOrNull->progress.state;
        const auto isItsEnd = [&planID = planID, state](const Planning::OutboxEntry& entry) {
            const auto* const reportOrNull = std::get_if<Planning::PlanReport>(&entry.report);
            return reportOrNull != nullptr && reportOrNull->planID == planID && reportOrNull->state == state;
        };
        if (Planning::IsFinal(state) && std::ranges::none_of(_store.GetState().outbox, isItsEnd))
        {
            _trace.Violate("plan {} has ended, but its final report is not stored", planID);
        }
    }
}

McsJudge::EKnowledge McsJudge::GetKnowledge(const std::string& planID) const
{
    return _plans.at(planID).knowledge;
}

std::vector<std::string> McsJudge::GetPaused() const
{
    std::vector<std::string> paused;
    for (const auto& [planID, plan] : _plans)
    {
        if (plan.status == Protocol::EPlanStatus::Paused)
        {
            paused.push_back(planID);
        }
    }
    return paused;
}

const std::map<std::string, Protocol::RobotStatusUpdate>& McsJudge::GetStatuses() const noexcept
{
    return _statuses;
}

const std::optional<Protocol::ETscState>& McsJudge::GetTscStateOrNull() const noexcept
{
    return _tscState;
}

const std::vector<Protocol::ErrorReport>& McsJudge::GetAlarms() const noexcept
{
    return _alarms;
}

std::string McsJudge::DescribeOwed() const
{
    std::string text;
    for (const auto& [planID, plan] : _plans)
    {
        if (plan.knowledge == EKnowledge::Unknown)
        {
            text += fmt::format("plan {} has no Ack; ", planID);
        }
        if (plan.knowledge == EKnowledge::Accepted && !Planning::IsFinal(MakeState(plan.status)))
        {
            text += fmt::format("plan {} is {}; ", planID, GetText(plan.status));
        }
    }
    return text + DescribeOwedResults();
}

} // namespace ACS::Simulation
