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

/// What a name of a template stands for.
using JobValue = std::variant<std::string, std::int64_t, double, bool>;

/// The keys of one station's table, `type` among them, and `height` and `side` where they are known.
using StationValues = std::map<std::string, JobValue, std::less<>>;

/// Of every station of the map.
using StationTable = std::map<std::string, StationValues, std::less<>>;

/// What templates can name of one job.
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

    /// The innermost station that has the job's own fixed place, which may be another one than where the robot is docked;
    /// that one where no station has the place.
    [[nodiscard]] const std::string& GetStationID() const noexcept;

    /// nullopt where the job has no such thing. A number of a place is 0 where the place lacks it.
    [[nodiscard]] std::optional<JobValue> FindOrNull(const JobName& name) const;

    /// The same as a whole number, 0 where there is none: the robot port is its own number.
    [[nodiscard]] std::int64_t GetNumber(const JobName& name) const;

private:
    [[nodiscard]] const std::optional<Core::Location>& GetLocation(JobName::ESubject subject) const;
    [[nodiscard]] const Core::Location* FindPlaceOrNull() const;
    [[nodiscard]] const Core::Location* FindRobotPlaceOrNull() const;
    [[nodiscard]] std::optional<JobValue> FindStationValueOrNull(const std::string& key) const;
};

} // namespace ACS::Acsd
