#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>
#include <acs/vda5050/FactsheetMessage.hpp>
#include <acs/vda5050/MasterAction.hpp>
#include <acs/vda5050/MasterOptions.hpp>
#include <acs/vda5050/OrderMessage.hpp>
#include <acs/vda5050/StateMessage.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::VDA5050
{

/// Whether the vehicle is connected to the broker, according to its connection messages.
enum class EVehicleLink : std::uint8_t
{
    Unknown, ///< No connection message yet, or the own link is down.
    Online,  ///< Connected, or a state was received.
    Offline, ///< Disconnected in an orderly way.
    Broken,  ///< The connection broke.
};

/// Progress of the order, according to the vehicle's states.
enum class EOrderPhase : std::uint8_t
{
    None,       ///< No order, or the last one ended.
    Sent,       ///< The vehicle has not shown the first message yet.
    Active,     ///< Accepted. An update may not be shown yet.
    Cancelling, ///< Cancel was requested.
};

/// A node or an edge on which the vehicle may drive without a further message.
struct ReservedElement
{
    std::string elementID; ///< nodeId or edgeId.
    std::uint32_t sequenceID = 0;
    bool bEdge = false;  ///< An edge; otherwise a node.
    bool bShown = false; ///< Shown by the vehicle's state; otherwise sent and not shown yet.

    bool operator==(const ReservedElement&) const = default;
};

/// An order as a master has stored it in order to resume it after a restart: each message before the call of SendOrder or
/// SendOrderUpdate, and the number from OrderAccepted.
struct OrderRecord
{
    /// All messages of the order, oldest first, each with its orderUpdateID. Not those that were reported by OrderRejected: the next
    /// update begins where the message before them ends.
    std::vector<OrderMessage> messages;
    std::optional<std::uint32_t> acceptedUpdateID; ///< The last one of OrderAccepted; nullopt: none was accepted.
    /// The orderID of MasterSession::GetStateOrNull before the call of SendOrder. With it an order is not executed twice if the
    /// vehicle was restarted too; nullopt: it is sent again whatever the vehicle shows.
    std::optional<std::string> orderIDBefore{};

    bool operator==(const OrderRecord&) const = default;
};

/// Counters of a session since it was created.
struct MasterStatistics
{
    std::uint64_t statesReceived = 0;  ///< Valid states, without ignored ones.
    std::uint64_t statesIgnored = 0;   ///< Older than the latest state.
    std::uint64_t retainedIgnored = 0; ///< Retained states and visualizations, whose age is unknown.
    std::uint64_t messagesRefused = 0; ///< Unreadable payloads, and those of another vehicle or major version.
    std::uint64_t messagesSent = 0;    ///< Orders, updates and instant actions, including resent ones.
    std::uint64_t ordersResent = 0;    ///< Orders and updates that the vehicle had not shown in time.
    std::string lastRefusal{};         ///< Topic and reason of the last refused message; empty: none was refused.
    /// The version in the header of the vehicle's last message that has one, refused or not; at most 32 characters.
    std::string lastVersion{};

    bool operator==(const MasterStatistics&) const = default;
};

/// One vehicle from the point of view of master control: resends orders and instant actions until the vehicle shows them,
/// and derives their progress from its states. Pure: no clock, no I/O; all output is appended to out, which the caller
/// reuses. The vehicle's state is authoritative: lost states, repeated retained messages and old wills are harmless. Not
/// shared between threads. Calls append to out: do not call while iterating over it.
class ACS_API MasterSession
{
    class ACS_HIDDEN Impl;
    std::unique_ptr<Impl> _impl;

public:
    /// The address must be valid (IsValidAddress): see Create.
    explicit MasterSession(MasterOptions options);
    MasterSession(const MasterSession&) = delete;
    MasterSession& operator=(const MasterSession&) = delete;
    MasterSession(MasterSession&&) noexcept;
    MasterSession& operator=(MasterSession&&) noexcept;
    ~MasterSession();

    /// For an address from outside. Fails with InvalidTopic if a part of it is not allowed in a topic.
    [[nodiscard]] static Core::Result<MasterSession> Create(MasterOptions options);

    /// Subscriptions to make before OnLinkUp: state, visualization, connection and factsheet of this vehicle.
    [[nodiscard]] std::vector<MqttSubscription> GetSubscriptions() const;

    /// The broker is connected and the subscriptions are made. The retained connection message follows by itself.
    void OnLinkUp(Core::Now now, MasterActions& out);
    /// The own link is down: the vehicle is Unknown from now on. Orders are kept, and resent after OnLinkUp.
    void OnLinkDown(Core::Now now, MasterActions& out);
    /// Messages of other vehicles and topics are ignored. A message whose header has another vehicle's name or another
    /// major version is refused; a retained state or visualization is only counted.
    void OnMessage(const MqttMessage& message, Core::Now now, MasterActions& out);
    /// A message that was not retained.
    void OnMessage(std::string_view topic, std::string_view payload, Core::Now now, MasterActions& out);
    /// Requested by StartMasterTimer.
    void OnTimer(EMasterTimer timer, Core::Now now, MasterActions& out);

    /// Sends an order (with orderID and route, without header) and resends it until the vehicle shows it. The
    /// orderUpdateID is sent as given. The orderID must be new to the vehicle, which would otherwise treat the order as its
    /// current or last one; see ResumeOrder.
    /// With a factsheet, unlisted optional members that the vehicle can do without are omitted, required ones filled in where a value
    /// restricts nothing, texts sent as the NUMBER, FLOAT, INTEGER or BOOL that an action parameter is listed as, and the horizon
    /// is shortened to what fits. Any other optional member, action, parameter or size that is not supported is an error.
    /// Errors: VehicleNotReady, OrderActive (also for an order of another master), InvalidOrder, NotSupported.
    [[nodiscard]] Core::Result<void> SendOrder(OrderMessage order, Core::Now now, MasterActions& out);
    /// For a vehicle that rejects orders with a horizon, which a factsheet cannot state: later orders and updates are sent without
    /// it. The order still ends only with a message that had no horizon before.
    void SetHorizonOmitted(bool bOmitted) noexcept;
    /// Whether the order, or the update if its orderID is that of the running order, is valid and allowed by the factsheet, if there
    /// is one. Errors: InvalidOrder; NotSupported, with the factsheet's name of the member as path.
    [[nodiscard]] Core::Result<void> CheckOrder(OrderMessage order, Core::Now now) const;
    /// The next update of the running order: nodes from the decision point on. The session sets orderID and orderUpdateID.
    /// The update is sent once the vehicle shows the previous message; at most one update can wait.
    /// Errors: NoOrder, UpdatePending, InvalidOrder, NotSupported.
    [[nodiscard]] Core::Result<void> SendOrderUpdate(OrderMessage update, Core::Now now, MasterActions& out);
    /// Resumes an order after a restart of the master. Messages that the vehicle's state shows count as accepted and are
    /// not sent; the later ones, two at most, are sent. An order that was accepted and is no longer shown is reported as
    /// lost and not sent again. Likewise an order that was not accepted, if the record has orderIDBefore and the vehicle shows
    /// another one or none: it may have executed the order. NodeReached starts at the first node again.
    /// Errors: OrderActive, VehicleNotReady, InvalidOrder, NotSupported.
    [[nodiscard]] Core::Result<void> ResumeOrder(OrderRecord record, Core::Now now, MasterActions& out);
    /// Sends an instant action until the vehicle shows its id. An action that is shown already is not sent; its status is
    /// reported (ActionChanged), so that a master that has stored its ids can repeat the call after a restart. The session
    /// sets blockingType as vehicles of 2.x expect it, and fills in an empty actionID; the result is the id.
    /// Errors: VehicleNotReady (also in a mode without master control, except for stateRequest and factsheetRequest),
    /// InvalidOrder (the id belongs to another action that is shown or has not ended), NotSupported (for cancelOrder,
    /// startPause, stopPause, stateRequest and factsheetRequest only if the id violates the vehicle's limits).
    [[nodiscard]] Core::Result<std::string> SendInstantAction(Action action, Core::Now now, MasterActions& out);
    /// Ends the resends of an instant action that the vehicle has not shown, for example because it was away in the meantime. It may
    /// have received the action: ActionChanged then reports its status as that of any action. False, without an effect: the action
    /// is shown already, was refused, is a request (sent once), or the cancelOrder of Cancel.
    [[nodiscard]] bool TryWithdrawInstantAction(std::string_view actionID);
    /// Whether a message of the order was sent.
    [[nodiscard]] bool IsOrderSent() const noexcept;
    /// Cancels the order, whether or not the vehicle has shown it. Ends with OrderCancelled, OrderFinished (the order ended
    /// first), OrderLost or CancelFailed. An order that was not sent yet is cancelled at once, without cancelOrder. Errors: NoOrder,
    /// VehicleNotReady.
    [[nodiscard]] Core::Result<void> Cancel(Core::Now now, MasterActions& out);

    /// Nodes and edges that must be kept free for the vehicle: its last node and the base of its last state, regardless of
    /// the order's sender and the state's age, followed by the base of the message that is not shown yet.
    [[nodiscard]] std::vector<ReservedElement> ListReserved() const;

    /// According to the last connection message; Unknown while the own link is down.
    [[nodiscard]] EVehicleLink GetLink() const noexcept;
    /// Progress of the order of GetOrderID.
    [[nodiscard]] EOrderPhase GetOrderPhase() const noexcept;
    /// The order of this session; empty if the phase is None.
    [[nodiscard]] const std::string& GetOrderID() const noexcept;
    /// Online, a state was received, mode AUTOMATIC or SEMIAUTOMATIC, and no order of any master runs.
    [[nodiscard]] bool CanTakeOrder() const;
    /// Online, a state was received since then, and the next one is not overdue.
    [[nodiscard]] bool IsReady() const;
    /// The last state, null before the first.
    [[nodiscard]] const StateMessage* GetStateOrNull() const noexcept;
    /// The last one received, or else MasterOptions::factsheet; null without either.
    [[nodiscard]] const FactsheetMessage* GetFactsheetOrNull() const noexcept;
    /// Counters since the session was created.
    [[nodiscard]] const MasterStatistics& GetStatistics() const noexcept;
    /// As they were passed to the constructor.
    [[nodiscard]] const MasterOptions& GetOptions() const noexcept;
};

} // namespace ACS::VDA5050
