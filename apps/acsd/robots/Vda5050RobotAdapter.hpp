#pragma once

#include "robots/CommandedActions.hpp"
#include "robots/DriveCheck.hpp"
#include "robots/ForeignOrder.hpp"
#include "robots/IMqttRobotAdapter.hpp"
#include "robots/JobMethods.hpp"
#include "robots/OperatorActions.hpp"
#include "robots/RobotOutputs.hpp"
#include "robots/VehicleDrive.hpp"
#include "robots/VehicleJob.hpp"
#include "robots/VehicleJobCheck.hpp"
#include "robots/VehicleMaps.hpp"
#include "robots/VehicleRepetition.hpp"
#include "robots/VehicleReport.hpp"
#include <acs/core/Now.hpp>
#include <acs/vda5050/MasterSession.hpp>
#include <acs/vda5050/OrderMessage.hpp>

#include <tl/expected.hpp>

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsd
{

/// Connects a VDA5050 vehicle to the engine. A drive is an order, its extensions are order updates. A job is an order with
/// the vehicle's current node only and one action, whose actionId is the commandID. Pure: messages to be sent go into the
/// outputs.
class Vda5050RobotAdapter final : public IMqttRobotAdapter
{
public:
    static constexpr std::chrono::milliseconds LOAD_TIMEOUT{10'000};

private:
    /// Numbers below 50 are those of the session's own timers.
    static constexpr Planning::AdapterTimerID LOAD_TIMER = 50;
    static constexpr Planning::AdapterTimerID FACTSHEET_TIMER = 51;
    /// Maximum time to wait for the answer to the first factsheetRequest. After it the vehicle is treated as one without a
    /// factsheet.
    static constexpr std::chrono::milliseconds FACTSHEET_TIMEOUT{5'000};

    bool _bFactsheetAwaited;
    VDA5050::MasterSession _session;
    JobMethods _methods;
    std::shared_ptr<DriveCheck> _drives;
    std::shared_ptr<const VehicleJobCheck> _jobCheck;
    RobotOutputs& _outputs;
    std::chrono::milliseconds _loadTimeout;
    VDA5050::MasterActions _sessionActions;

    bool _bOnline = false;
    bool _bHorizonOmitted = false;
    VehicleMaps _maps;
    VehicleReport _report;
    std::optional<VehicleDrive> _drive;
    VehicleJob _job;
    std::optional<VDA5050::OrderMessage> _pendingOrder; ///< Sent when the vehicle has finished the order before.
    std::optional<Planning::Drive> _nextDrive; ///< Waits for the end of a cancelled repetition, which is the drive.
    std::string _incompatibility;              ///< As reported.
    VehicleRepetition _repetition;
    ForeignOrder _foreignOrder;
    OperatorActions _operatorActions;
    CommandedActions _commandedActions;

public:
    /// The outputs must outlive the adapter. loadTimeout: maximum time for the loads to agree with a job whose action is
    /// finished. The factsheet is compared with the map, and job orders have the positions of its nodes. maps: how the vehicle
    /// gets the maps of these nodes.
    Vda5050RobotAdapter(
        VDA5050::MasterOptions options,
        JobMethods methods,
        RobotOutputs& outputs,
        std::chrono::milliseconds loadTimeout = LOAD_TIMEOUT,
        std::shared_ptr<DriveCheck> drives = std::make_shared<DriveCheck>(),
        const std::vector<NeededMap>& maps = {});

    void Handle(const Planning::RobotCommand& command, Core::Now now, Planning::AdapterActions& out) override;
    void OnTimer(Planning::AdapterTimerID timer, Core::Now now, Planning::AdapterActions& out) override;
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(std::string_view action) const override;

    [[nodiscard]] std::vector<VDA5050::MqttSubscription> GetSubscriptions() const override;
    void OnLinkUp(Core::Now now, Planning::AdapterActions& out) override;
    void OnLinkDown(Core::Now now, Planning::AdapterActions& out) override;
    void OnMqttMessage(const VDA5050::MqttMessage& message, Core::Now now, Planning::AdapterActions& out) override;

    [[nodiscard]] tl::expected<std::string, RobotActionRefusal> RequestAction(
        const RobotActionRequest& request,
        Core::Now now,
        Planning::AdapterActions& out) override;
    [[nodiscard]] const VDA5050::MasterSession& GetSession() const noexcept override;

    /// The factsheet was requested and has not arrived: what may be sent is not known. JobCheckChanged is raised at the end.
    [[nodiscard]] bool IsFactsheetAwaited() const noexcept;

    /// A drive with the vehicle's node only, which repeats the actions of the node that have not finished; nullopt if it has none. For
    /// the caller to command before the job. The engine does not know it.
    [[nodiscard]] std::optional<Planning::Drive> MakeRepetitionOrNull(const Planning::StartJob& job);

private:
    void StartDrive(const Planning::Drive& drive, Core::Now now, Planning::AdapterActions& out);
    void ExtendDrive(const Planning::ExtendDrive& extension, Core::Now now, Planning::AdapterActions& out);
    void StartJob(const Planning::StartJob& job, Core::Now now, Planning::AdapterActions& out);
    /// Starts the job, or returns it to the engine.
    void ContinueJob(const VehicleJob::Deferred& deferred, Core::Now now, Planning::AdapterActions& out);
    void CancelJob(const std::string& jobID, Core::Now now, Planning::AdapterActions& out);
    /// The node that the vehicle reports, or that of the job if it reports none; empty: unknown.
    [[nodiscard]] std::string FindNodeID(const Planning::StartJob& job) const;
    [[nodiscard]] VDA5050::OrderMessage MakeJobOrder(const Planning::StartJob& job, VDA5050::Action action) const;
    void OnJobDone(Planning::AdapterActions& out);
    void VerifyLoads(Planning::AdapterActions& out);
    void OnLoadTimeout(Planning::AdapterActions& out);
    void DropLoadCheck(Planning::AdapterActions& out);
    /// The vehicle has ended the action of the running job before it was done.
    void InterruptJob(const std::string& reason, Planning::AdapterActions& out);
    /// Reports what became of an interrupted job, when the vehicle is in automatic mode again. bFinal: its loads have had their time.
    void EvaluateInterruption(bool bFinal, Planning::AdapterActions& out);

    /// Evaluates what the vehicle's state shows of a job that was commanded before a restart.
    void RecoverJob(Core::Now now, Planning::AdapterActions& out);
    /// Continues the order of the job, which the vehicle shows, as if this adapter had sent it.
    void ResumeJob(const Planning::StartJob& job, Core::Now now, Planning::AdapterActions& out);
    void CancelOrder(std::string_view id, Core::Now now, Planning::AdapterActions& out);
    /// Has the vehicle download or enable a map that it lacks.
    void RequestMap(Core::Now now);
    void SendPendingOrder(Core::Now now, Planning::AdapterActions& out);
    void SendPendingUpdate(Core::Now now, Planning::AdapterActions& out);
    /// The vehicle executes an order that is neither the drive nor the job of this adapter.
    [[nodiscard]] bool IsOccupied() const;
    [[nodiscard]] bool IsDrive(std::string_view orderID) const;
    [[nodiscard]] bool IsJob(std::string_view orderID) const;
    /// The order waits to be sent.
    [[nodiscard]] bool IsPending(std::string_view orderID) const;
    void RejectOrder(const std::string& orderID, const std::string& reason, Planning::AdapterActions& out);

    /// The drive has ended. The next drive or job repeats the actions of the vehicle's node that have not finished.
    [[nodiscard]] VehicleDrive TakeDrive();
    /// The deferred job follows when the unfinished actions of the vehicle's node have been repeated; otherwise it is rejected.
    [[nodiscard]] bool IsRepeating() const;
    void ReportDriveRejected(const std::string& orderID, const std::string& reason, Planning::AdapterActions& out);

    /// The vehicle has accepted the drive, which cannot be continued. It is reported as rejected when the vehicle has stopped.
    void AbandonDrive(const std::string& reason, Core::Now now, Planning::AdapterActions& out);
    /// After each event that finds it due, because the vehicle may have been disconnected or have refused it.
    void CancelAbandoned(Core::Now now);

    /// Executes the actions of the session and reports its events to the engine.
    void Drain(Core::Now now, Planning::AdapterActions& out);
    void HandleAction(const VDA5050::MasterAction& action, Core::Now now, Planning::AdapterActions& out);
    void OnState(Core::Now now, Planning::AdapterActions& out);
    void OnPosition(const VDA5050::PositionReceived& received, Planning::AdapterActions& out);
    void OnNodeReached(const VDA5050::NodeReached& reached, Planning::AdapterActions& out);
    void OnActionChanged(const VDA5050::ActionChanged& action, Planning::AdapterActions& out);
    void OnDriveAction(const VDA5050::ActionChanged& action, Core::Now now, Planning::AdapterActions& out);
    void OnActionFailed(const std::string& reason, Planning::AdapterActions& out);
    void OnRejected(const VDA5050::OrderRejected& rejected, Core::Now now, Planning::AdapterActions& out);
    void OnDriveRejected(const std::string& reason, Planning::AdapterActions& out);
    void OnLost(const VDA5050::OrderLost& lost, Planning::AdapterActions& out);
    void OnFinished(const std::string& orderID, Core::Now now, Planning::AdapterActions& out);
    void OnDriveFinished(const std::string& orderID, Core::Now now, Planning::AdapterActions& out);
    void OnCancelled(const std::string& orderID, Core::Now now, Planning::AdapterActions& out);
    void SetOnline(bool bOnline, Core::Now now, Planning::AdapterActions& out);
    /// The factsheet was received, or is no longer awaited.
    void OnFactsheet(Core::Now now, Planning::AdapterActions& out);
    void UpdateJobCheck(Planning::AdapterActions& out);
    void UpdateCompatibility(Core::Now now, Planning::AdapterActions& out);
};

} // namespace ACS::Acsd
