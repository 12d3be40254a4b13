#pragma once

#include <acs/core/Now.hpp>

#include <condition_variable>
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
    struct Sleeper
    {
        std::vector<Stall> stalls;
        std::thread thread;
    };

    std::mutex _mutex;
    std::condition_variable _stopping;
    bool _bStopping = false;
    std::vector<Sleeper> _sleepers;

    void Watch(std::vector<Stall>& stalls);

public:
    StallWatch();
    StallWatch(const StallWatch&) = delete;
    StallWatch& operator=(const StallWatch&) = delete;
    ~StallWatch();

    /// Ends the watch. What all processors saw, in the order of its beginning.
    [[nodiscard]] std::vector<Stall> Stop();
};

} // namespace ACS::Load
