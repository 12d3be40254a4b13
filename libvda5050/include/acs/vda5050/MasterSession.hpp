#pragma once

#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>
#include <acs/vda5050/MasterAction.hpp>
#include <acs/vda5050/MasterOptions.hpp>
#include <acs/vda5050/OrderMessage.hpp>
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

enum class EVehicleLink : std::uint8_t
{
    Unknown, ///< No connection message yet, or our own link is down.
    Online,
    Offline,
    Broken,
};

/// Where the order stands, as far as the vehicle has shown it.
enum class EOrderPhase : std::uint8_t
{
    None,       ///< No order, or the last one ended.
    Sent,       ///< The first message of it waits for the echo.
    Active,     ///< Accepted. An update may wait for its echo.
    Cancelling, ///< Cancel was asked for.
};

/// A node or an edge on which the vehicle may drive without another word from us.
struct ReservedElement
{
    std::string elementID;
    std::uint32_t sequenceID = 0;
    bool bEdge = false;
    bool bShown = false; ///< By the vehicle's state; else sent to it and not yet answered.

    bool operator==(const ReservedElement&) const = default;
};

/// An order as a master wrote it down, to go on with it after a restart: each message before SendOrder or SendOrderUpdate
/// was called, and what OrderAccepted told.
struct OrderRecord
{
    std::vector<OrderMessage> messages; ///< All of the order, the first one first, each with its orderUpdateID.
    std::optional<std::uint32_t> acceptedUpdateID;

    bool operator==(const OrderRecord&) const = default;
};

class ActionIndex;

/// What a session has counted since it was made.
struct MasterStatistics
{
    std::uint64_t statesReceived = 0;
    std::uint64_t statesIgnored = 0;   ///< Older than one that came before it.
    std::uint64_t retainedIgnored = 0; ///< States and visualizations that somebody had retained: of unknown age.
    std::uint64_t messagesRefused = 0;
    std::uint64_t messagesSent = 0;
    std::uint64_t ordersResent = 0;

    bool operator==(const MasterStatistics&) const = default;
};

/// One vehicle as master control sees it: sends orders and instant actions until the vehicle shows them, and draws from
/// its states what became of them. Pure: no clock, no I/O; all output is appended to out, which the caller reuses.
/// The truth is what the vehicle says: lost states, repeated retained messages and old wills do no harm. All calls on one
/// thread; and none while its out is iterated, as calls append to it.
class MasterSession
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

    void Read(std::string_view topic, std::string_view payload, bool bRetained, Core::Now now, MasterActions& out);
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

public:
    /// The address must be one (IsValidAddress): see Create.
    explicit MasterSession(MasterOptions options);

    /// For an address that comes from outside. Fails with InvalidTopic where a part of it cannot stand in a topic.
    [[nodiscard]] static Core::Result<MasterSession> Create(MasterOptions options);

    /// What to subscribe to before OnLinkUp: state, visualization, connection and factsheet of this vehicle.
    [[nodiscard]] std::vector<MqttSubscription> GetSubscriptions() const;

    /// The broker is connected and the subscriptions stand. The retained connection message follows by itself.
    void OnLinkUp(Core::Now now, MasterActions& out);
    /// Our own link is down: the vehicle is Unknown from now on, orders stay as they are and are resent after OnLinkUp.
    void OnLinkDown(Core::Now now, MasterActions& out);
    /// Messages of other vehicles and topics are ignored. A header with another vehicle's name or another major version
    /// is refused; a state or visualization that was retained is no news, and only counted.
    void OnMessage(const MqttMessage& message, Core::Now now, MasterActions& out);
    /// As a message that was not retained.
    void OnMessage(std::string_view topic, std::string_view payload, Core::Now now, MasterActions& out);
    void OnTimer(EMasterTimer timer, Core::Now now, MasterActions& out);

    /// Sends an order (orderID and its route filled in, its header not) and resends it until the vehicle shows it. The
    /// orderUpdateID is sent as given. The orderID is one that the vehicle does not show: it would take the order for the
    /// one that it has, or had last; see ResumeOrder.
    /// Held against the factsheet, if one has come: unlisted tolerances and lengths are left out, any other optional
    /// member, action, parameter or size that it does not list is an error; an empty list refuses nothing.
    /// Errors: VehicleNotReady, OrderActive (also where the vehicle runs an order of somebody else), InvalidOrder,
    /// NotSupported.
    [[nodiscard]] Core::Result<void> SendOrder(OrderMessage order, Core::Now now, MasterActions& out);
    /// The next update of the running order: nodes from the decision point on. Its orderID and orderUpdateID are set
    /// here. Waits for the echo of the message before it; one may wait.
    /// Errors: NoOrder, UpdatePending, InvalidOrder, NotSupported.
    [[nodiscard]] Core::Result<void> SendOrderUpdate(OrderMessage update, Core::Now now, MasterActions& out);
    /// Takes up an order after a restart of the master. What the vehicle's state shows of it is taken as accepted and not
    /// sent; the messages behind that, two at most, are. An order that was accepted and that the vehicle no longer shows
    /// is told as lost and not sent a second time. NodeReached counts from the first node again.
    /// Errors: OrderActive, VehicleNotReady, InvalidOrder, NotSupported.
    [[nodiscard]] Core::Result<void> ResumeOrder(OrderRecord record, Core::Now now, MasterActions& out);
    /// Sends an instant action until the vehicle shows its id. One that it shows already is not sent, and its status is
    /// told (ActionChanged): a master that wrote its ids down may ask again after a restart. blockingType is set as vehicles
    /// of 2.x want it. An empty actionID is filled in; the result is the id. Errors: VehicleNotReady (also in a mode that
    /// takes none, but for stateRequest and factsheetRequest), InvalidOrder (the id of another action that the vehicle
    /// shows, or of one that has not ended), NotSupported (for cancelOrder, startPause, stopPause, stateRequest and
    /// factsheetRequest only where their id is not as the vehicle wants ids).
    [[nodiscard]] Core::Result<std::string> SendInstantAction(Action action, Core::Now now, MasterActions& out);
    /// Cancels the order: not yet seen by the vehicle, or running. Ends with OrderCancelled, OrderFinished (it was
    /// quicker), OrderLost or CancelFailed. Errors: NoOrder, VehicleNotReady.
    [[nodiscard]] Core::Result<void> Cancel(Core::Now now, MasterActions& out);

    /// What must be kept free for the vehicle: its last node and the base that its last state shows, by whoever gave it
    /// and however old the state is, and then the base of the message that it has not answered.
    [[nodiscard]] std::vector<ReservedElement> ListReserved() const;

    [[nodiscard]] EVehicleLink GetLink() const noexcept;
    [[nodiscard]] EOrderPhase GetOrderPhase() const noexcept;
    [[nodiscard]] const std::string& GetOrderID() const noexcept;
    /// Online, a state has come, mode AUTOMATIC or SEMIAUTOMATIC, and no order runs, nor one of somebody else.
    [[nodiscard]] bool CanTakeOrder() const;
    /// Online, a state has come since then and is not overdue.
    [[nodiscard]] bool IsReady() const;
    /// The last state, null before the first.
    [[nodiscard]] const StateMessage* GetStateOrNull() const noexcept;
    [[nodiscard]] const FactsheetMessage* GetFactsheetOrNull() const noexcept;
    [[nodiscard]] const MasterStatistics& GetStatistics() const noexcept;
    [[nodiscard]] const MasterOptions& GetOptions() const noexcept;
};

} // namespace ACS::VDA5050
