#pragma once

#include "robots/JobName.hpp"
#include "robots/LoadPositions.hpp"
#include <acs/core/Location.hpp>
#include <acs/plan/RobotCommand.hpp>

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <variant>

namespace ACS::Acsd
{

/// The value of a name in a template.
using JobValue = std::variant<std::string, std::int64_t, double, bool>;

/// The keys of one station's table. `type` is always present, `height` and `side` if they are known.
using StationValues = std::map<std::string, JobValue, std::less<>>;

/// Has every station of the map.
using StationTable = std::map<std::string, StationValues, std::less<>>;

/// The values of one job that templates can name.
class JobData final
{
    std::optional<Core::Location> _from;
    std::optional<Core::Location> _to;
    std::optional<Core::Location> _position;
    std::string _positionText;
    std::optional<std::string> _carrierID;
    std::int32_t _jobNumber;
    std::string _stationID;
    const StationValues* _stationOrNull = nullptr;
    std::optional<std::string> _robotPosition; ///< The vehicle's name of the robot port.

public:
    /// The stations must outlive it.
    JobData(const Planning::StartJob& job, const StationTable& stations, const LoadPositions& positions);

    /// The innermost station that contains the job's own fixed place. If none does, the station where the robot is docked.
    [[nodiscard]] const std::string& GetStationID() const noexcept;

    /// nullopt if the job has no such value. A number of a place is 0 if the place lacks the segment.
    [[nodiscard]] std::optional<JobValue> FindOrNull(const JobName& name) const;

    /// Likewise as a whole number, 0 if there is none. The robot port gives its own number.
    [[nodiscard]] std::int64_t GetNumber(const JobName& name) const;

private:
    [[nodiscard]] const std::optional<Core::Location>& GetLocation(JobName::ESubject subject) const;
    [[nodiscard]] const Core::Location* FindPlaceOrNull() const;
    [[nodiscard]] const Core::Location* FindRobotPlaceOrNull() const;
    [[nodiscard]] std::optional<JobValue> FindStationValueOrNull(const std::string& key) const;
};

} // namespace ACS::Acsd
