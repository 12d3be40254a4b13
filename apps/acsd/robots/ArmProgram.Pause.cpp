#include "robots/ArmProgram.hpp"

#include "robots/ArmProgramNames.hpp"

// What a program that is stopped for a pause needs before it is resumed or reset.

namespace ACS::Acsd
{

bool ArmProgram::IsPauseWanted() const noexcept
{
    return _bPauseWanted;
}

void ArmProgram::SetPauseWanted(bool bWanted)
{
    _bPauseWanted = bWanted;
    _bPauseKnown = true;
    if (Running* const runningOrNull = std::get_if<Running>(&_state))
    {
        runningOrNull->bStopRefused = false;
    }
    VerifyRecovered();
}

void ArmProgram::OnPauseSeen()
{
    _bPauseKnown = true;
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
void ArmProgram::AdvanceStopped(bool bProbing)
{
    EArmHalt& halt = std::get<Stopped>(_state).halt;
    const bool bPaused = _bPauseWanted && !_work.bCancelled;
    if (bPaused)
    {
        halt = halt == EArmHalt::Verified ? EArmHalt::Unchecked : halt;
    }
    else if (halt == EArmHalt::Unchecked && !bProbing)
    {
        _requests.push_back(EArmRequest::ProbePlayback);
    }
    else if (halt == EArmHalt::Verified && _work.bCancelled)
    {
        _state = Resetting{};
        _controls.Reset();
    }
    else if (halt == EArmHalt::Verified)
    {
        _state = Resuming{};
        _controls.Resume();
    }
}

} // namespace ACS::Acsd
