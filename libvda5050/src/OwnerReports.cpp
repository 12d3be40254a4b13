#include "OwnerReports.hpp"

#include "ActionFault.hpp"
#include "AngleBound.hpp"
#include "OrderErrors.hpp"
#include "StateBounds.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

namespace ACS::VDA5050
{

namespace
{

bool IsFinite(const AgvPosition& position)
{
    return std::isfinite(position.x) && std::isfinite(position.y) && std::isfinite(position.theta);
}

} // namespace

OwnerReports::OwnerReports(const VehicleOptions& options)
    : _options(options)
{
}

void OwnerReports::SetPosition(
    const AgvPosition& position,
    const Velocity& velocity,
    std::optional<double> distanceSinceLastNodeOrNull)
{
    if (!IsFinite(position))
    {
        return;
    }
    _position = position;
    DropNonFinite(*_position);
    // A heading that was counted on past a half turn; what rounding added is the codec's.
    if (std::abs(position.theta) > PI_BOUND)
    {
        _position->theta = std::remainder(position.theta, 2.0 * std::numbers::pi);
    }
    _velocity = velocity;
    DropNonFinite(*_velocity);
    _distanceSinceLastNode = distanceSinceLastNodeOrNull;
    if (!std::isfinite(distanceSinceLastNodeOrNull.value_or(0.0)))
    {
        _distanceSinceLastNode.reset();
    }
}

void OwnerReports::ResetDistance()
{
    _distanceSinceLastNode.reset();
}

void OwnerReports::SetInformation(std::vector<Information> information)
{
    _information = std::move(information);
}

bool OwnerReports::TryChangeBattery(const BatteryState& battery)
{
    const BatteryState before = std::exchange(_battery, battery);
    DropNonFinite(_battery);
    if (!std::isfinite(_battery.batteryCharge))
    {
        _battery.batteryCharge = before.batteryCharge;
    }
    return battery.bCharging != before.bCharging;
}

bool OwnerReports::TryChangeLoads(std::optional<std::vector<Load>> loadsOrNull)
{
    if (loadsOrNull.has_value())
    {
        std::ranges::for_each(*loadsOrNull, [](Load& load) { DropNonFinite(load); });
    }
    const bool bChanged = loadsOrNull != _loads;
    _loads = std::move(loadsOrNull);
    return bChanged;
}

bool OwnerReports::TryChangeMaps(std::optional<std::vector<MapState>> mapsOrNull)
{
    return _maps.TryChange(std::move(mapsOrNull));
}

bool OwnerReports::TryChangeErrors(std::vector<VehicleError> errors)
{
    for (VehicleError& error : errors)
    {
        // There are masters that take every error without an orderId and a topic for the refusal of the last order.
        if (FindReferenceOrNull(error, ReferenceKeys::TOPIC) == nullptr)
        {
            AddReference(error, ReferenceKeys::TOPIC, GetTopicName(ETopic::State));
        }
    }
    const bool bChanged = errors != _errors;
    _errors = std::move(errors);
    return bChanged;
}

bool OwnerReports::TryChangeSafety(const SafetyState& safety)
{
    const bool bChanged = safety != _safety;
    _safety = safety;
    return bChanged;
}

bool OwnerReports::TryChangeMode(EOperatingMode mode)
{
    return std::exchange(_operatingMode, mode) != mode;
}

std::string OwnerReports::FindFault(const Action& action, bool bPositionFixed) const
{
    for (const std::string_view key : {"mapId", "mapVersion", "lastNodeId"})
    {
        if (GetTextParameterOrNull(action, key).value_or(std::string()).size() > LONGEST_FOREIGN_TEXT)
        {
            return "too long to be shown in states: " + std::string(key);
        }
    }
    const bool bPose = action.actionType == ActionTypes::INIT_POSITION;
    return bPose ? FindPoseFault(action, bPositionFixed) : _maps.FindFault(action);
}

std::string OwnerReports::FindPoseFault(const Action& action, bool bPositionFixed) const
{
    const std::string mapID = GetTextParameterOrNull(action, "mapId").value_or(std::string());
    const bool bMapsKnown = _maps.GetStates().has_value() || !_options.mapIDs.empty();
    if (bMapsKnown && !_maps.HasMap(mapID) && std::ranges::find(_options.mapIDs, mapID) == _options.mapIDs.end())
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
    // The order determines the node of the vehicle.
    return bPositionFixed ? "an order runs" : std::string();
}

std::string OwnerReports::FindEndFault(const Action& action) const
{
    return _maps.FindEndFault(action);
}

void OwnerReports::Apply(const Action& action)
{
    _maps.Apply(action);
    if (action.actionType == ActionTypes::INIT_POSITION)
    {
        AgvPosition position;
        position.bPositionInitialized = true;
        position.x = GetNumberParameterOrNull(action, "x").value_or(0.0);
        position.y = GetNumberParameterOrNull(action, "y").value_or(0.0);
        position.theta = GetNumberParameterOrNull(action, "theta").value_or(0.0);
        position.mapID = GetTextParameterOrNull(action, "mapId").value_or(std::string());
        _maps.EnableOnlyVersion(position.mapID);
        _position = std::move(position);
    }
}

EOperatingMode OwnerReports::GetMode() const noexcept
{
    return _operatingMode;
}

bool OwnerReports::IsLed() const noexcept
{
    return IsLedByMaster(_operatingMode);
}

bool OwnerReports::IsPositionLost() const noexcept
{
    return _position.has_value() && !_position->bPositionInitialized;
}

std::optional<VisualizationMessage> OwnerReports::MakeVisualizationOrNull() const
{
    if (!_position.has_value())
    {
        return std::nullopt;
    }
    VisualizationMessage message;
    message.agvPosition = _position;
    message.velocity = _velocity;
    return message;
}

void OwnerReports::Fill(StateMessage& state) const
{
    state.maps = _maps.GetStates();
    state.agvPosition = _position;
    state.velocity = _velocity;
    state.loads = _loads;
    state.distanceSinceLastNode = _distanceSinceLastNode;
    state.batteryState = _battery;
    state.operatingMode = _operatingMode;
    state.errors = _errors;
    state.information = _information;
    state.safetyState = _safety;
}

void OwnerReports::Fill(OrderContext& context) const
{
    context.operatingMode = _operatingMode;
    context.position = _position;
    context.mapIDs = _options.mapIDs;
    if (_maps.GetStates().has_value())
    {
        context.bMapsKnown = true;
        std::ranges::transform(*_maps.GetStates(), std::back_inserter(context.mapIDs), &MapState::mapID);
    }
}

} // namespace ACS::VDA5050
