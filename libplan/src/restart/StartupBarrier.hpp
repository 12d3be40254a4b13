#pragma once

#include <cstdint>

namespace ACS::Planning
{

/// After a start: whether the engine still waits for the positions of robots, and whether it begins work meanwhile.
class StartupBarrier
{
    enum class EState : std::uint8_t
    {
        Passed,
        Waiting,
        HoldingWork, ///< As Waiting, and nothing is begun.
    };

    EState _state = EState::Passed;

public:
    /// bHasWork: there is work from before the start. Nothing is begun until the robots have reported what they do.
    void Begin(bool bHasWork) noexcept;
    /// All robots have reported, or the time is over. True: work was held back and may begin now.
    [[nodiscard]] bool TryRelease() noexcept;

    [[nodiscard]] bool IsWaiting() const noexcept;
    [[nodiscard]] bool IsHoldingWork() const noexcept;
};

} // namespace ACS::Planning
