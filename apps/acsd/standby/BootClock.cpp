#include "standby/BootClock.hpp"

#include <chrono>
#include <ctime>

namespace ACS::Acsd
{

Core::Now BootClock::GetNow() const
{
    timespec time{};
    ::clock_gettime(CLOCK_BOOTTIME, &time);
    const auto sinceBoot = std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
    return {Core::SteadyTime(std::chrono::duration_cast<Core::Duration>(sinceBoot)), std::chrono::system_clock::now()};
}

} // namespace ACS::Acsd
