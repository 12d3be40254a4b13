#pragma once

#include <acs/core/Now.hpp>

#include <atomic>
#include <condition_variable>
#include <mutex>

namespace ACS::Acsd
{

/// Until when this process may command robots and write to a shared store. May be used by several threads. A message that is
/// about to be sent is checked against the clock, because a process can stall for longer than its lease.
class LeaseGuard final
{
    const Core::IClock& _clock;
    std::atomic<Core::SteadyTime> _end{Core::SteadyTime::min()};
    std::mutex _mutex;
    std::condition_variable _ended;

public:
    /// Nothing is allowed at first. The clock outlives the guard.
    explicit LeaseGuard(const Core::IClock& clock);
    LeaseGuard(const LeaseGuard&) = delete;
    LeaseGuard& operator=(const LeaseGuard&) = delete;
    ~LeaseGuard() = default;

    void Extend(Core::SteadyTime end);
    void End();

    [[nodiscard]] bool IsHeld() const;

    /// Waits, or until the end. Returns whether the lease is still held.
    [[nodiscard]] bool TryWait(Core::Duration duration);
};

} // namespace ACS::Acsd
