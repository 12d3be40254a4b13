#pragma once

#include <acs/core/IRandom.hpp>
#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>
#include <acs/plan/EngineAction.hpp>
#include <acs/plan/EngineOptions.hpp>
#include <acs/plan/IPlanObserver.hpp>
#include <acs/plan/IPlanStore.hpp>
#include <acs/plan/PlanCommand.hpp>
#include <acs/plan/PlanRecord.hpp>
#include <acs/plan/RobotEvent.hpp>
#include <acs/plan/RobotStatus.hpp>
#include <acs/plan/SiteMap.hpp>
#include <acs/plan/WaitReason.hpp>

#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace ACS::Planning
{

/// Accepts plans, chooses robots, drives them, has their jobs done and reports everything once and in order. Pure: no I/O,
/// no clock, no thread; one thread at a time calls it. Every call appends actions to out, which the caller owns and
/// executes strictly in order before the next call; see EngineAction.hpp for what each demands. PlanEngineHost is the loop
/// around it.
///
/// The commit gate: a call whose changes must be stored returns StorePlans and withholds everything that depends on it (the
/// reply, reports, commands, timers). OnStored releases that, or what is done instead if the store has failed. Until then no
/// other call that changes the engine is allowed. A submitted plan is started by a later call (EEngineTimer::Dispatch), so
/// that its rejection for a failed store leaves no trace.
///
/// Traffic (docs/design/traffic.md): a node is held by one robot at a time. Nodes of a way are granted and released step by step,
/// only if afterwards all robots that could drive home one after another still can, and given back when the robot has told
/// of the next one. Robots that wait for one another are parted by sending one of them around or home first. A robot without
/// work goes home, and steps aside where it stands in somebody's way.
class PlanEngine
{
    class Impl;
    std::unique_ptr<Impl> _impl;

public:
    /// The options must be without mistakes (FindErrors). The random source makes transactionIDs and driveIDs; it
    /// must outlive the engine.
    PlanEngine(EngineOptions options, SiteMap site, Core::IRandom& random);
    PlanEngine(const PlanEngine&) = delete;
    PlanEngine& operator=(const PlanEngine&) = delete;
    ~PlanEngine();

    /// The observer must outlive the engine. At most one; call before anything else.
    void SetObserver(IPlanObserver& observer);

    /// Once, before any command or event: what the store held. Plans stay in their states and with their robots, paused ones
    /// and those held in the queue included, and controls whose outcome was open still owe it. Each robot is asked what
    /// became of a job whose end nobody heard (RecoverJob); where it cannot tell, the job is held with a heavy alarm until
    /// ResolveJob or AbortPlan. Drives are begun anew; nobody sets out before every robot has told its place, or
    /// EngineOptions::restartWait has passed. Unacknowledged reports are in GetUnacknowledged.
    void Restore(StoredState state, Core::Now now, EngineActions& out);

    /// Whatever it asks for: what cannot be done is refused by the ReplyCommand, with the reason.
    void Handle(const PlanCommand& command, Core::Now now, EngineActions& out);

    /// Plans that have come together, with one StorePlans for all of them: a store on disk takes many in the time of one.
    /// Otherwise as if each had been handled by itself, in this order.
    void Submit(std::span<const SubmitPlan> plans, Core::Now now, EngineActions& out);

    /// Events of robots that are not configured are ignored, and those of a drive or a job that is not the robot's present one.
    void Handle(std::string_view robotID, const RobotEvent& event, Core::Now now, EngineActions& out);

    /// A timer that was started has come to its end, and was neither cancelled nor started again since. One that comes late
    /// delays what it is for, and nothing else.
    void OnTimer(const EngineTimer& timer, Core::Now now, EngineActions& out);

    /// The batch of StorePlans is on disk, or could not be stored; call it exactly once for each StorePlans. On success the
    /// withheld actions are released. On failure plans of the batch are rejected and running ones continue: their commands
    /// are released, their reports wait until the store works again.
    void OnStored(const Core::Result<void>& result, Core::Now now, EngineActions& out);

    /// Whether OnStored is due.
    [[nodiscard]] bool IsStoring() const noexcept;

    /// The store has shown that it would fail (IPlanStore::Check), with no batch on its way: as if one had failed. It is tried
    /// again until it works.
    void OnStoreLost(std::string_view reason, Core::Now now, EngineActions& out);

    /// Reports that the MCS has not acknowledged, oldest first: what is sent again after a registration. Those that are
    /// held back for a failing store are not in it.
    [[nodiscard]] std::vector<OutboxEntry> GetUnacknowledged() const;

    /// Of the same reports, without a copy of them.
    [[nodiscard]] OutboxSummary GetOutboxSummary() const;

    /// One per configured robot, in the order of the options.
    [[nodiscard]] std::vector<RobotStatus> GetRobotStatuses() const;

    /// Of the robots that have told their position.
    [[nodiscard]] std::vector<RobotPose> GetRobotPoses() const;

    /// In progress, then paused, then pending, each in the order of the queue.
    [[nodiscard]] std::vector<PlanSummary> GetActivePlans() const;

    /// nullopt where the plan is not known (any more).
    [[nodiscard]] std::optional<PlanSummary> GetPlanOrNull(std::string_view planID) const;

    /// Of every plan that does not go on at this moment: those that are paused, those whose robot stands without working,
    /// then the queue in its order.
    [[nodiscard]] std::vector<WaitReason> GetWaitReasons() const;

    /// Why the engine would refuse the command at this moment; nullopt where it would not.
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(const SetCarriers& command) const;
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(const ResolveJob& command) const;
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(const SkipStep& command) const;

    /// nullopt where the plan is not known, is finished or goes on.
    [[nodiscard]] std::optional<WaitReason> GetWaitReasonOrNull(std::string_view planID) const;

    [[nodiscard]] const std::vector<Alarm>& GetActiveAlarms() const noexcept;

    [[nodiscard]] ETscState GetTscState() const noexcept;
};

} // namespace ACS::Planning
