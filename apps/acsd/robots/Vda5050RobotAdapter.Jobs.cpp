#include "robots/Vda5050RobotAdapter.hpp"

#include "robots/VehicleParameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace ACS::Acsd
{

namespace
{

using Planning::AdapterActions;
using Planning::RaiseEvent;

} // namespace

void Vda5050RobotAdapter::StartJob(const Planning::StartJob& job, Core::Now now, AdapterActions& out)
{
    if (!_bOnline || _bFactsheetAwaited)
    {
        DropLoadCheck(out);
        _job.Defer(job);
        if (!_bOnline)
        {
            _job.OnOffline(false); // the outage was not known when the job was commanded
        }
        return;
    }
    const std::optional<std::string> rejection = GetRejectionReasonOrNull(job.action);
    if (rejection.has_value())
    {
        out.emplace_back(RaiseEvent{Planning::JobFailed{job.jobID, *rejection}});
        return;
    }
    const VDA5050::StateMessage* stateOrNull = _session.GetStateOrNull();
    if (stateOrNull == nullptr || FindNodeID(job).empty())
    {
        out.emplace_back(RaiseEvent{Planning::JobRejected{job.jobID, "the vehicle does not report its node"}});
        return;
    }
    DropLoadCheck(out);
    _job.Clear();
    if (stateOrNull->orderID == job.commandID)
    {
        // The order was considered lost and has reached the vehicle late.
        ResumeJob(job, now, out);
        return;
    }
    if (IsDrive(_session.GetOrderID()))
    {
        _job.Defer(job); // until a cancelled repetition has ended, which shows whether another one is needed
        return;
    }
    if (const std::optional<Planning::Drive> repetition = MakeRepetitionOrNull(job); repetition.has_value())
    {
        _job.Defer(job);
        StartDrive(*repetition, now, out);
        return;
    }
    tl::expected<VDA5050::Action, std::string> action = _jobCheck->MakeAction(job);
    if (!action.has_value())
    {
        out.emplace_back(RaiseEvent{Planning::JobFailed{job.jobID, action.error()}});
        return;
    }
    _pendingOrder = MakeJobOrder(job, std::move(*action));
    _job.Run(job);
    SendPendingOrder(now, out);
}

void Vda5050RobotAdapter::ContinueJob(const VehicleJob::Deferred& deferred, Core::Now now, AdapterActions& out)
{
    if (deferred.bOutdated)
    {
        out.emplace_back(
            RaiseEvent{Planning::JobUnknown{deferred.job.jobID}}); // commanded again if it was not resolved
        return;
    }
    StartJob(deferred.job, now, out);
}

std::string Vda5050RobotAdapter::FindNodeID(const Planning::StartJob& job) const
{
    const VDA5050::StateMessage* const stateOrNull = _session.GetStateOrNull();
    const bool bReported = stateOrNull != nullptr && !stateOrNull->lastNodeID.empty();
    return bReported ? stateOrNull->lastNodeID : job.nodeID;
}

void Vda5050RobotAdapter::CancelJob(const std::string& jobID, Core::Now now, AdapterActions& out)
{
    const Planning::StartJob* const runningOrNull = _job.GetRunningOrNull();
    const VehicleJob::Interrupted* const interruptedOrNull = _job.GetInterruptedOrNull();
    if (interruptedOrNull != nullptr && interruptedOrNull->job.jobID == jobID)
    {
        out.emplace_back(RaiseEvent{Planning::JobFailed{jobID, interruptedOrNull->reason}});
        _job.Clear();
    }
    else if (_job.IsDeferred(jobID))
    {
        const std::string repetitionID = IsRepeating() ? _drive->GetOrderID() : std::string();
        _job.Clear();
        CancelOrder(repetitionID, now, out);
        out.emplace_back(RaiseEvent{Planning::JobFailed{jobID, "cancelled before it was sent to the vehicle"}});
    }
    else if (runningOrNull != nullptr && runningOrNull->jobID == jobID)
    {
        CancelOrder(std::string(runningOrNull->commandID), now, out);
    }
}

VDA5050::OrderMessage Vda5050RobotAdapter::MakeJobOrder(const Planning::StartJob& job, VDA5050::Action action) const
{
    VDA5050::OrderMessage order;
    // Not the jobID, which a later plan may use again: a vehicle treats a known orderId as a repetition.
    order.orderID = job.commandID;
    VDA5050::OrderNode& node = order.nodes.emplace_back();
    node.nodeID = FindNodeID(job);
    node.bReleased = true;
    if (const Planning::RouteNode* const knownOrNull = _drives->GetMap().FindNodeOrNull(node.nodeID);
        knownOrNull != nullptr)
    {
        node.nodePosition = MakeNodePosition(*knownOrNull);
    }
    node.actions.push_back(std::move(action));
    return order;
}

void Vda5050RobotAdapter::RecoverJob(Core::Now now, AdapterActions& out)
{
    const std::optional<Planning::RecoverJob> recoveryOrNull =
        _session.IsReady() ? _job.TakeRecoveryOrNull() : std::nullopt;
    if (!recoveryOrNull.has_value())
    {
        return;
    }
    const Planning::RecoverJob& recovery = *recoveryOrNull;
    const Planning::StartJob& job = recovery.job;
    const VDA5050::StateMessage& state = *_session.GetStateOrNull();
    const auto reportUnresolved = [&out, &job](const std::string& reason) {
        out.emplace_back(RaiseEvent{Planning::JobUnresolved{job.jobID, reason}});
    };
    const bool bShown = std::ranges::count(state.actionStates, job.commandID, &VDA5050::ActionState::actionID) > 0;
    if (bShown)
    {
        ResumeJob(job, now, out);
    }
    else if (state.orderID.empty())
    {
        reportUnresolved("the vehicle shows no order, it may have been restarted");
    }
    else if (
        std::ranges::count(recovery.earlierIDs, state.orderID) > 0 || _repetition.TryRecognize(recovery, state.orderID))
    {
        // A vehicle accepts orders one after the other: this one did not reach it.
        out.emplace_back(RaiseEvent{Planning::JobUnknown{job.jobID}});
    }
    else
    {
        reportUnresolved(fmt::format("the vehicle shows the order {} and not this job", state.orderID));
    }
}

void Vda5050RobotAdapter::ResumeJob(const Planning::StartJob& job, Core::Now now, AdapterActions& out)
{
    const VDA5050::StateMessage& state = *_session.GetStateOrNull();
    _job.Run(job);
    const auto shown = std::ranges::find(state.actionStates, job.commandID, &VDA5050::ActionState::actionID);
    if (shown != state.actionStates.end())
    {
        OnActionChanged({shown->actionID, shown->actionType, shown->actionStatus, shown->resultDescription}, out);
    }
    if (_job.GetRunningOrNull() == nullptr || state.orderID != job.commandID)
    {
        return; // its end is reported, or will be when the action's state shows it
    }
    // The vehicle has the parameters. They may be unknown here before its factsheet has been received.
    VDA5050::Action action;
    action.actionType = shown == state.actionStates.end() || shown->actionType.empty() ? job.action : shown->actionType;
    action.actionID = job.commandID;
    action.blockingType = JOB_BLOCKING;
    VDA5050::OrderRecord record;
    record.messages.push_back(MakeJobOrder(job, std::move(action)));
    record.acceptedUpdateID = state.orderUpdateID;
    const Core::Result<void> resumed = _session.ResumeOrder(std::move(record), now, _sessionActions);
    if (!resumed)
    {
        _job.Clear();
        out.emplace_back(RaiseEvent{Planning::JobUnresolved{job.jobID, Core::Describe(resumed.error())}});
    }
}

void Vda5050RobotAdapter::OnActionChanged(const VDA5050::ActionChanged& action, AdapterActions& out)
{
    const Planning::StartJob* const jobOrNull = _job.GetRunningOrNull();
    if (jobOrNull == nullptr || action.actionID != jobOrNull->commandID)
    {
        return;
    }
    switch (action.status)
    {
        case VDA5050::EActionStatus::Waiting:
            break;
        case VDA5050::EActionStatus::Initializing:
        case VDA5050::EActionStatus::Running:
        case VDA5050::EActionStatus::Paused:
            if (_job.TryStart())
            {
                out.emplace_back(RaiseEvent{Planning::JobStarted{jobOrNull->jobID}});
            }
            break;
        case VDA5050::EActionStatus::Finished:
            OnJobDone(out);
            break;
        case VDA5050::EActionStatus::Failed:
            OnActionFailed(
                action.resultDescription.empty() ? "the vehicle's action failed" : action.resultDescription,
                out);
            break;
        default:
            break;
    }
}

/// Outside automatic mode an action has not failed for a reason of its own: the vehicle has ended it, as the standard demands.
void Vda5050RobotAdapter::OnActionFailed(const std::string& reason, AdapterActions& out)
{
    if (!_report.GetState().bAutomatic)
    {
        InterruptJob(reason, out);
        return;
    }
    out.emplace_back(RaiseEvent{Planning::JobFailed{_job.TakeRunning().jobID, reason}});
}

} // namespace ACS::Acsd
