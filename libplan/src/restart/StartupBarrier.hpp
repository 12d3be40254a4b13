#pragma once

#include <cstdint>

namespace ACS::Planning
{

/// After a start: whether the engine waits for the robots' positions, and whether work is held back until then.
class StartupBarrier
{
public:
    /// Why no work is started while it is held back.
    static constexpr const char* REASON = "Not all robots have reported their positions since the restart.";

private:
    enum class EState : std::uint8_t
    {
        Passed,
        Waiting,
        HoldingWork, ///< As Waiting, and no work is started.
    };

    EState _state = EState::Passed;

public:
    /// bHasWork: there is work from before the start, so none is started until the robots have reported.
    void Begin(bool bHasWork) noexcept;
    /// All robots have reported, or the time limit has expired. True: work was held back and may start now.
    [[nodiscard]] bool TryRelease() noexcept;

    [[nodiscard]] bool IsWaiting() const noexcept;
    [[nodiscard]] bool IsHoldingWork() const noexcept;
};

} // namespace ACS::Planning
