#include "McsJudge.hpp"

// Requests of the MCS to control plans: their Acks and results.

namespace ACS::Simulation
{

namespace
{

/// Whether a plan in this state shows that the control was done.
bool IsDone(Planning::EPlanControl control, Protocol::EPlanStatus status)
{
    using Protocol::EPlanStatus;
    switch (control)
    {
        case Planning::EPlanControl::Cancel:
            return status == EPlanStatus::Cancelled;
        case Planning::EPlanControl::Abort:
            return status == EPlanStatus::Aborted;
        case Planning::EPlanControl::Pause:
            return status == EPlanStatus::Paused;
        case Planning::EPlanControl::Resume:
            return status == EPlanStatus::Pending || status == EPlanStatus::InProgress;
        default:
            return false;
    }
}

} // namespace

std::optional<Planning::EPlanControl> GetControlOrNull(Protocol::EAcsCommand command)
{
    using Protocol::EAcsCommand;
    if (command == EAcsCommand::CancelPlan || command == EAcsCommand::CancelResultReport)
    {
        return Planning::EPlanControl::Cancel;
    }
    if (command == EAcsCommand::AbortPlan || command == EAcsCommand::AbortResultReport)
    {
        return Planning::EPlanControl::Abort;
    }
    if (command == EAcsCommand::PausePlan || command == EAcsCommand::PauseResultReport)
    {
        return Planning::EPlanControl::Pause;
    }
    if (command == EAcsCommand::ResumePlan || command == EAcsCommand::ResumeResultReport)
    {
        return Planning::EPlanControl::Resume;
    }
    return std::nullopt;
}

void McsJudge::NoteControlSent(
    Planning::EPlanControl control,
    const std::string& planID,
    const std::string& transactionID)
{
    ControlView& view = _controls[{planID, control}];
    view.sent.insert(transactionID);
    view.refused.erase(transactionID);
    // acsd does not keep requests about unknown plans over a crash.
    const auto plan = _plans.find(planID);
    view.bUnknown = view.bUnknown || plan == _plans.end() || plan->second.knowledge != EKnowledge::Accepted;
}

void McsJudge::NoteControlAck(Planning::EPlanControl control, const std::string& planID, const Protocol::AcsAck& ack)
{
    // A request that the disk refuses cannot be promised.
    const bool bUnstored =
        ack.result == Protocol::EAckResult::Fail && ack.message.find("cannot be stored") != std::string::npos;
    if (bUnstored)
    {
        _controls[{planID, control}].refused.insert(ack.transactionID);
        return;
    }
    ++_controls[{planID, control}].acknowledged;
}

void McsJudge::OnResult(Planning::EPlanControl control, const std::string& planID, Protocol::EReportResult result)
{
    const auto plan = _plans.find(planID);
    const bool bFits = plan != _plans.end() && IsDone(control, plan->second.status);
    if (result == Protocol::EReportResult::Success && !bFits)
    {
        _trace.Violate(
            "{} of plan {} is reported as successful, but the plan is {}",
            GetText(control),
            planID,
            plan == _plans.end() ? "not known" : GetText(plan->second.status));
    }
    ControlView& view = _controls[{planID, control}];
    view.bDone = view.bDone || result == Protocol::EReportResult::Success;
    if (result == Protocol::EReportResult::Success && view.refused == view.sent && !view.bUnknown)
    {
        _trace.Violate("{} of plan {} was refused and is reported as successful", GetText(control), planID);
    }
    if (++view.results > view.sent.size() && !view.bUnknown)
    {
        _trace.Violate(
            "{} results for {} {}, which was requested {} times",
            view.results,
            GetText(control),
            planID,
            view.sent.size());
    }
}

std::string McsJudge::DescribeOwedResults() const
{
    std::string text;
    for (const auto& [key, control] : _controls)
    {
        const auto plan = _plans.find(key.first);
        const bool bEnds = (key.second == Planning::EPlanControl::Cancel || key.second == Planning::EPlanControl::Abort)
            && !_controlledByOperator.contains(key.first);
        if (bEnds && !control.bDone && plan != _plans.end() && IsDone(key.second, plan->second.status))
        {
            text += fmt::format(
                "{} of plan {} took effect, but no result reports success; ",
                GetText(key.second),
                key.first);
        }
        if (control.results < control.acknowledged)
        {
            text += fmt::format(
                "{} results of {} {}, acknowledged {} times; ",
                control.results,
                GetText(key.second),
                key.first,
                control.acknowledged);
        }
    }
    return text;
}

} // namespace ACS::Simulation
