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

/// Cancels, aborts, pauses and resumes plans (sections 6.5 to 6.8).
class PlanControls
{
    const EngineOptions& _options;
    PlanBook& _plans;
    Fleet& _fleet;
    EngineTransaction& _transaction;
    CallRecord& _call;
    const StoreBacklog& _backlog;
    const TscControl& _tsc;
    ControlAnswers& _answers;
    const WaitingRobots& _waiting;
    TrafficCoordinator& _coordinator;
    StatusPublisher& _status;
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

    void Control(const ControlPlan& command);
    /// With what a pause, or a control that came to nothing, has held up.
    void ContinueAfterControl(Robot& robot);
    /// The robot has not shown in time that it stopped, or that it goes on: what was asked for came to nothing.
    void OnControlTimeout(Robot& robot);
    /// What a robot's state says about a pause that was asked for, or that is to last. One that is back, in reach or under
    /// control, may have missed what it was told.
    void UpdatePause(Robot& robot, bool bBack, bool bWasPaused);
    /// A drive that was to be cancelled before the restart: the adapter gives up what is left of it, and here it stands.
    void UpdateStandstill(Robot& robot);

private:
    void Apply(EPlanControl control, ActivePlan& plan);
    void Cancel(ActivePlan& plan);
    /// Sections 6.6 and 6.14, register D-15, D-16.
    void Abort(ActivePlan& plan);
    /// Section 6.5, register D-14.
    [[nodiscard]] bool IsCancellable(const ActivePlan& plan) const;
    /// Ends the plan at once, or, where its robot is under way to the step's place, when the robot stands.
    void StopDrive(ActivePlan& plan, EPlanControl control);
    /// Section 6.7, register D-21, D-22. A plan without a robot is held in the queue; a robot that stands is just held; one
    /// that drives or works must show that it has stopped.
    void Pause(ActivePlan& plan);
    /// Section 6.8.
    void Resume(ActivePlan& plan);
    /// The robot may go on: its status, the plan's and the result leave in this order.
    void ConfirmResume(Robot& robot);
};

} // namespace ACS::Planning
