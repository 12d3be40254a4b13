#include "work/PlanControls.hpp"

#include <fmt/format.h>

#include <cassert>
#include <utility>

namespace ACS::Planning
{

namespace
{

constexpr const char* RECEIVED = "Received.";
constexpr const char* STORE_FAILING = "The request cannot be stored because the store is failing. Send it again.";

std::string DescribeResume(const ActivePlan& plan)
{
    return fmt::format("Resumed by {}.", ControlAnswers::DescribeOrigin(plan, EPlanControl::Resume));
}

} // namespace

PlanControls::PlanControls(
    EngineState& engine,
    const TscControl& tsc,
    ControlAnswers& answers,
    const WaitingRobots& waiting,
    TrafficCoordinator& coordinator,
    StatusPublisher& status,
    PlanWork& work)
    : _options(engine.options),
      _plans(engine.plans),
      _fleet(engine.fleet),
      _transaction(engine.transaction),
      _call(engine.call),
      _backlog(engine.backlog),
      _hold(engine.hold),
      _room(engine.room),
      _tsc(tsc),
      _answers(answers),
      _waiting(waiting),
      _coordinator(coordinator),
      _status(status),
      _assignment(work.GetAssignment()),
      _work(work)
{
}

void PlanControls::Control(const ControlPlan& command)
{
    if (command.origin == EControlOrigin::Operator)
    {
        ControlByOperator(command);
        return;
    }
    const bool bRepeated = _answers.IsRepetition(command);
    if (bRepeated)
    {
        if (_backlog.IsFailing() && _call.unstoredControlIDs.contains(ControlAnswers::MakeRequestID(command)))
        {
            _backlog.Withhold({command.replyToken, true, RECEIVED});
            return;
        }
        _transaction.Reply(command.replyToken, true, RECEIVED);
        return;
    }
    if (_backlog.IsFailing())
    {
        _transaction.Reply(command.replyToken, false, STORE_FAILING);
        return;
    }
    if (!_room.HasRoomForControl())
    {
        _transaction.Reply(
            command.replyToken,
            false,
            "Outbox Full: the request has no room for its result. Acknowledge reports, then send it again.");
        return;
    }
    _call.control = command;
    ActivePlan* planOrNull = _plans.FindActiveOrNull(command.planID);
    if (planOrNull == nullptr)
    {
        _answers.RefuseControl(command);
        return;
    }
    _transaction.Reply(command.replyToken, true, RECEIVED);
    ActivePlan& plan = *planOrNull;
    _answers.Remember(plan.record.progress, command);
    if (plan.record.progress.control == command.control)
    {
        ++plan.record.progress.controlCount;
        _plans.MarkProgressed(command.planID);
        return;
    }
    if (std::optional<std::string> reason = DescribeObstacleOrNull(command.control, plan))
    {
        _answers.ReportControlResult(command.control, command.planID, false, std::move(*reason));
        return;
    }
    Apply(command.control, command.origin, plan);
}

void PlanControls::ControlByOperator(const ControlPlan& command)
{
    if (std::optional<std::string> reason = GetRejectionReasonOrNull(command))
    {
        _transaction.Reply(command.replyToken, false, std::move(*reason));
        return;
    }
    _call.control = command;
    ActivePlan& plan = *_plans.FindActiveOrNull(command.planID);
    if (plan.record.progress.control != command.control)
    {
        Apply(command.control, command.origin, plan);
    }
    _transaction.Reply(
        command.replyToken,
        true,
        plan.record.progress.control.has_value()
            ? fmt::format("{}Plan of {} is in progress.", GetText(command.control), command.planID)
            : fmt::format("Plan {} is {}.", command.planID, GetText(plan.record.progress.state)));
}

std::optional<std::string> PlanControls::GetRejectionReasonOrNull(const ControlPlan& command) const
{
    const ActivePlan* planOrNull = _plans.FindActiveOrNull(command.planID);
    if (planOrNull == nullptr)
    {
        return _answers.DescribeInactive(command.planID);
    }
    const PlanProgress& progress = planOrNull->record.progress;
    if (_backlog.IsFailing())
    {
        return STORE_FAILING;
    }
    if (progress.controlCount > 0)
    {
        return fmt::format(
            "The MCS has {}Plan in progress for this plan. Wait for its result.",
            GetText(progress.control.value_or(command.control)));
    }
    // The reports of an end are among those that an accepted plan has room for.
    const bool bEnds = command.control == EPlanControl::Cancel || command.control == EPlanControl::Abort;
    if (!bEnds && !_room.HasRoomForControl())
    {
        return "Outbox Full: there is no room for the reports of the plan. Send the request again when the MCS has "
               "acknowledged reports.";
    }
    return progress.control == command.control ? std::nullopt : DescribeObstacleOrNull(command.control, *planOrNull);
}

std::optional<std::string> PlanControls::DescribeObstacleOrNull(EPlanControl control, const ActivePlan& plan) const
{
    const PlanProgress& progress = plan.record.progress;
    const bool bEnding = progress.control == EPlanControl::Abort
        || (progress.control == EPlanControl::Cancel && control != EPlanControl::Abort);
    if (bEnding)
    {
        return fmt::format("{}Plan is already in progress for this plan.", GetText(*progress.control));
    }
    if (control == EPlanControl::Cancel && !IsCancellable(plan))
    {
        return _options.controls.cancelUntil == ECancelWindow::Dispatch
            ? "The plan is assigned to a robot."
            : (plan.bJobBegun ? "The first job has started." : "The robot has arrived.");
    }
    if (control == EPlanControl::Resume && progress.state != EPlanState::Paused)
    {
        return "The plan is not paused.";
    }
    if (control == EPlanControl::Resume && _tsc.GetState() != ETscState::Auto && plan.robot.has_value())
    {
        return fmt::format("The TSC is {}. Resume the plan when it is Auto.", GetText(_tsc.GetState()));
    }
    return std::nullopt;
}

void PlanControls::Apply(EPlanControl control, EControlOrigin origin, ActivePlan& plan)
{
    switch (control)
    {
        case EPlanControl::Cancel:
            Cancel(plan, origin);
            break;
        case EPlanControl::Abort:
            Abort(plan, origin);
            break;
        case EPlanControl::Pause:
            Pause(plan, origin);
            break;
        case EPlanControl::Resume:
            Resume(plan, origin);
            break;
        default:
            assert(false && "a control has no case");
            break;
    }
}

void PlanControls::Cancel(ActivePlan& plan, EControlOrigin origin)
{
    _answers.Answer(plan, false, "Superseded by CancelPlan.");
    StopDrive(plan, EPlanControl::Cancel, origin);
}

void PlanControls::Abort(ActivePlan& plan, EControlOrigin origin)
{
    _answers.Answer(plan, false, "Superseded by AbortPlan.");
    const bool bJobRuns = plan.robot.has_value() && _fleet[*plan.robot].activity == EActivity::Works;
    if (!bJobRuns)
    {
        StopDrive(plan, EPlanControl::Abort, origin);
        return;
    }
    Robot& robot = _fleet[*plan.robot];
    _answers.Ask(plan, EPlanControl::Abort, origin);
    if (robot.job.IsUnresolved())
    {
        _work.AbortUnresolvedJob(robot);
        return;
    }
    const bool bPaused = plan.record.progress.state == EPlanState::Paused;
    const bool bFinishes = bPaused ? _options.controls.bAbortFinishesPausedJob : !_options.controls.bAbortStopsJob;
    if (!bFinishes)
    {
        _work.DropJob(robot);
        _work.EndByControl(plan, EPlanControl::Abort);
        return;
    }
    _answers.ReleasePause(robot);
    if (plan.jobClock.timeLeft.has_value())
    {
        _work.StartJobTimer(robot, *std::exchange(plan.jobClock.timeLeft, std::nullopt));
    }
}

bool PlanControls::IsCancellable(const ActivePlan& plan) const
{
    switch (_options.controls.cancelUntil)
    {
        case ECancelWindow::Dispatch:
            return !plan.robot.has_value() || IsOffered(plan);
        case ECancelWindow::FirstJob:
            return !plan.bJobBegun;
        case ECancelWindow::FirstArrival:
        default:
            return !plan.record.progress.bArrived;
    }
}

void PlanControls::StopDrive(ActivePlan& plan, EPlanControl control, EControlOrigin origin)
{
    _answers.Ask(plan, control, origin);
    Robot* robotOrNull = plan.robot.has_value() ? &_fleet[*plan.robot] : nullptr;
    if (robotOrNull == nullptr || !robotOrNull->drive.has_value() || robotOrNull->drive->goal == EDriveGoal::Home)
    {
        _work.EndByControl(plan, control);
        return;
    }
    if (std::exchange(robotOrNull->drive->cancellation, ECancellation::Awaited) != ECancellation::Awaited)
    {
        _transaction.Command(*robotOrNull, CancelDrive{robotOrNull->drive->driveID});
    }
    // A paused vehicle between two nodes may have to reach the next one before it can cancel its drive.
    _answers.ReleasePause(*robotOrNull);
    _answers.StartConfirming(*robotOrNull, _options.controls.cancelTimeout);
}

void PlanControls::ContinueAfterControl(Robot& robot)
{
    ActivePlan& plan = *robot.planOrNull;
    _answers.ReleasePause(robot);
    _transaction.RequestDispatch();
    robot.changes.MarkStatus();
    if (plan.next == EContinuation::End)
    {
        _work.EndPlan(plan, EPlanState::Completed, {});
        return;
    }
    if (plan.jobClock.timeLeft.has_value())
    {
        _work.StartJobTimer(robot, *std::exchange(plan.jobClock.timeLeft, std::nullopt));
    }
    if (plan.next == EContinuation::Step)
    {
        _assignment.BeginStep(plan, robot);
    }
    if (robot.drive.has_value())
    {
        _coordinator.ExtendBase(robot);
    }
}

void PlanControls::OnControlTimeout(Robot& robot)
{
    if (!std::exchange(robot.control.bConfirming, false))
    {
        return;
    }
    _coordinator.AbandonReroute(robot);
    if (robot.planOrNull == nullptr || !robot.planOrNull->record.progress.control.has_value())
    {
        return;
    }
    ActivePlan& plan = *robot.planOrNull;
    const EPlanControl control = *plan.record.progress.control;
    if (robot.drive.has_value())
    {
        robot.drive->StopAwaitingCancellation();
        _work.UpdateApproach(robot);
    }
    const bool bStaysPaused = control != EPlanControl::Pause && plan.record.progress.state == EPlanState::Paused;
    if (bStaysPaused)
    {
        _answers.Answer(
            plan,
            false,
            control == EPlanControl::Resume ? "The robot did not confirm that it resumed; the plan stays paused."
                                            : "The robot did not confirm that it stopped; the plan stays paused.");
        robot.control.pause.Pause();
        _transaction.Command(robot, Planning::Pause{});
        return;
    }
    if (plan.record.progress.state == EPlanState::Paused)
    {
        _answers.LeavePause(plan, "The pause has failed: the robot did not confirm that it stopped.");
    }
    _answers.Answer(plan, false, "The robot did not confirm that it stopped; the plan continues.");
    ContinueAfterControl(robot);
}

void PlanControls::Pause(ActivePlan& plan, EControlOrigin origin)
{
    const bool bPaused = plan.record.progress.state == EPlanState::Paused;
    if (bPaused && !plan.record.progress.control.has_value())
    {
        if (origin == EControlOrigin::MCS)
        {
            const std::string& planID = plan.record.plan.planID;
            _answers.ReportControlResult(EPlanControl::Pause, planID, true, "The plan is already paused.");
        }
        return;
    }
    _answers.Answer(plan, false, "Superseded by PausePlan.");
    if (IsOffered(plan) && !_fleet[*plan.robot].drive.has_value())
    {
        _assignment.Withdraw(plan);
    }
    _assignment.Start(plan); // its robot may have accepted the drive and not shown it yet
    _answers.Ask(plan, EPlanControl::Pause, origin);
    if (!plan.robot.has_value())
    {
        _plans.Dequeue(plan);
        _transaction.ChangePlan(
            plan,
            EPlanState::Paused,
            fmt::format("Held in the queue by {}.", ControlAnswers::DescribeOrigin(plan, EPlanControl::Pause)));
        _answers.Answer(plan, true, "The plan is held in the queue.");
        return;
    }
    Robot& robot = _fleet[*plan.robot];
    const bool bWorks = robot.activity == EActivity::Works;
    if (bWorks && _options.controls.bPausesAfterJob)
    {
        return; // confirmed at the end of the job
    }
    if (!bWorks && !robot.drive.has_value())
    {
        _work.ConfirmPause(robot);
        return;
    }
    _call.bResumeInterrupted = robot.control.pause.IsResuming();
    robot.control.pause.Pause();
    _transaction.Command(robot, Planning::Pause{});
    _answers.StartConfirming(robot, _options.controls.pauseTimeout);
    UpdatePause(robot, false, false);
}

void PlanControls::Resume(ActivePlan& plan, EControlOrigin origin)
{
    _answers.Answer(plan, false, "Superseded by ResumePlan.");
    _answers.Ask(plan, EPlanControl::Resume, origin);
    if (!plan.robot.has_value())
    {
        _answers.LeavePause(plan, DescribeResume(plan));
        _plans.Enqueue(plan);
        _answers.Answer(plan, true, "The plan is back in the queue.");
        _transaction.RequestDispatch();
        return;
    }
    Robot& robot = _fleet[*plan.robot];
    const bool bShowsPaused = robot.view.state.has_value() && robot.view.state->bPaused;
    if (!robot.control.pause.IsPaused() && !bShowsPaused)
    {
        ConfirmResume(robot, plan);
        return;
    }
    robot.control.pause.Resume();
    _transaction.Command(robot, Planning::Resume{});
    _answers.StartConfirming(robot, _options.controls.pauseTimeout);
}

void PlanControls::UpdatePause(Robot& robot, bool bBack, bool bWasPaused)
{
    if (!robot.view.state.has_value())
    {
        return;
    }
    const StateChanged& state = *robot.view.state;
    // During the hold of the restart it has not been commanded to resume, whatever it shows.
    const bool bResumesLater = _hold.IsActive() && robot.control.pause.IsResuming();
    const PauseTracker::ERepeat repeat = bResumesLater
        ? PauseTracker::ERepeat::None
        : robot.control.pause.OnState(state.bPaused, bWasPaused, state.bAutomatic, bBack);
    if (repeat == PauseTracker::ERepeat::Resume)
    {
        _transaction.Command(robot, Planning::Resume{});
    }
    else if (repeat == PauseTracker::ERepeat::Pause)
    {
        _transaction.Note(robot, "pause command repeated");
        _transaction.Command(robot, Planning::Pause{});
    }
    if (robot.planOrNull == nullptr)
    {
        return;
    }
    ActivePlan& plan = *robot.planOrNull;
    const std::optional<EPlanControl> control = plan.record.progress.control;
    if (control == EPlanControl::Pause && robot.control.pause.IsPaused() && state.bPaused && !state.bDriving)
    {
        _work.ConfirmPause(robot);
    }
    else if (control == EPlanControl::Resume && !state.bPaused)
    {
        ConfirmResume(robot, plan);
    }
}

void PlanControls::ConfirmResume(Robot& robot, ActivePlan& plan)
{
    _status.PublishStatus(robot, _status.DeriveStatus(robot));
    _answers.LeavePause(plan, DescribeResume(plan));
    _answers.Answer(plan, true, "The plan continues.");
    ContinueAfterControl(robot);
}

void PlanControls::UpdateStandstill(Robot& robot)
{
    const StateChanged& state = *robot.view.state;
    if (!robot.control.bStandstillAwaited || !robot.place.bPlaced || state.bOccupied || state.bDriving)
    {
        return;
    }
    robot.control.bStandstillAwaited = false;
    ActivePlan& plan = *robot.planOrNull;
    const EPlanControl control = *plan.record.progress.control;
    const bool bArrived = robot.place.IsOn(_waiting.GetTargetOrNull(robot));
    if (control != EPlanControl::Cancel || !bArrived || _options.controls.cancelUntil == ECancelWindow::FirstJob)
    {
        _work.EndByControl(plan, control);
        return;
    }
    _work.MarkArrived(robot);
    _answers.Answer(plan, false, "The robot has arrived.");
    if (plan.record.progress.state != EPlanState::Paused)
    {
        ContinueAfterControl(robot);
    }
}

} // namespace ACS::Planning
