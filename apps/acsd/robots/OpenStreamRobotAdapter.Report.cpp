#include "robots/OpenStreamRobotAdapter.hpp"

#include <utility>
#include <variant>

// Reports of the robot as a whole: the engine does not distinguish its base from its arm.

namespace ACS::Acsd
{

namespace
{

using Planning::AdapterActions;
using Planning::RaiseEvent;

} // namespace

void OpenStreamRobotAdapter::DrainBase(Core::Now now, AdapterActions& out)
{
    // The end of a repetition may add more of them.
    for (Planning::AdapterAction& action : std::exchange(_baseActions, {}))
    {
        const RaiseEvent* raiseOrNull = std::get_if<RaiseEvent>(&action);
        const Planning::LinkChanged* linkOrNull =
            raiseOrNull == nullptr ? nullptr : std::get_if<Planning::LinkChanged>(&raiseOrNull->event);
        const Planning::StateChanged* stateOrNull =
            raiseOrNull == nullptr ? nullptr : std::get_if<Planning::StateChanged>(&raiseOrNull->event);
        const bool bJobCheck =
            raiseOrNull != nullptr && std::holds_alternative<Planning::JobCheckChanged>(raiseOrNull->event);
        if (raiseOrNull != nullptr && TryEndRepetition(raiseOrNull->event, now, out))
        {
            continue;
        }
        if (bJobCheck)
        {
            ReportOnline(out); // the factsheet is here; the base does no jobs
            continue;
        }
        if (stateOrNull != nullptr)
        {
            _baseState = *stateOrNull;
            _program.OnPauseShown(stateOrNull->bPaused);
            _bPaused = IsPaused();
            _bArmOccupied = IsArmOccupied();
            out.emplace_back(RaiseEvent{MakeState()});
        }
        else if (linkOrNull != nullptr)
        {
            _bBaseOnline = linkOrNull->bOnline;
            if (!_bBaseOnline)
            {
                _baseState.reset();
            }
            ReportOnline(out);
        }
        else
        {
            out.push_back(std::move(action));
        }
    }
}

Planning::StateChanged OpenStreamRobotAdapter::MakeState() const
{
    Planning::StateChanged state = *_baseState;
    state.bPaused = _bPaused;
    state.bOccupied = state.bOccupied || IsArmOccupied();
    state.restartEvidence.progressToken = _evidence.MakeProgressToken();
    if (_trouble.has_value())
    {
        state.errors.push_back(*_trouble);
    }
    return state;
}

void OpenStreamRobotAdapter::ReportState(AdapterActions& out) const
{
    if (_baseState.has_value())
    {
        out.emplace_back(RaiseEvent{MakeState()});
    }
}

/// With an error of the arm the robot is online, but does no work. Without an error, an arm that shows no counters is
/// offline.
void OpenStreamRobotAdapter::ReportArm(AdapterActions& out)
{
    const std::optional<Planning::RobotError>& trouble =
        _monitor.GetTroubleOrNull().has_value() ? _monitor.GetTroubleOrNull() : _program.GetTroubleOrNull();
    const bool bNews = _trouble != trouble;
    _trouble = trouble;
    const bool bWasOnline = _bOnline;
    ReportOnline(out);
    if (bNews && bWasOnline && _bOnline)
    {
        ReportState(out);
    }
}

/// The robot is online if its base and its arm are.
void OpenStreamRobotAdapter::ReportOnline(AdapterActions& out)
{
    const bool bArmInReach = _monitor.IsReady() || (!_monitor.IsLost() && _trouble.has_value());
    const bool bOnline = _bBaseOnline && bArmInReach && !_base.IsFactsheetAwaited();
    if (std::exchange(_bOnline, bOnline) == bOnline)
    {
        return;
    }
    if (_repetition.has_value())
    {
        _repetition->bOutdated = true; // also if it begins while the robot is offline
    }
    out.emplace_back(RaiseEvent{Planning::LinkChanged{bOnline}});
    if (bOnline)
    {
        ReportState(out); // the base may report its next state much later
    }
}

/// The robot is paused from when base and arm are stopped until both continue. The program of a job of before a restart may run
/// until the counters show what became of it.
bool OpenStreamRobotAdapter::IsPaused() const
{
    const bool bBasePaused = _baseState.has_value() && _baseState->bPaused;
    return (bBasePaused && !_recovery.has_value() && _program.IsArmStopped()) || _program.IsResumeDue();
}

/// The arm runs the program of a job that was cancelled, or resolved by the operator; or it may, as the counters of after the
/// restart have not arrived yet.
bool OpenStreamRobotAdapter::IsArmOccupied() const
{
    const bool bUncounted = _recovery.has_value() && _recovery->bReleased;
    return bUncounted || (_bJobReleased && _program.HasJob());
}

void OpenStreamRobotAdapter::ReportActivity(AdapterActions& out)
{
    if (!_baseState.has_value())
    {
        return;
    }
    const bool bPauseChanged = std::exchange(_bPaused, IsPaused()) != IsPaused();
    const bool bOccupationChanged = std::exchange(_bArmOccupied, IsArmOccupied()) != IsArmOccupied();
    if (bPauseChanged || bOccupationChanged)
    {
        ReportState(out);
    }
}

} // namespace ACS::Acsd
