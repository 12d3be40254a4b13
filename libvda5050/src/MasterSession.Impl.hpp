#pragma once

#include <acs/vda5050/MasterSession.hpp>
#include <acs/vda5050/Vda5050Codec.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ACS::VDA5050
{

class ActionIndex;

class MasterSession::Impl
{
    struct PendingAction
    {
        Action action;
        std::uint32_t sendCount = 0;
        std::string orderID; ///< Of the vehicle when the action was sent.
    };

    struct TrackedAction
    {
        std::string actionID;
        std::string actionType;
        bool bInstant = false;
        bool bShown = false;
    };

    /// An order that has ended for the master, while a message of it may still be under way.
    struct WithdrawnOrder
    {
        std::string orderID;
        std::vector<std::string> actionIDs;
        bool bRejected = false; ///< Rejected or never shown; otherwise cancelled.
    };

    /// Whether the vehicle can show the message in flight.
    enum class EEcho : std::uint8_t
    {
        Impossible, ///< It was never sent.
        Possible,   ///< It was sent, perhaps before a restart of the master.
    };

    struct RouteNode
    {
        std::string nodeID;
        std::uint32_t sequenceID = 0;
        bool bReleased = false;
        std::vector<std::string> actionIDs; ///< Of the node and of the edge to it.
    };

    MasterOptions _options;
    Vda5050Codec _codec;
    std::array<std::uint32_t, TOPIC_COUNT> _headerIDs{};
    std::array<std::string, TOPIC_COUNT> _topics;
    MasterStatistics _statistics;
    bool _bLinkUp = false;
    EVehicleLink _link = EVehicleLink::Unknown;
    bool _bSilent = false;
    bool _bStateFresh = false;   ///< A state was received since the vehicle is online.
    bool _bNumbersKnown = false; ///< A state was received since ONLINE, which restarts the headerIds.
    bool _bHorizonOmitted = false;
    bool _bAwaySinceSend = false; ///< The vehicle was not connected for a time since the order was sent.
    Core::SteadyTime _lastStateTime;
    std::optional<StateMessage> _state;
    std::optional<FactsheetMessage> _factsheet; ///< Received, or that of the options.
    EOrderPhase _phase = EOrderPhase::None;
    std::string _orderID;
    std::uint32_t _lastSentUpdateID = 0;
    std::uint32_t _acceptedUpdateID = 0;
    bool _bAccepted = false;               ///< The vehicle has shown a message of this order.
    std::optional<OrderMessage> _inFlight; ///< Sent, and not shown yet.
    std::optional<OrderMessage> _queued;   ///< Waits until the one in flight is shown.
    /// The messages that were built with a horizon, from the accepted one on: more nodes follow, whether or not it was sent.
    std::vector<std::uint32_t> _continuedUpdateIDs;
    EEcho _echo = EEcho::Impossible;
    std::uint32_t _sendCount = 0;
    std::optional<Core::SteadyTime> _lastOrderTime; ///< Of the last published message.
    std::optional<OrderMessage> _withdrawn;         ///< In flight when the cancel was sent; the vehicle may receive it.
    std::vector<WithdrawnOrder> _withdrawnOrders;   ///< The last orders that ended before they were shown.
    std::vector<TrackedAction> _tracked;            ///< Not yet ended.
    std::vector<VehicleError> _errorsBeforeSend;    ///< Sorted.
    std::string _orderIDBeforeSend;                 ///< Of the vehicle's state.
    std::uint32_t _firstHeaderID = 0;               ///< Of the message in flight; increases with each resend.
    std::vector<RouteNode> _route;                  ///< Accepted nodes, base and horizon.
    std::size_t _reachedNodes = 0;                  ///< Number of nodes of _route that were reported.
    std::vector<PendingAction> _pendingActions;
    std::string _cancelActionID;
    std::uint32_t _ownActionCount = 0;

public:
    explicit Impl(MasterOptions options);

    [[nodiscard]] std::vector<MqttSubscription> GetSubscriptions() const;
    void OnLinkUp(Core::Now now, MasterActions& out);
    void OnLinkDown(Core::Now now, MasterActions& out);
    void OnMessage(std::string_view topic, std::string_view payload, bool bRetained, Core::Now now, MasterActions& out);
    void OnTimer(EMasterTimer timer, Core::Now now, MasterActions& out);
    /// Sets the zone set of the options where the order has none.
    void SetZoneSet(OrderMessage& order) const;
    /// Changes the order to what the factsheet supports, as far as the standard allows.
    [[nodiscard]] Core::Result<void> FitOrder(OrderMessage& order, Core::Now now) const;
    [[nodiscard]] Core::Result<void> SendOrder(OrderMessage order, Core::Now now, MasterActions& out);
    void SetHorizonOmitted(bool bOmitted) noexcept;
    [[nodiscard]] Core::Result<void> SendOrderUpdate(OrderMessage update, Core::Now now, MasterActions& out);
    [[nodiscard]] Core::Result<void> ResumeOrder(OrderRecord record, Core::Now now, MasterActions& out);
    [[nodiscard]] Core::Result<std::string> SendInstantAction(Action action, Core::Now now, MasterActions& out);
    [[nodiscard]] bool TryWithdrawInstantAction(std::string_view actionID);
    [[nodiscard]] Core::Result<void> Cancel(Core::Now now, MasterActions& out);
    [[nodiscard]] std::vector<ReservedElement> ListReserved() const;
    [[nodiscard]] EVehicleLink GetLink() const noexcept;
    [[nodiscard]] EOrderPhase GetOrderPhase() const noexcept;
    [[nodiscard]] const std::string& GetOrderID() const noexcept;
    [[nodiscard]] bool CanTakeOrder() const;
    [[nodiscard]] bool IsReady() const;
    [[nodiscard]] const StateMessage* GetStateOrNull() const noexcept;
    [[nodiscard]] const FactsheetMessage* GetFactsheetOrNull() const noexcept;
    [[nodiscard]] const MasterStatistics& GetStatistics() const noexcept;
    [[nodiscard]] const MasterOptions& GetOptions() const noexcept;

private:
    [[nodiscard]] bool IsForeign(ETopic topic, const Header& header, MasterActions& out);
    void OnConnection(std::string_view payload, Core::Now now, MasterActions& out);
    void OnState(std::string_view payload, Core::Now now, MasterActions& out);
    void OnVisualization(std::string_view payload, MasterActions& out);
    void OnFactsheet(std::string_view payload, MasterActions& out);
    void Refuse(ETopic topic, Core::Error error, MasterActions& out);
    void OnVehicleOnline(Core::Now now, MasterActions& out);
    void OnVehicleGone(EVehicleLink link, MasterActions& out);
    void CheckSilence(Core::Now now, MasterActions& out);
    [[nodiscard]] bool IsStale(const StateMessage& state) const;
    /// Whether the last known mode allows orders and instant actions.
    [[nodiscard]] bool IsUnderMasterControl() const;

    void ReportDifferences(
        const std::optional<StateMessage>& previousOrNull,
        const ActionIndex& shown,
        MasterActions& out) const;
    /// The cancelOrder was for an order of another master, which has ended: sent again it would end the next order.
    [[nodiscard]] bool IsCancelLate(const PendingAction& pending) const;
    void SettlePendingActions(const ActionIndex& shown, MasterActions& out);
    void SettleInFlight(Core::Now now, MasterActions& out);
    /// Keeps the numbers of what was not sent above the one that the vehicle shows.
    void RenumberUnsent(MasterActions& out);
    /// False: no orderUpdateId is left for the update.
    [[nodiscard]] bool TryRenumber(OrderMessage& update);
    void AcceptInFlight(MasterActions& out);
    /// The update that waits, once the vehicle has shown the message before it and still holds the order.
    void SendQueued(Core::Now now, MasterActions& out);
    /// Whether the vehicle may have executed the order in flight without showing it, and forgotten it by a restart.
    [[nodiscard]] bool IsInFlightDoubtful() const;
    void DropInFlight(MasterActions& out);
    void RejectInFlight(const std::string& errorType, const std::string& reason, MasterActions& out);
    [[nodiscard]] bool IsRejection(const VehicleError& error) const;
    [[nodiscard]] const VehicleError* FindRejectionOrNull() const;
    void UpdateOrder(MasterActions& out);
    void ReportReachedNodes(MasterActions& out);
    [[nodiscard]] bool IsOrderDone() const;
    void UpdateCancel(MasterActions& out);
    void EndCancel(EActionStatus status, MasterActions& out);
    void EndOrder(MasterActions& out);
    void ExtendRoute(const OrderMessage& order);
    /// Discards the previous order.
    void BeginOrder(std::string orderID, std::uint32_t lastUpdateID);
    void AddToRoute(const OrderMessage& order);
    /// Changes the order to what the vehicle takes. True: it continues with nodes that are not in its base.
    [[nodiscard]] Core::Result<bool> Prepare(OrderMessage& order, Core::Now now) const;
    void NoteContinuation(std::uint32_t orderUpdateID, bool bContinues);
    /// The next orderUpdateId, above what was numbered and what the vehicle shows; empty after the last one.
    [[nodiscard]] std::optional<std::uint32_t> TakeUpdateIDOrNull();
    /// The message is in flight until the vehicle shows it.
    void StartWaitingForEcho(OrderMessage order, EEcho echo, Core::Now now, MasterActions& out);
    /// The start of an update: the last released node of the last message.
    [[nodiscard]] std::pair<std::string, std::uint32_t> GetDecisionPoint() const;
    [[nodiscard]] bool IsPending(std::string_view actionID) const;
    /// Whether an order action or instant action with this id has not ended.
    [[nodiscard]] bool IsTracked(std::string_view actionID) const;
    [[nodiscard]] bool IsSentHeader(std::string_view headerID) const;
    [[nodiscard]] const ActionState* FindShownOrNull(std::string_view actionID) const;

    void TrackOrderActions(const OrderMessage& order);
    void UpdateActions(const ActionIndex& shown, MasterActions& out);
    void EndOrderActions(MasterActions& out);
    void RemoveTrackedAction(std::string_view actionID);
    /// Remembers the order in case the vehicle receives its message late; null if none was sent.
    void Withdraw(const OrderMessage* messageOrNull, bool bRejected);
    [[nodiscard]] bool IsRunning(const WithdrawnOrder& order) const;
    void CancelReappeared(Core::Now now, MasterActions& out);
    /// Whether the vehicle has nodes or edges left, of any order.
    [[nodiscard]] bool IsBusy() const;

    /// Null without a factsheet, or if it is not obeyed.
    [[nodiscard]] const FactsheetMessage* GetRulesOrNull() const;
    [[nodiscard]] Core::Result<void> FitInstantAction(Action& action, Core::Now now) const;
    [[nodiscard]] Core::Duration GetOrderInterval() const;
    [[nodiscard]] Core::Duration GetAllowedSilence() const;
    [[nodiscard]] std::size_t GetMaximumInstantActions() const;

    [[nodiscard]] Header PeekHeader(ETopic topic, Core::Now now) const;
    [[nodiscard]] Header MakeHeader(ETopic topic, Core::Now now);
    void PublishPayload(ETopic topic, std::string payload, MasterActions& out);
    void PublishOrder(Core::Now now, MasterActions& out);
    void PublishInstantActions(std::vector<Action> actions, Core::Now now, MasterActions& out);
    void ResendOrder(Core::Now now, MasterActions& out);
    void ResendInstantActions(Core::Now now, MasterActions& out);
    [[nodiscard]] std::string MakeActionID(std::string_view actionType, Core::Now now);
    [[nodiscard]] std::string MakeNextActionID(std::string_view actionType, Core::Now now);
};

} // namespace ACS::VDA5050
