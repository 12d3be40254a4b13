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
    };

    struct TrackedAction
    {
        std::string actionID;
        std::string actionType;
        bool bInstant = false;
        bool bShown = false;
    };

    /// One that has ended for us, though the vehicle may still have it in a queue.
    struct WithdrawnOrder
    {
        std::string orderID;
        std::vector<std::string> actionIDs;
        bool bRejected = false; ///< Or never shown; else cancelled.
    };

    struct RouteNode
    {
        std::string nodeID;
        std::uint32_t sequenceID = 0;
        bool bReleased = false;
        std::vector<std::string> actionIDs; ///< Of the node and of the edge that leads to it.
    };

    MasterOptions _options;
    Vda5050Codec _codec;
    std::array<std::uint32_t, TOPIC_COUNT> _headerIDs{};
    std::array<std::string, TOPIC_COUNT> _topics;
    MasterStatistics _statistics;
    bool _bLinkUp = false;
    EVehicleLink _link = EVehicleLink::Unknown;
    bool _bSilent = false;
    bool _bStateFresh = false;   ///< A state came since the vehicle is online.
    bool _bNumbersKnown = false; ///< A state came since the vehicle said ONLINE last: before, its headerIds count anew.
    Core::SteadyTime _lastStateTime;
    std::optional<StateMessage> _state;
    std::optional<FactsheetMessage> _factsheet;
    EOrderPhase _phase = EOrderPhase::None;
    std::string _orderID;
    std::uint32_t _lastSentUpdateID = 0;
    std::uint32_t _acceptedUpdateID = 0;
    bool _bAccepted = false;               ///< Any message of this order was echoed.
    std::optional<OrderMessage> _inFlight; ///< Sent and not yet echoed.
    std::optional<OrderMessage> _queued;   ///< Waits for the echo of the one in flight.
    std::uint32_t _sendCount = 0;
    std::optional<Core::SteadyTime> _lastOrderTime; ///< When one was published last.
    std::optional<OrderMessage> _withdrawn;         ///< In flight when the cancel was sent: the vehicle may have it.
    std::vector<WithdrawnOrder> _withdrawnOrders;   ///< Without having been seen; the last ones.
    std::vector<TrackedAction> _tracked;            ///< Not yet ended.
    std::vector<VehicleError> _errorsBeforeSend;    ///< Sorted.
    std::uint32_t _firstHeaderID = 0;               ///< Of the message in flight; each resend has the next one.
    std::vector<RouteNode> _route;                  ///< Accepted nodes, base and horizon.
    std::size_t _reachedNodes = 0;                  ///< How many of _route were told.
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
    [[nodiscard]] Core::Result<void> SendOrder(OrderMessage order, Core::Now now, MasterActions& out);
    [[nodiscard]] Core::Result<void> SendOrderUpdate(OrderMessage update, Core::Now now, MasterActions& out);
    [[nodiscard]] Core::Result<void> ResumeOrder(OrderRecord record, Core::Now now, MasterActions& out);
    [[nodiscard]] Core::Result<std::string> SendInstantAction(Action action, Core::Now now, MasterActions& out);
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
    void ComeOnline(Core::Now now, MasterActions& out);
    void GoAway(EVehicleLink link, MasterActions& out);
    void CheckSilence(Core::Now now, MasterActions& out);
    [[nodiscard]] bool IsStale(const StateMessage& state) const;
    /// Whether its mode takes orders and instant actions, as far as is known.
    [[nodiscard]] bool IsLed() const;

    void TellDifferences(const std::optional<StateMessage>& previous, MasterActions& out) const;
    void SettlePendingActions(const ActionIndex& shown, MasterActions& out);
    void SettleInFlight(Core::Now now, MasterActions& out);
    void AcceptInFlight(Core::Now now, MasterActions& out);
    void RejectInFlight(const std::string& errorType, const std::string& reason, MasterActions& out);
    [[nodiscard]] bool IsRejection(const VehicleError& error) const;
    [[nodiscard]] const VehicleError* FindRejectionOrNull() const;
    void FollowOrder(MasterActions& out);
    void TellReachedNodes(MasterActions& out);
    [[nodiscard]] bool IsOrderDone() const;
    void FollowCancel(MasterActions& out);
    void EndCancel(EActionStatus status, MasterActions& out);
    void EndOrder(MasterActions& out);
    void ExtendRoute(const OrderMessage& order);
    /// Forgets the order before it.
    void BeginOrder(std::string orderID, std::uint32_t lastUpdateID);
    void TakeIntoRoute(const OrderMessage& order);
    /// From now on this message waits for its echo.
    void PutInFlight(OrderMessage order, Core::Now now, MasterActions& out);
    /// Where an update has to begin: the last released node of what was sent last.
    [[nodiscard]] std::pair<std::string, std::uint32_t> GetDecisionPoint() const;
    [[nodiscard]] bool IsPending(std::string_view actionID) const;
    /// Whether an action with this id, of an order or not, has not ended yet.
    [[nodiscard]] bool IsTracked(std::string_view actionID) const;
    [[nodiscard]] bool IsSentHeader(std::string_view headerID) const;
    [[nodiscard]] const ActionState* FindShownOrNull(std::string_view actionID) const;

    void TrackOrderActions(const OrderMessage& order);
    void FollowActions(const ActionIndex& shown, MasterActions& out);
    void EndOrderActions(MasterActions& out);
    void ForgetAction(std::string_view actionID);
    /// Remembers it in case that it comes late. The message that the vehicle may have; null where none was sent.
    void Withdraw(const OrderMessage* messageOrNull, bool bRejected);
    [[nodiscard]] bool IsRunning(const WithdrawnOrder& order) const;
    void CancelReappeared(Core::Now now, MasterActions& out);
    /// Whether the vehicle has nodes or edges left, of whatever order.
    [[nodiscard]] bool IsBusy() const;

    /// Null where there is no factsheet, or it is not to be obeyed.
    [[nodiscard]] const FactsheetMessage* GetRulesOrNull() const;
    [[nodiscard]] Core::Result<void> FitOrder(OrderMessage& order, Core::Now now) const;
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
