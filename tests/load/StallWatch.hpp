#pragma once

#include <acs/core/Now.hpp>

#include <chrono>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace ACS::Load
{

/// Detects stalls of the machine: one thread pinned to each processor sleeps for a millisecond in a loop and records when
/// it woke late. Such a delay is caused by the machine, not by a program.
class StallWatch
{
public:
    /// From the time at which the thread should have woken to the time at which it did.
    struct Stall
    {
        Core::SteadyTime begin;
        Core::SteadyTime end;
    };

private:
    /// Each has its own lock, so that one that is delayed while it holds the lock does not delay the others.
    struct Sleeper
    {
        std::mutex mutex;
        std::condition_variable stopping;
        bool bStopping = false;
        std::deque<Stall> stalls; ///< A deque does not move its elements in memory, which would fragment the heap.
        std::thread thread;
    };

    std::vector<std::unique_ptr<Sleeper>> _sleepers;

public:
    /// Records delays longer than this.
    explicit StallWatch(std::chrono::milliseconds late = std::chrono::milliseconds(1));
    StallWatch(const StallWatch&) = delete;
    StallWatch& operator=(const StallWatch&) = delete;
    ~StallWatch();

    /// Ends the watch. Returns the stalls of all processors, in the order of their beginning.
    [[nodiscard]] std::vector<Stall> Stop();

private:
    static void Watch(Sleeper& sleeper, Core::Duration late);
};

} // namespace ACS::Load
