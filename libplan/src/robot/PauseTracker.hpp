#pragma once

#include <cstdint>

namespace ACS::Planning
{

/// Whether a robot was commanded to pause, and whether it has confirmed that it resumed.
class PauseTracker
{
public:
    /// The command to repeat.
    enum class ERepeat : std::uint8_t
    {
        None,
        Pause,
        Resume,
    };

private:
    enum class EState : std::uint8_t
    {
        Running,
        Paused,   ///< A pause was commanded, and no resume since.
        Resuming, ///< A resume was commanded, and no state has confirmed it.
        Ending,   ///< Likewise; one state showed no pause, which may be older than the pause.
    };

    EState _state = EState::Running;

public:
    void Pause() noexcept;
    void Resume() noexcept;
    /// True: a pause was commanded; command the robot to resume.
    [[nodiscard]] bool TryResume() noexcept;
    /// Forgets the last command.
    void Reset() noexcept;
    /// By the robot's new state. bBack: it is connected or in automatic mode again, and may have missed a command.
    [[nodiscard]] ERepeat OnState(bool bPaused, bool bWasPaused, bool bAutomatic, bool bBack) noexcept;

    [[nodiscard]] bool IsPaused() const noexcept;
    [[nodiscard]] bool IsResuming() const noexcept;
};

} // namespace ACS::Planning
