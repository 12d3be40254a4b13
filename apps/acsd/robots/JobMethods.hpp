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
#include <vector>

namespace ACS::Acsd
{

/// How one robot does the jobs of the MCS, resolved from the tables of actions, robots and stations.
class JobMethods final
{
    using MethodsByStation = std::map<std::string, JobMethod, std::less<>>; ///< Empty key: any other station.

    std::map<std::string, MethodsByStation, std::less<>> _methods; ///< By action.
    LoadPositions _positions;
    std::shared_ptr<const StationTable> _stations = std::make_shared<const StationTable>();

public:
    JobMethods() = default;

    /// By action, the same at every station. Stations have no values, and the vehicle's names of its ports are those of
    /// MCS-ACS.
    JobMethods(std::initializer_list<std::pair<std::string, JobMethod>> methods);

    JobMethods(LoadPositions positions, std::shared_ptr<const StationTable> stations);

    /// Sets the method at one station. An empty stationID means every station without a method of its own.
    void SetMethod(const std::string& action, const std::string& stationID, JobMethod method);

    /// The methods of all actions at all stations. Valid until SetMethod.
    [[nodiscard]] std::vector<const JobMethod*> ListMethods() const;

    /// The method at some station; null if the robot has none for the action.
    [[nodiscard]] const JobMethod* FindMethodOrNull(std::string_view action) const;

    /// The method at the station of the job's own place.
    [[nodiscard]] const JobMethod* FindMethodOrNull(std::string_view action, const JobData& data) const;

    /// Refers to the stations of this object.
    [[nodiscard]] JobData MakeData(const Planning::StartJob& job) const;

    [[nodiscard]] const LoadPositions& GetPositions() const noexcept;
};

} // namespace ACS::Acsd
