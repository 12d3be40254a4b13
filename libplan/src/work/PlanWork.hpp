#pragma once

#include "control/ControlAnswers.hpp"
#include "control/LoadWatch.hpp"
#include "dispatch/PortCheck.hpp"
#include "dispatch/StatusPublisher.hpp"
#include "transaction/EngineState.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// Carries a plan through its steps and jobs to its end.
class PlanWork
{
    const EngineOptions& _options;
    Core::IRandom& _random;
    PlanBook& _plans;
    Fleet& _fleet;
    AlarmBook& _alarms;
    EngineTransaction& _transaction;
    CallRecord& _call;
    ControlAnswers& _answers;
    LoadWatch& _loads;
    StatusPublisher& _status;

public:
    PlanWork(EngineState& engine, ControlAnswers& answers, LoadWatch& loads, StatusPublisher& status);

    void BeginPlan(ActivePlan& plan, Robot& robot);
    void BeginStep(ActivePlan& plan, Robot& robot);
    void MarkStepBegun(ActivePlan& plan);
    /// The robot is at the last node before its step's place, or there.
    void MarkArrived(Robot& robot);
    /// Arrival is reported before the robot docks. A robot whose drive is to be cancelled has not arrived.
    void UpdateApproach(Robot& robot);
    /// The robot stands at its step's place and can work.
    void BeginWork(Robot& robot);
    void EndJob(Robot& robot, std::string message);
    /// On to the next step that is not skipped, or to the end.
    void LeaveStep(Robot& robot);
    /// The robot stands: its status, the plan's and the result leave in this order.
    void ConfirmPause(Robot& robot);
    /// Section 6.14: the job, its step and the plan at once; nothing about what never ran.
    void FailPlan(ActivePlan& plan, const std::string& reason);
    /// The robot is free again, the plan is history. The plan lives to the end of this call. A control that is under way has
    /// its answer in that.
    void EndPlan(ActivePlan& plan, EPlanState state, const std::string& message);
    void EndByControl(ActivePlan& plan, EPlanControl control);
    /// The robot is told to give its job up, and is not used before it has told the job's end.
    void DropJob(Robot& robot);
    [[nodiscard]] Alarm MakeDroppedAlarm(const Robot& robot) const;
    /// The job is not repeated, and the robot gets no other work, until an operator has checked.
    void SuspendJob(Robot& robot, const std::string& reason);
    /// Aborting the plan does not require an operator to resolve its job.
    void AbortUnresolvedJob(Robot& robot);
    /// Nothing is open any more about the job that the robot was commanded.
    void ReleaseJob(Robot& robot);
    /// As soon as the robot stands at the place and may work. The ID is usually that of the job which is released here.
    void RepeatJob(Robot& robot, std::string commandID);
    /// The robot has reported the outcome of the job.
    void EndRecovery(Robot& robot);
    void StartJobTimer(Robot& robot, Core::Duration limit);
    void StopJobTimer(Robot& robot);

private:
    void BeginJob(Robot& robot);
    void LimitJob(Robot& robot);
    /// With the next job or step, unless the plan is to begin nothing further.
    void ContinuePlan(Robot& robot);
    /// What comes after a job.
    void BeginNext(Robot& robot);
    void RaiseDropped(const Robot& robot);
    /// Instead of beginning the present job.
    void SuspendDoubtfulJob(Robot& robot);
    [[nodiscard]] Alarm MakeUnresolvedAlarm(const Robot& robot) const;
};

} // namespace ACS::Planning
