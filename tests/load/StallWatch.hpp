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

/// Notices when the machine stands still: one thread bound to each processor, which does nothing but sleep for a
/// millisecond, and remembers when it woke late. What it saw is the machine's doing and no program's.
class StallWatch
{
public:
    /// From when the sleeper should have woken to when it did.
    struct Stall
    {
        Core::SteadyTime begin;
        Core::SteadyTime end;
    };

private:
    /// Each with a lock of its own: who is kept waiting while it holds it must not make the others late.
    struct Sleeper
    {
        std::mutex mutex;
        std::condition_variable stopping;
        bool bStopping = false;
        std::deque<Stall> stalls; ///< Never moved in memory, which would leave holes of its size.
        std::thread thread;
    };

    std::vector<std::unique_ptr<Sleeper>> _sleepers;

public:
    /// Remembers what was later than this.
    explicit StallWatch(std::chrono::milliseconds late = std::chrono::milliseconds(1));
    StallWatch(const StallWatch&) = delete;
    StallWatch& operator=(const StallWatch&) = delete;
    ~StallWatch();

    /// Ends the watch. What all processors saw, in the order of its beginning.
    [[nodiscard]] std::vector<Stall> Stop();

private:
    static void Watch(Sleeper& sleeper, Core::Duration late);
};

} // namespace ACS::Load
