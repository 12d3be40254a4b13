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

enum class EVehicleTimer : std::uint8_t
{
    MinimumStateInterval, ///< A change waits until a state may be sent again.
    MaximumStateInterval, ///< A state is due although nothing changed.
    Visualization,
};

/// To do: call OnTimer after the delay; replaces a running timer of the same name.
struct StartVehicleTimer
{
    EVehicleTimer timer = EVehicleTimer::MaximumStateInterval;
    Core::Duration delay{};

    bool operator==(const StartVehicleTimer&) const = default;
};

struct CancelVehicleTimer
{
    EVehicleTimer timer = EVehicleTimer::MaximumStateInterval;

    bool operator==(const CancelVehicleTimer&) const = default;
};

/// The leg behind a node that is passed without a stop.
struct NextLeg
{
    OrderEdge edge;
    OrderNode node;

    bool operator==(const NextLeg&) const = default;
};

/// To do: drive along the edge to its end node, then call TryReachNode with the node's sequenceID. One leg at a time.
/// The same sequenceID again, while on the way: only bStopAtNode has changed; after StopDriving: drive on.
struct DriveTo
{
    OrderEdge edge;
    OrderNode node;
    bool bStopAtNode = true; ///< False: the next leg is released and nothing is to be done at the node: do not brake.
    /// Just where it does not stop: how fast and how turned the vehicle has to be there. Its own DriveTo follows at the
    /// node.
    std::optional<NextLeg> next;

    bool operator==(const DriveTo&) const = default;
};

/// To do: stand still, wherever that is; OnDrivingChanged(false) follows.
struct StopDriving
{
    bool operator==(const StopDriving&) const = default;
};

/// To do: perform it, and tell with TrySetActionStatus: Initializing or Running, then Finished or Failed.
struct StartAction
{
    Action action;
    EActionScope scope = EActionScope::Node;
    std::string elementID; ///< The node's or the edge's id; empty for an instant action.
    std::uint32_t sequenceID = 0;

    bool operator==(const StartAction&) const = default;
};

/// To do, if it can be: TrySetActionStatus(Paused) follows; an action that cannot be paused goes on.
struct PauseAction
{
    std::string actionID;

    bool operator==(const PauseAction&) const = default;
};

/// To do: TrySetActionStatus(Running) follows.
struct ResumeAction
{
    std::string actionID;

    bool operator==(const ResumeAction&) const = default;
};

/// To do: end it now (Failed), or let it end by itself if it cannot be interrupted. At the end of its edge an action
/// that has no goal of its own ends with Finished.
struct StopAction
{
    std::string actionID;
    bool bEdgeEnded = false; ///< Else the order was cancelled.

    bool operator==(const StopAction&) const = default;
};

/// Told: a new order, or an update of it, was taken.
struct OrderTaken
{
    std::string orderID;
    std::uint32_t orderUpdateID = 0;
    bool bUpdate = false;

    bool operator==(const OrderTaken&) const = default;
};

/// Told: a message was refused; the errors are in the state.
struct OrderRefused
{
    std::string orderID;
    std::uint32_t orderUpdateID = 0;
    std::string errorType;
    std::string reason;

    bool operator==(const OrderRefused&) const = default;
};

/// Told: nothing left to reach, every action ended.
struct OrderCompleted
{
    std::string orderID;

    bool operator==(const OrderCompleted&) const = default;
};

/// Told: the order was cancelled (by master control or by a change of the operating mode).
struct OrderCleared
{
    std::string orderID;

    bool operator==(const OrderCleared&) const = default;
};

/// Told: a message that was ignored, and why (another vehicle's name in its header, retained, unreadable).
struct MessageIgnored
{
    ETopic topic = ETopic::Order;
    Core::Error error;

    bool operator==(const MessageIgnored&) const = default;
};

/// What a VehicleSession asks of its owner, and tells him.
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

using VehicleActions = std::vector<VehicleAction>;

} // namespace ACS::VDA5050
