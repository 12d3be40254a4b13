#pragma once

#include <acs/core/Now.hpp>

#include <chrono>

namespace ACS::Testing
{

/// A clock that a test sets. Starts at 2025-07-02T12:00:00Z.
class ManualClock final : public Core::IClock
{
    static constexpr std::chrono::seconds START_WALL{1'751'457'600};
    static constexpr std::chrono::seconds START_STEADY{1'000};

    Core::Now _now{Core::SteadyTime(START_STEADY), Core::WallTime(START_WALL)};

public:
    [[nodiscard]] Core::Now GetNow() const override
    {
        return _now;
    }

    void Advance(std::chrono::milliseconds span)
    {
        _now.steady += span;
        _now.wall += span;
    }

    /// Changes the wall clock alone, as an operator or NTP does.
    void JumpWall(std::chrono::milliseconds span)
    {
        _now.wall += span;
    }
};

} // namespace ACS::Testing
