#include "standby/LeaseGuard.hpp"

namespace ACS::Acsd
{

LeaseGuard::LeaseGuard(const Core::IClock& clock)
    : _clock(clock)
{
}

void LeaseGuard::Extend(Core::SteadyTime end)
{
    _end = end;
}

void LeaseGuard::End()
{
    {
        const std::lock_guard lock(_mutex);
        _end = Core::SteadyTime::min();
    }
    _ended.notify_all();
}

bool LeaseGuard::IsHeld() const
{
    return _clock.GetNow().steady < _end.load();
}

bool LeaseGuard::TryWait(Core::Duration duration)
{
    std::unique_lock lock(_mutex);
    _ended.wait_for(lock, duration, [this] { return !IsHeld(); });
    return IsHeld();
}

} // namespace ACS::Acsd
