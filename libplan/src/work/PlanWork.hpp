#pragma once

#include "control/ControlAnswers.hpp"
#include "control/LoadWatch.hpp"
#include "dispatch/PortCheck.hpp"
#include "dispatch/StatusPublisher.hpp"
#include "transaction/EngineState.hpp"
#include "work/PlanAssignment.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// Executes a plan: its steps, jobs and end. Decides what follows a job, and suspends a job whose outcome is unknown.
class PlanWork
{
    const EngineOptions& _options;
    const SiteMap& _site;
    const RestartHold& _hold;
    Core::IRandom& _random;
    PlanBook& _plans;
    JobTimes& _jobTimes;
    Fleet& _fleet;
    AlarmBook& _alarms;
    EngineTransaction& _transaction;
    ControlAnswers& _answers;
    LoadWatch& _loads;
    StatusPublisher& _status;
    PlanAssignment _assignment;

public:
    PlanWork(EngineState& engine, ControlAnswers& answers, LoadWatch& loads, StatusPublisher& status);

    [[nodiscard]] PlanAssignment& GetAssignment() noexcept;
    /// The robot moves to the step's station: the step is InProgress.
    void MarkStepBegun(ActivePlan& plan);
    /// The robot is at the last node before its step's station, or at the station.
    void MarkArrived(Robot& robot);
    /// Reports Arrival on the last node before the station, unless the drive is being cancelled.
    void UpdateApproach(Robot& robot);
    /// The robot is at its step's station and can work.
    void BeginWork(Robot& robot);
    /// The present job is done: the plan continues.
    void EndJob(Robot& robot, std::string message);
    /// Continues with the next step that is not skipped, or ends the plan.
    void LeaveStep(Robot& robot);
    /// The robot has stopped: reports its status, the plan's state and the result, in this order.
    void ConfirmPause(Robot& robot);
    /// Fails the present job, its step and the plan; jobs and steps that never ran are not reported (section 6.14).
    void FailPlan(ActivePlan& plan, const std::string& reason);
    /// Ends the plan, answers its open control and frees the robot. References to the plan stay valid until the end of the call.
    void EndPlan(ActivePlan& plan, EPlanState state, const std::string& message);
    /// Ends the plan as Cancelled or Aborted.
    void EndByControl(ActivePlan& plan, EPlanControl control);
    /// Commands the robot to cancel its job. The robot gets no work until it has reported the end of the job.
    void DropJob(Robot& robot);
    /// ACS-1007
    [[nodiscard]] static Alarm MakeDroppedAlarm(const Robot& robot);
    /// The outcome of the job is unknown: the robot gets no work until an operator resolves the job.
    void SuspendJob(Robot& robot, const std::string& reason);
    /// Aborts the plan without an operator resolving its job.
    void AbortUnresolvedJob(Robot& robot);
    /// Before an unresolved job is released without having been done: its robot must not continue it.
    void AbandonJob(Robot& robot);
    /// Asks the robot after a restart for the outcome of a resolved job: its arm may still run the program.
    void RecoverResolvedJob(Robot& robot);
    /// The job is closed, and its alarm is cleared.
    void ReleaseJob(Robot& robot);
    /// Commands the job again once the robot may work; with the same commandID if the robot never had the job.
    void RepeatJob(Robot& robot, std::string commandID);
    /// The robot has reported the outcome of the job.
    void EndRecovery(Robot& robot);
    /// Limits the time of the present job as its action demands.
    void LimitJob(Robot& robot);
    void StartJobTimer(Robot& robot, Core::Duration limit);
    void StopJobTimer(Robot& robot);

private:
    void BeginJob(Robot& robot);
    /// Continues with the next job or step, unless the plan is paused.
    void ContinuePlan(Robot& robot);
    /// Begins the next step, or the next job if the robot can work.
    void BeginNext(Robot& robot);
    /// Raises ACS-1007 if the job moves something.
    void RaiseDropped(const Robot& robot);
    /// Suspends the present job instead of commanding it.
    void SuspendUnresolvedJob(Robot& robot);
    [[nodiscard]] static Alarm MakeUnresolvedAlarm(const Robot& robot);
};

} // namespace ACS::Planning
