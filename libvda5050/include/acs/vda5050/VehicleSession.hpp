#pragma once

#include <acs/core/Now.hpp>
#include <acs/vda5050/HeldActions.hpp>
#include <acs/vda5050/HeldRoute.hpp>
#include <acs/vda5050/OrderValidator.hpp>
#include <acs/vda5050/Vda5050Codec.hpp>
#include <acs/vda5050/VehicleAction.hpp>
#include <acs/vda5050/VehicleOptions.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
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
    /// All end with an order that is taken; some earlier.
    enum class EErrorLifetime : std::uint8_t
    {
        UntilOrder,
        UntilInstantAction, ///< Taken in a later message.
        UntilMode,          ///< Until orders can be taken.
    };

    struct SessionError
    {
        VehicleError error;
        EErrorLifetime lifetime = EErrorLifetime::UntilOrder;
        bool bShown = false; ///< Of an earlier message.
    };

    struct EvictedAction
    {
        std::string actionID;
        std::string actionType;
    };

    VehicleOptions _options;
    Vda5050Codec _codec;
    std::array<std::uint32_t, TOPIC_COUNT> _headerIDs{};
    std::array<std::string, TOPIC_COUNT> _topics;
    std::array<std::size_t, TOPIC_COUNT> _payloadBytes{}; ///< Of the last message: the next one will be about as long.

    // What the owner says.
    std::optional<AgvPosition> _position;
    std::optional<Velocity> _velocity;
    std::optional<double> _distanceSinceLastNode;
    std::optional<std::vector<Load>> _loads;
    std::optional<std::vector<MapState>> _maps;
    BatteryState _battery;
    SafetyState _safety;
    std::vector<VehicleError> _ownerErrors;
    std::vector<Information> _information;
    EOperatingMode _operatingMode = EOperatingMode::Automatic;
    bool _bDriving = false;

    // The order.
    std::string _orderID;
    std::string _zoneSetID;
    std::string _lastNodeID;
    std::uint32_t _orderUpdateID = 0;
    std::uint32_t _lastNodeSequenceID = 0;
    HeldRoute _route; ///< Still to be driven.
    HeldActions _actions;
    std::deque<std::string> _actionQueue; ///< Of what was reached or entered, not yet started.
    std::vector<EvictedAction> _evicted;  ///< Instant actions that were shown and made way, the latest.
    std::vector<SessionError> _sessionErrors;
    std::optional<VehicleError> _corridorError; ///< While the vehicle is outside of its edge's corridor.
    std::vector<std::string> _pauseActionIDs;   ///< startPause that waits for the vehicle to stand.
    std::vector<std::string> _cancelActionIDs;
    bool _bOrderRunning = false; ///< Taken and not yet told as completed.
    bool _bCleared = false;      ///< The order was cancelled.
    bool _bEdgeEntered = false;
    bool _bHeldByFailure = false; ///< A critical action failed.
    bool _bLegActive = false;     ///< DriveTo was told last.
    bool _bLegBegun = false;      ///< Between two nodes, driving or not.
    bool _bLegStops = true;
    bool _bLastLeg = false; ///< A cancelled vehicle that is bound to nodes drives to the next one.
    bool _bHalting = false; ///< StopDriving was told, and not yet that the vehicle stands.
    bool _bMasterPause = false;
    bool _bHardwarePause = false;
    bool _bPauseOverridden = false;

    // Publishing.
    bool _bLinkUp = false;
    bool _bStateDue = false;
    bool _bMinimumTimerRuns = false;
    std::optional<Core::SteadyTime> _lastStateTime;

    void OnOrder(std::string_view payload, VehicleActions& out);
    void OnInstantActions(std::string_view payload, Core::Now now, VehicleActions& out);
    [[nodiscard]] bool TryTakeInstantAction(
        const Action& action,
        const Header& header,
        bool bTooMany,
        Core::Now now,
        VehicleActions& out);
    [[nodiscard]] bool IsForeign(ETopic topic, const Header& header, VehicleActions& out) const;
    void RefusePayload(ETopic topic, std::string_view payload, const Core::Error& error, VehicleActions& out);
    [[nodiscard]] bool ShouldTake(ETopic topic, const Header& header, VehicleActions& out);
    void AddSessionError(VehicleError error, EErrorLifetime lifetime);
    [[nodiscard]] OrderContext MakeContext() const;
    void RefuseOrder(const OrderMessage& order, OrderJudgement judgement, VehicleActions& out);
    void TakeNewOrder(OrderMessage order, VehicleActions& out);
    void TakeUpdate(OrderMessage order, VehicleActions& out);
    void AppendElements(OrderMessage order);
    void DropHorizon();

    void Advance(VehicleActions& out);
    void StartQueuedActions(VehicleActions& out);
    void DriveOn(VehicleActions& out);
    void DriveToFront(bool bStopAtNode, VehicleActions& out);
    void DriveLastLeg(VehicleActions& out);
    void FinishOrderIfDone(VehicleActions& out);
    void ReachFront(VehicleActions& out);
    [[nodiscard]] bool CanDrive() const;
    [[nodiscard]] bool NeedsStopAtFront() const;
    [[nodiscard]] bool IsExecuting() const;
    [[nodiscard]] bool NeedsNewBase() const;
    [[nodiscard]] bool CanMoveByItself() const;

    void AddActions(
        const std::vector<Action>& actions,
        EActionScope scope,
        const std::string& elementID,
        std::uint32_t sequenceID);
    void ReportUnlistedParameters(const Action& action, ETopic topic);
    void Enqueue(std::span<const Action> actions);
    void Start(HeldAction& tracked, VehicleActions& out);
    void SetStatus(std::string_view actionID, EActionStatus status, const std::string& result = {});
    HeldAction& AddInstantAction(const Action& action, EActionStatus status, const std::string& result = {});
    [[nodiscard]] bool TryEvict();
    [[nodiscard]] bool TryMakeRoomFor(const Action& action);
    [[nodiscard]] bool IsRepeated(const Action& action);
    [[nodiscard]] std::string FindClash(const Action& action);
    [[nodiscard]] std::string FindRefusal(const Action& action, bool bTooMany) const;
    void ReportInstantAction(
        const Action& action,
        std::optional<std::uint32_t> headerIDOrNull,
        std::string_view errorType,
        const std::string& reason);
    void FailInstantAction(
        const Action& action,
        const Header& header,
        std::string_view errorType,
        const std::string& reason);
    [[nodiscard]] bool IsPauseOverridden(const Action& action, const Header& header);
    void StartPause(const Action& action, const Header& header, VehicleActions& out);
    void StopPause(const Action& action, const Header& header, VehicleActions& out);
    void EnterPause(VehicleActions& out);
    void LeavePause(VehicleActions& out) const;
    [[nodiscard]] bool IsHeldByPause() const noexcept;
    [[nodiscard]] bool IsStanding() const;
    void StartCancel(const Action& action, const Header& header, VehicleActions& out);
    void StopOrderActions(const std::string& reason, VehicleActions& out);
    void StopMoving(VehicleActions& out);
    void ForgetRoute();
    void ClearOrder(VehicleActions& out);
    void FinishCancelIfStanding(VehicleActions& out);
    void FinishPauseIfStanding();
    [[nodiscard]] std::string FindOwnFault(const Action& action, EActionScope scope);
    [[nodiscard]] std::string FindPoseFault(const Action& action, EActionScope scope) const;
    void ApplyOwnEffect(const Action& action, EActionScope scope);
    void EnableOnlyVersion(const std::string& mapID);
    void ApplyMapEffect(const Action& action);
    void SetLastNode(std::string nodeID);
    void OnActionFailed(const HeldAction& tracked, VehicleActions& out);
    void OnOrderActionFailed(const HeldAction& tracked, VehicleActions& out);
    void PerformOwnInstantAction(const Action& action, const Header& header, Core::Now now, VehicleActions& out);

    [[nodiscard]] Header MakeHeader(ETopic topic, Core::Now now);
    [[nodiscard]] StateMessage BuildState() const;
    template <typename TMessage>
    [[nodiscard]] MqttMessage MakeMessage(ETopic topic, const TMessage& message);
    void PublishState(Core::Now now, VehicleActions& out);
    void PublishFactsheet(Core::Now now, VehicleActions& out);
    void PublishVisualization(Core::Now now, VehicleActions& out);
    void PublishConnection(EConnectionState state, Core::Now now, VehicleActions& out);
    /// Ends each call from outside: sends the state that has become due, now or when it may be sent again.
    void Settle(Core::Now now, VehicleActions& out);

public:
    explicit VehicleSession(VehicleOptions options);

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
