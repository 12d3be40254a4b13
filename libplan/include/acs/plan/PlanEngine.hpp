#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/IRandom.hpp>
#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>
#include <acs/plan/Block.hpp>
#include <acs/plan/EngineAction.hpp>
#include <acs/plan/EngineOptions.hpp>
#include <acs/plan/IPlanObserver.hpp>
#include <acs/plan/IPlanStore.hpp>
#include <acs/plan/OfferedCommand.hpp>
#include <acs/plan/PlanCommand.hpp>
#include <acs/plan/PlanRecord.hpp>
#include <acs/plan/RobotEvent.hpp>
#include <acs/plan/RobotStatus.hpp>
#include <acs/plan/SiteMap.hpp>
#include <acs/plan/StoreLog.hpp>
#include <acs/plan/WaitReason.hpp>

#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Planning
{

/// Accepts plans, assigns robots, drives them, commands their jobs and reports every change once and in order. Does no I/O and
/// has no clock and no thread. Called by one thread at a time. Every call appends actions to out. The caller owns out and
/// executes the actions strictly in order before the next call; EngineAction.hpp describes each of them. PlanEngineHost is
/// the loop around the engine.
///
/// Storing: a call whose changes must be stored appends StorePlans and withholds the actions that depend on it (reply,
/// reports, commands, timers). OnStored appends them or, after a failure, other actions. Until then no other call that
/// changes the engine is allowed. A submitted plan is started by a later call (EEngineTimer::Dispatch), so that a plan that
/// could not be stored has no effect.
///
/// Traffic (docs/design/traffic.md): a node is reserved for at most one robot. Further nodes of a route are granted only if
/// the state stays safe: all robots that could leave the lanes one after another, to their parking positions or to other dead ends,
/// still can. A reservation ends when the robot has reported the next node. A deadlock is resolved by a detour of one robot, or by
/// sending it to its parking position or another dead end. A robot without a plan drives to its parking position, and yields if it
/// blocks another robot. A plan begins when no other robot is expected at its first two stations at the same time; plans that share
/// a station begin in the queue's order.
class ACS_API PlanEngine
{
    class ACS_HIDDEN Impl;
    std::unique_ptr<Impl> _impl;

public:
    /// The options must be valid (FindErrors). The random source generates transactionIDs and commandIDs; it must outlive the
    /// engine.
    PlanEngine(EngineOptions options, SiteMap site, Core::IRandom& random);
    PlanEngine(const PlanEngine&) = delete;
    PlanEngine& operator=(const PlanEngine&) = delete;
    ~PlanEngine();

    /// The observers must outlive the engine. They are called in the order in which they were added. Add them before any other
    /// call.
    void AddObserver(IPlanObserver& observer);

    /// Restores the content of the store. Call it once, before any command or event. Plans keep their states and robots, and
    /// pending controls are still answered by a result report. A robot whose job has no reported end receives RecoverJob; a
    /// job whose outcome cannot be known becomes unresolved, with a heavy alarm, until ResolveJob, SkipStep or AbortPlan.
    /// Drives are started again, but none before every robot has reported its position or EngineOptions::restartWait has
    /// passed. Unacknowledged reports are in GetUnacknowledged.
    void Restore(StoredState state, Core::Now now, EngineActions& out);

    /// Handles a command. If it cannot be executed, it is rejected by ReplyCommand with the reason.
    void Handle(const PlanCommand& command, Core::Now now, EngineActions& out);

    /// Handles several commands in this order with a single StorePlans, because a store on disk needs about the same time for
    /// many changes as for one. Either all are SubmitPlan, or none is SubmitPlan or ControlPlan. The same StorePlans has the
    /// receipts of the commands that are not refused, also if they change nothing.
    void Handle(std::span<const OfferedCommand> commands, Core::Now now, EngineActions& out);

    /// Handles an event of a robot. Ignored if the robot is not configured, or if the event belongs to another drive or job
    /// than the robot's current one.
    void Handle(std::string_view robotID, const RobotEvent& event, Core::Now now, EngineActions& out);

    /// A timer has expired and was neither cancelled nor restarted since. A late call delays only what the timer is for.
    void OnTimer(const EngineTimer& timer, Core::Now now, EngineActions& out);

    /// The result of StorePlans; call it exactly once for each. On success the withheld actions are appended. On failure
    /// submitted plans of the batch are rejected; running plans continue: their commands are appended, their reports wait
    /// until the store works again.
    void OnStored(const Core::Result<void>& result, Core::Now now, EngineActions& out);

    /// Whether a StorePlans has no OnStored yet.
    [[nodiscard]] bool IsStoring() const noexcept;

    /// IPlanStore::Check has failed. Handled as a failed batch: storing is retried until it succeeds. Not allowed while
    /// IsStoring.
    void OnStoreLost(std::string_view reason, Core::Now now, EngineActions& out);

    /// The result of IPlanStore::CheckLog. Raises ACS-1021 if the log cannot be merged and is longer than
    /// EngineOptions::maximumLogBytes, or less than this is free on its file system; clears it when the log was merged.
    void OnStoreLog(const StoreLog& log, Core::Now now, EngineActions& out);

    /// The reports that the MCS has not acknowledged, oldest first: those to replay after a registration. Reports that are
    /// withheld because the store fails are not included.
    [[nodiscard]] std::vector<OutboxEntry> GetUnacknowledged() const;

    /// Number and age of the same reports, without copying them.
    [[nodiscard]] OutboxSummary GetOutboxSummary() const;

    /// One per configured robot, in the order of EngineOptions::robots.
    [[nodiscard]] std::vector<RobotStatus> GetRobotStatuses() const;

    /// Only of robots that have reported their position.
    [[nodiscard]] std::vector<RobotPose> GetRobotPoses() const;

    /// One for every robot.
    [[nodiscard]] std::vector<RobotDetail> GetRobotDetails() const;

    /// One for every robot.
    [[nodiscard]] std::vector<RobotRoute> GetRobotRoutes() const;

    /// In progress, then paused, then pending, each in the order of the queue. Without the plans whose acceptance is being
    /// stored: they are refused if that fails.
    [[nodiscard]] std::vector<PlanSummary> GetActivePlans() const;

    /// nullopt if the plan is unknown or was deleted.
    [[nodiscard]] std::optional<PlanSummary> GetPlanOrNull(std::string_view planID) const;

    /// The whole record of a plan that GetPlanOrNull finds. Valid until the next call that changes the engine.
    [[nodiscard]] const PlanRecord* GetPlanRecordOrNull(std::string_view planID) const;

    /// The records of GetActivePlans, in its order. Valid until the next call that changes the engine.
    [[nodiscard]] std::vector<std::reference_wrapper<const PlanRecord>> GetActivePlanRecords() const;

    /// The finished plans that are kept (EngineOptions::finishedPlansKept), at most limit, those that ended last first. Valid
    /// until the next call that changes the engine.
    [[nodiscard]] std::vector<std::reference_wrapper<const PlanRecord>> GetFinishedPlanRecords(std::size_t limit) const;

    /// One for every plan that makes no progress now: paused plans, plans whose robot neither drives nor works, then the queue
    /// in its order. The lists of robots are limited (MAXIMUM_LISTED_ROBOTS).
    [[nodiscard]] std::vector<WaitReason> GetWaitReasons() const;

    /// Why the engine would reject the command now; nullopt if it would accept it.
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(const SetCarriers& command) const;
    /// Likewise.
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(const ResolveJob& command) const;
    /// Likewise.
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(const SkipStep& command) const;

    /// Likewise.
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(const SetPlanPriority& command) const;
    /// Likewise.
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(const BlockPlace& command) const;
    /// Likewise.
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(const UnblockPlace& command) const;
    /// Likewise; the command is taken as an operator's.
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(const ControlPlan& command) const;

    /// nullopt if the plan is unknown, is finished or makes progress.
    [[nodiscard]] std::optional<WaitReason> GetWaitReasonOrNull(std::string_view planID) const;

    /// The alarms that are set.
    [[nodiscard]] const std::vector<Alarm>& GetActiveAlarms() const noexcept;

    /// In the order in which they were set. Those whose id is not on the map (any more) have no effect.
    [[nodiscard]] const std::vector<Block>& GetBlocks() const noexcept;

    /// As passed to the constructor.
    [[nodiscard]] const EngineOptions& GetOptions() const noexcept;

    /// As passed to the constructor.
    [[nodiscard]] const SiteMap& GetSite() const noexcept;

    /// Whether plans are executed.
    [[nodiscard]] ETscState GetTscState() const noexcept;

    /// Why the TSC has been Paused since the start (StoredState::holdReason), until the operator resumes it; otherwise empty.
    [[nodiscard]] const std::string& GetHoldReason() const noexcept;

    /// Why GetTscState is Paused although no operator has paused the TSC since the start: GetHoldReason, or that not all robots
    /// have reported, which ends by itself at the latest after EngineOptions::restartWait; otherwise empty.
    [[nodiscard]] std::string_view GetTscReason() const noexcept;
};

} // namespace ACS::Planning
