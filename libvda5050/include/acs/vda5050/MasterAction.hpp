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

enum class EMasterTimer : std::uint8_t
{
    ResendOrder,
    ResendInstantActions,
    Silence,
};

/// To do: call OnTimer after the delay; replaces a running timer of the same name.
struct StartMasterTimer
{
    EMasterTimer timer = EMasterTimer::ResendOrder;
    Core::Duration delay{};

    bool operator==(const StartMasterTimer&) const = default;
};

struct CancelMasterTimer
{
    EMasterTimer timer = EMasterTimer::ResendOrder;

    bool operator==(const CancelMasterTimer&) const = default;
};

/// Said ONLINE. Orders can be sent once a state has come, too: MasterSession::CanTakeOrder.
struct VehicleOnline
{
    bool operator==(const VehicleOnline&) const = default;
};

/// Left in order.
struct VehicleOffline
{
    bool operator==(const VehicleOffline&) const = default;
};

/// Its connection broke; it may still drive to the end of its base.
struct VehicleBroken
{
    bool operator==(const VehicleBroken&) const = default;
};

/// No state for longer than MasterOptions allows, though its connection stands. Told once; the next state ends it.
struct VehicleSilent
{
    Core::Duration age{};

    bool operator==(const VehicleSilent&) const = default;
};

/// MasterSession::GetStateOrNull has it. Comes before the events that were drawn from it.
struct StateReceived
{
    bool operator==(const StateReceived&) const = default;
};

/// MasterSession::GetFactsheetOrNull has it.
struct FactsheetReceived
{
    bool operator==(const FactsheetReceived&) const = default;
};

/// From a visualization or a state.
struct PositionReceived
{
    AgvPosition position;
    std::optional<Velocity> velocity;

    bool operator==(const PositionReceived&) const = default;
};

/// The vehicle shows the ids in its state.
struct OrderAccepted
{
    std::string orderID;
    std::uint32_t orderUpdateID = 0;

    bool operator==(const OrderAccepted&) const = default;
};

/// The vehicle refuses this message (an order in the running order's place leaves that one alive), or never echoed it.
struct OrderRejected
{
    std::string orderID;
    std::uint32_t orderUpdateID = 0;
    std::string errorType; ///< "validationError", …; empty where the resends ran out.
    std::string reason;    ///< A sentence for people.

    bool operator==(const OrderRejected&) const = default;
};

/// A message of the order waits until the vehicle takes another: its factsheet's minOrderInterval. Sent by itself then.
struct OrderDelayed
{
    std::string orderID;
    std::uint32_t orderUpdateID = 0;
    Core::Duration delay{};

    bool operator==(const OrderDelayed&) const = default;
};

/// Each node of the order once and in order, also when the states in between were lost.
struct NodeReached
{
    std::string nodeID;
    std::uint32_t sequenceID = 0;

    bool operator==(const NodeReached&) const = default;
};

/// The reported status (or result) of an action changed; order and instant actions. Statuses in between may be missing.
struct ActionChanged
{
    std::string actionID;
    std::string actionType;
    EActionStatus status = EActionStatus::Waiting;
    std::string resultDescription;

    bool operator==(const ActionChanged&) const = default;
};

/// An action that was seen, or belonged to an order that has ended, and whose end nobody will hear of any more.
struct ActionLost
{
    std::string actionID;
    std::string actionType;
    std::string reason;

    bool operator==(const ActionLost&) const = default;
};

/// The vehicle refuses an instant action by an error, or never showed it.
struct InstantActionRejected
{
    std::string actionID;
    std::string errorType;
    std::string reason;

    bool operator==(const InstantActionRejected&) const = default;
};

/// Everything released is done and there was no horizon: nothing left to reach, every action ended.
struct OrderFinished
{
    std::string orderID;

    bool operator==(const OrderFinished&) const = default;
};

/// The order ended by Cancel; the vehicle is ready for another.
struct OrderCancelled
{
    std::string orderID;

    bool operator==(const OrderCancelled&) const = default;
};

/// The vehicle has taken an order that was cancelled before it had seen it, or rejected, or never shown (OrderRejected): a
/// message that came late. Where it still runs it is cancelled once more by itself, and the end of that is told as that of
/// any cancel; else OrderFinished follows.
struct OrderReappeared
{
    std::string orderID;

    bool operator==(const OrderReappeared&) const = default;
};

/// The cancelOrder action failed though the vehicle still holds the order, or was refused.
struct CancelFailed
{
    std::string orderID;
    std::string reason;

    bool operator==(const CancelFailed&) const = default;
};

/// The vehicle dropped the order by itself: restarted, taken over by hand, or given another order by somebody else.
struct OrderLost
{
    std::string orderID;
    std::string reason;

    bool operator==(const OrderLost&) const = default;
};

/// An error that is in this state and was not in the one before (or no longer is).
struct VehicleErrorChanged
{
    VehicleError error;
    bool bActive = false;

    bool operator==(const VehicleErrorChanged&) const = default;
};

/// A payload that could not be read, counted and left out.
struct MessageRefused
{
    ETopic topic = ETopic::State;
    Core::Error error;

    bool operator==(const MessageRefused&) const = default;
};

/// What a MasterSession asks for (the first three) and tells.
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

using MasterActions = std::vector<MasterAction>;

} // namespace ACS::VDA5050
