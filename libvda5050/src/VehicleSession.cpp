#include <acs/vda5050/VehicleSession.hpp>

#include <chrono>
#include <cmath>
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

VehicleSession::VehicleSession(VehicleOptions options)
    : _options(std::move(options)),
      _lastNodeID(_options.initialNodeID)
{
    // What the factsheet says about timing is what the vehicle does.
    ProtocolTiming& timing = _options.factsheet.protocolLimits.timing;
    timing.minStateInterval = ToSeconds(_options.minimumStateInterval);
    timing.defaultStateInterval = ToSeconds(_options.maximumStateInterval);
    timing.visualizationInterval.reset();
    if (_options.visualizationInterval.count() > 0)
    {
        timing.visualizationInterval = ToSeconds(_options.visualizationInterval);
    }
    for (std::size_t index = 0; index < TOPIC_COUNT; ++index)
    {
        _topics.at(index) = BuildTopic(_options.address, static_cast<ETopic>(index));
    }
}

void VehicleSession::OnPosition(
    const AgvPosition& position,
    const Velocity& velocity,
    std::optional<double> distanceSinceLastNode)
{
    if (IsFinite(position))
    {
        _position = position;
        _velocity = velocity;
        _distanceSinceLastNode = distanceSinceLastNode;
    }
}

void VehicleSession::OnBattery(const BatteryState& battery, Core::Now now, VehicleActions& out)
{
    _bStateDue = _bStateDue || battery.bCharging != _battery.bCharging;
    _battery = battery;
    Settle(now, out);
}

void VehicleSession::OnLoads(std::optional<std::vector<Load>> loads, Core::Now now, VehicleActions& out)
{
    _bStateDue = _bStateDue || loads != _loads;
    _loads = std::move(loads);
    Settle(now, out);
}

void VehicleSession::OnMaps(std::optional<std::vector<MapState>> maps, Core::Now now, VehicleActions& out)
{
    _bStateDue = _bStateDue || maps != _maps;
    _maps = std::move(maps);
    Settle(now, out);
}

void VehicleSession::OnErrors(std::vector<VehicleError> errors, Core::Now now, VehicleActions& out)
{
    _bStateDue = _bStateDue || errors != _ownerErrors;
    _ownerErrors = std::move(errors);
    Settle(now, out);
}

void VehicleSession::OnInformation(std::vector<Information> information)
{
    _information = std::move(information);
}

void VehicleSession::OnSafetyState(const SafetyState& safety, Core::Now now, VehicleActions& out)
{
    _bStateDue = _bStateDue || safety != _safety;
    _safety = safety;
    Settle(now, out);
}

StateMessage VehicleSession::GetState() const
{
    return BuildState();
}

bool VehicleSession::IsPaused() const noexcept
{
    return IsHeldByPause();
}

bool VehicleSession::IsOrderRunning() const noexcept
{
    return _bOrderRunning;
}

} // namespace ACS::VDA5050
