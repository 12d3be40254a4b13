#include "robots/Vda5050RobotAdapter.hpp"

#include <utility>

namespace ACS::Acsd
{

using Planning::AdapterActions;
using Planning::RaiseEvent;

/// The vehicle reports the end of the job's action. Its loads may follow later, or contradict it.
void Vda5050RobotAdapter::OnJobDone(AdapterActions& out)
{
    const Planning::StartJob job = _job.TakeRunning();
    const JobMethod* const methodOrNull = _methods.FindMethodOrNull(job.action);
    LoadCheck check(job, methodOrNull == nullptr ? Planning::EActionEffect::None : methodOrNull->effect);
    const auto loads = _methods.GetPositions().MakePortLoadsOrNull(*_session.GetStateOrNull());
    if (loads.has_value() && check.FindContradictionOrNull(*loads).has_value())
    {
        _job.VerifyLoads(std::move(check));
        out.emplace_back(Planning::StartAdapterTimer{LOAD_TIMER, _loadTimeout});
        return;
    }
    out.emplace_back(RaiseEvent{Planning::JobFinished{job.jobID}});
}

/// A job is finished as soon as the loads agree. A vehicle that no longer reports loads does not confirm it.
void Vda5050RobotAdapter::VerifyLoads(AdapterActions& out)
{
    const LoadCheck* const checkOrNull = _job.GetLoadCheckOrNull();
    const std::optional<std::vector<Planning::PortLoad>>& loads = _report.GetState().loads;
    const bool bAgreed =
        checkOrNull != nullptr && loads.has_value() && !checkOrNull->FindContradictionOrNull(*loads).has_value();
    if (bAgreed)
    {
        const std::string jobID = checkOrNull->GetJobID();
        DropLoadCheck(out);
        out.emplace_back(RaiseEvent{Planning::JobFinished{jobID}});
    }
}

void Vda5050RobotAdapter::OnLoadTimeout(AdapterActions& out)
{
    const VehicleJob::Interrupted* const interruptedOrNull = _job.GetInterruptedOrNull();
    if (interruptedOrNull != nullptr && interruptedOrNull->bLoadsAwaited)
    {
        EvaluateInterruption(true, out);
        return;
    }
    const LoadCheck* const checkOrNull = _job.GetLoadCheckOrNull();
    if (checkOrNull == nullptr)
    {
        return;
    }
    if (!_session.IsReady())
    {
        // The state that shows the loads may be what was lost.
        out.emplace_back(Planning::StartAdapterTimer{LOAD_TIMER, _loadTimeout});
        return;
    }
    const std::optional<std::vector<Planning::PortLoad>>& loads = _report.GetState().loads;
    const std::optional<std::string> contradiction =
        loads.has_value() ? checkOrNull->FindContradictionOrNull(*loads) : std::nullopt;
    out.emplace_back(RaiseEvent{Planning::JobUnresolved{
        checkOrNull->GetJobID(),
        "the vehicle reports the action finished, but its loads disagree: "
            + contradiction.value_or("it no longer reports any")}});
    _job.Clear();
}

/// The loads agree, another job begins, or this one is recovered.
void Vda5050RobotAdapter::DropLoadCheck(AdapterActions& out)
{
    if (_job.GetLoadCheckOrNull() != nullptr)
    {
        out.emplace_back(Planning::CancelAdapterTimer{LOAD_TIMER});
        _job.Clear();
    }
}

void Vda5050RobotAdapter::InterruptJob(const std::string& reason, AdapterActions& out)
{
    if (_report.GetState().loads.has_value())
    {
        _job.Interrupt(reason);
        EvaluateInterruption(false, out);
        return;
    }
    const std::string jobID = _job.TakeRunning().jobID;
    out.emplace_back(RaiseEvent{Planning::JobUnresolved{jobID, reason + "; the vehicle reports no loads"}});
}

/// Loads may follow later, so only a job that is done is certain at once.
void Vda5050RobotAdapter::EvaluateInterruption(bool bFinal, AdapterActions& out)
{
    const VehicleJob::Interrupted* const interruptedOrNull = _job.GetInterruptedOrNull();
    const Planning::StateChanged& state = _report.GetState();
    if (interruptedOrNull == nullptr)
    {
        return;
    }
    if (!_session.IsReady() || !state.bAutomatic || state.bOccupied)
    {
        _job.StopAwaitingLoads();
        return;
    }
    const Planning::StartJob& job = interruptedOrNull->job;
    const JobMethod* const methodOrNull = _methods.FindMethodOrNull(job.action);
    const LoadCheck check(job, methodOrNull == nullptr ? Planning::EActionEffect::None : methodOrNull->effect);
    const ELoadEvidence evidence = state.loads.has_value() ? check.GetEvidence(*state.loads) : ELoadEvidence::None;
    if (evidence != ELoadEvidence::Done && !bFinal)
    {
        if (_job.TryAwaitLoads())
        {
            out.emplace_back(Planning::StartAdapterTimer{LOAD_TIMER, _loadTimeout});
        }
        return;
    }
    switch (evidence)
    {
        case ELoadEvidence::Done:
            out.emplace_back(RaiseEvent{Planning::JobFinished{job.jobID}});
            break;
        case ELoadEvidence::NotDone:
            out.emplace_back(RaiseEvent{Planning::JobInterrupted{job.jobID, interruptedOrNull->reason}});
            break;
        case ELoadEvidence::None:
        default:
            out.emplace_back(RaiseEvent{Planning::JobUnresolved{
                job.jobID,
                interruptedOrNull->reason + "; the loads of the vehicle do not show whether it was done"}});
            break;
    }
    out.emplace_back(Planning::CancelAdapterTimer{LOAD_TIMER});
    _job.Clear();
}

} // namespace ACS::Acsd
