#include "VehicleMaps.hpp"

#include "ActionFault.hpp"

#include <algorithm>
#include <utility>

namespace ACS::VDA5050
{

namespace
{

/// Which map an action is about.
struct MapKey
{
    std::string mapID;
    std::string mapVersion;
};

MapKey GetMapKey(const Action& action)
{
    return MapKey{
        GetTextParameterOrNull(action, "mapId").value_or(std::string()),
        GetTextParameterOrNull(action, "mapVersion").value_or(std::string())};
}

bool IsMapAction(const Action& action)
{
    return action.actionType == ActionTypes::ENABLE_MAP || action.actionType == ActionTypes::DOWNLOAD_MAP
        || action.actionType == ActionTypes::DELETE_MAP;
}

const MapState* FindMapOrNull(const std::optional<std::vector<MapState>>& mapsOrNull, const MapKey& key)
{
    if (!mapsOrNull.has_value())
    {
        return nullptr;
    }
    const auto found = std::ranges::find_if(*mapsOrNull, [&key](const MapState& map) {
        return map.mapID == key.mapID && map.mapVersion == key.mapVersion;
    });
    return found == mapsOrNull->end() ? nullptr : &*found;
}

} // namespace

bool VehicleMaps::TryChange(std::optional<std::vector<MapState>> mapsOrNull)
{
    const bool bChanged = mapsOrNull != _maps;
    _maps = std::move(mapsOrNull);
    return bChanged;
}

std::string VehicleMaps::FindFault(const Action& action) const
{
    if (!IsMapAction(action))
    {
        return {};
    }
    const MapKey key = GetMapKey(action);
    const MapState* const mapOrNull = FindMapOrNull(_maps, key);
    const std::string name = "the map " + key.mapID + " in version " + key.mapVersion;
    if (action.actionType == ActionTypes::DOWNLOAD_MAP)
    {
        return mapOrNull == nullptr ? std::string() : name + " is on the vehicle already";
    }
    if (mapOrNull == nullptr)
    {
        return name + " is not on the vehicle";
    }
    const bool bDelete = action.actionType == ActionTypes::DELETE_MAP;
    return bDelete && mapOrNull->mapStatus == EMapStatus::Enabled ? name + " is in use" : std::string();
}

std::string VehicleMaps::FindEndFault(const Action& action) const
{
    const MapKey key = GetMapKey(action);
    const bool bOnVehicle = FindMapOrNull(_maps, key) != nullptr;
    const bool bDelete = action.actionType == ActionTypes::DELETE_MAP && bOnVehicle;
    const bool bEnable = action.actionType == ActionTypes::ENABLE_MAP && !bOnVehicle;
    return bDelete || bEnable ? FindFault(action) : std::string();
}

void VehicleMaps::Apply(const Action& action)
{
    if (!IsMapAction(action))
    {
        return;
    }
    const MapKey key = GetMapKey(action);
    const MapState* const mapOrNull = FindMapOrNull(_maps, key);
    if (action.actionType == ActionTypes::DOWNLOAD_MAP)
    {
        if (mapOrNull == nullptr)
        {
            _maps = _maps.value_or(std::vector<MapState>());
            _maps->push_back(MapState{key.mapID, key.mapVersion, EMapStatus::Disabled, {}});
        }
        return;
    }
    if (mapOrNull == nullptr)
    {
        return;
    }
    if (action.actionType == ActionTypes::DELETE_MAP)
    {
        _maps->erase(_maps->begin() + (mapOrNull - _maps->data()));
        return;
    }
    for (MapState& map : *_maps)
    {
        if (map.mapID == key.mapID)
        {
            map.mapStatus = &map == mapOrNull ? EMapStatus::Enabled : EMapStatus::Disabled;
        }
    }
}

void VehicleMaps::EnableOnlyVersion(std::string_view mapID)
{
    const auto isVersion = [mapID](const MapState& map) {
        return map.mapID == mapID;
    };
    if (_maps.has_value() && std::ranges::count_if(*_maps, isVersion) == 1)
    {
        std::ranges::find_if(*_maps, isVersion)->mapStatus = EMapStatus::Enabled;
    }
}

bool VehicleMaps::HasMap(std::string_view mapID) const
{
    return _maps.has_value() && std::ranges::find(*_maps, mapID, &MapState::mapID) != _maps->end();
}

const std::optional<std::vector<MapState>>& VehicleMaps::GetStates() const noexcept
{
    return _maps;
}

} // namespace ACS::VDA5050
