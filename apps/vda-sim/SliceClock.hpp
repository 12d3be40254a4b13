#pragma once

#include <acs/core/Now.hpp>

#include <cstddef>
#include <optional>

namespace ACS::VdaSim
{

/// Simulated time of a vehicle, which passes in whole slices while it ticks: the motion does not depend on when the timers
/// fire. Pure: time is a parameter.
class SliceClock
{
public:
    /// Simulated: the step of all motion.
    static constexpr double SLICE_SECONDS = 0.02;

private:
    double _timeScale;
    std::optional<Core::SteadyTime> _lastTime;
    double _pendingSeconds = 0.0; ///< Simulated, not yet processed: less than a slice.
    bool _bTicking = false;

public:
    /// Simulated seconds per second.
    explicit SliceClock(double timeScale);

    /// Time has passed until now. Returns the number of slices to process: 0 unless it ticks.
    [[nodiscard]] std::size_t CountSlices(Core::SteadyTime now);

    /// Ticks until OnTick, which is due after the result.
    [[nodiscard]] Core::Duration StartTick();
    void OnTick() noexcept;
    [[nodiscard]] bool IsTicking() const noexcept;
};

} // namespace ACS::VdaSim
