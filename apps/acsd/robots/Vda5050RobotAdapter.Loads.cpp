#include "robots/Vda5050RobotAdapter.hpp"

#include <utility>

namespace ACS::Acsd
{

using Planning::AdapterActions;
using Planning::RaiseEvent;

/// The vehicle reports the end of the job's action. Its loads may follow later, or show that it did something else.
void Vda5050RobotAdapter::OnJobDone(AdapterActions& out)
{
    const Planning::StartJob job = *std::exchange(_job, std::nullopt);
    const JobMethod* const methodOrNull = _methods.FindMethodOrNull(job.action);
    _loadCheck.emplace(job, methodOrNull == nullptr ? Planning::EActionEffect::None : methodOrNull->effect);
    const auto loads = _methods.GetPositions().MakePortLoadsOrNull(*_session.GetStateOrNull());
    const bool bContradicted = loads.has_value() && _loadCheck->FindContradictionOrNull(*loads).has_value();
    if (bContradicted)
    {
        out.emplace_back(Planning::StartAdapterTimer{LOAD_TIMER, _loadTimeout});
        return;
    }
    out.emplace_back(RaiseEvent{Planning::JobFinished{job.jobID}});
    _loadCheck.reset();
}

/// A job is finished as soon as the loads agree; a vehicle that no longer reports any does not confirm it.
void Vda5050RobotAdapter::VerifyLoads(AdapterActions& out)
{
    const bool bAgreed = _loadCheck.has_value() && _state.loads.has_value()
        && !_loadCheck->FindContradictionOrNull(*_state.loads).has_value();
    if (bAgreed)
    {
        out.emplace_back(Planning::CancelAdapterTimer{LOAD_TIMER});
        out.emplace_back(RaiseEvent{Planning::JobFinished{_loadCheck->GetJobID()}});
        _loadCheck.reset();
    }
}

void Vda5050RobotAdapter::OnLoadTimeout(AdapterActions& out)
{
    if (!_loadCheck.has_value())
    {
        return;
    }
    const std::optional<std::string> contradiction =
        _state.loads.has_value() ? _loadCheck->FindContradictionOrNull(*_state.loads) : std::nullopt;
    out.emplace_back(RaiseEvent{Planning::JobUncertain{
        _loadCheck->GetJobID(),
        "the vehicle reports the action finished, but its loads disagree: "
            + contradiction.value_or("it no longer reports any")}});
    _loadCheck.reset();
}

/// Another job begins, or this one is asked for again.
void Vda5050RobotAdapter::DropLoadCheck(AdapterActions& out)
{
    if (_loadCheck.has_value())
    {
        out.emplace_back(Planning::CancelAdapterTimer{LOAD_TIMER});
        _loadCheck.reset();
    }
}

} // namespace ACS::Acsd
