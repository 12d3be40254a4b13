#pragma once

#include "robots/JobData.hpp"
#include "robots/JobMethod.hpp"
#include "robots/LoadPositions.hpp"
#include <acs/plan/RobotCommand.hpp>

#include <functional>
#include <initializer_list>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace ACS::Acsd
{

/// How one robot does the jobs of the MCS, resolved from the tables of actions, robots and stations.
class JobMethods final
{
    using MethodsByStation = std::map<std::string, JobMethod, std::less<>>; ///< Empty: any other station.

    std::map<std::string, MethodsByStation, std::less<>> _methods; ///< By action.
    LoadPositions _positions;
    std::shared_ptr<const StationTable> _stations = std::make_shared<const StationTable>();

public:
    JobMethods() = default;

    /// By action, alike at every station. No station has values, and the vehicle calls its ports as the MCS does.
    JobMethods(std::initializer_list<std::pair<std::string, JobMethod>> methods);

    JobMethods(LoadPositions positions, std::shared_ptr<const StationTable> stations);

    /// At one station, or where its id is empty at every station that has no method of its own.
    void SetMethod(const std::string& action, const std::string& stationID, JobMethod method);

    /// Anywhere; null where the robot has no method for the action.
    [[nodiscard]] const JobMethod* FindMethodOrNull(std::string_view action) const;

    /// At the station of the job's own place.
    [[nodiscard]] const JobMethod* FindMethodOrNull(std::string_view action, const JobData& data) const;

    /// Refers to the stations of this object.
    [[nodiscard]] JobData MakeData(const Planning::StartJob& job) const;

    [[nodiscard]] const LoadPositions& GetPositions() const noexcept;
};

} // namespace ACS::Acsd
