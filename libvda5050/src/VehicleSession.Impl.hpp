#pragma once

#include "ActionFault.hpp"
#include "RemainingRoute.hpp"
#include "ReportedActions.hpp"
#include <acs/vda5050/OrderValidator.hpp>
#include <acs/vda5050/Vda5050Codec.hpp>
#include <acs/vda5050/VehicleSession.hpp>

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

class VehicleSession::Impl
{
    /// All errors end with the next accepted order; some earlier. None ends before a state has shown it.
    enum class EErrorLifetime : std::uint8_t
    {
        UntilOrder,
        UntilInstantAction, ///< Until an instant action of a later message is accepted.
        UntilMode,          ///< Until the operating mode allows orders.
    };

    struct SessionError
    {
        VehicleError error;
        EErrorLifetime lifetime = EErrorLifetime::UntilOrder;
        bool bShown = false; ///< Was published in a state.
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
    std::array<std::size_t, TOPIC_COUNT> _payloadBytes{}; ///< Size of the last message, to reserve that of the next.

    // Reported by the owner.
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
    RemainingRoute _route; ///< Remaining nodes and edges.
    ReportedActions _actions;
    std::deque<std::string> _actionQueue; ///< Actions of reached nodes and entered edges that are not started.
    std::vector<EvictedAction> _evicted;  ///< The latest shown instant actions that were removed for new ones.
    std::vector<SessionError> _sessionErrors;
    std::optional<VehicleError> _corridorError; ///< Set while the vehicle is outside the corridor.
    std::vector<std::string> _pauseActionIDs;   ///< startPause actions that wait until the vehicle is stationary.
    std::vector<std::string> _cancelActionIDs;
    bool _bOrderRunning = false; ///< Accepted, and OrderCompleted not sent.
    bool _bCleared = false;      ///< The order was cancelled.
    bool _bEdgeEntered = false;
    bool _bHeldByFailure = false; ///< A critical action failed.
    bool _bLegActive = false;     ///< DriveTo was sent last.
    bool _bLegBegun = false;      ///< Between two nodes, driving or not.
    bool _bLegStops = true;
    bool _bLastLeg = false;    ///< After a cancel, a line-guided vehicle drives to the next node.
    bool _bEndReached = false; ///< The last node of a cancelled order, which is shown until the cancel is finished.
    bool _bHalting = false;    ///< StopDriving was sent, and the vehicle is not stationary yet.
    bool _bMasterPause = false;
    bool _bHardwarePause = false;
    bool _bPauseOverridden = false;

    // Publishing.
    bool _bLinkUp = false;
    bool _bStateDue = false;
    bool _bMinimumTimerRuns = false;
    std::optional<Core::SteadyTime> _lastStateTime;

public:
    explicit Impl(VehicleOptions options);

    [[nodiscard]] std::vector<MqttSubscription> GetSubscriptions() const;
    [[nodiscard]] MqttWill MakeWill(Core::Now now);
    void OnLinkUp(Core::Now now, VehicleActions& out);
    void OnLinkDown(Core::Now now, VehicleActions& out);
    void Leave(Core::Now now, VehicleActions& out);
    void OnMessage(
        std::string_view topic,
        std::string_view payload,
        bool bRetained,
        Core::Now now,
        VehicleActions& out);
    void OnTimer(EVehicleTimer timer, Core::Now now, VehicleActions& out);
    bool TryReachNode(NodeArrival arrival, Core::Now now, VehicleActions& out);
    bool TrySetLastNode(std::string nodeID, Core::Now now, VehicleActions& out);
    bool TrySetOutsideCorridor(bool bOutside, Core::Now now, VehicleActions& out);
    bool TrySetTrajectory(std::uint32_t edgeSequenceID, Trajectory trajectory, Core::Now now, VehicleActions& out);
    void OnPosition(
        const AgvPosition& position,
        const Velocity& velocity,
        std::optional<double> distanceSinceLastNodeOrNull);
    void OnDrivingChanged(bool bDriving, Core::Now now, VehicleActions& out);
    bool TrySetActionStatus(
        std::string_view actionID,
        EActionStatus status,
        std::string resultDescription,
        Core::Now now,
        VehicleActions& out);
    void OnBattery(const BatteryState& battery, Core::Now now, VehicleActions& out);
    void OnLoads(std::optional<std::vector<Load>> loadsOrNull, Core::Now now, VehicleActions& out);
    void OnMaps(std::optional<std::vector<MapState>> mapsOrNull, Core::Now now, VehicleActions& out);
    void OnErrors(std::vector<VehicleError> errors, Core::Now now, VehicleActions& out);
    void OnInformation(std::vector<Information> information);
    void OnSafetyState(const SafetyState& safety, Core::Now now, VehicleActions& out);
    void OnHardwarePause(bool bPaused, bool bOverridesMaster, Core::Now now, VehicleActions& out);
    void OnOperatingMode(EOperatingMode mode, Core::Now now, VehicleActions& out);
    [[nodiscard]] StateMessage GetState() const;
    [[nodiscard]] bool IsPaused() const noexcept;
    [[nodiscard]] bool IsOrderRunning() const noexcept;

private:
    void OnOrder(std::string_view payload, VehicleActions& out);
    void OnInstantActions(std::string_view payload, Core::Now now, VehicleActions& out);
    [[nodiscard]] bool TryHandleInstantAction(
        const Action& action,
        const Header& header,
        bool bTooMany,
        Core::Now now,
        VehicleActions& out);
    [[nodiscard]] bool IsForeign(ETopic topic, const Header& header, VehicleActions& out) const;
    void RefusePayload(ETopic topic, std::string_view payload, const Core::Error& error, VehicleActions& out);
    [[nodiscard]] bool ShouldAccept(ETopic topic, const Header& header, VehicleActions& out);
    void AddSessionError(VehicleError error, EErrorLifetime lifetime);
    [[nodiscard]] OrderContext MakeContext() const;
    void RefuseOrder(const OrderMessage& order, OrderJudgement judgement, VehicleActions& out);
    void AcceptOrder(OrderMessage order, VehicleActions& out);
    void AcceptUpdate(OrderMessage order, VehicleActions& out);
    void AppendElements(OrderMessage order);
    void DropHorizon();

    void Advance(VehicleActions& out);
    void StartQueuedActions(VehicleActions& out);
    void ContinueDriving(VehicleActions& out);
    void DriveToFront(bool bStopAtNode, VehicleActions& out);
    void DriveLastLeg(VehicleActions& out);
    void FinishOrderIfDone(VehicleActions& out);
    void LeaveEdge(std::vector<EdgeActionEnd> ends, VehicleActions& out);
    void PassFrontNode();
    [[nodiscard]] bool HasRunningEdgeAction() const;
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
    void Start(ReportedAction& tracked, VehicleActions& out);
    [[nodiscard]] bool TryChangeStatus(
        ReportedAction& tracked,
        EActionStatus status,
        std::string resultDescription,
        VehicleActions& out);
    void SetStatus(std::string_view actionID, EActionStatus status, const std::string& result = {});
    ReportedAction& AddInstantAction(const Action& action, EActionStatus status, const std::string& result = {});
    [[nodiscard]] bool TryEvict();
    [[nodiscard]] bool TryMakeRoomFor(const Action& action);
    [[nodiscard]] bool IsRepeated(const Action& action);
    [[nodiscard]] std::string FindClash(const Action& action);
    [[nodiscard]] std::optional<ActionFault> FindRefusalOrNull(const Action& action, bool bTooMany) const;
    void ReportInstantAction(
        const Action& action,
        std::optional<std::uint32_t> headerIDOrNull,
        std::string_view errorType,
        const ActionFault& fault);
    void FailInstantAction(
        const Action& action,
        const Header& header,
        std::string_view errorType,
        const ActionFault& fault);
    [[nodiscard]] bool IsPauseOverridden(const Action& action, const Header& header);
    void StartPause(const Action& action, const Header& header, VehicleActions& out);
    void StopPause(const Action& action, const Header& header, VehicleActions& out);
    void EnterPause(VehicleActions& out);
    void LeavePause(VehicleActions& out) const;
    [[nodiscard]] bool IsStationary() const;
    void StartCancel(const Action& action, const Header& header, VehicleActions& out);
    void StopOrderActions(const std::string& reason, VehicleActions& out);
    void StopMoving(VehicleActions& out);
    void DiscardRoute();
    void ClearOrder(VehicleActions& out);
    void ForgetOrder(bool bBetweenNodes);
    void FinishCancelIfStationary(VehicleActions& out);
    void FinishPauseIfStationary();
    [[nodiscard]] std::string FindOwnFault(const Action& action, EActionScope scope);
    [[nodiscard]] std::string FindPoseFault(const Action& action, EActionScope scope) const;
    void ApplyOwnEffect(const Action& action, EActionScope scope);
    void EnableOnlyVersion(const std::string& mapID);
    void ApplyMapEffect(const Action& action);
    void SetLastNode(std::string nodeID);
    void OnActionFailed(const ReportedAction& tracked, VehicleActions& out);
    void OnOrderActionFailed(const ReportedAction& tracked, VehicleActions& out);
    void PerformOwnInstantAction(const Action& action, const Header& header, Core::Now now, VehicleActions& out);

    [[nodiscard]] Header MakeHeader(ETopic topic, Core::Now now);
    template <typename TMessage>
    [[nodiscard]] MqttMessage MakeMessage(ETopic topic, const TMessage& message);
    void PublishState(Core::Now now, VehicleActions& out);
    void PublishFactsheet(Core::Now now, VehicleActions& out);
    void PublishVisualization(Core::Now now, VehicleActions& out);
    void PublishConnection(EConnectionState state, Core::Now now, VehicleActions& out);
    /// Ends each public call: sends a state that has become due, now or after the minimum interval.
    void Settle(Core::Now now, VehicleActions& out);
};

} // namespace ACS::VDA5050
