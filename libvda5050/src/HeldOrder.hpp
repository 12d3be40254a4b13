#pragma once

#include <acs/vda5050/OrderMessage.hpp>
#include <acs/vda5050/OrderValidator.hpp>
#include <acs/vda5050/StateMessage.hpp>
#include <acs/vda5050/VehicleAction.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace ACS::VDA5050
{

/// The order that a vehicle holds, running or not, and the cancelOrder actions that wait for its end.
class HeldOrder
{
    enum class EProgress : std::uint8_t
    {
        Idle,    ///< None, or OrderCompleted was sent.
        Running, ///< Accepted, and OrderCompleted not sent.
        Cleared, ///< Cancelled, and perhaps not on lastNodeId.
    };

    std::string _orderID;
    std::string _zoneSetID;
    std::uint32_t _orderUpdateID = 0;
    EProgress _progress = EProgress::Idle;
    bool _bHeldByFailure = false; ///< A critical action failed.
    std::vector<std::string> _cancelActionIDs;

public:
    void Accept(const OrderMessage& order, VehicleActions& out);
    void AcceptUpdate(const OrderMessage& update, VehicleActions& out);
    /// Nothing is left to execute.
    void Complete(VehicleActions& out);
    void HoldByFailure();
    /// True: the first cancel of the order.
    [[nodiscard]] bool TryBeginCancel(std::string actionID);
    /// Returns the cancelOrder actions, which have succeeded. bNodeLeft: the vehicle may have left lastNodeId.
    [[nodiscard]] std::vector<std::string> Clear(bool bNodeLeft, VehicleActions& out);
    /// The vehicle is on a node again, according to the owner.
    void OnLastNodeSet();
    void Forget();

    [[nodiscard]] const std::string& GetOrderID() const noexcept;
    [[nodiscard]] bool IsRunning() const noexcept;
    [[nodiscard]] bool IsCancelling() const noexcept;
    [[nodiscard]] bool IsHeldByFailure() const noexcept;
    void Fill(StateMessage& state) const;
    void Fill(OrderContext& context) const;

private:
    void Run(const OrderMessage& message, bool bUpdate, VehicleActions& out);
};

} // namespace ACS::VDA5050
