#pragma once

#include <acs/core/Now.hpp>
#include <acs/vda5050/IMqttLink.hpp>
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

/// The vehicle's side of the protocol: takes orders and instant actions by the rules of 2.x, tells its owner (the
/// vehicle's control, or a simulator) where to drive and what to do, and publishes what becomes of it. Pure: no clock, no
/// I/O; all output is appended to out, which the caller reuses. All calls on one thread, whichever that is; and none while
/// its out is iterated: calls append to it. Take the actions out first, then obey them. Changes are told through the On… calls; states are
/// merged and sent as section 6.10 asks.
class VehicleSession
{
    class Impl;
    std::unique_ptr<Impl> _impl;

public:
    explicit VehicleSession(VehicleOptions options);
    VehicleSession(const VehicleSession&) = delete;
    VehicleSession& operator=(const VehicleSession&) = delete;
    VehicleSession(VehicleSession&&) noexcept;
    VehicleSession& operator=(VehicleSession&&) noexcept;
    ~VehicleSession();

    /// order and instantActions of this vehicle.
    [[nodiscard]] std::vector<MqttSubscription> GetSubscriptions() const;
    /// Made anew for each connect: its header says when.
    [[nodiscard]] MqttWill MakeWill(Core::Now now);

    /// Connected and subscribed: publishes ONLINE, the factsheet and a state, and starts the timers.
    void OnLinkUp(Core::Now now, VehicleActions& out);
    /// The order goes on to the end of the base; nothing is published until OnLinkUp.
    void OnLinkDown(Core::Now now, VehicleActions& out);
    /// Publishes OFFLINE. The owner disconnects when it is sent.
    void Leave(Core::Now now, VehicleActions& out);
    void OnMessage(
        std::string_view topic,
        std::string_view payload,
        bool bRetained,
        Core::Now now,
        VehicleActions& out);
    /// As a link delivers it.
    void OnMessage(const MqttMessage& message, Core::Now now, VehicleActions& out);
    void OnTimer(EVehicleTimer timer, Core::Now now, VehicleActions& out);

    /// The node of the last DriveTo, by its sequenceID; any other is ignored. False then.
    bool TryReachNode(std::uint32_t sequenceID, Core::Now now, VehicleActions& out);
    /// The vehicle has found itself on this node (moved by hand, a tag); empty: on none. False while an order runs.
    bool TrySetLastNode(std::string nodeID, Core::Now now, VehicleActions& out);
    /// The vehicle has left the corridor of the edge that it drives, or is back inside: it watches that itself, for its
    /// centre or its contour. Outside it stops, with a FATAL error, until it is back or the order is cancelled. False
    /// where it is on no edge with a corridor.
    bool TrySetOutsideCorridor(bool bOutside, Core::Now now, VehicleActions& out);
    /// The way that a vehicle has planned by itself along an edge of its order, for the state's edgeStates (a NURBS). One
    /// that an edge has, sent or planned, stays: false then, and where there is no such edge or the curve is none.
    bool TrySetTrajectory(std::uint32_t edgeSequenceID, Trajectory trajectory, Core::Now now, VehicleActions& out);
    /// No reason to send a state: it goes into the next one and into visualization. A position that is no number is
    /// ignored, other members that are none are left out, here and in OnBattery and OnLoads.
    void OnPosition(
        const AgvPosition& position,
        const Velocity& velocity,
        std::optional<double> distanceSinceLastNode = {});
    /// After StopDriving always told, false, once the vehicle stands: what waits for that (startPause, cancelOrder) ends
    /// then.
    void OnDrivingChanged(bool bDriving, Core::Now now, VehicleActions& out);
    /// Ignored (false) for an action that the owner was not told to start, and for a change that the table of
    /// ActionMachine forbids. With Finished of a map action or of initPosition maps, position and last node change by
    /// themselves.
    bool TrySetActionStatus(
        std::string_view actionID,
        EActionStatus status,
        std::string resultDescription,
        Core::Now now,
        VehicleActions& out);
    /// A state is sent when charging begins or ends; a level alone waits for the next state. One that is no number is not
    /// taken: the last one stays.
    void OnBattery(const BatteryState& battery, Core::Now now, VehicleActions& out);
    void OnLoads(std::optional<std::vector<Load>> loads, Core::Now now, VehicleActions& out);
    void OnMaps(std::optional<std::vector<MapState>> maps, Core::Now now, VehicleActions& out);
    /// All active errors of the vehicle itself; those about orders are kept by the session. One without a reference to a
    /// topic gets one, to the state.
    void OnErrors(std::vector<VehicleError> errors, Core::Now now, VehicleActions& out);
    void OnInformation(std::vector<Information> information);
    void OnSafetyState(const SafetyState& safety, Core::Now now, VehicleActions& out);
    /// A pause at the vehicle itself. Where its switch overrides master control, startPause and stopPause fail; else
    /// stopPause ends it.
    void OnHardwarePause(bool bPaused, bool bOverridesMaster, Core::Now now, VehicleActions& out);
    /// Entering and leaving MANUAL clears the order (2.x, section 6.10.6).
    void OnOperatingMode(EOperatingMode mode, Core::Now now, VehicleActions& out);

    /// The state as it would be sent, its header but for the names left empty.
    [[nodiscard]] StateMessage GetState() const;
    /// Whether a pause holds the vehicle up, from the moment that it is asked for; a state says paused once it stands.
    [[nodiscard]] bool IsPaused() const noexcept;
    [[nodiscard]] bool IsOrderRunning() const noexcept;
};

} // namespace ACS::VDA5050
