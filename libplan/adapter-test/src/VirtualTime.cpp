#include "VirtualTime.hpp"

#include <algorithm>

namespace ACS::AdapterTest
{

Core::Now VirtualTime::GetNow() const
{
    return _now;
}

void VirtualTime::Post(Core::Duration delay, Task task)
{
    static_cast<void>(PostTask(delay, std::move(task)));
}

VirtualTime::Ticket VirtualTime::PostTask(Core::Duration delay, Task task)
{
    constexpr Core::Duration LONGEST = std::chrono::hours(24 * 365);
    const Ticket ticket{_now.steady + std::clamp(delay, Core::Duration::zero(), LONGEST), ++_lastOrder};
    _tasks.emplace(ticket, std::move(task));
    return ticket;
}

void VirtualTime::Withdraw(const Ticket& ticket)
{
    _tasks.erase(ticket);
}

bool VirtualTime::TryStep(Core::SteadyTime until)
{
    if (IsExhausted() || _tasks.empty() || _tasks.begin()->first.first > until)
    {
        AdvanceTo(until);
        return false;
    }
    auto next = _tasks.extract(_tasks.begin());
    ++_steps;
    _stepsAtOnce = next.key().first == _now.steady ? _stepsAtOnce + 1 : 0;
    AdvanceTo(next.key().first);
    next.mapped()();
    return true;
}

bool VirtualTime::IsExhausted() const noexcept
{
    return _steps >= MAXIMUM_STEPS || _stepsAtOnce >= MAXIMUM_AT_ONCE;
}

Core::Duration VirtualTime::GetAge() const
{
    return _now.steady - Core::SteadyTime(START_STEADY);
}

void VirtualTime::AdvanceTo(Core::SteadyTime time)
{
    const Core::Duration span = std::max(time - _now.steady, Core::Duration::zero());
    _now.steady += span;
    _now.wall += std::chrono::duration_cast<Core::WallTime::duration>(span);
}

} // namespace ACS::AdapterTest
