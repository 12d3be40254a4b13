#include "VehicleSession.Impl.hpp"

#include <utility>

namespace ACS::VDA5050
{

VehicleSession::VehicleSession(VehicleOptions options)
    : _impl(std::make_unique<Impl>(std::move(options)))
{
}

VehicleSession::VehicleSession(VehicleSession&&) noexcept = default;

VehicleSession& VehicleSession::operator=(VehicleSession&&) noexcept = default;

VehicleSession::~VehicleSession() = default;

std::vector<MqttSubscription> VehicleSession::GetSubscriptions() const
{
    return _impl->GetTopics().GetSubscriptions();
}

MqttWill VehicleSession::MakeWill(Core::Now now)
{
    return _impl->MakeWill(now);
}

void VehicleSession::OnLinkUp(Core::Now now, VehicleActions& out)
{
    _impl->OnLinkUp(now, out);
}

void VehicleSession::OnLinkDown(Core::Now now, VehicleActions& out)
{
    _impl->OnLinkDown(now, out);
}

void VehicleSession::Leave(Core::Now now, VehicleActions& out)
{
    _impl->Leave(now, out);
}

void VehicleSession::OnMessage(
    std::string_view topic,
    std::string_view payload,
    bool bRetained,
    Core::Now now,
    VehicleActions& out)
{
    _impl->OnMessage(topic, payload, bRetained, now, out);
}

void VehicleSession::OnMessage(const MqttMessage& message, Core::Now now, VehicleActions& out)
{
    _impl->OnMessage(message.topic, message.payload, message.bRetained, now, out);
}

void VehicleSession::OnTimer(EVehicleTimer timer, Core::Now now, VehicleActions& out)
{
    _impl->OnTimer(timer, now, out);
}

bool VehicleSession::TryReachNode(NodeArrival arrival, Core::Now now, VehicleActions& out)
{
    return _impl->TryReachNode(std::move(arrival), now, out);
}

bool VehicleSession::TrySetLastNode(std::string nodeID, Core::Now now, VehicleActions& out)
{
    return _impl->TrySetLastNode(std::move(nodeID), now, out);
}

bool VehicleSession::TrySetOutsideCorridor(bool bOutside, Core::Now now, VehicleActions& out)
{
    return _impl->TrySetOutsideCorridor(bOutside, now, out);
}

bool VehicleSession::TrySetTrajectory(
    std::uint32_t edgeSequenceID,
    Trajectory trajectory,
    Core::Now now,
    VehicleActions& out)
{
    return _impl->TrySetTrajectory(edgeSequenceID, std::move(trajectory), now, out);
}

void VehicleSession::OnPosition(
    const AgvPosition& position,
    const Velocity& velocity,
    std::optional<double> distanceSinceLastNodeOrNull)
{
    _impl->GetReports().SetPosition(position, velocity, distanceSinceLastNodeOrNull);
}

void VehicleSession::OnDrivingChanged(bool bDriving, Core::Now now, VehicleActions& out)
{
    _impl->OnDrivingChanged(bDriving, now, out);
}

bool VehicleSession::TrySetActionStatus(
    std::string_view actionID,
    EActionStatus status,
    std::string resultDescription,
    Core::Now now,
    VehicleActions& out)
{
    return _impl->TrySetActionStatus(actionID, status, std::move(resultDescription), now, out);
}

void VehicleSession::OnBattery(const BatteryState& battery, Core::Now now, VehicleActions& out)
{
    _impl->Settle(_impl->GetReports().TryChangeBattery(battery), now, out);
}

void VehicleSession::OnLoads(std::optional<std::vector<Load>> loadsOrNull, Core::Now now, VehicleActions& out)
{
    _impl->Settle(_impl->GetReports().TryChangeLoads(std::move(loadsOrNull)), now, out);
}

void VehicleSession::OnMaps(std::optional<std::vector<MapState>> mapsOrNull, Core::Now now, VehicleActions& out)
{
    _impl->Settle(_impl->GetReports().TryChangeMaps(std::move(mapsOrNull)), now, out);
}

void VehicleSession::OnErrors(std::vector<VehicleError> errors, Core::Now now, VehicleActions& out)
{
    _impl->Settle(_impl->GetReports().TryChangeErrors(std::move(errors)), now, out);
}

void VehicleSession::OnInformation(std::vector<Information> information)
{
    _impl->GetReports().SetInformation(std::move(information));
}

void VehicleSession::OnSafetyState(const SafetyState& safety, Core::Now now, VehicleActions& out)
{
    _impl->Settle(_impl->GetReports().TryChangeSafety(safety), now, out);
}

void VehicleSession::OnHardwarePause(bool bPaused, bool bOverridesMaster, Core::Now now, VehicleActions& out)
{
    _impl->OnHardwarePause(bPaused, bOverridesMaster, now, out);
}

void VehicleSession::OnOperatingMode(EOperatingMode mode, Core::Now now, VehicleActions& out)
{
    _impl->OnOperatingMode(mode, now, out);
}

StateMessage VehicleSession::GetState() const
{
    return _impl->GetState();
}

bool VehicleSession::IsPaused() const noexcept
{
    return _impl->IsPaused();
}

bool VehicleSession::IsOrderRunning() const noexcept
{
    return _impl->IsOrderRunning();
}

} // namespace ACS::VDA5050
