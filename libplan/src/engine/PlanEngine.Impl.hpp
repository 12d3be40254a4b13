#pragma once

#include "engine/AlarmBook.hpp"
#include "engine/CommitGate.hpp"
#include "engine/EngineAlarm.hpp"
#include "engine/StoreBacklog.hpp"
#include "plan/PlanAdmission.hpp"
#include "plan/PlanBook.hpp"
#include "restart/StartupBarrier.hpp"
#include "restart/WorkRecord.hpp"
#include "robot/ActiveDrive.hpp"
#include "robot/ChargingPolicy.hpp"
#include "robot/JobTracker.hpp"
#include "robot/PauseTracker.hpp"
#include "robot/PortLedger.hpp"
#include "robot/StallMonitor.hpp"
#include "traffic/Traffic.hpp"
#include <acs/plan/PlanEngine.hpp>
#include <acs/plan/PlanTransitions.hpp>
#include <acs/plan/ReportOutbox.hpp>
#include <acs/plan/Router.hpp>

#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Planning
{

class PlanEngine::Impl
{
public:
    enum class EActivity : std::uint8_t
    {
        Idle,  ///< No plan.
        Waits, ///< Has a plan and must get to its step's place.
        Works, ///< A job runs.
    };

    /// Why a robot can neither be driven nor work.
    enum class EUnavailability : std::uint8_t
    {
        None,
        Link,
        Place,
        Maintenance,
        Error,
        SafetyStop,
        Paused,
        Manual,
        Occupied,
    };

    /// Whether a robot's ports fit a plan.
    struct PortVerdict
    {
        std::optional<std::string> unavailabilityOrNull;
        bool bSupposed = false; ///< A carrier that the plan unloads is not on record: it was put on by hand, if at all.
    };

    /// A robot yields to the leader until the leader has reached its target, or has another one.
    struct Yield
    {
        std::size_t leader = 0;
        std::optional<std::uint64_t> planSequence; ///< nullopt: the leader goes home.
        std::size_t step = 0;
    };

    struct Robot
    {
        std::size_t index = 0;
        const RobotOptions* options = nullptr;
        ActivePlan* planOrNull = nullptr;
        std::uint64_t refusedAt = 0; ///< Traffic::GetFreedCount then.
        std::uint64_t detourAt = 0;
        std::size_t detourTarget = 0;
        std::size_t detours = 0;                   ///< Driven on the way to its present step.
        std::shared_ptr<const IJobCheck> jobCheck; ///< Null: no job is rejected.
        std::optional<std::size_t> node;           ///< The node it stands on or has passed last.
        std::optional<std::size_t> homeNode;       ///< Its target without work; with a low battery its chargeNode.
        std::optional<std::size_t> chargeNode;
        std::optional<std::size_t> retreatNode; ///< Its next target, to clear the route of others.
        std::optional<std::size_t> parkingNode; ///< Its home or, without one, where it blocks no robot.
        /// After a restart: the stored nodes where it may be; once it has reported its node, those of them that are ahead.
        std::vector<std::size_t> possibleNodes;
        std::vector<std::size_t> heldNodes; ///< Without a drive: its node and those to which it may still drive.
        /// Without a drive: nodes after its own on its former route that it may have reached, or may still reach.
        std::vector<std::size_t> aheadNodes;
        std::vector<std::size_t> blockers; ///< Robots that blocked its last attempt to drive.
        std::string position;              ///< The last station at which it stood.
        std::optional<Yield> yield;
        StallMonitor stall;
        PortLedger ports;
        std::optional<PlannedRoute> plannedRoute; ///< The quickest route to its target, kept while it waits.
        std::optional<PlannedRoute>
            detour; ///< Around the robots that blocked the route at detourAt (_standingChanges).
        RobotStatus lastStatus;
        std::optional<StateChanged> state;
        std::optional<ActiveDrive> drive;
        JobTracker job;
        WorkRecord work;
        unsigned homeRefusals = 0; ///< In a row, without a move and without becoming available again.
        bool bOnline = false;
        bool bPlaced = false;      ///< Its position is known since the start.
        bool bHomeRefused = false; ///< Until the timer HomeRetry.
        bool bTouched = true;      ///< Its status may have changed.
        bool bConfirming = false;  ///< The timer ControlConfirm runs.
        bool bInMaintenance = false;
        EActivity activity = EActivity::Idle;
        PauseTracker pause;
        bool bStandstillAwaited = false; ///< After a restart: the plan's control is answered once it stands.
        bool bWorkTouched = false;       ///< Its WorkRecord may have changed.
        ChargingPolicy charging;
    };

private:
    EngineOptions _options;
    SiteMap _site;
    Core::IRandom& _random;
    IPlanObserver* _observerOrNull = nullptr;
    Router _router;
    PlanAdmission _admission;
    Traffic _traffic;
    std::uint64_t _standingChanges = 1; ///< Grows when a robot stops, starts, or becomes movable or not.

    PlanBook _plans;
    std::vector<std::string> _begun;             ///< Plans begun in the call that is being stored.
    std::map<ReplyToken, std::string> _repeated; ///< Plans that were submitted again in this call.
    std::optional<std::string> _asked;           ///< The control of this call, as in PlanProgress::requestIDs.
    std::set<std::string> _unstoredIDs;          ///< Controls that could not be stored; likewise.
    std::vector<std::string> _unreported;        ///< Accepted, PlanReport(Pending) not sent.
    ETscState _tscState = ETscState::Auto;

    std::vector<Robot> _robots;
    std::map<std::string, std::size_t, std::less<>> _robotIndices;
    AlarmBook _alarms;
    ReportOutbox _outbox;

    StartupBarrier _startup;
    CommitGate _gate;

    // The present call: the changes are stored before the actions are released.
    Core::Now _now;
    std::vector<StoreChange> _changes;
    EngineActions _actions;
    bool _bDispatchNeeded = false;

    StoreBacklog _backlog;
    std::vector<StoreChange> _acknowledged; ///< Stored with the next batch, or by the timer.

public:
    Impl(EngineOptions options, SiteMap site, Core::IRandom& random);

    void SetObserver(IPlanObserver& observer);
    void Restore(StoredState state, Core::Now now, EngineActions& out);
    void HandleCommand(const PlanCommand& command, Core::Now now, EngineActions& out);
    void SubmitAll(std::span<const SubmitPlan> plans, Core::Now now, EngineActions& out);
    void HandleEvent(std::string_view robotID, const RobotEvent& event, Core::Now now, EngineActions& out);
    void OnTimer(const EngineTimer& timer, Core::Now now, EngineActions& out);
    void OnStored(const Core::Result<void>& result, Core::Now now, EngineActions& out);
    [[nodiscard]] bool IsStoring() const noexcept;
    void OnStoreLost(std::string_view reason, Core::Now now, EngineActions& out);

    [[nodiscard]] std::vector<OutboxEntry> GetUnacknowledged() const;
    [[nodiscard]] OutboxSummary GetOutboxSummary() const;
    [[nodiscard]] std::vector<RobotStatus> GetRobotStatuses() const;
    [[nodiscard]] std::vector<RobotPose> GetRobotPoses() const;
    [[nodiscard]] std::vector<PlanSummary> GetActivePlans() const;
    [[nodiscard]] std::optional<PlanSummary> GetPlanOrNull(std::string_view planID) const;
    [[nodiscard]] std::vector<WaitReason> GetWaitReasons() const;
    [[nodiscard]] std::optional<WaitReason> GetWaitReasonOrNull(std::string_view planID) const;
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(const SetCarriers& command) const;
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(const SettleJob& command) const;
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(const SkipStep& command) const;
    [[nodiscard]] const std::vector<Alarm>& GetActiveAlarms() const noexcept;
    [[nodiscard]] ETscState GetTscState() const noexcept;

private:
    // Of every call: begin, end, and the only places where states change (PlanEngine.Impl.cpp).
    void Begin(Core::Now now);
    void CollectWork();
    void End(EngineActions& out);
    std::string_view AddReport(Report report);
    void WatchOutbox();
    void PublishStatusChanges();
    void PublishStatus(Robot& robot, ERobotStatus status);
    void StartTimer(EEngineTimer kind, const std::string& robotID, Core::Duration delay);
    void CancelTimer(EEngineTimer kind, const std::string& robotID);
    void Command(Robot& robot, RobotCommand command);
    void Note(const Robot& robot, const std::string& text);
    void ChangePlan(ActivePlan& plan, EPlanState state, std::string message);
    void ChangeStep(ActivePlan& plan, EStepState state, std::string message);
    void ChangeStepAt(ActivePlan& plan, std::size_t index, EStepState state, std::string message);
    void ChangeJob(ActivePlan& plan, EJobState state, std::string message);
    void Store(std::vector<StoreChange> changes);
    void ReportAlarms(const std::vector<ErrorReport>& reports);
    void RaiseAlarm(Alarm alarm);
    void ClearAlarm(const Alarm& alarm);
    [[nodiscard]] ERobotStatus DeriveStatus(const Robot& robot) const;
    [[nodiscard]] ERobotStatus DeriveDriveStatus(const Robot& robot, const ActiveDrive& drive) const;
    [[nodiscard]] bool IsAtPlace(const Robot& robot) const;
    [[nodiscard]] std::string GetReportedPosition(const Robot& robot, ERobotStatus status) const;
    [[nodiscard]] std::string DescribeStatus(const Robot& robot) const;
    [[nodiscard]] RobotStatus MakeStatus(const Robot& robot, ERobotStatus status) const;
    [[nodiscard]] const std::string& GetRobotID(const Robot& robot) const;

    // Commands (PlanEngine.Commands.cpp).
    void Submit(const SubmitPlan& command);
    void ReportAccepted();
    void SwitchTsc(const ControlTsc& command);
    void ChangeTsc(ETscState state);
    void PublishTscState(ETscState from);
    void FinishTscPause();
    [[nodiscard]] bool CanDriveHome() const;
    void Acknowledge(const MessageAcknowledged& command);
    [[nodiscard]] Core::Result<ResolvedPlan> Admit(const Plan& plan) const;
    [[nodiscard]] bool IsRepetition(const Plan& plan, const std::string& transactionID) const;

    // What an operator asks for (PlanEngine.Operator.cpp).
    void Reply(ReplyToken token, bool bAccepted, std::string message);
    void Maintain(const SetMaintenance& command);
    void ClearByOperator(const ClearAlarms& command);
    void CorrectCarriers(const SetCarriers& command);
    void Skip(const SkipStep& command);
    void SkipUnresolved(Robot& robot);
    [[nodiscard]] Robot* FindRobotOrNull(std::string_view robotID);
    [[nodiscard]] bool HasCause(const Alarm& alarm) const;

    // Batteries (PlanEngine.Charging.cpp).
    void UpdateBattery(Robot& robot);
    void ChargeIdle();
    void EndCharging(Robot& robot);
    void OnChargeRetry(Robot& robot);
    [[nodiscard]] Alarm MakeChargeAlarm(const Robot& robot) const;
    [[nodiscard]] bool IsChargeDue(const Robot& robot) const;
    [[nodiscard]] std::optional<std::size_t> GetHomeOrNull(const Robot& robot) const;

    // Which robot takes which plan (PlanEngine.Choice.cpp).
    void AssignPlans();
    [[nodiscard]] Robot* FindNearestOrNull(const ActivePlan& plan);
    [[nodiscard]] Robot* FindQuickestOrNull(const ActivePlan& plan, const std::vector<Robot*>& robots) const;
    [[nodiscard]] static EUnavailability GetUnavailability(const Robot& robot);
    [[nodiscard]] static std::string Describe(const Robot& robot, EUnavailability unavailability);
    [[nodiscard]] static bool IsUsable(const Robot& robot);
    [[nodiscard]] static bool IsFree(const Robot& robot);
    [[nodiscard]] std::string DescribeUnfree(const Robot& robot) const;
    [[nodiscard]] bool HasWay(const ActivePlan& plan, const Robot& robot) const;
    [[nodiscard]] std::optional<std::size_t> FindPortOrNull(
        const Robot& robot,
        const std::optional<Core::Location>& place) const;
    [[nodiscard]] PortVerdict JudgePorts(const ActivePlan& plan, const Robot& robot) const;
    void JudgeJob(
        const Robot& robot,
        const ResolvedStep& step,
        std::size_t job,
        const std::string& carrierID,
        PortLedger::Contents& planned,
        PortVerdict& verdict) const;
    [[nodiscard]] static std::optional<std::string> DescribeMissingTrayOrNull(
        const Robot& robot,
        const ResolvedJob& job,
        const PortLedger::Contents& planned);
    [[nodiscard]] static std::optional<std::string> DescribeMissingTrayOrNull(const Robot& robot);
    [[nodiscard]] std::optional<std::string> DescribeLoadConflictOrNull(const Robot& robot, std::size_t port) const;
    [[nodiscard]] std::optional<std::string> DescribeUnloadConflictOrNull(
        const Robot& robot,
        std::size_t port,
        const std::string& carrierID) const;

    // Why plans wait (PlanEngine.WaitReasons.cpp).
    [[nodiscard]] std::optional<std::string> DescribeUnavailabilityOrNull(const ActivePlan& plan, const Robot& robot)
        const;
    [[nodiscard]] WaitReason DescribeWaiting(const ActivePlan& plan, std::size_t position) const;
    [[nodiscard]] std::optional<WaitReason> DescribeBegunOrNull(const ActivePlan& plan) const;
    [[nodiscard]] std::string DescribeStanding(const Robot& robot) const;

    // Control of plans (PlanEngine.Controls.cpp).
    void Control(const ControlPlan& command);
    void Apply(EPlanControl control, ActivePlan& plan);
    void RefuseControl(const ControlPlan& command);
    void Cancel(ActivePlan& plan);
    void Abort(ActivePlan& plan);
    [[nodiscard]] bool IsRepetition(const ControlPlan& command) const;
    void Remember(PlanProgress& progress, const ControlPlan& command);
    void Ask(ActivePlan& plan, EPlanControl control);
    void Answer(ActivePlan& plan, bool bSucceeded, const std::string& message);
    void StopDrive(ActivePlan& plan, EPlanControl control);
    void DropJob(Robot& robot);
    void RaiseDropped(const Robot& robot);
    [[nodiscard]] Alarm MakeDroppedAlarm(const Robot& robot) const;
    void EndByControl(ActivePlan& plan, EPlanControl control);
    void ContinueAfterControl(Robot& robot);
    void StartConfirming(Robot& robot, Core::Duration limit);
    void StopConfirming(Robot& robot);
    void StopConfirmingControl(Robot& robot);
    void OnControlTimeout(Robot& robot);
    void StartJobTimer(Robot& robot, Core::Duration limit);
    void StopJobTimer(Robot& robot);
    void ReportControlResult(EPlanControl control, const std::string& planID, bool bSucceeded, std::string message);
    [[nodiscard]] bool IsCancellable(const ActivePlan& plan) const;

    // Pausing and resuming (PlanEngine.Pause.cpp).
    void Pause(ActivePlan& plan);
    void Resume(ActivePlan& plan);
    void UpdatePause(Robot& robot, bool bBack, bool bWasPaused);
    void ConfirmPause(Robot& robot);
    void ConfirmResume(Robot& robot);
    void LeavePause(ActivePlan& plan, std::string message);
    void ReleasePause(Robot& robot);
    [[nodiscard]] static bool IsHeld(const Robot& robot);

    // Events of robots (PlanEngine.Robots.cpp).
    void OnLink(Robot& robot, const LinkChanged& event);
    void OnState(Robot& robot, const StateChanged& event);
    void OnNodePassed(Robot& robot, const NodePassed& event);
    void OnArrived(Robot& robot, const Arrived& event);
    void OnDriveRejected(Robot& robot, const DriveRejected& event);
    [[nodiscard]] static bool IsEnding(const Robot& robot);
    void OnDriveCancelled(Robot& robot, const DriveCancelled& event);
    void UpdateApproach(Robot& robot);
    [[nodiscard]] Alarm MakeLinkAlarm(const Robot& robot, std::string message) const;
    [[nodiscard]] Alarm MakePlaceAlarm(const Robot& robot, std::string message) const;
    void Place(Robot& robot);
    void OnPositionLost(Robot& robot);
    [[nodiscard]] std::vector<std::size_t> ListClaimed(const Robot& robot, std::size_t node) const;
    void CompareErrors(Robot& robot);
    [[nodiscard]] bool TryAdvance(Robot& robot, std::size_t routeIndex);
    void EndDrive(Robot& robot);

    // Outcomes of jobs (PlanEngine.Jobs.cpp).
    void OnJobStarted(Robot& robot, const JobStarted& event);
    void OnJobFinished(Robot& robot, const JobFinished& event);
    void OnJobFailed(Robot& robot, const JobFailed& event);
    void OnJobUnknown(Robot& robot, const JobUnknown& event);
    void OnJobUncertain(Robot& robot, const JobUncertain& event);
    void OnJobTimeout(Robot& robot);
    void OnJobEndTimeout(Robot& robot);
    [[nodiscard]] bool TryEndOverdueJob(Robot& robot, const std::string& jobID, bool bDone);
    void SuspendDoubtfulJob(Robot& robot);
    void SuspendJob(Robot& robot, const std::string& reason);
    void AbortUnresolvedJob(Robot& robot);
    void EndRecovery(Robot& robot);
    void ReleaseJob(Robot& robot);
    void RepeatJob(Robot& robot, std::string commandID);
    [[nodiscard]] std::optional<std::size_t> FindWorkerOrNull(const SettleJob& command) const;
    void Settle(const SettleJob& command);
    void CatchUp(Robot& robot);
    void ApplyAnswer(Robot& robot, EJobAnswer answer);
    [[nodiscard]] Alarm MakeUnresolvedAlarm(const Robot& robot) const;

    // Which jobs a robot can do (PlanEngine.JobCheck.cpp).
    void OnJobCheck(Robot& robot, const JobCheckChanged& event);
    void CheckJobs(ActivePlan& plan, const Robot& robot) const;
    [[nodiscard]] bool IsRejectedByAll(const ActivePlan& plan) const;
    [[nodiscard]] std::string DescribeRejections(const ActivePlan& plan) const;

    // Stalled drives (PlanEngine.Progress.cpp).
    void UpdateStall(Robot& robot);
    void OnDriveStall(Robot& robot);
    [[nodiscard]] bool IsProgressExpected(const Robot& robot) const;
    [[nodiscard]] std::string DescribeStall(const Robot& robot) const;

    // Steps and jobs (PlanEngine.Work.cpp).
    void BeginPlan(ActivePlan& plan, Robot& robot);
    void BeginStep(ActivePlan& plan, Robot& robot);
    void MarkArrived(Robot& robot);
    void BeginWork(Robot& robot);
    void BeginJob(Robot& robot);
    void LimitJob(Robot& robot);
    void EndJob(Robot& robot, std::string message);
    void LeaveStep(Robot& robot);
    void ContinuePlan(Robot& robot);
    void BeginNext(Robot& robot);
    void MarkStepBegun(ActivePlan& plan);
    void FailPlan(ActivePlan& plan, const std::string& reason);
    void EndPlan(ActivePlan& plan, EPlanState state, const std::string& message);
    void MoveCarrier(Robot& robot, const StartJob& job);
    [[nodiscard]] std::vector<PortUse> ListPortUses(const Robot& robot, const StartJob& job) const;

    // What robots show on their ports (PlanEngine.Loads.cpp).
    void CompareLoads(Robot& robot);
    void UpdateLoadAlarm(Robot& robot);
    void OnLoadAlarmTimer(Robot& robot);
    [[nodiscard]] StartJob MakeStartJob(const Robot& robot) const;
    [[nodiscard]] StartJob MakeStartJob(
        const ActivePlan& plan,
        std::size_t stepIndex,
        std::size_t jobIndex,
        const Robot& robot) const;

    // Who does what (PlanEngine.Dispatch.cpp).
    void Dispatch();

    // Who drives when (PlanEngine.Traffic.cpp).
    void AssignParking();
    [[nodiscard]] bool CanParkAt(const RobotOptions& robot, std::size_t dock) const;
    void NoteMovable(const Robot& robot);
    void MoveWaiting();
    void ExtendDrives();
    void ExtendBase(Robot& robot);
    void SendIdleHome();
    [[nodiscard]] std::vector<Robot*> ListAwayFromHome();
    [[nodiscard]] std::vector<Robot*> GetWaiting();
    [[nodiscard]] std::optional<std::size_t> GetTargetOrNull(const Robot& robot) const;
    [[nodiscard]] std::vector<std::size_t> GetTargetHolders(const Robot& robot, std::size_t target) const;
    [[nodiscard]] bool TryDrive(Robot& robot);
    [[nodiscard]] bool TryBeginPlannedRoute(Robot& robot);
    [[nodiscard]] bool TryBeginDrive(Robot& robot, const PlannedRoute& plannedRoute);
    [[nodiscard]] bool TryPlanRoute(Robot& robot, std::size_t target);
    [[nodiscard]] std::optional<PlannedRoute> PlanRouteOrNull(
        const Robot& robot,
        std::size_t target,
        const Router::NodeFilter& isExcluded) const;
    [[nodiscard]] static bool CanAdvance(const Robot& robot);
    [[nodiscard]] bool CanServe(const Robot& robot, const ActivePlan& plan) const;
    [[nodiscard]] static bool IsMoreUrgent(const Robot* left, const Robot* right);
    void OnNoRoute(Robot& robot, std::size_t target);
    void RefuseHome(Robot& robot);

    // Robots that wait for one another (PlanEngine.Yielding.cpp).
    void ResolveDeadlocks();
    [[nodiscard]] bool IsMoving(const Robot& robot) const;
    [[nodiscard]] bool IsWaiting(const Robot& robot) const;
    [[nodiscard]] bool IsHelpable(const Robot& robot) const;
    [[nodiscard]] bool IsYielding(const Robot& robot) const;
    [[nodiscard]] std::vector<Robot*> ListDeadlocked();
    [[nodiscard]] std::vector<Robot*> GetBlockersOf(const Robot& start);
    [[nodiscard]] bool TryResolveDeadlock(const std::vector<Robot*>& stuck);
    [[nodiscard]] bool TryDetour(Robot& robot);
    [[nodiscard]] bool TryMakeWay(Robot& leader, const std::vector<Robot*>& stuck);
    [[nodiscard]] bool TryRetreat(Robot& robot, const Robot& leader);
    [[nodiscard]] bool TryStepAside(Robot& robot, const Robot& leader);
    [[nodiscard]] bool TryReroute(Robot& robot, PlannedRoute plannedRoute, bool bRetreats);
    void BeginReroute(Robot& robot, PlannedRoute plannedRoute, bool bRetreats);
    void AbandonReroute(Robot& robot);
    static void YieldTo(Robot& robot, const Robot& leader);

    // After a restart (PlanEngine.Recovery.cpp).
    void RestoreRobot(const RobotWorkChanged& work);
    void RestorePlan(PlanRecord record);
    void RestoreWork(ActivePlan& plan, Robot& robot);
    void RestoreControl(ActivePlan& plan, Robot& robot);
    void RestoreAlarms(std::vector<Alarm> alarms);
    void RestoreTsc(ETscState stored);
    void RestoreOverdue(Robot& robot);
    void EndUnfit(ActivePlan& plan, const std::string& reason);
    void UpdateStandstill(Robot& robot);
    void RequestJobOutcome(Robot& robot);

    // Waiting for the robots after a start (PlanEngine.Startup.cpp).
    [[nodiscard]] static bool IsPositionAwaited(const Robot& robot);
    void BeginStartup(bool bHasWork);
    void UpdateStartup();
    void EndStartup();
    void RaiseMissing();
    void ReservePossibleNodes();
    void ReleasePossibleNodes(std::span<const std::size_t> nodes);
    void ForgetPossibleNodes(Robot& robot);
    [[nodiscard]] static std::vector<std::size_t> ListPossibleAhead(const Robot& robot, std::size_t node);
    [[nodiscard]] std::vector<std::string> ListNodes(const Robot& robot) const;

    // Failures of the store (PlanEngine.StoreFailure.cpp).
    void CheckStoreRecovery();
    [[nodiscard]] std::size_t RecoverBatch(const StoreBatch& batch);
    void ReleaseWithoutStore(
        const EngineActions& withheld,
        bool bPlanRefused,
        std::string_view reason,
        EngineActions& out);
    [[nodiscard]] bool TryWithdraw(const CommandRobot& command);
    void WithdrawPause(Robot& robot);
    void ReportStoreFailure(std::string_view reason, EngineActions& out);
    void ReleaseActions(EngineActions& out);
    void StartStoreRetry(EngineActions& out);
    [[nodiscard]] static Alarm MakeStoreAlarm(std::string message);
};

/// The fields of a plan in section 4.3.
[[nodiscard]] PlanSummary MakeSummary(const PlanRecord& record);

} // namespace ACS::Planning
