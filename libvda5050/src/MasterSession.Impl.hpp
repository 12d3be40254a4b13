#pragma once

#include "AcceptedRoute.hpp"
#include "ActionIndex.hpp"
#include "FactsheetRules.hpp"
#include "MasterTopics.hpp"
#include "OrderOutbox.hpp"
#include "PendingActions.hpp"
#include "TrackedActions.hpp"
#include "VehicleView.hpp"
#include "WithdrawnOrders.hpp"
#include <acs/vda5050/MasterSession.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ACS::VDA5050
{

/// Routes each input to the parts that it concerns, and what one of them has found out to the next.
class MasterSession::Impl
{
    const MasterOptions _options;
    MasterTopics _topics{_options};
    FactsheetRules _rules{_options};
    VehicleView _vehicle;

    // The order of this session.
    std::string _orderID; ///< Empty: none runs.
    OrderOutbox _outbox{_options};
    AcceptedRoute _route;
    std::string _cancelActionID; ///< Empty unless the order is being cancelled.
    bool _bHorizonOmitted = false;

    WithdrawnOrders _withdrawnOrders;
    TrackedActions _actions;
    PendingActions _pendingActions;
    std::uint32_t _ownActionCount = 0;

public:
    explicit Impl(MasterOptions options);

    void OnLinkUp(Core::Now now, MasterActions& out);
    void OnLinkDown(Core::Now now, MasterActions& out);
    void OnMessage(std::string_view topic, std::string_view payload, bool bRetained, Core::Now now, MasterActions& out);
    void OnTimer(EMasterTimer timer, Core::Now now, MasterActions& out);
    /// Changes the order to what the vehicle takes. True: it continues with nodes that are not in its base.
    [[nodiscard]] Core::Result<bool> Prepare(OrderMessage& order, Core::Now now) const;
    [[nodiscard]] Core::Result<void> SendOrder(OrderMessage order, Core::Now now, MasterActions& out);
    void SetHorizonOmitted(bool bOmitted) noexcept;
    [[nodiscard]] Core::Result<void> SendOrderUpdate(OrderMessage update, Core::Now now, MasterActions& out);
    [[nodiscard]] Core::Result<void> ResumeOrder(OrderRecord record, Core::Now now, MasterActions& out);
    [[nodiscard]] Core::Result<std::string> SendInstantAction(Action action, Core::Now now, MasterActions& out);
    [[nodiscard]] bool TryWithdrawInstantAction(std::string_view actionID);
    [[nodiscard]] bool IsOrderSent() const noexcept;
    [[nodiscard]] Core::Result<void> Cancel(Core::Now now, MasterActions& out);
    [[nodiscard]] std::vector<ReservedElement> ListReserved() const;
    [[nodiscard]] EOrderPhase GetOrderPhase() const noexcept;
    [[nodiscard]] const std::string& GetOrderID() const noexcept;
    [[nodiscard]] bool CanTakeOrder() const;
    [[nodiscard]] const MasterTopics& GetTopics() const noexcept;
    [[nodiscard]] const FactsheetRules& GetRules() const noexcept;
    [[nodiscard]] const VehicleView& GetVehicle() const noexcept;
    [[nodiscard]] const MasterOptions& GetOptions() const noexcept;

private:
    void OnConnection(std::string_view payload, bool bRetained, Core::Now now, MasterActions& out);
    void OnState(std::string_view payload, Core::Now now, MasterActions& out);
    void OnVisualization(std::string_view payload, MasterActions& out);
    void OnVehicleOnline(Core::Now now, MasterActions& out);

    void SettleInFlight(const ActionIndex& shown, MasterActions& out);
    void RejectInFlight(const std::string& errorType, const std::string& reason, MasterActions& out);
    void UpdateOrder(MasterActions& out);
    /// The vehicle, which has shown the order, shows none.
    void UpdateCleared(MasterActions& out);
    /// Reports the order as lost. An update of it may reach the vehicle late.
    void LoseAccepted(std::string reason, MasterActions& out);
    void UpdateCancel(MasterActions& out);
    void CancelReappeared(Core::Now now, MasterActions& out);
    void EndCancel(EActionStatus status, MasterActions& out);
    void EndOrder(MasterActions& out);
    [[nodiscard]] bool IsOrderDone() const;
    /// Whether the vehicle shows that the accepted order has ended, by its last node, but no longer the orderId.
    [[nodiscard]] bool IsClearedAtEnd() const;
    /// Whether the vehicle shows the end of the cancelOrder.
    [[nodiscard]] bool IsCancelAnswered() const;
    /// The number that the vehicle shows for the order; 0 without one.
    [[nodiscard]] std::uint32_t GetShownUpdateID() const;

    /// Sets the zone set of the options where the order has none.
    void SetZoneSet(OrderMessage& order) const;
    /// See FactsheetRules::FitOrder.
    [[nodiscard]] Core::Result<void> FitOrder(OrderMessage& order, Core::Now now) const;
    void BeginOrder(std::string orderID, OrderNumbers numbers);
    void AddToRoute(const OrderMessage& order, bool bUpdate);
    /// Whether the order, which the vehicle does not show, was accepted or may have been.
    [[nodiscard]] bool IsRecordLost(const OrderRecord& record) const;
    void ReportRecordLost(const OrderRecord& record, MasterActions& out);
    /// The start of an update: the last released node of the last message.
    [[nodiscard]] std::pair<std::string, std::uint32_t> GetDecisionPoint() const;
    /// Sends the message in flight, for the first time or once more, if the vehicle can receive it now.
    void PublishOrder(Core::Now now, MasterActions& out);

    void PublishInstantActions(std::vector<Action> actions, Core::Now now, MasterActions& out);
    void ResendInstantActions(Core::Now now, MasterActions& out);
    void RemoveTracked(const std::vector<std::string>& actionIDs);
    [[nodiscard]] std::string MakeActionID(std::string_view actionType, Core::Now now);
};

} // namespace ACS::VDA5050
