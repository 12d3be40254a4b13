#include "StallWatch.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <pthread.h>
#include <sched.h>

namespace ACS::Load
{

namespace
{

constexpr std::chrono::milliseconds SLEEP{1};

/// Best effort: if the system forbids it, the thread watches the processor on which it happens to run.
void BindToProcessor(std::thread& thread, std::size_t processor)
{
    cpu_set_t set{};
    CPU_ZERO(&set);
    CPU_SET(processor, &set);
    static_cast<void>(pthread_setaffinity_np(thread.native_handle(), sizeof set, &set));
}

} // namespace

StallWatch::StallWatch(std::chrono::milliseconds late)
{
    for (std::size_t index = 0; index < std::thread::hardware_concurrency(); ++index)
    {
        Sleeper& sleeper = *_sleepers.emplace_back(std::make_unique<Sleeper>());
        sleeper.thread = std::thread([&sleeper, late]() { Watch(sleeper, late); });
        BindToProcessor(sleeper.thread, index);
    }
}

StallWatch::~StallWatch()
{
    static_cast<void>(Stop());
}

void StallWatch::Watch(Sleeper& sleeper, Core::Duration late)
{
    std::unique_lock<std::mutex> lock(sleeper.mutex);
    while (!sleeper.bStopping)
    {
        const Core::SteadyTime due = std::chrono::steady_clock::now() + SLEEP;
        sleeper.stopping.wait_until(lock, due);
        const Core::SteadyTime now = std::chrono::steady_clock::now();
        if (now - due > late)
        {
            sleeper.stalls.push_back(Stall{due, now});
        }
    }
}

std::vector<StallWatch::Stall> StallWatch::Stop()
{
    std::vector<Stall> all;
    for (const std::unique_ptr<Sleeper>& sleeper : _sleepers)
    {
        {
            const std::unique_lock<std::mutex> lock(sleeper->mutex);
            sleeper->bStopping = true;
        }
        sleeper->stopping.notify_all();
        if (sleeper->thread.joinable())
        {
            sleeper->thread.join();
        }
        all.insert(all.end(), sleeper->stalls.begin(), sleeper->stalls.end());
    }
    std::ranges::sort(all, {}, &Stall::begin);
    return all;
}

} // namespace ACS::Load
