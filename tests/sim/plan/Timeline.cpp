#include "Timeline.hpp"

#include <algorithm>

namespace ACS::Simulation
{

Core::Now Timeline::GetNow() const
{
    return _now;
}

Timeline::Ticket Timeline::Post(Core::Duration delay, Task task)
{
    const Ticket ticket{_now.steady + std::max(delay, Core::Duration::zero()), ++_lastOrder};
    _tasks.emplace(ticket, std::move(task));
    return ticket;
}

void Timeline::Withdraw(const Ticket& ticket)
{
    _tasks.erase(ticket);
}

std::optional<Core::SteadyTime> Timeline::GetNextTimeOrNull() const
{
    return _tasks.empty() ? std::nullopt : std::optional(_tasks.begin()->first.first);
}

bool Timeline::TryStep()
{
    if (_tasks.empty())
    {
        return false;
    }
    auto next = _tasks.extract(_tasks.begin());
    const Core::Duration span = next.key().first - _now.steady;
    _now.steady += span;
    _now.wall += std::chrono::duration_cast<Core::WallTime::duration>(span);
    next.mapped()();
    return true;
}

Core::Duration Timeline::GetAge() const
{
    return _now.steady - Core::SteadyTime(START_STEADY);
}

} // namespace ACS::Simulation
