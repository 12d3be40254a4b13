#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/Now.hpp>
#include <acs/vda5050/IMqttLink.hpp>
#include <acs/vda5050/NodeArrival.hpp>
#include <acs/vda5050/OrderMessage.hpp>
#include <acs/vda5050/StateMessage.hpp>
#include <acs/vda5050/VehicleAction.hpp>
#include <acs/vda5050/VehicleOptions.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::VDA5050
{

/// The vehicle side of the protocol: accepts orders and instant actions by the rules of 2.x, requests drives and actions
/// from its owner (the vehicle control, or a simulator), and publishes the state. Pure: no clock, no I/O; all output is
/// appended to out, which the caller reuses. Not shared between threads. Calls append to out: move the actions out of it
/// before carrying them out. The owner reports changes with the On… functions. One state has all consequences of a call;
/// states are at least minimumStateInterval apart, and changes in between are merged into the next one.
class ACS_API VehicleSession
{
    class ACS_HIDDEN Impl;
    std::unique_ptr<Impl> _impl;

public:
    /// Publishes nothing before OnLinkUp.
    explicit VehicleSession(VehicleOptions options);
    VehicleSession(const VehicleSession&) = delete;
    VehicleSession& operator=(const VehicleSession&) = delete;
    VehicleSession(VehicleSession&&) noexcept;
    VehicleSession& operator=(VehicleSession&&) noexcept;
    ~VehicleSession();

    /// order and instantActions of this vehicle.
    [[nodiscard]] std::vector<MqttSubscription> GetSubscriptions() const;
    /// The will for the next connect; its header has the time.
    [[nodiscard]] MqttWill MakeWill(Core::Now now);

    /// Connected and subscribed: publishes ONLINE, the factsheet and, once minimumStateInterval has passed since the last
    /// one, a state; starts the timers.
    void OnLinkUp(Core::Now now, VehicleActions& out);
    /// The order continues to the end of the base; nothing is published until OnLinkUp.
    void OnLinkDown(Core::Now now, VehicleActions& out);
    /// Publishes OFFLINE. The owner disconnects after it was sent.
    void Leave(Core::Now now, VehicleActions& out);
    /// A message of one of the subscriptions. Retained and empty messages and those of other vehicles are ignored
    /// (MessageIgnored).
    void OnMessage(
        std::string_view topic,
        std::string_view payload,
        bool bRetained,
        Core::Now now,
        VehicleActions& out);
    /// A message as IMqttLink delivers it.
    void OnMessage(const MqttMessage& message, Core::Now now, VehicleActions& out);
    /// Requested by StartVehicleTimer. Ignored while the link is down.
    void OnTimer(EVehicleTimer timer, Core::Now now, VehicleActions& out);

    /// The vehicle has reached the node of the last DriveTo. Returns false and does nothing for any other sequenceID.
    /// While the order is being cancelled, its last node is shown as reached only when the cancel is finished.
    bool TryReachNode(NodeArrival arrival, Core::Now now, VehicleActions& out);
    /// The vehicle has localised itself on this node (moved by hand, a tag); empty: on none. False while an order runs.
    bool TrySetLastNode(std::string nodeID, Core::Now now, VehicleActions& out);
    /// The vehicle has left the corridor of its current edge, or is back inside. The vehicle monitors this itself, for its
    /// centre or its contour. Outside it stops, with a FATAL error, until it is back or the order is cancelled. False if
    /// the current edge has no corridor.
    bool TrySetOutsideCorridor(bool bOutside, Core::Now now, VehicleActions& out);
    /// The trajectory (a NURBS) that the vehicle has planned for an edge of its order, for the edgeStates of the state.
    /// False if the edge already has a trajectory, if there is no such edge, or if the curve is invalid.
    bool TrySetTrajectory(std::uint32_t edgeSequenceID, Trajectory trajectory, Core::Now now, VehicleActions& out);
    /// Sends no state; the position is in the next state and in visualization. A position that is not finite is ignored;
    /// other members that are not finite are omitted, also in OnBattery and OnLoads.
    void OnPosition(
        const AgvPosition& position,
        const Velocity& velocity,
        std::optional<double> distanceSinceLastNodeOrNull = {});
    /// Required with false after StopDriving, once the vehicle is stationary: startPause and cancelOrder wait for it.
    void OnDrivingChanged(bool bDriving, Core::Now now, VehicleActions& out);
    /// Returns false and does nothing for an action that StartAction did not request, and for a transition that
    /// ActionMachine forbids. Finished of a map action or of initPosition updates maps, position and last node.
    bool TrySetActionStatus(
        std::string_view actionID,
        EActionStatus status,
        std::string resultDescription,
        Core::Now now,
        VehicleActions& out);
    /// A state is sent when charging begins or ends; a new charge alone waits for the next state. If the charge is not
    /// finite, the previous value stays in effect.
    void OnBattery(const BatteryState& battery, Core::Now now, VehicleActions& out);
    /// The loads on the vehicle; nullopt: unknown. A change sends a state.
    void OnLoads(std::optional<std::vector<Load>> loadsOrNull, Core::Now now, VehicleActions& out);
    /// The maps on the vehicle; nullopt: unknown. A change sends a state.
    void OnMaps(std::optional<std::vector<MapState>> mapsOrNull, Core::Now now, VehicleActions& out);
    /// All active errors of the vehicle itself; the session manages errors about orders. An error without a reference to a
    /// topic gets a reference to the state topic.
    void OnErrors(std::vector<VehicleError> errors, Core::Now now, VehicleActions& out);
    /// All active information; part of the next state.
    void OnInformation(std::vector<Information> information);
    /// A change sends a state.
    void OnSafetyState(const SafetyState& safety, Core::Now now, VehicleActions& out);
    /// A pause at the vehicle itself. If its switch overrides master control, startPause and stopPause fail; otherwise
    /// stopPause ends the pause.
    void OnHardwarePause(bool bPaused, bool bOverridesMaster, Core::Now now, VehicleActions& out);
    /// Entering and leaving MANUAL clears the order (2.x, section 6.10.6).
    void OnOperatingMode(EOperatingMode mode, Core::Now now, VehicleActions& out);

    /// The state as it would be sent now; of its header only the names are set.
    [[nodiscard]] StateMessage GetState() const;
    /// Whether a pause was requested. The state reports paused once the vehicle is stationary.
    [[nodiscard]] bool IsPaused() const noexcept;
    /// Whether nodes are left, the horizon included, order actions have not ended, or a cancel is running.
    [[nodiscard]] bool IsOrderRunning() const noexcept;
};

} // namespace ACS::VDA5050
