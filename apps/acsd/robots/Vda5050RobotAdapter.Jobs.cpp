#include "robots/Vda5050RobotAdapter.hpp"

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
    if (_bFactsheetAwaited)
    {
        _deferredJob = job;
        return;
    }
    const std::optional<std::string> rejection = GetRejectionReasonOrNull(job.action);
    if (rejection.has_value())
    {
        out.emplace_back(RaiseEvent{Planning::JobFailed{job.jobID, *rejection}});
        return;
    }
    const VDA5050::StateMessage* stateOrNull = _session.GetStateOrNull();
    if (stateOrNull == nullptr || stateOrNull->lastNodeID.empty())
    {
        out.emplace_back(RaiseEvent{Planning::JobFailed{job.jobID, "the vehicle does not tell on which node it is"}});
        return;
    }
    _recovery.reset();
    DropLoadCheck(out);
    if (stateOrNull->orderID == job.commandID)
    {
        // It came to the vehicle late, and is there all the same.
        TakeUp(job, now, out);
        return;
    }
    tl::expected<VDA5050::Action, std::string> action = _jobCheck->MakeAction(job);
    if (!action.has_value())
    {
        out.emplace_back(RaiseEvent{Planning::JobFailed{job.jobID, action.error()}});
        return;
    }
    _job = job;
    _bJobStarted = false;
    _pendingOrder = PendingOrder{MakeJobOrder(job, std::move(*action))};
    SendPendingOrder(now, out);
}

VDA5050::OrderMessage Vda5050RobotAdapter::MakeJobOrder(const Planning::StartJob& job, VDA5050::Action action) const
{
    VDA5050::OrderMessage order;
    // Plans may name a job as one before did: a vehicle takes an orderId that it knows for a repetition.
    order.orderID = job.commandID;
    VDA5050::OrderNode& node = order.nodes.emplace_back();
    node.nodeID = _session.GetStateOrNull()->lastNodeID;
    node.bReleased = true;
    node.actions.push_back(std::move(action));
    return order;
}

void Vda5050RobotAdapter::FindJob(Core::Now now, AdapterActions& out)
{
    if (!_recovery.has_value() || !_session.IsReady())
    {
        return;
    }
    const Planning::RecoverJob recovery = *std::exchange(_recovery, std::nullopt);
    const Planning::StartJob& job = recovery.job;
    const VDA5050::StateMessage& state = *_session.GetStateOrNull();
    const auto tell = [&out, &job](const std::string& reason) {
        out.emplace_back(RaiseEvent{Planning::JobUncertain{job.jobID, reason}});
    };
    const bool bShown = std::ranges::count(state.actionStates, job.commandID, &VDA5050::ActionState::actionID) > 0;
    if (bShown)
    {
        TakeUp(job, now, out);
    }
    else if (state.orderID.empty())
    {
        tell("the vehicle shows no order, as after a restart of its own");
    }
    else if (std::ranges::count(recovery.earlierIDs, state.orderID) > 0)
    {
        // Orders are taken one after the other: this one never came.
        out.emplace_back(RaiseEvent{Planning::JobUnknown{job.jobID}});
    }
    else
    {
        tell(fmt::format("the vehicle shows the order {} and nothing of this job", state.orderID));
    }
}

void Vda5050RobotAdapter::TakeUp(const Planning::StartJob& job, Core::Now now, AdapterActions& out)
{
    const VDA5050::StateMessage& state = *_session.GetStateOrNull();
    DropLoadCheck(out);
    _job = job;
    _bJobStarted = false;
    const auto shown = std::ranges::find(state.actionStates, job.commandID, &VDA5050::ActionState::actionID);
    if (shown != state.actionStates.end())
    {
        TakeAction({shown->actionID, shown->actionType, shown->actionStatus, shown->resultDescription}, out);
    }
    if (!_job.has_value() || state.orderID != job.commandID)
    {
        return; // its end is told, or will be by the action's own state
    }
    // The vehicle has the parameters. They may not be known here before its factsheet has come.
    VDA5050::Action action;
    action.actionType = shown == state.actionStates.end() || shown->actionType.empty() ? job.action : shown->actionType;
    action.actionID = job.commandID;
    action.blockingType = VDA5050::EBlockingType::Hard;
    VDA5050::OrderRecord record;
    record.messages.push_back(MakeJobOrder(job, std::move(action)));
    record.acceptedUpdateID = state.orderUpdateID;
    const Core::Result<void> resumed = _session.ResumeOrder(std::move(record), now, _sessionActions);
    if (!resumed)
    {
        _job.reset();
        out.emplace_back(RaiseEvent{Planning::JobUncertain{job.jobID, Core::Describe(resumed.error())}});
    }
}

/// Whether the job's action goes on, which a vehicle may show together with paused.
bool Vda5050RobotAdapter::IsJobRunning(const VDA5050::StateMessage& state) const
{
    return _job.has_value() && std::ranges::any_of(state.actionStates, [this](const VDA5050::ActionState& action) {
               return action.actionID == _job->commandID
                   && (action.actionStatus == VDA5050::EActionStatus::Initializing
                       || action.actionStatus == VDA5050::EActionStatus::Running);
           });
}

void Vda5050RobotAdapter::TakeAction(const VDA5050::ActionChanged& action, AdapterActions& out)
{
    if (!_job.has_value() || action.actionID != _job->commandID)
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
            if (!std::exchange(_bJobStarted, true))
            {
                out.emplace_back(RaiseEvent{Planning::JobStarted{_job->jobID}});
            }
            break;
        case VDA5050::EActionStatus::Finished:
            OnJobDone(out);
            break;
        case VDA5050::EActionStatus::Failed:
            out.emplace_back(RaiseEvent{Planning::JobFailed{
                std::exchange(_job, std::nullopt)->jobID,
                action.resultDescription.empty() ? "the vehicle's action failed" : action.resultDescription}});
            break;
        default:
            break;
    }
}

} // namespace ACS::Acsd
