#pragma once

#include "control/ChargingControl.hpp"
#include "control/ControlAnswers.hpp"
#include "control/LoadWatch.hpp"
#include "control/RejectionWatch.hpp"
#include "control/StallWatch.hpp"
#include "control/TscControl.hpp"
#include "dispatch/Dispatcher.hpp"
#include "dispatch/StatusPublisher.hpp"
#include "dispatch/WaitReasons.hpp"
#include "engine/OperatorCommands.hpp"
#include "engine/PlanSubmission.hpp"
#include "engine/RestartRecovery.hpp"
#include "engine/StoreGate.hpp"
#include "traffic/PlaceTracker.hpp"
#include "traffic/TrafficCoordinator.hpp"
#include "traffic/WaitingRobots.hpp"
#include "transaction/EngineState.hpp"
#include "work/DriveOutcomes.hpp"
#include "work/JobOutcomes.hpp"
#include "work/PlanControls.hpp"
#include "work/PlanWork.hpp"
#include <acs/plan/PlanEngine.hpp>

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Planning
{

/// Owns the parts. Routes each input to the part that handles it, dispatches until nothing is left to do, and commits the
/// call. A part calls only the parts that are declared before it.
class PlanEngine::Impl
{
    EngineState _engine;
    TscControl _tsc;
    ControlAnswers _answers;
    ChargingControl _charging;
    LoadWatch _loads;
    StallWatch _stalls;
    RejectionWatch _rejections;
    PlaceTracker _places;
    WaitingRobots _waiting;
    TrafficCoordinator _coordinator;
    Dispatcher _dispatcher;
    WaitReasons _waits;
    StatusPublisher _status;
    PlanWork _work;
    JobOutcomes _jobs;
    PlanControls _controls;
    DriveOutcomes _drives;
    PlanSubmission _submission;
    OperatorCommands _operator;
    RestartRecovery _recovery;
    StoreGate _store;

public:
    Impl(EngineOptions options, SiteMap site, Core::IRandom& random);

    void SetObserver(IPlanObserver& observer);
    void Restore(StoredState state, Core::Now now, EngineActions& out);
    void HandleCommands(
        std::span<const PlanCommand> commands,
        std::span<const CommandReceipt> receipts,
        Core::Now now,
        EngineActions& out);
    void HandleEvent(std::string_view robotID, const RobotEvent& event, Core::Now now, EngineActions& out);
    void OnTimer(const EngineTimer& timer, Core::Now now, EngineActions& out);
    void OnStored(const Core::Result<void>& result, Core::Now now, EngineActions& out);
    [[nodiscard]] bool IsStoring() const noexcept;
    void OnStoreLost(std::string_view reason, Core::Now now, EngineActions& out);
    void OnStoreLog(const StoreLog& log, Core::Now now, EngineActions& out);

    [[nodiscard]] std::vector<OutboxEntry> GetUnacknowledged() const;
    [[nodiscard]] OutboxSummary GetOutboxSummary() const;
    [[nodiscard]] std::vector<RobotStatus> GetRobotStatuses() const;
    [[nodiscard]] std::vector<RobotPose> GetRobotPoses() const;
    [[nodiscard]] std::vector<RobotDetail> GetRobotDetails() const;
    [[nodiscard]] std::vector<RobotRoute> GetRobotRoutes() const;
    [[nodiscard]] std::vector<PlanSummary> GetActivePlans() const;
    [[nodiscard]] std::optional<PlanSummary> GetPlanOrNull(std::string_view planID) const;
    [[nodiscard]] const PlanRecord* GetPlanRecordOrNull(std::string_view planID) const;
    [[nodiscard]] std::vector<std::reference_wrapper<const PlanRecord>> GetActivePlanRecords() const;
    [[nodiscard]] std::vector<std::reference_wrapper<const PlanRecord>> GetFinishedPlanRecords(std::size_t limit) const;
    [[nodiscard]] std::vector<WaitReason> GetWaitReasons() const;
    [[nodiscard]] std::optional<WaitReason> GetWaitReasonOrNull(std::string_view planID) const;
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(const SetCarriers& command) const;
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(const ResolveJob& command) const;
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(const SkipStep& command) const;
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(const ControlPlan& command) const;
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(const BlockPlace& command) const;
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(const UnblockPlace& command) const;
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(const SetPlanPriority& command) const;
    [[nodiscard]] const std::vector<Alarm>& GetActiveAlarms() const noexcept;
    [[nodiscard]] const std::vector<Block>& GetBlocks() const noexcept;
    [[nodiscard]] const EngineOptions& GetOptions() const noexcept;
    [[nodiscard]] const SiteMap& GetSite() const noexcept;
    [[nodiscard]] ETscState GetTscState() const noexcept;
    [[nodiscard]] const std::string& GetHoldReason() const noexcept;

private:
    void Begin(Core::Now now);
    void HandleCommand(const PlanCommand& command);
    void Dispatch();
    void AssignPlans();
    /// Gives plans of robots that reject their commands to other robots.
    void HandOverPlans();
    void End(EngineActions& out);
    void OnRobotTimer(EEngineTimer kind, Robot& robot);
    void OnLink(Robot& robot, const LinkChanged& event);
    void OnState(Robot& robot, const StateChanged& event);
};

} // namespace ACS::Planning
