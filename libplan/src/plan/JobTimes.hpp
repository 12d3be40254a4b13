#pragma once

#include <acs/core/Now.hpp>

#include <map>
#include <string>
#include <string_view>

namespace ACS::Planning
{

/// How long a job takes at each station, as observed since the start.
class JobTimes
{
    std::map<std::string, double, std::less<>> _seconds; ///< Of the stations of the map, so there is a limit.

public:
    /// A job at the station has ended after this time.
    void Note(const std::string& stationID, Core::Duration time);
    /// The mean, in which later jobs count more; an assumption where none has ended yet.
    [[nodiscard]] double GetSeconds(std::string_view stationID) const;
};

} // namespace ACS::Planning
