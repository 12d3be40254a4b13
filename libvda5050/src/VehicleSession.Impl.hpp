#pragma once

#include "ActionBook.hpp"
#include "ActionFault.hpp"
#include "HeldOrder.hpp"
#include "OwnerReports.hpp"
#include "PauseControl.hpp"
#include "RouteDrive.hpp"
#include "SessionErrors.hpp"
#include "StateSchedule.hpp"
#include "VehicleTopics.hpp"
#include <acs/vda5050/VehicleSession.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::VDA5050
{

/// Routes each input to the parts that it concerns, and what one of them has found out to the next.
class VehicleSession::Impl
{
    VehicleOptions _options;
    VehicleTopics _topics{_options};
    StateSchedule _schedule{_options};
    OwnerReports _reports{_options};
    SessionErrors _errors;
    HeldOrder _order;
    RouteDrive _drive{_options.initialNodeID};
    ActionBook _actions{_options.factsheet};
    PauseControl _pause;

public:
    explicit Impl(VehicleOptions options);

    [[nodiscard]] MqttWill MakeWill(Core::Now now);
    void OnLinkUp(Core::Now now, VehicleActions& out);
    void OnLinkDown(Core::Now now, VehicleActions& out);
    void Leave(Core::Now now, VehicleActions& out);
    void OnMessage(
        std::string_view topic,
        std::string_view payload,
        bool bRetained,
        Core::Now now,
        VehicleActions& out);
    void OnTimer(EVehicleTimer timer, Core::Now now, VehicleActions& out);
    bool TryReachNode(NodeArrival arrival, Core::Now now, VehicleActions& out);
    bool TrySetLastNode(std::string nodeID, Core::Now now, VehicleActions& out);
    bool TrySetOutsideCorridor(bool bOutside, Core::Now now, VehicleActions& out);
    bool TrySetTrajectory(std::uint32_t edgeSequenceID, Trajectory trajectory, Core::Now now, VehicleActions& out);
    void OnDrivingChanged(bool bDriving, Core::Now now, VehicleActions& out);
    bool TrySetActionStatus(
        std::string_view actionID,
        EActionStatus status,
        std::string resultDescription,
        Core::Now now,
        VehicleActions& out);
    void OnHardwarePause(bool bPaused, bool bOverridesMaster, Core::Now now, VehicleActions& out);
    void OnOperatingMode(EOperatingMode mode, Core::Now now, VehicleActions& out);
    /// Ends a change of the reports: requests a state if one must show it soon.
    void Settle(bool bChanged, Core::Now now, VehicleActions& out);
    [[nodiscard]] OwnerReports& GetReports() noexcept;
    [[nodiscard]] const VehicleTopics& GetTopics() const noexcept;
    [[nodiscard]] StateMessage GetState() const;
    [[nodiscard]] bool IsPaused() const noexcept;
    [[nodiscard]] bool IsOrderRunning() const noexcept;

private:
    void OnOrder(std::string_view payload, VehicleActions& out);
    void OnInstantActions(std::string_view payload, Core::Now now, VehicleActions& out);
    void RefusePayload(ETopic topic, std::string_view payload, const Core::Error& error, VehicleActions& out);
    [[nodiscard]] bool ShouldAccept(ETopic topic, const Header& header, VehicleActions& out);

    // The order.
    [[nodiscard]] OrderContext MakeContext() const;
    void AcceptOrder(OrderMessage order, VehicleActions& out);
    void AcceptUpdate(OrderMessage order, VehicleActions& out);
    void AppendElements(OrderMessage order);
    void AddActions(
        const std::vector<Action>& actions,
        EActionScope scope,
        const std::string& elementID,
        std::uint32_t sequenceID);
    void Advance(VehicleActions& out);
    void StartQueuedActions(VehicleActions& out);
    void ContinueDriving(VehicleActions& out);
    void LeaveEdge(std::vector<EdgeActionEnd> ends, VehicleActions& out);
    void PassFrontNode();
    void ClearOrder(bool bNodeLeft, VehicleActions& out);
    void SetLastNode(std::string nodeID);
    [[nodiscard]] bool IsExecuting() const;

    // Actions.
    /// One that cannot succeed, by what the session knows itself, fails instead.
    void Start(ReportedAction& tracked, VehicleActions& out);
    bool TryChangeStatus(
        ReportedAction& tracked,
        EActionStatus status,
        std::string resultDescription,
        VehicleActions& out);
    void OnActionFailed(const ReportedAction& failed, VehicleActions& out);
    void ReportUnlistedParameters(const Action& action, ETopic topic);
    [[nodiscard]] bool TryHandleInstantAction(
        const Action& action,
        const Header& header,
        bool bTooMany,
        Core::Now now,
        VehicleActions& out);
    [[nodiscard]] std::optional<ActionFault> FindRefusalOrNull(const Action& action, bool bTooMany) const;
    void PerformInstantAction(const Action& action, const Header& header, Core::Now now, VehicleActions& out);
    void FailInstantAction(
        const Action& action,
        const Header& header,
        std::string_view errorType,
        const ActionFault& fault);
    void ChangePause(const Action& action, const Header& header, VehicleActions& out);
    /// After a change of what pauses the vehicle.
    void FollowPause(bool bWasPaused, VehicleActions& out);
    void StartCancel(const Action& action, const Header& header, VehicleActions& out);
    /// Ends what waits until the vehicle is stationary: startPause, cancelOrder.
    void FinishIfStationary(VehicleActions& out);

    void PublishState(Core::Now now, VehicleActions& out);
    void PublishFactsheet(Core::Now now, VehicleActions& out);
    /// Ends each public call: sends a state that has become due, now or after the minimum interval.
    void Settle(Core::Now now, VehicleActions& out);
};

} // namespace ACS::VDA5050
