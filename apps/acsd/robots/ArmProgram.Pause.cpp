#include "robots/ArmProgram.hpp"

#include "robots/ArmProgramNames.hpp"
#include "robots/ArmTimers.hpp"

#include <fmt/format.h>

// What a program that is stopped for a pause needs before it is resumed or reset.

namespace ACS::Acsd
{

using Planning::AdapterActions;

bool ArmProgram::IsPauseWanted() const noexcept
{
    return _bPauseOrNull.value_or(false);
}

void ArmProgram::SetPauseWanted(bool bWanted)
{
    _bPauseOrNull = bWanted;
    _bPauseKnown = true;
    if (Running* const runningOrNull = std::get_if<Running>(&_state))
    {
        runningOrNull->bStopRefused = false;
    }
    VerifyRecovered();
}

void ArmProgram::OnPauseShown(bool bPaused)
{
    _bPauseShown = bPaused;
    _bPauseKnown = _bPauseKnown || bPaused;
    VerifyRecovered();
}

/// A program that was found after a restart may be stopped by an earlier pause. It is stopped and resumed, after which it is
/// known to run.
void ArmProgram::VerifyRecovered()
{
    const Running* const runningOrNull = std::get_if<Running>(&_state);
    if (runningOrNull != nullptr && runningOrNull->start == EArmStart::Counted && _bPauseKnown)
    {
        _work.bResumeRepeated = true;
        _state = Unverified{};
    }
}

/// It may have been resumed at the controller since its stop was verified. So it is probed again before it is reset or
/// resumed.
void ArmProgram::AdvanceStopped(bool bProbing, AdapterActions& out)
{
    EArmHalt& halt = std::get<Stopped>(_state).halt;
    // A pause of before a restart, or of the vehicle's operator, continues until it is ended there or by a command.
    const bool bPaused = _bPauseOrNull.value_or(_bPauseShown) && !_work.bCancelled;
    const bool bReplaced = _work.stoppedProgramOrNull.has_value() && _work.probedProgramOrNull.has_value()
        && _work.stoppedProgramOrNull != _work.probedProgramOrNull;
    if (bPaused)
    {
        halt = halt == EArmHalt::Shown ? halt : EArmHalt::Unchecked;
    }
    else if ((halt == EArmHalt::Unchecked || (halt == EArmHalt::Replaced && _work.bCancelled)) && !bProbing)
    {
        _requests.push_back(EArmRequest::ProbePlayback);
    }
    else if (halt == EArmHalt::Verified && _work.bCancelled)
    {
        _state = Resetting{};
        _controls.Reset();
    }
    else if (halt == EArmHalt::Verified && bReplaced)
    {
        halt = EArmHalt::Replaced;
        RaiseHalt(fmt::format(
            "The arm's program of job {} was paused and cannot be resumed: it was stopped in program {}, and program {} is "
            "selected. Retrying in 5 s. Select it again, or abandon it there: the job then fails.",
            _work.jobID,
            *_work.stoppedProgramOrNull,
            *_work.probedProgramOrNull));
        out.emplace_back(Planning::StartAdapterTimer{ArmTimers::RETRY, ArmTimers::RETRY_DELAY});
    }
    else if (halt == EArmHalt::Verified)
    {
        _state = Resuming{};
        _controls.Resume();
    }
}

/// A program that was resumed at the controller just before its reset may not have been reset.
void ArmProgram::FinishReset(const std::optional<GeneralState>& stateOrNull, AdapterActions& out)
{
    if (stateOrNull.value_or(GeneralState{}).bPlaying)
    {
        _state = Running{};
        return;
    }
    _controls.OnResetVerified();
    Fail("cancelled while it was paused", out);
}

} // namespace ACS::Acsd
