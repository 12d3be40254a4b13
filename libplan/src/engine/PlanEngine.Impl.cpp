#include "engine/PlanEngine.Impl.hpp"

#include "control/ErrorWatch.hpp"
#include "dispatch/QueuePass.hpp"
#include "robot/ValidState.hpp"
#include <acs/core/Overloaded.hpp>

#include <algorithm>
#include <cassert>
#include <utility>

namespace ACS::Planning
{

PlanEngine::Impl::Impl(EngineOptions options, SiteMap site, Core::IRandom& random)
    : _engine(std::move(options), std::move(site), random),
      _tsc(_engine),
      _answers(_engine),
      _charging(_engine),
      _loads(_engine),
      _stalls(_engine),
      _rejections(_engine),
      _places(_engine),
      _waiting(_engine, _tsc, _places),
      _coordinator(_engine, _answers, _charging, _places, _waiting),
      _dispatcher(_engine, _coordinator),
      _waits(_engine, _tsc, _stalls, _waiting, _coordinator, _dispatcher),
      _status(_engine, _stalls, _waiting, _waits.GetReasons()),
      _work(_engine, _answers, _loads, _status),
      _jobs(_engine, _loads, _rejections, _work),
      _controls(_engine, _tsc, _answers, _waiting, _coordinator, _status, _work),
      _drives(_engine, _tsc, _answers, _rejections, _places, _waiting, _coordinator, _work, _controls),
      _submission(_engine, _tsc, _waits.GetReasons()),
      _operator(_engine, _loads, _stalls, _rejections, _places, _coordinator, _work, _jobs),
      _recovery(_engine, _tsc, _answers, _places, _status, _work),
      _store(_engine, _answers, _places, _work)
{
    assert(FindErrors(_engine.options, _engine.site).empty());
    for (Robot& robot : _engine.fleet)
    {
        robot.parking.homeNode = _charging.GetHomeOrNull(robot);
        robot.parking.chargeNode = _charging.GetChargeNodeOrNull(robot);
        _status.Reset(robot);
    }
    _coordinator.AssignParking();
}

void PlanEngine::Impl::HandleCommand(const PlanCommand& command)
{
    std::visit(
        Core::Overloaded{
            [this](const SubmitPlan& submit) { _submission.Submit(submit); },
            [this](const ControlPlan& control) { _controls.Control(control); },
            [this](const MessageAcknowledged& acknowledged) { _store.Acknowledge(acknowledged); },
            [this](const ControlTSC& control) { _tsc.SwitchTSC(control); },
            [this](const ResolveJob& resolve) { _operator.Resolve(resolve); },
            [this](const SetMaintenance& maintenance) { _operator.Maintain(maintenance); },
            [this](const ClearAlarms& clear) { _operator.ClearByOperator(clear); },
            [this](const SetCarriers& carriers) { _operator.CorrectCarriers(carriers); },
            [this](const SkipStep& skip) { _operator.Skip(skip); },
            [this](const SetPlanPriority& priority) { _operator.ChangePriority(priority); },
            [this](const BlockPlace& block) {
                _work.GetAssignment().WithdrawOffers(EOffers::All); // to robots that may have no way now
                _operator.GetBlocks().Add(block);
            },
            [this](const UnblockPlace& unblock) {
                _operator.GetBlocks().Remove(unblock);
            }},
        command);
}

void PlanEngine::Impl::HandleEvent(Robot& robot, const RobotEvent& event)
{
    std::visit(
        Core::Overloaded{
            [this, &robot](const LinkChanged& typed) { OnLink(robot, typed); },
            [this, &robot](const StateChanged& typed) { OnState(robot, typed); },
            [this, &robot](const NodePassed& typed) { _drives.OnNodePassed(robot, typed); },
            [this, &robot](const Arrived& typed) { _drives.OnArrived(robot, typed); },
            [this, &robot](const DriveRejected& typed) { _drives.OnDriveRejected(robot, typed); },
            [this, &robot](const DriveCancelled& typed) { _drives.OnDriveCancelled(robot, typed); },
            [this, &robot](const JobStarted& typed) { _jobs.OnJobStarted(robot, typed); },
            [this, &robot](const JobFinished& typed) { _jobs.OnJobFinished(robot, typed); },
            [this, &robot](const JobFailed& typed) { _jobs.OnJobFailed(robot, typed); },
            [this, &robot](const JobRejected& typed) { _jobs.OnJobRejected(robot, typed); },
            [this, &robot](const JobInterrupted& typed) { _jobs.OnJobInterrupted(robot, typed); },
            [this, &robot](const JobUnknown& typed) { _jobs.OnJobUnknown(robot, typed); },
            [this, &robot](const JobUnresolved& typed) { _jobs.OnJobUnresolved(robot, typed); },
            [this, &robot](const JobCheckChanged& typed) {
                _dispatcher.OnJobCheck(robot, typed);
                _rejections.OnRobotChanged(robot);
            },
            [this, &robot](const CompatibilityChanged& typed) {
                _rejections.OnCompatibility(robot, typed);
            }},
        event);
}

void PlanEngine::Impl::OnEngineTimer(EEngineTimer kind)
{
    switch (kind)
    {
        case EEngineTimer::Dispatch:
            _submission.ReportAccepted();
            _engine.transaction.RequestDispatch();
            break;
        case EEngineTimer::StoreRetry:
            _engine.backlog.OnRetryDue(); // stored at the end of the call
            break;
        case EEngineTimer::Acknowledged:
            _store.StoreAcknowledged();
            break;
        case EEngineTimer::AlarmQuiet:
            _engine.transaction.OnAlarmQuiet();
            break;
        case EEngineTimer::Startup:
            _recovery.OnStartupDue();
            break;
        case EEngineTimer::DriveExtension:
        case EEngineTimer::ControlConfirm:
        case EEngineTimer::JobTimeout:
        case EEngineTimer::HomeRetry:
        case EEngineTimer::JobEnd:
        case EEngineTimer::ChargeRetry:
        case EEngineTimer::DriveStall:
        case EEngineTimer::RejectionRetry:
        case EEngineTimer::DriveWait:
        case EEngineTimer::LoadAlarm:
        default:
            break;
    }
}

void PlanEngine::Impl::OnRobotTimer(EEngineTimer kind, Robot& robot)
{
    switch (kind)
    {
        case EEngineTimer::DriveExtension:
            _coordinator.OnExtensionDue(robot);
            break;
        case EEngineTimer::ControlConfirm:
            _controls.OnControlTimeout(robot);
            break;
        case EEngineTimer::JobTimeout:
            _jobs.OnJobTimeout(robot);
            break;
        case EEngineTimer::HomeRetry:
            _coordinator.OnHomeRetry(robot);
            break;
        case EEngineTimer::JobEnd:
            _jobs.OnJobEndTimeout(robot);
            break;
        case EEngineTimer::ChargeRetry:
            _charging.OnChargeRetry(robot);
            break;
        case EEngineTimer::DriveStall:
            _stalls.OnDriveStall(robot);
            break;
        case EEngineTimer::DriveWait:
            _waits.OnWaitDue(robot);
            break;
        case EEngineTimer::RejectionRetry:
            _rejections.OnRetryDue(robot);
            break;
        case EEngineTimer::LoadAlarm:
            _loads.OnLoadAlarmTimer(robot);
            break;
        case EEngineTimer::Dispatch:
        case EEngineTimer::StoreRetry:
        case EEngineTimer::Acknowledged:
        case EEngineTimer::Startup:
        case EEngineTimer::AlarmQuiet:
        default:
            assert(false && "not a timer of a robot");
            break;
    }
}

void PlanEngine::Impl::Begin(Core::Now now)
{
    assert(!_store.IsStoring());
    _engine.transaction.SetNow(now);
    _engine.plans.BeginCall(now.steady);
    _store.CheckStoreRecovery();
    _engine.call.Begin();
}

void PlanEngine::Impl::End(EngineActions& out)
{
    _recovery.UpdateStartup();
    if (_engine.transaction.IsDispatchNeeded() && !_engine.startup.IsHoldingWork() && !_engine.hold.IsActive())
    {
        Dispatch();
    }
    _tsc.FinishTscPause();
    _stalls.UpdateStalls();
    _waits.UpdateWaits();
    _status.PublishStatusChanges();
    _engine.transaction.WatchOutbox();
    _engine.transaction.WatchAlarms();
    _store.Commit(out);
}

void PlanEngine::Impl::Dispatch()
{
    // Each pass may free what an earlier one waited for.
    while (_engine.transaction.TryBeginDispatch())
    {
        // The start of a plan must be stored before the plan is executed.
        const bool bAuto = _tsc.GetState() == ETscState::Auto;
        _work.GetAssignment().WithdrawOffers(bAuto ? EOffers::Unavailable : EOffers::All);
        if (bAuto && !_engine.backlog.IsFailing())
        {
            HandOverPlans();
            AssignPlans();
        }
        _drives.MoveWaiting();
        if (_tsc.CanDriveHome())
        {
            _drives.SendIdleHome();
        }
        _places.NoteAllMovable(); // A robot whose plan ended above may be out of service.
        _drives.ResolveDeadlocks();
        _charging.ChargeIdle();
    }
}

void PlanEngine::Impl::AssignPlans()
{
    if (_engine.plans.GetQueue().empty())
    {
        return;
    }
    FreeRobots free(_engine.fleet);
    if (free.IsEmpty())
    {
        return;
    }
    QueuePass pass(_engine, _coordinator.GetVisits(), _dispatcher, free);
    while (const std::optional<QueuePass::Choice> choice = pass.FindNextOrNull())
    {
        _work.GetAssignment().Offer(choice->plan, choice->robot);
    }
}

void PlanEngine::Impl::HandOverPlans()
{
    for (Robot& robot : _engine.fleet)
    {
        if (robot.planOrNull == nullptr || robot.drive.has_value())
        {
            continue;
        }
        ActivePlan& plan = *robot.planOrNull;
        if (!robot.IsUnfit() || !_work.GetAssignment().CanHandOver(plan))
        {
            continue;
        }
        if (Robot* successorOrNull = _dispatcher.FindNearestOrNull(plan); successorOrNull != nullptr)
        {
            _work.GetAssignment().HandOver(plan, *successorOrNull);
        }
    }
}

void PlanEngine::Impl::OnLink(Robot& robot, const LinkChanged& event)
{
    if (robot.view.bOnline == event.bOnline)
    {
        return;
    }
    robot.view.bOnline = event.bOnline;
    Alarm alarm = MakeLinkAlarm(robot.GetID(), "Robot disconnected. Check the robot and its network.");
    _engine.transaction.RequestDispatch();
    if (event.bOnline)
    {
        _engine.transaction.ClearAlarm(alarm);
        _rejections.OnRobotChanged(robot);
        return;
    }
    // The state is outdated when the robot reconnects.
    robot.view.state.reset();
    robot.charging.OnLinkLost();
    _engine.transaction.RaiseAlarm(std::move(alarm));
}

void PlanEngine::Impl::OnState(Robot& robot, const StateChanged& event)
{
    if (!robot.view.bOnline)
    {
        return;
    }
    const bool bWasUsable = robot.IsUsable();
    const bool bFirst = !robot.view.state.has_value();
    const bool bWasPaused = !bFirst && robot.view.state->bPaused;
    // A robot in manual mode may ignore commands.
    const bool bBack = bFirst || (!robot.view.state->bAutomatic && event.bAutomatic);
    const bool bErrorsChanged = !bFirst && robot.view.state->errors != event.errors;
    robot.view.state = MakeValidState(event, robot.view.state);
    robot.view.bHadPose = robot.view.bHadPose || robot.view.state->bPoseKnown;
    ErrorWatch(_engine).CompareErrors(robot);
    if (bBack || bErrorsChanged)
    {
        _rejections.OnRobotChanged(robot);
    }
    if (!robot.drive.has_value())
    {
        _places.Place(robot);
    }
    else
    {
        _coordinator.VerifyRoute(robot);
        if (event.bDriving && robot.drive->goal == EDriveGoal::Step && robot.planOrNull != nullptr)
        {
            _work.MarkStepBegun(*robot.planOrNull);
        }
    }
    robot.changes.MarkWork(robot.work.TryCheckEvidence(event, robot.planOrNull != nullptr));
    _loads.CompareLoads(robot);
    if (const auto jobID = bBack && event.bAutomatic ? robot.job.TakeCancelOrNull() : std::nullopt; jobID.has_value())
    {
        // Before it resumes: it would continue the job.
        robot.changes.MarkWork();
        _engine.transaction.Command(robot, CancelJob{*jobID});
    }
    _controls.UpdatePause(robot, bBack, bWasPaused);
    _controls.UpdateStandstill(robot);
    _charging.UpdateBattery(robot);
    if (robot.IsUsable() && !bWasUsable)
    {
        robot.parking.refusals = 0;
        _engine.transaction.RequestDispatch();
    }
}

} // namespace ACS::Planning
