#include "common/process/SystemClock.hpp"

#include <chrono>

namespace ACS::Apps
{

Core::Now SystemClock::GetNow() const
{
    return {std::chrono::steady_clock::now(), std::chrono::system_clock::now()};
}

} // namespace ACS::Apps
