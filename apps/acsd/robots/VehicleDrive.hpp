#pragma once

#include <acs/core/Result.hpp>
#include <acs/plan/RobotCommand.hpp>
#include <acs/vda5050/OrderBuilder.hpp>
#include <acs/vda5050/OrderMessage.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <variant>

namespace ACS::Acsd
{

/// One drive as an order of a VDA5050 vehicle: its route, the nodes that the engine has released, and the message that the
/// vehicle has not confirmed yet.
class VehicleDrive final
{
    /// The order itself is not confirmed.
    struct OrderPending
    {
    };

    struct UpdatePending
    {
        VDA5050::OrderMessage update;
    };

    /// The vehicle has confirmed the latest message.
    struct Confirmed
    {
    };

    VDA5050::OrderBuilder _route;
    std::size_t _wantedReleased; ///< Number of nodes that the engine has released.
    std::variant<OrderPending, UpdatePending, Confirmed> _message;
    std::string _lastPassedNodeID;
    bool _bShortUpdate = false; ///< The vehicle has rejected an update, and has confirmed none since.
    std::optional<std::string> _abandonReason;

    VehicleDrive(VDA5050::OrderBuilder route, std::size_t wantedReleased);

public:
    /// Fails with InvalidOrder.
    [[nodiscard]] static Core::Result<VehicleDrive> Create(const Planning::Drive& drive);

    /// The first message. Fails with InvalidOrder.
    [[nodiscard]] Core::Result<VDA5050::OrderMessage> MakeOrder();
    void Extend(std::size_t releasedCount);
    /// The engine has released more than the vehicle knows, the vehicle has confirmed the latest message, and the drive is
    /// not abandoned.
    [[nodiscard]] bool IsUpdateDue() const;
    /// Fails with InvalidOrder.
    [[nodiscard]] Core::Result<VDA5050::OrderMessage> MakeUpdate();
    /// The update was sent.
    void OnUpdateSent(VDA5050::OrderMessage update);
    /// The vehicle has confirmed the latest message.
    void OnConfirmed();
    /// The vehicle has rejected the update: the next one is as short as possible. False: this was the short one.
    [[nodiscard]] bool TryShortenUpdate();
    void OnNodePassed(std::string nodeID);

    /// The drive is being cancelled for this reason. It is reported as rejected when the vehicle has stopped.
    void Abandon(std::string reason);
    [[nodiscard]] const std::optional<std::string>& GetAbandonReasonOrNull() const noexcept;

    [[nodiscard]] const std::string& GetOrderID() const noexcept;
    [[nodiscard]] const std::string& GetLastPassedNodeID() const noexcept;
    /// Nodes of the route are not released yet.
    [[nodiscard]] bool HasHorizon() const noexcept;
    /// The update that the vehicle has not confirmed; null where there is none.
    [[nodiscard]] const VDA5050::OrderMessage* GetPendingUpdateOrNull() const noexcept;
};

} // namespace ACS::Acsd
