#include "engine/PlanEngine.Impl.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace ACS::Planning
{

/// Section 6.7, register D-21, D-22. A plan without a robot is held in the queue; a robot that stands is just held; one
/// that drives or works must show that it has stopped.
void PlanEngine::Impl::Pause(ActivePlan& plan)
{
    const bool bPaused = plan.record.progress.state == EPlanState::Paused;
    if (bPaused && !plan.record.progress.control.has_value())
    {
        ReportControlResult(EPlanControl::Pause, plan.record.plan.planID, true, "The plan is paused already.");
        return;
    }
    Answer(plan, false, "PausePlan came in between.");
    Ask(plan, EPlanControl::Pause);
    if (!plan.robot.has_value())
    {
        _plans.Dequeue(plan);
        ChangePlan(plan, EPlanState::Paused, "Held in the queue by PausePlan.");
        Answer(plan, true, "The plan is held in the queue.");
        return;
    }
    Robot& robot = _robots[*plan.robot];
    const bool bWorks = robot.activity == EActivity::Works;
    if (bWorks && _options.controls.bPausesAfterJob)
    {
        return; // until the job ends
    }
    if (!bWorks && !robot.drive.has_value())
    {
        ConfirmPause(robot);
        return;
    }
    robot.pause.Pause();
    Command(robot, Planning::Pause{});
    StartConfirming(robot, _options.controls.pauseTimeout);
    UpdatePause(robot, false, false);
}

/// Section 6.8.
void PlanEngine::Impl::Resume(ActivePlan& plan)
{
    const std::string& planID = plan.record.plan.planID;
    if (plan.record.progress.state != EPlanState::Paused)
    {
        ReportControlResult(EPlanControl::Resume, planID, false, "The plan is not paused.");
        return;
    }
    if (_tscState != ETscState::Auto && plan.robot.has_value())
    {
        ReportControlResult(
            EPlanControl::Resume,
            planID,
            false,
            fmt::format("The TSC is {}: nothing is begun before it is Auto.", GetText(_tscState)));
        return;
    }
    Answer(plan, false, "ResumePlan came in between.");
    Ask(plan, EPlanControl::Resume);
    if (!plan.robot.has_value())
    {
        LeavePause(plan, "Resumed by ResumePlan.");
        _plans.Enqueue(plan);
        Answer(plan, true, "The plan waits in the queue again.");
        _bDispatchNeeded = true;
        return;
    }
    Robot& robot = _robots[*plan.robot];
    const bool bShowsPaused = robot.state.has_value() && robot.state->bPaused;
    if (!robot.pause.IsPaused() && !bShowsPaused)
    {
        ConfirmResume(robot);
        return;
    }
    robot.pause.Resume();
    Command(robot, Planning::Resume{});
    StartConfirming(robot, _options.controls.pauseTimeout);
}

/// What a robot's state says about a pause that was asked for, or that is to last. One that is back, in reach or under
/// control, may have missed what it was told.
void PlanEngine::Impl::UpdatePause(Robot& robot, bool bBack, bool bWasPaused)
{
    if (!robot.state.has_value())
    {
        return;
    }
    const StateChanged& state = *robot.state;
    const PauseTracker::ERepeat repeat = robot.pause.OnState(state.bPaused, bWasPaused, state.bAutomatic, bBack);
    if (repeat == PauseTracker::ERepeat::Resume)
    {
        Command(robot, Planning::Resume{});
    }
    else if (repeat == PauseTracker::ERepeat::Pause)
    {
        Note(robot, "is told once more to pause");
        Command(robot, Planning::Pause{});
    }
    const std::optional<EPlanControl> control =
        robot.planOrNull == nullptr ? std::nullopt : robot.planOrNull->record.progress.control;
    if (control == EPlanControl::Pause && robot.pause.IsPaused() && state.bPaused && !state.bDriving)
    {
        ConfirmPause(robot);
    }
    else if (control == EPlanControl::Resume && !state.bPaused)
    {
        ConfirmResume(robot);
    }
}

/// The robot stands: its status, the plan's and the result leave in this order.
void PlanEngine::Impl::ConfirmPause(Robot& robot)
{
    ActivePlan& plan = *robot.planOrNull;
    if (plan.jobDeadline.has_value())
    {
        const Core::Duration least = std::chrono::milliseconds(1);
        plan.jobTimeLeft = std::max(least, *plan.jobDeadline - _now.steady);
        StopJobTimer(robot);
    }
    PublishStatus(robot, ERobotStatus::Stopped);
    robot.bTouched = true;
    if (plan.record.progress.state != EPlanState::Paused)
    {
        ChangePlan(plan, EPlanState::Paused, "Paused by PausePlan.");
    }
    Answer(plan, true, "The plan is paused.");
}

/// The robot may go on: its status, the plan's and the result leave in this order.
void PlanEngine::Impl::ConfirmResume(Robot& robot)
{
    ActivePlan& plan = *robot.planOrNull;
    PublishStatus(robot, DeriveStatus(robot));
    LeavePause(plan, "Resumed by ResumePlan.");
    Answer(plan, true, "The plan goes on.");
    ContinueAfterControl(robot);
}

void PlanEngine::Impl::LeavePause(ActivePlan& plan, std::string message)
{
    ChangePlan(plan, plan.robot.has_value() ? EPlanState::InProgress : EPlanState::Pending, std::move(message));
}

/// The robot's own pause ends, where the engine has asked for it.
void PlanEngine::Impl::ReleasePause(Robot& robot)
{
    if (robot.pause.TryResume())
    {
        Command(robot, Planning::Resume{});
    }
}

/// Whether the robot's plan is to begin nothing further.
bool PlanEngine::Impl::IsHeld(const Robot& robot)
{
    const ActivePlan* planOrNull = robot.planOrNull;
    return planOrNull != nullptr
        && (planOrNull->record.progress.state == EPlanState::Paused
            || planOrNull->record.progress.control == EPlanControl::Pause);
}

} // namespace ACS::Planning
