#include "vda-sim/SliceClock.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace ACS::VdaSim
{
namespace
{

using namespace std::chrono_literals;

constexpr double MAX_TICK_SECONDS = 5.0; ///< Real time: a process that was suspended does not skip ahead.

} // namespace

SliceClock::SliceClock(double timeScale)
    : _timeScale(timeScale)
{
}

std::size_t SliceClock::CountSlices(Core::SteadyTime now)
{
    const Core::SteadyTime last = std::exchange(_lastTime, now).value_or(now);
    std::size_t slices = 0;
    if (_bTicking)
    {
        const double passed = std::chrono::duration<double>(now - last).count();
        _pendingSeconds += std::clamp(passed, 0.0, MAX_TICK_SECONDS) * _timeScale;
        while (_pendingSeconds >= SLICE_SECONDS)
        {
            _pendingSeconds -= SLICE_SECONDS;
            ++slices;
        }
    }
    return slices;
}

Core::Duration SliceClock::StartTick()
{
    _bTicking = true;
    // The faster the simulated time, the shorter the tick, so that arrivals are not reported late in simulated time.
    return std::chrono::duration_cast<Core::Duration>(50ms / std::clamp(_timeScale, 1.0, 5.0));
}

void SliceClock::OnTick() noexcept
{
    _bTicking = false;
}

bool SliceClock::IsTicking() const noexcept
{
    return _bTicking;
}

} // namespace ACS::VdaSim
