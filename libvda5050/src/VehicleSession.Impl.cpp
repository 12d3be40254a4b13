#include "VehicleSession.Impl.hpp"

#include "AngleBound.hpp"
#include "OrderCapability.hpp"
#include "OrderErrors.hpp"
#include "StateBounds.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
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

double ToSeconds(std::chrono::milliseconds interval)
{
    return std::chrono::duration<double>(interval).count();
}

} // namespace

VehicleSession::Impl::Impl(VehicleOptions options)
    : _options(std::move(options)),
      _lastNodeID(_options.initialNodeID)
{
    // The factsheet states the actual timing of the vehicle.
    ProtocolTiming& timing = _options.factsheet.protocolLimits.timing;
    timing.minStateInterval = ToSeconds(_options.minimumStateInterval);
    timing.defaultStateInterval = ToSeconds(_options.maximumStateInterval);
    timing.visualizationInterval.reset();
    if (_options.visualizationInterval.count() > 0)
    {
        timing.visualizationInterval = ToSeconds(_options.visualizationInterval);
    }
    if (std::optional<std::vector<OptionalParameter>>& list = _options.factsheet.protocolFeatures.optionalParameters;
        !list.has_value())
    {
        list = ListOptionalParameters(); // the schema demands a list
    }
    for (std::size_t index = 0; index < TOPIC_COUNT; ++index)
    {
        _topics.at(index) = BuildTopic(_options.address, static_cast<ETopic>(index));
    }
}

void VehicleSession::Impl::OnPosition(
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

void VehicleSession::Impl::OnBattery(const BatteryState& battery, Core::Now now, VehicleActions& out)
{
    _bStateDue = _bStateDue || battery.bCharging != _battery.bCharging;
    const double lastCharge = _battery.batteryCharge;
    _battery = battery;
    DropNonFinite(_battery);
    if (!std::isfinite(_battery.batteryCharge))
    {
        _battery.batteryCharge = lastCharge;
    }
    Settle(now, out);
}

void VehicleSession::Impl::OnLoads(std::optional<std::vector<Load>> loadsOrNull, Core::Now now, VehicleActions& out)
{
    if (loadsOrNull.has_value())
    {
        std::ranges::for_each(*loadsOrNull, [](Load& load) { DropNonFinite(load); });
    }
    _bStateDue = _bStateDue || loadsOrNull != _loads;
    _loads = std::move(loadsOrNull);
    Settle(now, out);
}

void VehicleSession::Impl::OnMaps(std::optional<std::vector<MapState>> mapsOrNull, Core::Now now, VehicleActions& out)
{
    _bStateDue = _bStateDue || mapsOrNull != _maps;
    _maps = std::move(mapsOrNull);
    Settle(now, out);
}

void VehicleSession::Impl::OnErrors(std::vector<VehicleError> errors, Core::Now now, VehicleActions& out)
{
    for (VehicleError& error : errors)
    {
        // There are masters that take every error without an orderId and a topic for the refusal of the last order.
        if (FindReferenceOrNull(error, ReferenceKeys::TOPIC) == nullptr)
        {
            AddReference(error, ReferenceKeys::TOPIC, GetTopicName(ETopic::State));
        }
    }
    _bStateDue = _bStateDue || errors != _ownerErrors;
    _ownerErrors = std::move(errors);
    Settle(now, out);
}

void VehicleSession::Impl::OnInformation(std::vector<Information> information)
{
    _information = std::move(information);
}

void VehicleSession::Impl::OnSafetyState(const SafetyState& safety, Core::Now now, VehicleActions& out)
{
    _bStateDue = _bStateDue || safety != _safety;
    _safety = safety;
    Settle(now, out);
}

bool VehicleSession::Impl::IsOrderRunning() const noexcept
{
    return _bOrderRunning;
}

} // namespace ACS::VDA5050
