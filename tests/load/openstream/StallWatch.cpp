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
constexpr std::chrono::milliseconds LATE{1};

/// Best effort: where the system forbids it, the sleeper watches whichever processor it is on.
void BindToProcessor(std::thread& thread, std::size_t processor)
{
    cpu_set_t set{};
    CPU_ZERO(&set);
    CPU_SET(processor, &set);
    static_cast<void>(pthread_setaffinity_np(thread.native_handle(), sizeof set, &set));
}

} // namespace

StallWatch::StallWatch()
    : _sleepers(std::thread::hardware_concurrency())
{
    for (std::size_t index = 0; index < _sleepers.size(); ++index)
    {
        Sleeper& sleeper = _sleepers[index];
        sleeper.thread = std::thread([this, &sleeper]() { Watch(sleeper.stalls); });
        BindToProcessor(sleeper.thread, index);
    }
}

StallWatch::~StallWatch()
{
    static_cast<void>(Stop());
}

void StallWatch::Watch(std::vector<Stall>& stalls)
{
    std::unique_lock<std::mutex> lock(_mutex);
    while (!_bStopping)
    {
        const Core::SteadyTime due = std::chrono::steady_clock::now() + SLEEP;
        _stopping.wait_until(lock, due);
        const Core::SteadyTime now = std::chrono::steady_clock::now();
        if (now - due > LATE)
        {
            stalls.push_back(Stall{due, now});
        }
    }
}

std::vector<StallWatch::Stall> StallWatch::Stop()
{
    {
        const std::unique_lock<std::mutex> lock(_mutex);
        _bStopping = true;
    }
    _stopping.notify_all();
    std::vector<Stall> all;
    for (Sleeper& sleeper : _sleepers)
    {
        if (sleeper.thread.joinable())
        {
            sleeper.thread.join();
        }
        all.insert(all.end(), sleeper.stalls.begin(), sleeper.stalls.end());
    }
    std::ranges::sort(all, {}, &Stall::begin);
    return all;
}

} // namespace ACS::Load
