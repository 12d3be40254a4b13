#pragma once

#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>
#include <acs/vda5050/Action.hpp>
#include <acs/vda5050/FactsheetMessage.hpp>
#include <acs/vda5050/IMqttLink.hpp>
#include <acs/vda5050/OrderMessage.hpp>
#include <acs/vda5050/Topic.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace ACS::VDA5050
{

/// Timers of a VehicleSession.
enum class EVehicleTimer : std::uint8_t
{
    MinimumStateInterval, ///< A change waits until a state may be sent again.
    MaximumStateInterval, ///< A state is due although nothing changed.
    Visualization,        ///< The next visualization is due.
};

/// Call OnTimer after the delay. Replaces a running timer of the same name.
struct StartVehicleTimer
{
    EVehicleTimer timer = EVehicleTimer::MaximumStateInterval;
    Core::Duration delay{};

    bool operator==(const StartVehicleTimer&) const = default;
};

/// Do not call OnTimer for this timer.
struct CancelVehicleTimer
{
    EVehicleTimer timer = EVehicleTimer::MaximumStateInterval;

    bool operator==(const CancelVehicleTimer&) const = default;
};

/// The leg after a node that is passed without a stop.
struct NextLeg
{
    OrderEdge edge; ///< From the node to the next one.
    OrderNode node; ///< The end of the edge.

    bool operator==(const NextLeg&) const = default;
};

/// Drive along the edge to its end node, then call TryReachNode with the node's sequenceID; if it stops there, once it is
/// stationary. One leg at a time. A repeated sequenceID changes only bStopAtNode while driving, and resumes the drive after
/// StopDriving.
struct DriveTo
{
    OrderEdge edge;          ///< With its limits, corridor and trajectory.
    OrderNode node;          ///< The end of the edge.
    bool bStopAtNode = true; ///< False: the next leg is released and the node has no actions: do not brake.
    /// Set if the vehicle does not stop: gives the speed and heading it needs at the node. The DriveTo of this leg follows
    /// at the node.
    std::optional<NextLeg> next;

    bool operator==(const DriveTo&) const = default;
};

/// Stop at once, wherever the vehicle is; then call OnDrivingChanged(false).
struct StopDriving
{
    bool operator==(const StopDriving&) const = default;
};

/// Perform the action and report with TrySetActionStatus: Initializing or Running, then Finished or Failed.
struct StartAction
{
    Action action;                           ///< With its parameters, as in the order or the instantActions message.
    EActionScope scope = EActionScope::Node; ///< Whether it belongs to a node, to an edge, or is an instant action.
    std::string elementID;                   ///< The node's or the edge's id; empty for an instant action.
    std::uint32_t sequenceID = 0;

    bool operator==(const StartAction&) const = default;
};

/// Pause the action if possible, then call TrySetActionStatus(Paused); an action that cannot be paused continues.
struct PauseAction
{
    std::string actionID;

    bool operator==(const PauseAction&) const = default;
};

/// Resume the action, then call TrySetActionStatus(Running).
struct ResumeAction
{
    std::string actionID;

    bool operator==(const ResumeAction&) const = default;
};

/// End the action now (Failed), or let it finish if it cannot be interrupted.
struct StopAction
{
    std::string actionID;
    /// Its edge has ended, and NodeArrival did not contain it: it is FAILED already. Otherwise the order was cancelled.
    bool bEdgeEnded = false;

    bool operator==(const StopAction&) const = default;
};

/// Event: an order or an order update was accepted.
struct OrderTaken
{
    std::string orderID;
    std::uint32_t orderUpdateID = 0;
    bool bUpdate = false; ///< It extends the current order.

    bool operator==(const OrderTaken&) const = default;
};

/// Event: a message was refused; the errors are in the state.
struct OrderRefused
{
    std::string orderID;
    std::uint32_t orderUpdateID = 0;
    std::string errorType;
    std::string reason;

    bool operator==(const OrderRefused&) const = default;
};

/// Event: all nodes are reached and all actions have ended.
struct OrderCompleted
{
    std::string orderID;

    bool operator==(const OrderCompleted&) const = default;
};

/// Event: the order was cancelled (by master control or by a change of the operating mode).
struct OrderCleared
{
    std::string orderID;

    bool operator==(const OrderCleared&) const = default;
};

/// Event: a message was ignored (another vehicle's name in its header, retained, unreadable).
struct MessageIgnored
{
    ETopic topic = ETopic::Order; ///< That of the message.
    Core::Error error;            ///< Why, with the JSON path.

    bool operator==(const MessageIgnored&) const = default;
};

/// Requests and events of a VehicleSession.
using VehicleAction = std::variant<
    PublishMessage,
    StartVehicleTimer,
    CancelVehicleTimer,
    DriveTo,
    StopDriving,
    StartAction,
    PauseAction,
    ResumeAction,
    StopAction,
    OrderTaken,
    OrderRefused,
    OrderCompleted,
    OrderCleared,
    MessageIgnored>;

/// To be carried out in order.
using VehicleActions = std::vector<VehicleAction>;

} // namespace ACS::VDA5050
