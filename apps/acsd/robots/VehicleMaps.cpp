#include "robots/VehicleMaps.hpp"

#include <acs/vda5050/PredefinedActions.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>
#include <utility>

namespace ACS::Acsd
{

namespace
{

constexpr std::string_view ERROR_CODE = "AGV-mapNotEnabled";

std::string Describe(const NeededMap& map)
{
    return map.version.empty() ? "map " + map.mapID : fmt::format("map {} version {}", map.mapID, map.version);
}

void AddParameter(VDA5050::Action& action, std::string_view key, const std::string& value)
{
    action.actionParameters.push_back({std::string(key), Core::JsonText::FromString(value)});
}

} // namespace

VehicleMaps::VehicleMaps(std::vector<NeededMap> needed)
    : _needed(std::move(needed))
{
}

VehicleMaps::VehicleMaps(const VehicleMap& map, const std::vector<NeededMap>& configured)
{
    std::set<std::string> mapIDs;
    for (const Planning::Route& route : map.GetRoutes())
    {
        for (const Planning::RouteNode& node : route.nodes)
        {
            mapIDs.insert(node.mapID);
        }
    }
    mapIDs.erase(std::string());
    for (const std::string& mapID : mapIDs)
    {
        const auto row = std::ranges::find(configured, mapID, &NeededMap::mapID);
        _needed.push_back(row == configured.end() ? NeededMap{mapID, {}, {}, {}} : *row);
    }
}

void VehicleMaps::OnConnected()
{
    _request.reset();
    _failures.clear();
    _requestCounts.clear();
}

void VehicleMaps::OnReported(std::optional<std::vector<VDA5050::MapState>> mapsOrNull)
{
    _reported = std::move(mapsOrNull);
}

std::optional<VDA5050::Action> VehicleMaps::MakeRequestOrNull() const
{
    const NeededMap* const mapOrNull = _request.has_value() ? nullptr : FindNextOrNull();
    if (mapOrNull == nullptr)
    {
        return std::nullopt;
    }
    const bool bDownload = MakeTask(*mapOrNull).bDownload;
    VDA5050::Action action;
    action.actionType = bDownload ? VDA5050::ActionTypes::DOWNLOAD_MAP : VDA5050::ActionTypes::ENABLE_MAP;
    AddParameter(action, "mapId", mapOrNull->mapID);
    AddParameter(action, "mapVersion", mapOrNull->version);
    if (bDownload)
    {
        AddParameter(action, "mapDownloadLink", mapOrNull->downloadLink);
        if (!mapOrNull->hash.empty())
        {
            AddParameter(action, "mapHash", mapOrNull->hash);
        }
    }
    return action;
}

void VehicleMaps::OnSent(std::string actionID)
{
    if (const NeededMap* const mapOrNull = FindNextOrNull(); mapOrNull != nullptr)
    {
        _request = Request{std::move(actionID), MakeTask(*mapOrNull)};
        ++_requestCounts[_request->task];
    }
}

void VehicleMaps::OnNotSent(const std::string& error)
{
    if (const NeededMap* const mapOrNull = FindNextOrNull(); mapOrNull != nullptr)
    {
        _failures.insert_or_assign(MakeTask(*mapOrNull), error);
    }
}

bool VehicleMaps::TryEnd(const std::string& actionID, const std::string& error)
{
    if (!_request.has_value() || _request->actionID != actionID)
    {
        return false;
    }
    if (!error.empty())
    {
        _failures.insert_or_assign(_request->task, error);
    }
    else if (_requestCounts[_request->task] == MOST_REQUESTS)
    {
        _failures.insert_or_assign(
            _request->task,
            fmt::format("it reported {} times that it has, and does not show it in its state", MOST_REQUESTS));
    }
    _request.reset();
    return true;
}

bool VehicleMaps::TryApply(const VDA5050::ActionChanged& action)
{
    if (action.status == VDA5050::EActionStatus::Finished)
    {
        return TryEnd(action.actionID, {});
    }
    if (action.status == VDA5050::EActionStatus::Failed)
    {
        return TryEnd(
            action.actionID,
            action.resultDescription.empty() ? "the action failed" : action.resultDescription);
    }
    return false;
}

std::vector<Planning::RobotError> VehicleMaps::ListErrors() const
{
    std::vector<Planning::RobotError> errors;
    for (const NeededMap& map : _needed)
    {
        if (!_reported.has_value() || IsEnabled(map))
        {
            continue;
        }
        const bool bThere = FindReportedOrNull(map) != nullptr;
        const auto failure = _failures.find(MakeTask(map));
        const bool bBegun = _request.has_value() && _request->task.mapID == map.mapID;
        std::string text = fmt::format("{} is {}", Describe(map), bThere ? "not enabled" : "not on the vehicle");
        if (failure != _failures.end())
        {
            text +=
                fmt::format(", and the vehicle could not {} it: {}", bThere ? "enable" : "download", failure->second);
        }
        text += bBegun
            ? fmt::format("; it {} it now", bThere ? "enables" : "downloads")
            : std::string(". Enable it at the vehicle, or correct the maps of the robot in the configuration");
        errors.push_back({std::string(ERROR_CODE), Planning::EAlarmLevel::Heavy, text + "."});
    }
    return errors;
}

const VDA5050::MapState* VehicleMaps::FindReportedOrNull(const NeededMap& map) const
{
    if (!_reported.has_value())
    {
        return nullptr;
    }
    const VDA5050::MapState* foundOrNull = nullptr;
    for (const VDA5050::MapState& reported : *_reported)
    {
        const bool bSame = reported.mapID == map.mapID && (map.version.empty() || reported.mapVersion == map.version);
        const bool bBetter = foundOrNull == nullptr || reported.mapStatus == VDA5050::EMapStatus::Enabled;
        foundOrNull = bSame && bBetter ? &reported : foundOrNull;
    }
    return foundOrNull;
}

bool VehicleMaps::IsEnabled(const NeededMap& map) const
{
    const VDA5050::MapState* const reportedOrNull = FindReportedOrNull(map);
    return reportedOrNull != nullptr && reportedOrNull->mapStatus == VDA5050::EMapStatus::Enabled;
}

/// The first map that acsd can download or enable, and that has not failed.
const NeededMap* VehicleMaps::FindNextOrNull() const
{
    const auto next = std::ranges::find_if(_needed, [this](const NeededMap& map) {
        const bool bPossible =
            !map.version.empty() && (FindReportedOrNull(map) != nullptr || !map.downloadLink.empty());
        return _reported.has_value() && !IsEnabled(map) && bPossible && !_failures.contains(MakeTask(map));
    });
    return next == _needed.end() ? nullptr : &*next;
}

VehicleMaps::Task VehicleMaps::MakeTask(const NeededMap& map) const
{
    return {map.mapID, FindReportedOrNull(map) == nullptr};
}

} // namespace ACS::Acsd
