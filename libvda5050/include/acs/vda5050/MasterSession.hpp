#pragma once

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
    class Impl;
    std::unique_ptr<Impl> _impl;

public:
    /// The address must be one (IsValidAddress): see Create.
    explicit MasterSession(MasterOptions options);
    MasterSession(const MasterSession&) = delete;
    MasterSession& operator=(const MasterSession&) = delete;
    MasterSession(MasterSession&&) noexcept;
    MasterSession& operator=(MasterSession&&) noexcept;
    ~MasterSession();

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
