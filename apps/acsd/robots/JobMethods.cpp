#include "robots/JobMethods.hpp"

#include <utility>

namespace ACS::Acsd
{

JobMethods::JobMethods(std::initializer_list<std::pair<std::string, JobMethod>> methods)
{
    for (const auto& [action, method] : methods)
    {
        SetMethod(action, {}, method);
    }
}

JobMethods::JobMethods(LoadPositions positions, std::shared_ptr<const StationTable> stations)
    : _positions(std::move(positions)),
      _stations(std::move(stations))
{
}

void JobMethods::SetMethod(const std::string& action, const std::string& stationID, JobMethod method)
{
    _methods[action].insert_or_assign(stationID, std::move(method));
}

std::vector<const JobMethod*> JobMethods::ListMethods() const
{
    std::vector<const JobMethod*> methods;
    for (const auto& [action, byStation] : _methods)
    {
        for (const auto& [stationID, method] : byStation)
        {
            methods.push_back(&method);
        }
    }
    return methods;
}

const JobMethod* JobMethods::FindMethodOrNull(std::string_view action) const
{
    const auto methods = _methods.find(action);
    if (methods == _methods.end())
    {
        return nullptr;
    }
    const auto method = methods->second.find(std::string_view());
    return method == methods->second.end() ? nullptr : &method->second;
}

const JobMethod* JobMethods::FindMethodOrNull(std::string_view action, const JobData& data) const
{
    const auto methods = _methods.find(action);
    if (methods == _methods.end())
    {
        return nullptr;
    }
    const auto method = methods->second.find(data.GetStationID());
    return method == methods->second.end() ? FindMethodOrNull(action) : &method->second;
}

JobData JobMethods::MakeData(const Planning::StartJob& job) const
{
    return {job, *_stations, _positions};
}

const LoadPositions& JobMethods::GetPositions() const noexcept
{
    return _positions;
}

} // namespace ACS::Acsd
