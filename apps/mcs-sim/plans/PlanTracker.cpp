#include "plans/PlanTracker.hpp"

#include "console/CleanText.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <utility>
#include <variant>

namespace ACS::McsSim
{

using Protocol::EAckResult;
using Protocol::EAcsCommand;

namespace
{

TrackedPlan MakeTracked(PlannedPlan&& planned)
{
    TrackedPlan tracked;
    for (const Protocol::PlanStep& step : planned.plan.steps)
    {
        TrackedStep& made = tracked.steps.emplace_back();
        made.stepNo = step.stepNo;
        made.action = step.action;
        made.position = step.position;
        for (const Protocol::PlanJob& job : step.jobs)
        {
            made.jobs.emplace_back().jobID = job.jobID;
        }
    }
    std::stable_sort(tracked.steps.begin(), tracked.steps.end(), [](const TrackedStep& left, const TrackedStep& right) {
        return left.stepNo < right.stepNo;
    });
    tracked.planned = std::move(planned);
    return tracked;
}

} // namespace

PlanTracker::PlanTracker(std::vector<PlannedPlan> plans, bool bResending)
    : _bResending(bResending)
{
    _plans.reserve(plans.size());
    for (PlannedPlan& planned : plans)
    {
        static_cast<void>(AddPlan(std::move(planned)));
    }
}

std::size_t PlanTracker::AddPlan(PlannedPlan plan)
{
    const auto [entry, bNew] = _byTransaction.emplace(plan.transactionID, _plans.size());
    if (bNew)
    {
        _byPlanID[plan.plan.planID].push_back(_plans.size());
        _plans.push_back(MakeTracked(std::move(plan)));
        ++_outcomes.front();
    }
    return entry->second;
}

void PlanTracker::OnRegistered()
{
    _bAcsReady = true;
    _firstWaiting = 0;
    for (TrackedPlan& plan : _plans)
    {
        if (plan.delivery == EDelivery::Sent && _bResending)
        {
            plan.delivery = EDelivery::Waiting;
        }
    }
}

void PlanTracker::OnLinkLost()
{
    _bAcsReady = false;
    for (TrackedPlan& plan : _plans)
    {
        plan.bAckLost = plan.bAckLost || plan.delivery == EDelivery::Sent;
    }
    _controls.OnLinkLost();
    _standstillsDue.clear(); // without a connection the next status may replace it
}

std::optional<std::size_t> PlanTracker::GetNextToSendOrNull(Core::Now now, std::size_t first)
{
    if (!_bAcsReady)
    {
        return std::nullopt;
    }
    std::size_t unanswered = 0;
    // Those before `first` count where the number of unanswered plans is limited.
    for (std::size_t i = _bResending ? _firstWaiting : std::max(_firstWaiting, first); i < _plans.size(); ++i)
    {
        const TrackedPlan& plan = _plans[i];
        const bool bOpen = GetOutcome(plan) == EOutcome::Open;
        const bool bSent = bOpen && plan.delivery == EDelivery::Sent;
        const bool bLate = bSent && _bResending && now.steady - plan.lastSent >= RESEND_AFTER;
        const bool bDue = (bOpen && plan.delivery == EDelivery::Waiting) || bLate;
        if (bDue && i >= first)
        {
            return i;
        }
        const bool bDueLater = bDue || bSent || plan.delivery == EDelivery::Blocked;
        _firstWaiting += !bDueLater && i == _firstWaiting ? 1U : 0U;
        unanswered += bSent ? 1U : 0U;
        if (unanswered >= SEND_WINDOW && _bResending)
        {
            return std::nullopt;
        }
    }
    return std::nullopt;
}

void PlanTracker::Block(std::size_t index)
{
    assert(_plans[index].sends == 0);
    _plans[index].delivery = EDelivery::Blocked;
}

void PlanTracker::Unblock(std::size_t index)
{
    assert(_plans[index].delivery == EDelivery::Blocked);
    _plans[index].delivery = EDelivery::Waiting;
}

void PlanTracker::ReplacePlan(std::size_t index, const Protocol::ExecutionPlan& plan)
{
    assert(_plans[index].sends == 0);
    _plans[index].planned.plan = plan;
}

void PlanTracker::OnSent(std::size_t index, Core::Now now, Lines& out)
{
    TrackedPlan& plan = _plans[index];
    // What was answered once stays answered, though it goes again.
    plan.delivery = plan.delivery == EDelivery::Waiting ? EDelivery::Sent : plan.delivery;
    plan.lastSent = now.steady;
    ++plan.sends;
    out.push_back(fmt::format(
        "{} ExecutionPlan {}",
        CleanText(plan.planned.plan.planID),
        plan.sends == 1 ? "sent" : "sent again"));
}

void PlanTracker::OnRequestSent(const Protocol::AcsRequest& request)
{
    _controls.OnSent(request);
}

void PlanTracker::OnAck(const Protocol::AcsAck& ack, Lines& out)
{
    _controls.OnAck(ack);
    if (ack.command != EAcsCommand::ExecutionPlan)
    {
        const auto* const planAckOrNull = std::get_if<Protocol::PlanAck>(&ack.payload);
        out.push_back(fmt::format(
            "{} {}Ack {}{}",
            CleanText(planAckOrNull == nullptr || planAckOrNull->planID.empty() ? "ACS" : planAckOrNull->planID),
            GetText(ack.command),
            GetText(ack.result),
            MakeTail(ack.message)));
        return;
    }
    const auto found = _byTransaction.find(ack.transactionID);
    TrackedPlan* planOrNull = found == _byTransaction.end() ? nullptr : &_plans[found->second];
    const auto* const payloadOrNull = std::get_if<Protocol::PlanAck>(&ack.payload);
    if (payloadOrNull != nullptr && !payloadOrNull->planID.empty()
        && (planOrNull == nullptr || planOrNull->planned.plan.planID != payloadOrNull->planID))
    {
        // An Ack that came too late is taken for that of another transaction by the session: its planId knows better.
        const auto named = _byPlanID.find(payloadOrNull->planID);
        planOrNull = named == _byPlanID.end() ? nullptr : &_plans[named->second.front()];
    }
    if (planOrNull == nullptr)
    {
        AddViolation("ExecutionPlanAck for an unknown plan", out);
        return;
    }
    if (planOrNull->delivery == EDelivery::Accepted || planOrNull->delivery == EDelivery::Refused)
    {
        return; // The answer to one that was sent twice.
    }
    // A plan that is reported was accepted, regardless of the answer to a repetition.
    const bool bAccepted = ack.result == EAckResult::Success || planOrNull->bReported;
    ChangePlan(*planOrNull, [planOrNull, bAccepted, &ack] {
        planOrNull->delivery = bAccepted ? EDelivery::Accepted : EDelivery::Refused;
        planOrNull->reason = bAccepted ? planOrNull->reason : ack.message;
    });
    out.push_back(fmt::format(
        "{} ExecutionPlanAck {}{}",
        CleanText(planOrNull->planned.plan.planID),
        GetText(ack.result),
        MakeTail(ack.message)));
}

void PlanTracker::OnAckLost(const std::string& transactionID)
{
    if (const auto found = _byTransaction.find(transactionID); found != _byTransaction.end())
    {
        _plans[found->second].bAckLost = true;
    }
}

const std::vector<TrackedPlan>& PlanTracker::GetPlans() const noexcept
{
    return _plans;
}

const TrackedPlan* PlanTracker::FindPlanOrNull(const std::string& planID) const
{
    const std::optional<std::size_t> index = FindIndexOrNull(planID);
    return index.has_value() ? &_plans[*index] : nullptr;
}

TrackedPlan* PlanTracker::FindTrackedOrNull(const std::string& planID)
{
    const std::optional<std::size_t> index = FindIndexOrNull(planID);
    return index.has_value() ? &_plans[*index] : nullptr;
}

std::optional<std::size_t> PlanTracker::FindIndexOrNull(const std::string& planID) const
{
    const auto found = _byPlanID.find(planID);
    if (found == _byPlanID.end())
    {
        return std::nullopt;
    }
    const auto index = std::find_if(found->second.begin(), found->second.end(), [this](std::size_t candidate) {
        return _plans[candidate].delivery != EDelivery::Refused;
    });
    return index == found->second.end() ? found->second.front() : *index;
}

std::size_t PlanTracker::CountOutcome(EOutcome outcome) const noexcept
{
    return _outcomes[static_cast<std::size_t>(outcome)];
}

std::size_t PlanTracker::CountFailed() const noexcept
{
    return _plans.size() - CountOutcome(EOutcome::Open) - CountOutcome(EOutcome::Completed);
}

DoneCount PlanTracker::CountSteps() const noexcept
{
    DoneCount count;
    for (const TrackedPlan& plan : _plans)
    {
        count.all += plan.steps.size();
        count.done += static_cast<std::size_t>(std::count_if(plan.steps.begin(), plan.steps.end(), IsDone));
    }
    return count;
}

DoneCount PlanTracker::CountJobs() const noexcept
{
    DoneCount count;
    for (const TrackedPlan& plan : _plans)
    {
        for (const TrackedStep& step : plan.steps)
        {
            count.all += step.jobs.size();
            count.done +=
                static_cast<std::size_t>(std::count_if(step.jobs.begin(), step.jobs.end(), [](const TrackedJob& job) {
                    return job.status == Protocol::EJobStatus::Completed;
                }));
        }
    }
    return count;
}

std::size_t PlanTracker::CountResends() const noexcept
{
    std::size_t count = 0;
    for (const TrackedPlan& plan : _plans)
    {
        count += plan.sends > 1 ? plan.sends - 1 : 0;
    }
    return count;
}

std::size_t PlanTracker::CountViolations() const noexcept
{
    return _violationCount;
}

const std::vector<std::string>& PlanTracker::GetViolations() const noexcept
{
    return _violations;
}

bool PlanTracker::IsFinished() const noexcept
{
    return CountOutcome(EOutcome::Open) == 0;
}

bool PlanTracker::IsSuccess() const noexcept
{
    return CountOutcome(EOutcome::Completed) == _plans.size() && _violationCount == 0;
}

void PlanTracker::Finish(Lines& out)
{
    for (TrackedPlan& plan : _plans)
    {
        if (plan.bReported && plan.delivery == EDelivery::Sent && !plan.bAckLost)
        {
            AddViolation(CleanText(plan.planned.plan.planID) + " reported without ExecutionPlanAck", out);
        }
        if (plan.unconfirmed.has_value())
        {
            AddViolation(
                fmt::format(
                    "{} {} Success without PlanReport {}",
                    CleanText(plan.planned.plan.planID),
                    GetText(*plan.unconfirmed),
                    GetText(GetControlRule(*plan.unconfirmed).status)),
                out);
            plan.unconfirmed.reset();
        }
        CheckStandstill(plan, out);
    }
}

void PlanTracker::AddViolation(std::string text, Lines& out)
{
    ++_violationCount;
    out.push_back("VIOLATION " + text);
    if (_violations.size() < MAX_VIOLATION_TEXTS)
    {
        _violations.push_back(std::move(text));
    }
}

void PlanTracker::ChangePlan(TrackedPlan& plan, const std::function<void()>& change)
{
    --_outcomes[static_cast<std::size_t>(GetOutcome(plan))];
    change();
    ++_outcomes[static_cast<std::size_t>(GetOutcome(plan))];
}

} // namespace ACS::McsSim
