#pragma once

#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>
#include <acs/plan/RobotCommand.hpp>
#include <acs/vda5050/OrderBuilder.hpp>
#include <acs/vda5050/OrderMessage.hpp>

#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsd
{

/// The node's position in an order.
[[nodiscard]] VDA5050::NodePosition MakeNodePosition(const Planning::RouteNode& node);

/// What the order of a drive has, besides the route.
struct DriveContents
{
    std::vector<Planning::SiteAction> startActions = {}; ///< Of the first node, instead of those of the route.
    bool bCorridors = true;
};

/// One drive as an order of a VDA5050 vehicle: its route, the nodes that the engine has released, and whether the
/// vehicle has confirmed the latest message.
class VehicleDrive final
{
public:
    /// An error whose path begins with "max" means that the message is too large.
    using OrderCheck = std::function<Core::Result<void>(const VDA5050::OrderMessage&)>;
    /// Time from a refused cancelOrder to the next one at the same node. A vehicle reports each refusal by a state.
    static constexpr std::chrono::seconds CANCEL_PAUSE{10};

private:
    /// A REQUIRED action of the map that the vehicle has not finished.
    struct OpenAction
    {
        std::string actionID;
        std::string text; ///< What it is, for people.
        /// With this action alone; absent for an action of an edge.
        std::optional<Planning::RouteNode> node;
    };

    VDA5050::OrderBuilder _route;
    std::size_t _wantedReleased; ///< Number of nodes that the engine has released.
    bool _bConfirmed = false;    ///< The vehicle has confirmed or rejected the latest message.
    std::size_t _passedCount = 0;
    std::string _lastPassedNodeID;
    bool _bShortUpdate = false; ///< The vehicle has rejected an update, and has confirmed none since.
    std::optional<std::string> _abandonReason;
    std::optional<Core::SteadyTime> _cancelRefusedAt; ///< Since it passed its last node.
    std::optional<std::string> _failure;
    std::vector<OpenAction> _openActions;

    VehicleDrive(VDA5050::OrderBuilder route, std::size_t wantedReleased);

public:
    /// Fails with InvalidOrder.
    [[nodiscard]] static Core::Result<VehicleDrive> Create(
        const Planning::Drive& drive,
        const DriveContents& contents = {});

    /// The first message, with as many of the released nodes as the check accepts, at least two. Fails with the error of the check,
    /// or with InvalidOrder.
    [[nodiscard]] Core::Result<VDA5050::OrderMessage> MakeOrder(const OrderCheck& check);
    void Extend(std::size_t releasedCount);
    /// The engine has released more than the vehicle knows, the vehicle has confirmed the latest message, and the drive is
    /// not abandoned.
    [[nodiscard]] bool IsUpdateDue() const;
    /// With as many further nodes as the check accepts, at least one. Fails with the error of the check, or with InvalidOrder.
    [[nodiscard]] Core::Result<VDA5050::OrderMessage> MakeUpdate(const OrderCheck& check);
    /// The vehicle still has nodes to pass. What does not fit beside them may fit later.
    [[nodiscard]] bool HasNodesAhead() const;
    /// The update was sent.
    void OnUpdateSent();
    /// The vehicle has confirmed the latest message.
    void OnConfirmed();
    /// The vehicle has rejected the update: the next one is as short as possible. False: this was the short one.
    [[nodiscard]] bool TryShortenUpdate();
    void OnNodePassed(std::string nodeID);
    void OnActionFinished(std::string_view actionID);
    /// In the state with which the order ended. If it was cancelled, that is why the action failed.
    void OnActionFailed(std::string reason);
    /// What the unfinished action is, for people; null if the drive has no such action.
    [[nodiscard]] const std::string* FindOpenActionOrNull(std::string_view actionID) const;
    /// Likewise of the first unfinished action.
    [[nodiscard]] const std::string* GetOpenActionOrNull() const noexcept;
    /// The node that the vehicle passed last, with its unfinished actions; nullopt if it has none.
    [[nodiscard]] std::optional<Planning::RouteNode> GetOpenNodeOrNull() const;

    /// The drive is being cancelled for this reason. It is reported as rejected when the vehicle has stopped.
    void Abandon(std::string reason);
    [[nodiscard]] const std::optional<std::string>& GetAbandonReasonOrNull() const noexcept;
    /// The vehicle has refused to cancel it.
    void OnCancelRefused(Core::Now now);
    /// It is abandoned, and the vehicle has passed a node or CANCEL_PAUSE has elapsed since it refused to cancel it.
    [[nodiscard]] bool IsCancelDue(Core::Now now) const;
    /// Why the drive was not executed although the vehicle has reached its end: it is abandoned, or an action failed.
    [[nodiscard]] const std::optional<std::string>& GetFailureOrNull() const noexcept;

    [[nodiscard]] const std::string& GetOrderID() const noexcept;
    [[nodiscard]] const std::string& GetLastPassedNodeID() const noexcept;
    /// Nodes of the route are not released yet.
    [[nodiscard]] bool HasHorizon() const noexcept;

private:
    [[nodiscard]] Core::Result<VDA5050::OrderMessage> MakeFitting(std::size_t leastReleased, const OrderCheck& check);
};

} // namespace ACS::Acsd
