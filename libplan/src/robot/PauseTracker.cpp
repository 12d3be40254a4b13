#include "robot/PauseTracker.hpp"

namespace ACS::Planning
{

void PauseTracker::Pause() noexcept
{
    _state = EState::Paused;
}

void PauseTracker::Resume() noexcept
{
    _state = EState::Resuming;
}

bool PauseTracker::TryResume() noexcept
{
    if (!IsPaused())
    {
        return false;
    }
    Resume();
    return true;
}

void PauseTracker::Reset() noexcept
{
    _state = EState::Running;
}

PauseTracker::ERepeat PauseTracker::OnState(bool bPaused, bool bWasPaused, bool bAutomatic, bool bBack) noexcept
{
    if (IsPaused())
    {
        return !bPaused && (bBack || bWasPaused) ? ERepeat::Pause : ERepeat::None;
    }
    if (!IsResuming())
    {
        return ERepeat::None;
    }
    if (bPaused)
    {
        Resume();
    }
    // In manual mode the robot may not have received the pause, and may still stop.
    else if (bAutomatic)
    {
        _state = bWasPaused || _state == EState::Ending ? EState::Running : EState::Ending;
    }
    // Also if it shows no pause: its base may drive while its arm is still stopped.
    return bBack ? ERepeat::Resume : ERepeat::None;
}

bool PauseTracker::IsPaused() const noexcept
{
    return _state == EState::Paused;
}

bool PauseTracker::IsResuming() const noexcept
{
    return _state == EState::Resuming || _state == EState::Ending;
}

} // namespace ACS::Planning
