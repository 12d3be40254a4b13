#include "ActionFault.hpp"
#include "AngleBound.hpp"
#include "OrderErrors.hpp"
#include "VehicleSession.Impl.hpp"

#include <algorithm>
#include <cmath>
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

MapState* FindMapOrNull(std::optional<std::vector<MapState>>& maps, const MapKey& key)
{
    if (!maps.has_value())
    {
        return nullptr;
    }
    const auto found = std::ranges::find_if(*maps, [&key](const MapState& map) {
        return map.mapID == key.mapID && map.mapVersion == key.mapVersion;
    });
    return found == maps->end() ? nullptr : &*found;
}

} // namespace

/// Why an action fails before it begins, by what the session itself knows; empty where it may begin.
std::string VehicleSession::Impl::FindOwnFault(const Action& action, EActionScope scope)
{
    for (const std::string_view key : {"mapId", "mapVersion", "lastNodeId"})
    {
        if (GetTextParameterOrNull(action, key).value_or(std::string()).size() > LONGEST_FOREIGN_TEXT)
        {
            return "too long to be shown in states: " + std::string(key);
        }
    }
    if (action.actionType == ActionTypes::INIT_POSITION)
    {
        return FindPoseFault(action, scope);
    }
    if (!IsMapAction(action))
    {
        return {};
    }
    const MapKey key = GetMapKey(action);
    const MapState* mapOrNull = FindMapOrNull(_maps, key);
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

std::string VehicleSession::Impl::FindPoseFault(const Action& action, EActionScope scope) const
{
    const std::string mapID = GetTextParameterOrNull(action, "mapId").value_or(std::string());
    const bool bMapKnown = std::ranges::find(_options.mapIDs, mapID) != _options.mapIDs.end()
        || (_maps.has_value() && std::ranges::find(*_maps, mapID, &MapState::mapID) != _maps->end());
    if (!bMapKnown && (_maps.has_value() || !_options.mapIDs.empty()))
    {
        return "the vehicle does not have the map " + mapID;
    }
    for (const std::string_view key : {"x", "y", "theta"})
    {
        const std::optional<double> number = GetNumberParameterOrNull(action, key);
        if (!number.has_value() || !std::isfinite(*number) || (key == "theta" && std::abs(*number) > PI_BOUND))
        {
            return "the pose is no pose: " + std::string(key);
        }
    }
    // During an order, the order determines the node of the vehicle.
    return scope == EActionScope::Instant && IsExecuting() ? "an order runs" : std::string();
}

/// Applies the effects of a finished action on the reported state; the owner may have reported them already.
void VehicleSession::Impl::ApplyOwnEffect(const Action& action, EActionScope scope)
{
    if (action.actionType == ActionTypes::INIT_POSITION)
    {
        AgvPosition position;
        position.bPositionInitialized = true;
        position.x = GetNumberParameterOrNull(action, "x").value_or(0.0);
        position.y = GetNumberParameterOrNull(action, "y").value_or(0.0);
        position.theta = GetNumberParameterOrNull(action, "theta").value_or(0.0);
        position.mapID = GetMapKey(action).mapID;
        EnableOnlyVersion(position.mapID);
        _position = std::move(position);
        if (scope == EActionScope::Instant)
        {
            SetLastNode(GetTextParameterOrNull(action, "lastNodeId").value_or(std::string()));
        }
    }
    else if (IsMapAction(action))
    {
        ApplyMapEffect(action);
    }
}

/// A vehicle that is localised on a map uses it, and a map in use is ENABLED. Of several versions the one is unknown.
void VehicleSession::Impl::EnableOnlyVersion(const std::string& mapID)
{
    const auto isVersion = [&mapID](const MapState& map) {
        return map.mapID == mapID;
    };
    if (_maps.has_value() && std::ranges::count_if(*_maps, isVersion) == 1)
    {
        std::ranges::find_if(*_maps, isVersion)->mapStatus = EMapStatus::Enabled;
    }
}

void VehicleSession::Impl::ApplyMapEffect(const Action& action)
{
    const MapKey key = GetMapKey(action);
    MapState* mapOrNull = FindMapOrNull(_maps, key);
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
    // At most one version of a map is enabled.
    for (MapState& map : *_maps)
    {
        if (map.mapID == key.mapID)
        {
            map.mapStatus = &map == mapOrNull ? EMapStatus::Enabled : EMapStatus::Disabled;
        }
    }
}

/// lastNodeSequenceId stays: it counts within the order that is held, and an update may still follow.
void VehicleSession::Impl::SetLastNode(std::string nodeID)
{
    _lastNodeID = std::move(nodeID);
    _distanceSinceLastNode.reset();
    _bCleared = false;
    _bStateDue = true;
}

bool VehicleSession::Impl::TrySetLastNode(std::string nodeID, Core::Now now, VehicleActions& out)
{
    if (IsExecuting())
    {
        return false;
    }
    SetLastNode(std::move(nodeID));
    Settle(now, out);
    return true;
}

/// The owner's word that an action did not succeed.
void VehicleSession::Impl::OnActionFailed(const ReportedAction& tracked, VehicleActions& out)
{
    if (!tracked.IsInstant())
    {
        OnOrderActionFailed(tracked, out);
        return;
    }
    const ActionState& state = tracked.machine.GetState();
    ReportInstantAction(
        tracked.action,
        std::nullopt,
        ErrorTypes::ACTION_ERROR,
        {state.actionType + " failed: " + state.resultDescription, {}});
}

/// 2.x does not stop an order for a failed action; a vehicle may, for the kinds that it names.
void VehicleSession::Impl::OnOrderActionFailed(const ReportedAction& tracked, VehicleActions& out)
{
    if (tracked.bCancelled)
    {
        return;
    }
    const std::string& actionType = tracked.action.actionType;
    const bool bCritical =
        std::ranges::find(_options.criticalActionTypes, actionType) != _options.criticalActionTypes.end();
    VehicleError error;
    error.errorType = ErrorTypes::ACTION_ERROR;
    error.errorLevel = bCritical ? EErrorLevel::Fatal : EErrorLevel::Warning;
    error.errorDescription = actionType + " failed: " + tracked.machine.GetState().resultDescription;
    // No orderId: some masters take every error with one for the refusal of the order; and others one without a topic.
    AddReference(error, ReferenceKeys::TOPIC, GetTopicName(ETopic::Order));
    AddReference(error, ReferenceKeys::ACTION_ID, tracked.action.actionID);
    AddReference(
        error,
        tracked.scope == EActionScope::Node ? ReferenceKeys::NODE_ID : ReferenceKeys::EDGE_ID,
        tracked.elementID);
    AddSessionError(std::move(error), EErrorLifetime::UntilOrder);
    if (bCritical)
    {
        _bHeldByFailure = true;
        StopMoving(out);
    }
}

} // namespace ACS::VDA5050
