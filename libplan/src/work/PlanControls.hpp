#pragma once

#include "control/ControlAnswers.hpp"
#include "control/TscControl.hpp"
#include "dispatch/StatusPublisher.hpp"
#include "traffic/TrafficCoordinator.hpp"
#include "traffic/WaitingRobots.hpp"
#include "transaction/EngineState.hpp"
#include "work/PlanWork.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// Handles CancelPlan, AbortPlan, PausePlan and ResumePlan (sections 6.5 to 6.8): decides when each succeeds or fails.
class PlanControls
{
    const EngineOptions& _options;
    PlanBook& _plans;
    Fleet& _fleet;
    EngineTransaction& _transaction;
    CallRecord& _call;
    StoreBacklog& _backlog;
    const RestartHold& _hold;
    const OutboxRoom& _room;
    const TscControl& _tsc;
    ControlAnswers& _answers;
    const WaitingRobots& _waiting;
    TrafficCoordinator& _coordinator;
    StatusPublisher& _status;
    PlanAssignment& _assignment;
    PlanWork& _work;

public:
    PlanControls(
        EngineState& engine,
        const TscControl& tsc,
        ControlAnswers& answers,
        const WaitingRobots& waiting,
        TrafficCoordinator& coordinator,
        StatusPublisher& status,
        PlanWork& work);

    /// Acknowledges the request and applies it.
    void Control(const ControlPlan& command);
    /// Why an operator's control would be refused now.
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(const ControlPlan& command) const;
    /// Continues what a pause or a failed control has delayed.
    void ContinueAfterControl(Robot& robot);
    /// The robot has not confirmed in time that it stopped or resumed: the control fails.
    void OnControlTimeout(Robot& robot);
    /// Confirms an open pause or resume from the robot's state, and repeats the command. bBack: the robot is connected or in
    /// automatic mode again, and may have missed a command.
    void UpdatePause(Robot& robot, bool bBack, bool bWasPaused);
    /// Completes a cancel or abort from before a restart once the robot is stationary.
    void UpdateStandstill(Robot& robot);

private:
    void ControlByOperator(const ControlPlan& command);
    /// Why the plan cannot be controlled now, for the MCS and for the operator.
    [[nodiscard]] std::optional<std::string> DescribeObstacleOrNull(EPlanControl control, const ActivePlan& plan) const;
    void Apply(EPlanControl control, EControlOrigin origin, ActivePlan& plan);
    void Cancel(ActivePlan& plan, EControlOrigin origin);
    /// Sections 6.6 and 6.14, register D-15, D-16.
    void Abort(ActivePlan& plan, EControlOrigin origin);
    /// Section 6.5, register D-14.
    [[nodiscard]] bool IsCancellable(const ActivePlan& plan) const;
    /// Ends the plan at once, or, if its robot drives to the step's station, when the robot has stopped.
    void StopDrive(ActivePlan& plan, EPlanControl control, EControlOrigin origin);
    /// Section 6.7, register D-21, D-22. A plan without a robot is held in the queue. A robot that drives or works must confirm
    /// that it has stopped.
    void Pause(ActivePlan& plan, EControlOrigin origin);
    /// Section 6.8.
    void Resume(ActivePlan& plan, EControlOrigin origin);
    /// The robot has resumed: reports its status, the plan's state and the result, in this order.
    void ConfirmResume(Robot& robot, ActivePlan& plan);
};

} // namespace ACS::Planning
