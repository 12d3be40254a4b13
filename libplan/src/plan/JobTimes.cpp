#include "plan/JobTimes.hpp"

#include <chrono>

namespace ACS::Planning
{

void JobTimes::Note(const std::string& stationID, Core::Duration time)
{
    constexpr double WEIGHT = 0.25; ///< Of the last job.
    const double seconds = std::chrono::duration<double>(time).count();
    const auto [entry, bNew] = _seconds.try_emplace(stationID, seconds);
    if (!bNew)
    {
        entry->second += WEIGHT * (seconds - entry->second);
    }
}

double JobTimes::GetSeconds(std::string_view stationID) const
{
    constexpr double ASSUMED_SECONDS = 8;
    const auto found = _seconds.find(stationID);
    return found == _seconds.end() ? ASSUMED_SECONDS : found->second;
}

} // namespace ACS::Planning
