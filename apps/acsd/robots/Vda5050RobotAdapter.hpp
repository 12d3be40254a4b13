#pragma once

#include "robots/IMqttRobotAdapter.hpp"
#include "robots/JobMethods.hpp"
#include "robots/LoadCheck.hpp"
#include "robots/RobotOutputs.hpp"
#include "robots/VehicleJobCheck.hpp"
#include <acs/core/Now.hpp>
#include <acs/vda5050/MasterSession.hpp>
#include <acs/vda5050/OrderBuilder.hpp>

#include <tl/expected.hpp>

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsd
{

/// Joins a VDA5050 vehicle to the engine. A drive is an order, its extensions are order updates; a job is an order of
/// the single node where the vehicle stands, with one action whose actionId is the jobId. Pure: what has to be sent goes
/// into the outputs.
class Vda5050RobotAdapter final : public IMqttRobotAdapter
{
    /// An order that waits until the vehicle has finished the one before.
    struct PendingOrder
    {
        VDA5050::OrderMessage order;
    };

    /// The session has the numbers of its own timers, which are fewer.
    static constexpr Planning::AdapterTimerID LOAD_TIMER = 50;
    static constexpr std::chrono::milliseconds LOAD_TIMEOUT{10'000};
    static constexpr Planning::AdapterTimerID FACTSHEET_TIMER = 51;
    /// For the answer to the first factsheetRequest. Then the vehicle counts as one that publishes none.
    static constexpr std::chrono::milliseconds FACTSHEET_TIMEOUT{5'000};

    bool _bFactsheetAwaited;
    VDA5050::MasterSession _session;
    JobMethods _methods;
    std::shared_ptr<const VehicleJobCheck> _jobCheck;
    RobotOutputs& _outputs;
    std::chrono::milliseconds _loadTimeout;
    VDA5050::MasterActions _sessionActions;

    bool _bOnline = false;
    Planning::StateChanged _state;
    bool _bPoseInState = false;                  ///< The latest state had a position.
    std::optional<VDA5050::OrderBuilder> _route; ///< Of the present drive.
    std::size_t _wantedReleased = 0;             ///< Nodes that the engine has released.
    bool _bUpdateUnderWay = false;               ///< The vehicle has not shown the last message of the drive yet.
    std::string _lastPassedNodeID;
    std::optional<Planning::StartJob> _job; ///< The vehicle knows it by its commandID, as order and as action.
    bool _bJobStarted = false;
    std::optional<Planning::StartJob> _deferredJob; ///< Until the factsheet has come, or is awaited no longer.
    std::optional<LoadCheck> _loadCheck; ///< Of a job whose action is finished and whose loads do not show it yet.
    std::optional<PendingOrder> _pendingOrder;
    std::optional<Planning::RecoverJob> _recovery;    ///< Asked for, and the vehicle has not told its state yet.
    std::optional<VDA5050::OrderMessage> _lastUpdate; ///< Sent and not shown yet.
    std::optional<std::string> _lossReason;           ///< Why the present drive is given up; told when it is cancelled.
    bool _bPauseDone = false; ///< startPause was done and stopPause not, of a vehicle whose state does not say paused.
    std::string _foreignOrderID; ///< Of an order that is not ours and was asked to be cancelled.

    void StartDrive(const Planning::Drive& drive, Core::Now now, Planning::AdapterActions& out);
    void StartJob(const Planning::StartJob& job, Core::Now now, Planning::AdapterActions& out);
    [[nodiscard]] VDA5050::OrderMessage MakeJobOrder(const Planning::StartJob& job, VDA5050::Action action) const;
    void OnJobDone(Planning::AdapterActions& out);
    void VerifyLoads(Planning::AdapterActions& out);
    void OnLoadTimeout(Planning::AdapterActions& out);
    void DropLoadCheck(Planning::AdapterActions& out);

    /// What the vehicle's state says of a job that was commanded before a restart.
    void FindJob(Core::Now now, Planning::AdapterActions& out);
    /// Goes on with the order of the job, which the vehicle shows, as if this adapter had sent it.
    void TakeUp(const Planning::StartJob& job, Core::Now now, Planning::AdapterActions& out);
    void CancelOrder(std::string_view id, Core::Now now, Planning::AdapterActions& out);
    void SendInstantAction(std::string_view actionType, Core::Now now);
    void SendPendingOrder(Core::Now now, Planning::AdapterActions& out);
    void SendPendingUpdate(Core::Now now, Planning::AdapterActions& out);
    void RefuseOrder(const std::string& orderID, const std::string& reason, Planning::AdapterActions& out);

    /// The vehicle holds the drive and will not be brought further: it is told as refused once it stands.
    void GiveDriveUp(const std::string& reason, Core::Now now, Planning::AdapterActions& out);

    /// Whether the vehicle works on an order that this adapter did not give it, or gave it before a restart. What is left
    /// to drive is cancelled, once per order; running actions come to their end.
    [[nodiscard]] bool IsOccupied(const VDA5050::StateMessage& state) const;
    void CancelForeignOrder(Core::Now now);
    [[nodiscard]] bool IsJobRunning(const VDA5050::StateMessage& state) const;
    void FollowPauseActions(const VDA5050::StateMessage& state);
    void TakeCancelled(const std::string& orderID, Planning::AdapterActions& out);
    void TakeCancelFailed(Core::Now now, Planning::AdapterActions& out);
    void TakeRejected(const VDA5050::OrderRejected& rejected, Core::Now now, Planning::AdapterActions& out);

    /// Carries out what the session asked for, and tells the engine what it told.
    void Drain(Core::Now now, Planning::AdapterActions& out);
    void Take(const VDA5050::MasterAction& action, Core::Now now, Planning::AdapterActions& out);
    void TakeState(Core::Now now, Planning::AdapterActions& out);
    void TakePosition(const VDA5050::PositionReceived& received, Planning::AdapterActions& out);
    void TakeAction(const VDA5050::ActionChanged& action, Planning::AdapterActions& out);
    void TakeFinished(const std::string& orderID, Planning::AdapterActions& out);
    void SetOnline(bool bOnline, Planning::AdapterActions& out);
    /// The factsheet has come, or is awaited no longer.
    void OnFactsheet(Core::Now now, Planning::AdapterActions& out);
    void UpdateJobCheck(Planning::AdapterActions& out);

public:
    /// The outputs must outlive the adapter. The time limit is for the loads to agree with a job whose action is finished.
    Vda5050RobotAdapter(
        VDA5050::MasterOptions options,
        JobMethods methods,
        RobotOutputs& outputs,
        std::chrono::milliseconds loadTimeout = LOAD_TIMEOUT);

    void Handle(const Planning::RobotCommand& command, Core::Now now, Planning::AdapterActions& out) override;
    void OnTimer(Planning::AdapterTimerID timer, Core::Now now, Planning::AdapterActions& out) override;
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(std::string_view action) const override;

    [[nodiscard]] std::vector<VDA5050::MqttSubscription> GetSubscriptions() const override;
    void OnLinkUp(Core::Now now, Planning::AdapterActions& out) override;
    void OnLinkDown(Core::Now now, Planning::AdapterActions& out) override;
    void OnMqttMessage(const VDA5050::MqttMessage& message, Core::Now now, Planning::AdapterActions& out) override;

    [[nodiscard]] const VDA5050::MasterSession& GetSession() const noexcept override;
};

} // namespace ACS::Acsd
