#pragma once

#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>
#include <acs/vda5050/IMqttLink.hpp>
#include <acs/vda5050/StateMessage.hpp>
#include <acs/vda5050/Topic.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace ACS::VDA5050
{

/// Timers of a MasterSession.
enum class EMasterTimer : std::uint8_t
{
    ResendOrder,          ///< The vehicle has not shown the order, or the update, yet: send it again.
    ResendInstantActions, ///< The vehicle has not shown the instant actions yet: send them again.
    Silence,              ///< No state for longer than MasterOptions::stateInterval and its margin.
};

/// Call OnTimer after the delay. Replaces a running timer of the same name.
struct StartMasterTimer
{
    EMasterTimer timer = EMasterTimer::ResendOrder;
    Core::Duration delay{};

    bool operator==(const StartMasterTimer&) const = default;
};

/// Do not call OnTimer for this timer.
struct CancelMasterTimer
{
    EMasterTimer timer = EMasterTimer::ResendOrder;

    bool operator==(const CancelMasterTimer&) const = default;
};

/// The vehicle reported ONLINE, also once more after a restart that no will has preceded. Orders can be sent once a state was received as well: MasterSession::CanTakeOrder.
struct VehicleOnline
{
    bool operator==(const VehicleOnline&) const = default;
};

/// The vehicle has disconnected in an orderly way.
struct VehicleOffline
{
    bool operator==(const VehicleOffline&) const = default;
};

/// The vehicle's connection broke; it may still drive to the end of its base.
struct VehicleBroken
{
    bool operator==(const VehicleBroken&) const = default;
};

/// No state for longer than MasterOptions allows, while the vehicle is online. Reported once, until the next state.
struct VehicleSilent
{
    Core::Duration age{}; ///< Time since the last state.

    bool operator==(const VehicleSilent&) const = default;
};

/// See MasterSession::GetStateOrNull. Precedes the events that were derived from the state.
struct StateReceived
{
    bool operator==(const StateReceived&) const = default;
};

/// See MasterSession::GetFactsheetOrNull.
struct FactsheetReceived
{
    bool operator==(const FactsheetReceived&) const = default;
};

/// From a visualization or a state.
struct PositionReceived
{
    AgvPosition position;             ///< Only meaningful with bPositionInitialized.
    std::optional<Velocity> velocity; ///< Absent: not reported.

    bool operator==(const PositionReceived&) const = default;
};

/// The vehicle's state shows this orderID and orderUpdateID.
struct OrderAccepted
{
    std::string orderID;
    std::uint32_t orderUpdateID = 0;

    bool operator==(const OrderAccepted&) const = default;
};

/// The vehicle has refused this message (an order that runs is not affected), or has never shown it.
struct OrderRejected
{
    std::string orderID;
    std::uint32_t orderUpdateID = 0;
    std::string errorType; ///< For example "validationError"; empty after the last resend.
    std::string reason;    ///< For the operator.

    bool operator==(const OrderRejected&) const = default;
};

/// A message of the order waits for the minOrderInterval of the vehicle's factsheet. The session sends it when the
/// interval has passed.
struct OrderDelayed
{
    std::string orderID;
    std::uint32_t orderUpdateID = 0;
    Core::Duration delay{};

    bool operator==(const OrderDelayed&) const = default;
};

/// Reported once per node of the order, in order, even if states were lost.
struct NodeReached
{
    std::string nodeID;
    std::uint32_t sequenceID = 0;

    bool operator==(const NodeReached&) const = default;
};

/// The reported status (or result) of an order action or instant action has changed. Intermediate statuses may be missing.
struct ActionChanged
{
    std::string actionID;
    std::string actionType;
    EActionStatus status = EActionStatus::Waiting; ///< The new one.
    std::string resultDescription;

    bool operator==(const ActionChanged&) const = default;
};

/// The outcome of an action remains unknown: it disappeared from the state, or its order ended.
struct ActionLost
{
    std::string actionID;
    std::string actionType;
    std::string reason;

    bool operator==(const ActionLost&) const = default;
};

/// The vehicle has refused an instant action with an error, or has never shown it.
struct InstantActionRejected
{
    std::string actionID;
    std::string errorType;
    std::string reason;

    bool operator==(const InstantActionRejected&) const = default;
};

/// All nodes are reached, all actions have ended, and there is no horizon. Also if the vehicle shows the last node and has cleared the
/// orderID already.
struct OrderFinished
{
    std::string orderID;

    bool operator==(const OrderFinished&) const = default;
};

/// The order was cancelled; the vehicle can accept another one.
struct OrderCancelled
{
    std::string orderID;

    bool operator==(const OrderCancelled&) const = default;
};

/// The vehicle has accepted a late message of an order that was cancelled before the vehicle had shown it, or that was
/// reported as OrderRejected. If it still runs, the session cancels it again and reports the end as for any cancel;
/// otherwise OrderFinished follows.
struct OrderReappeared
{
    std::string orderID;

    bool operator==(const OrderReappeared&) const = default;
};

/// The cancelOrder action was refused, or it failed and the vehicle still has the order. The order continues as if it had not been
/// cancelled: updates that the vehicle has not shown are sent with the numbers that they have.
struct CancelFailed
{
    std::string orderID;
    std::string reason;

    bool operator==(const CancelFailed&) const = default;
};

/// The vehicle has dropped the order by itself: restart, manual mode, or an order of another master. Also of an order that it has
/// not shown: it was away or restarted after the order was sent, and may have executed it.
struct OrderLost
{
    std::string orderID;
    std::string reason;

    bool operator==(const OrderLost&) const = default;
};

/// An error that is new in the state, or no longer in it.
struct VehicleErrorChanged
{
    VehicleError error;   ///< As in the state. An error that differs in any member is another one.
    bool bActive = false; ///< False: the state no longer has it.

    bool operator==(const VehicleErrorChanged&) const = default;
};

/// An unreadable payload, which is counted and ignored.
struct MessageRefused
{
    ETopic topic = ETopic::State; ///< That of the payload.
    Core::Error error;            ///< What is invalid, with its JSON path.

    bool operator==(const MessageRefused&) const = default;
};

/// Requests (the first three) and events of a MasterSession.
using MasterAction = std::variant<
    PublishMessage,
    StartMasterTimer,
    CancelMasterTimer,
    VehicleOnline,
    VehicleOffline,
    VehicleBroken,
    VehicleSilent,
    StateReceived,
    FactsheetReceived,
    PositionReceived,
    OrderAccepted,
    OrderRejected,
    OrderDelayed,
    NodeReached,
    ActionChanged,
    ActionLost,
    InstantActionRejected,
    OrderFinished,
    OrderCancelled,
    OrderReappeared,
    CancelFailed,
    OrderLost,
    VehicleErrorChanged,
    MessageRefused>;

/// To be carried out in order, before the next call.
using MasterActions = std::vector<MasterAction>;

} // namespace ACS::VDA5050
